"""The check of normals against the bisectors of a chain."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError
from optipath.frames import vectors

if TYPE_CHECKING:
    import numpy.typing as npt

_TOLERANCE = 1e-6
_STRAIGHT = 1e-7
"""A bisector shorter than this is known to fewer digits than normals are checked to."""


def normal_faults(chain: Any, normals: Any, count: int) -> list[str]:
    """Return which normals are not along the bisectors of their vertices, and by how much.

    Examples
    --------
    >>> chain = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> normal_faults(chain, [[0.0, -2.0, -2.0]], 1)
    []
    """
    if not isinstance(chain, np.ndarray):
        return ["normals are checked against points that are known; leave them out"]
    try:
        given = vectors("normals", normals)
        batch = np.broadcast_shapes(given.shape[:-2], chain.shape[:-2])
    except (FrameError, ValueError) as error:
        return [str(error)]
    if given.shape[-2:] != (count, 3):
        return [f"normals must have shape (..., {count}, 3), not {given.shape}"]
    if not np.all(np.any(given, axis=-1)):
        return ["a normal has no length; give one with a direction of its own"]
    off = np.broadcast_to(_off(chain, given), (*batch, count)).reshape(-1, count)
    if np.all(off <= _TOLERANCE):
        return []
    place = int(np.argmax(np.max(off, axis=0)))
    worst = int(np.argmax(off[:, place]))
    where = f" of chain {worst}" if batch else ""
    sentence = (
        f"the normal of vertex {place + 1}{where} is off the bisector of its legs by "
        f"{np.degrees(off[worst, place]):.3g} deg; it must be along it to within "
        f"{_TOLERANCE:g} rad, or be left out"
    )
    return [sentence]


def _off(chain: npt.NDArray[Any], normals: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return the angles between normals and bisectors.

    Light that goes straight on has none: its surfaces are all those along it.
    """
    unit = _units(np.diff(chain, axis=-2))
    normal, bisector = _units(normals), unit[..., 1:, :] - unit[..., :-1, :]
    along = np.abs(np.sum(normal * bisector, axis=-1))
    angle = np.arctan2(np.linalg.norm(np.cross(normal, bisector), axis=-1), along)
    straight = np.linalg.norm(bisector, axis=-1) < _STRAIGHT
    through = np.arcsin(np.minimum(np.abs(np.sum(normal * unit[..., 1:, :], axis=-1)), 1.0))
    return np.asarray(np.where(straight, through, angle))


def _units(several: npt.NDArray[Any]) -> npt.NDArray[Any]:
    length = np.linalg.norm(several, axis=-1, keepdims=True)
    return np.asarray(several / np.where(length > 0.0, length, 1.0))
