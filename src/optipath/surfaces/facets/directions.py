"""Directions in which light comes to a surface and leaves it, and the frames that it has there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import SurfaceError
from optipath.light.frames import Frame
from optipath.light.given_vectors import rounding_in, vectors
from optipath.values.arrays.jax_values import check_known
from optipath.values.arrays.shapes import first_place

if TYPE_CHECKING:
    import numpy.typing as npt

_UNIT = 1e-8
_LAST_DIGITS = 2.0**-50
_LEVEL = 2.0**-52
"""The z of a direction that is along the surface, to rounding."""


def frame_along(name: str, direction: npt.ArrayLike, *, up: bool) -> Frame:
    """Return the frame of light that comes down to a surface, or goes up from it.

    Its x is perpendicular to the meridional plane, along (0, 0, 1) cross direction. Along the
    normal, where there is no such plane, it is (0, 1, 0), as for light beside it that travels on
    towards x.

    Shapes: direction (..., 3); returns (...).

    Examples
    --------
    >>> frame_along("outgoing", (0.6, 0.0, 0.8), up=True).x
    array([0., 1., 0.])
    """
    check_known(name, direction)
    given, rounding = vectors(name, direction), rounding_in(direction)
    # Of components of which each is at most 1, so that no square overflows.
    size = np.max(np.abs(given), axis=-1, initial=0.0, keepdims=True)
    given = given / np.where(size > 2.0, size / 2.0, 1.0)
    length = np.linalg.norm(given, axis=-1)
    if np.any(bad := np.abs(length - 1.0) > max(_UNIT, 2.0 * rounding)):
        raise SurfaceError(
            f"{name}{first_place(bad)} is no unit vector; divide it by its length, "
            f"v / np.linalg.norm(v, axis=-1, keepdims=True)"
        )
    # What is one to the last digits keeps them, by which directions next to each other differ.
    z = given / np.where(np.abs(length - 1.0) > _LAST_DIGITS, length, 1.0)[..., np.newaxis]
    _check_side(name, z[..., 2], max(rounding, _LEVEL), up=up)
    x = _across_meridian(z)
    return Frame.trusted(x, np.cross(z, x), z, rounding)


def _check_side(name: str, height: npt.NDArray[np.float64], level: float, *, up: bool) -> None:
    if np.any(bad := np.abs(height) < level):
        raise SurfaceError(
            f"{name}{first_place(bad)} is along the surface, which light that travels along it "
            f"does not meet; give an angle to the normal below 90 deg"
        )
    if np.any(bad := (height > 0.0) != up):
        way, sign = ("up from", "above") if up else ("down to", "below")
        raise SurfaceError(
            f"{name}{first_place(bad)} has z = {height[bad].flat[0]:.6g}; it is the direction in "
            f"which light travels {way} the surface, so give a z {sign} 0"
        )


def _across_meridian(z: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    size = np.hypot(z[..., 0], z[..., 1])[..., np.newaxis]
    along_normal = size == 0.0
    level = np.stack([-z[..., 1], z[..., 0], np.zeros(z.shape[:-1])], axis=-1)
    # Adding 0 turns -0 into 0.
    return np.where(along_normal, (0.0, 1.0, 0.0), level / np.where(along_normal, 1.0, size)) + 0.0
