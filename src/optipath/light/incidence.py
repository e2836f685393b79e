"""The plane in which light meets a surface: its axis s, the frames before and behind, the angle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import FrameError, shown
from optipath.kernels.geometry.vectors import Vector, cross, dot
from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.frames import Frame
from optipath.light.given_vectors import rounding_in, vectors
from optipath.light.underflow import normalise_exponent
from optipath.values.arrays.shapes import check_broadcast

if TYPE_CHECKING:
    import numpy.typing as npt

# A sine below this is the rounding of the directions, and tells no plane.
_PARALLEL = 2.0**-50


class PlaneOfIncidence(NamedTuple):
    """How light meets a surface.

    Attributes
    ----------
    arriving, reflected : Frame
        The frames of the light before and behind a reflection; both have
        x = s = normal cross direction, perpendicular to the plane of incidence.
    cos, sin : ndarray
        Of the angle of incidence.
    """

    arriving: Frame
    reflected: Frame
    cos: npt.NDArray[np.float64]
    sin: npt.NDArray[np.float64]

    @property
    def incidence(self) -> npt.NDArray[np.float64]:
        """The angle of incidence in radians."""
        return np.arctan2(self.sin, self.cos)


def plane_of_incidence(
    direction: npt.ArrayLike, normal: npt.ArrayLike, keep: Frame | None = None
) -> PlaneOfIncidence:
    """Return the plane of incidence of light that meets a surface.

    Products of direction and normal are taken in twice the precision, so that the plane keeps
    all its digits next to the normal, and the cosine next to grazing incidence.

    Parameters
    ----------
    direction, normal : array_like, shape (..., 3)
        The direction in which light travels and the normal of the surface, of any
        length; the normal may point to either side.
    keep : Frame, optional
        The frame that the light has: where light arrives along the normal, every plane is
        one of incidence, and its x is kept.

    Returns
    -------
    PlaneOfIncidence
        The frames there, and the cosine and sine of the angle of incidence.

    Raises
    ------
    FrameError
        If a vector has no length, or light arrives along the normal and no frame is
        given, or one of another direction.

    Examples
    --------
    >>> meets = plane_of_incidence((1.0, 0.0, -1.0), (0.0, 0.0, 1.0))
    >>> float(meets.incidence) == np.pi / 4, meets.arriving.x, meets.reflected.z.round(3)
    (True, array([0., 1., 0.]), array([0.707, 0.   , 0.707]))
    """
    k, n = _given("the direction of light", direction), _given("a normal", normal)
    rounding = rounding_in(direction, normal)
    check_broadcast({"direction": k.shape[:-1], "normal": n.shape[:-1]})
    k, n = np.broadcast_arrays(k, n)
    along = _dot(k, n)
    n = np.where((along > 0.0)[..., np.newaxis], -n, n)
    across = _cross(n, k)
    lengths = _length(k) * _length(n)
    sin, cos = _length(across) / lengths, np.abs(along) / lengths
    parallel = sin < _PARALLEL
    if keep is not None and not isinstance(keep, Frame):
        raise FrameError(f"keep must be the Frame that the light has, not {shown(keep)}")
    x = _axis(across, k, parallel, keep, rounding)
    z = k / _length(k)[..., np.newaxis]
    unit = n / _length(n)[..., np.newaxis]
    back = z + 2.0 * cos[..., np.newaxis] * unit
    back /= _length(back)[..., np.newaxis]
    arriving, reflected = (Frame(x, np.cross(axis, x), axis, rounding) for axis in (z, back))
    return PlaneOfIncidence(
        arriving, reflected, np.where(parallel, 1.0, cos), np.where(parallel, 0.0, sin)
    )


def _axis(
    across: Any, k: Any, parallel: Any, keep: Frame | None, rounding: float
) -> npt.NDArray[np.float64]:
    length = _length(across)
    x = across / np.where(parallel, 1.0, length)[..., np.newaxis]
    if not np.any(parallel):
        return np.asarray(x)
    if keep is None:
        raise FrameError(
            "light that arrives along the normal has no plane of incidence of its own; give "
            "keep=, the frame whose x it keeps"
        )
    check_broadcast({"direction": k.shape[:-1], "keep": keep.z.shape[:-1]})
    # Only the frame of this very light says what is kept; the others keep nothing.
    z = np.where(parallel[..., np.newaxis], k, keep.z)
    kept = Frame.from_direction(z, keep.x)
    keep.turn_to(Frame(kept.x, kept.y, kept.z, rounding))
    return np.where(parallel[..., np.newaxis], kept.x, x)


def _cross(a: Any, b: Any) -> npt.NDArray[np.float64]:
    return np.stack([part.high for part in cross(_doubled(a), _doubled(b))], axis=-1)


def _dot(a: Any, b: Any) -> npt.NDArray[np.float64]:
    return np.asarray(dot(_doubled(a), _doubled(b)).high)


def _doubled(vector: Any) -> Vector:
    x, y, z = (DoubleDouble(NUMPY, vector[..., axis]) for axis in range(3))
    return x, y, z


def _length(vector: Any) -> npt.NDArray[np.float64]:
    return np.asarray(np.linalg.norm(vector, axis=-1))


def _given(what: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return vectors over a power of two: exact, and their squares do not overflow."""
    vector = vectors(what, value)
    if not np.all(np.any(vector, axis=-1)):
        raise FrameError(f"{what} has no length; give a vector with a direction of its own")
    return normalise_exponent(vector, 0)[0]
