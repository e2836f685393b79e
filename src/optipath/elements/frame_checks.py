"""Checks of the world frames and azimuths of an element's ports."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from optipath.light.frame import Frame


def same_frame(first: Frame, second: Frame) -> bool:
    """Tell whether two frames are one, to rounding."""
    pairs = ((first.x, second.x), (first.z, second.z))
    rounding = first.rounding_to(second)
    return all(bool(np.all(np.abs(one - other) <= rounding)) for one, other in pairs)


def share_x(first: Frame, second: Frame) -> bool:
    """Tell whether two frames have x along one line, as s is before and after a reflection."""
    across = np.linalg.norm(np.cross(first.x, second.x), axis=-1)
    return bool(np.all(across <= first.rounding_to(second)))


def x_faults(owner: str, frames: Mapping[str, Frame]) -> list[str]:
    """Return which ports have not the x of the first, as s is that of all ports of a boundary."""
    placed = list(frames.items())
    faulty = [port for port, frame in placed if not share_x(frame, placed[0][1])]
    if not faulty:
        return []
    ports = " and ".join(f"'{owner}.{port}'" for port in (placed[0][0], *faulty))
    return [f"the frames of {ports} must share one x, perpendicular to the plane of incidence"]


def incidence_between(arriving: Frame, reflected: Frame) -> npt.NDArray[np.float64]:
    """Return the angle of incidence in rad at which light is turned between directions."""
    across = np.linalg.norm(np.cross(arriving.z, reflected.z), axis=-1)
    against = -np.sum(arriving.z * reflected.z, axis=-1)
    return np.asarray(0.5 * np.arctan2(across, against))


def angle_between(first: Frame, second: Frame) -> npt.NDArray[np.float64]:
    """Return the angle in rad between the directions of two frames."""
    across = np.linalg.norm(np.cross(first.z, second.z), axis=-1)
    return np.asarray(np.arctan2(across, np.sum(first.z * second.z, axis=-1)))


def azimuth_at(element: Any, port: str) -> Any:
    """Return the azimuth in rad of a port; that of an element is that of its ``in``."""
    is_other = port != "in" and "in" in element.inputs
    return 0.0 if is_other else getattr(element, "azimuth", 0.0)
