"""Checks of the world frames and azimuths of an element's ports."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from optipath.light.frame import Frame


def same_frame(first: Frame, second: Frame) -> bool:
    """Tell whether two frames are one, to rounding.

    >>> from optipath.light.frame import Frame
    >>> same_frame(Frame(), Frame().turned(0.1))
    False
    """
    pairs = ((first.x, second.x), (first.z, second.z))
    rounding = first.rounding_to(second)
    return all(bool(np.all(np.abs(one - other) <= rounding)) for one, other in pairs)


def share_x(first: Frame, second: Frame) -> bool:
    """Tell whether two frames have x along one line, as s is before and after a reflection.

    >>> from optipath.light.frame import Frame
    >>> share_x(Frame(), Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0)))
    True
    """
    across = np.linalg.norm(np.cross(first.x, second.x), axis=-1)
    return bool(np.all(across <= first.rounding_to(second)))


def x_faults(owner: str, frames: Mapping[str, Frame]) -> list[str]:
    """Return which ports have not the x of the first, as s is that of all ports of a boundary."""
    first, *others = frames.items() or [("", None)]
    faulty = [port for port, frame in others if not share_x(frame, first[1])]
    if not faulty:
        return []
    ports = " and ".join(f"'{owner}.{port}'" for port in (first[0], *faulty))
    return [f"the frames of {ports} must share one x, perpendicular to the plane of incidence"]


def incidence_between(arriving: Frame, reflected: Frame) -> npt.NDArray[np.float64]:
    """Return the angle of incidence in rad at which light is turned between directions.

    >>> from optipath.light.frame import Frame
    >>> to_the_side = Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    >>> float(np.degrees(incidence_between(Frame(), to_the_side)).round(9))
    45.0
    """
    across = np.linalg.norm(np.cross(arriving.z, reflected.z), axis=-1)
    against = -np.sum(arriving.z * reflected.z, axis=-1)
    return np.asarray(0.5 * np.arctan2(across, against))


def angle_between(first: Frame, second: Frame) -> npt.NDArray[np.float64]:
    """Return the angle in rad between the directions of two frames.

    >>> from optipath.light.frame import Frame
    >>> aside = Frame.from_direction(z=(0, 1, 1), x=(1, 0, 0))
    >>> float(np.degrees(angle_between(Frame(), aside)).round(9))
    45.0
    """
    across = np.linalg.norm(np.cross(first.z, second.z), axis=-1)
    return np.asarray(np.arctan2(across, np.sum(first.z * second.z, axis=-1)))


def azimuth_at(element: Any, port: str) -> Any:
    """Return the azimuth in rad of a port; that of an element is that of its ``in``.

    >>> from optipath import Interface
    >>> pane = Interface(1.5, 0.8, azimuth=0.3)
    >>> azimuth_at(pane, "in"), azimuth_at(pane, "back")
    (0.3, 0.0)
    """
    is_other = port != "in" and "in" in element.inputs
    return 0.0 if is_other else getattr(element, "azimuth", 0.0)
