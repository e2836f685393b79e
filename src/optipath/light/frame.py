"""Frame: the reference frame of light; vectors in space and planes of incidence."""

from __future__ import annotations

from numbers import Real
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import FrameError
from optipath.faults import shown
from optipath.kernels.catalog import ALIGN
from optipath.kernels.double_double import DoubleDouble
from optipath.kernels.primitives import NUMPY
from optipath.kernels.vectors import Vector, cross, dot
from optipath.materials.quantities import ANGLE
from optipath.values.angles import warn_of_degrees
from optipath.values.arrays import Unchanging, as_argument, check_broadcast, locked
from optipath.values.precision import Array, as_doubles, doubles, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt


_TOLERANCE = 1e-8
_PARALLEL = 1e-12
_ORTHOGONAL = 2.0**-49
_COARSEST = 2.0**-10
"""The rounding of half precision."""


class Frame(Unchanging):
    """A right-handed frame (x, y, z) whose z is the direction in which light travels.

    Parameters
    ----------
    x, y, z : array_like, shape (..., 3), optional
        Unit vectors in world coordinates with ``y = z cross x``; by default the
        axes of the world itself. They broadcast together over the leading axes.
    rounding : float, optional
        The rounding of the numbers that the axes were computed from, where it is more than
        their own precision has, such as ``np.finfo(np.float32).eps``; 2^-10 at most.

    Raises
    ------
    FrameError
        If the axes are no right-handed set of orthogonal unit vectors, to 1e-8, or to their
        rounding, out of which they are made orthogonal again.

    Examples
    --------
    >>> Frame().turned(np.pi / 2).x.round(12)
    array([0., 1., 0.])
    """

    __slots__ = ("rounding", "x", "y", "z")

    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    z: npt.NDArray[np.float64]
    rounding: float

    def __init__(
        self,
        x: npt.ArrayLike = (1.0, 0.0, 0.0),
        y: npt.ArrayLike = (0.0, 1.0, 0.0),
        z: npt.ArrayLike = (0.0, 0.0, 1.0),
        rounding: float = 0.0,
    ) -> None:
        if not isinstance(rounding, Real) or not 0.0 <= rounding <= _COARSEST:
            raise FrameError(
                f"the rounding of a frame is {shown(rounding)}; give one within 0 .. {_COARSEST}"
            )
        named = {"x": x, "y": y, "z": z}
        read = {name: vectors(f"axis {name} of a frame", axis) for name, axis in named.items()}
        with FrameError.wrapping("axes of a frame"):
            check_broadcast({name: axis.shape[:-1] for name, (axis, _) in read.items()})
        axes, roundings = zip(*read.values(), strict=True)
        rounding = max(float(rounding), *roundings)
        x, y, z = np.broadcast_arrays(*axes)
        off = _check(np.stack([x, y, z], axis=-2), max(_TOLERANCE, 2.0 * rounding))
        # What is orthogonal stays as it is, so that copies are equal.
        if rounding and off > _ORTHOGONAL:
            z = _unit("z", z)
            x = _across(z, x)
            y = np.cross(z, x)
        _keep(self, [np.array(axis) for axis in (x, y, z)], rounding)

    @classmethod
    def trusted(cls, x: Array, y: Array, z: Array, rounding: float = 0.0) -> Frame:
        """Return the frame of axes of one shape that are known to be right, unchecked.

        Parameters
        ----------
        x, y, z : ndarray, shape (..., 3)
            The axes, which become read-only.
        rounding : float, optional
            As a frame has it.

        Returns
        -------
        Frame
            Of these very arrays.
        """
        return _keep(cls.__new__(cls), [x, y, z], rounding)

    @classmethod
    def from_direction(cls, z: npt.ArrayLike, x: npt.ArrayLike) -> Frame:
        """Return the frame of light along z whose x lies towards the given x.

        Parameters
        ----------
        z, x : array_like, shape (..., 3)
            The direction of travel, of any length, and any vector not along it;
            x is made perpendicular to z.

        Returns
        -------
        Frame
            Of the shape that both broadcast to.

        Raises
        ------
        FrameError
            If z has no length, or x lies along z.

        Examples
        --------
        >>> Frame.from_direction(z=(0, 0, 2), x=(3, 0, 5)).x
        array([1., 0., 0.])
        """
        along, rounding = vectors("axis z of a frame", z)
        towards, of_x = vectors("axis x of a frame", x)
        along, towards = _unit("z", along), _unit("x", towards)
        check_broadcast({"z": along.shape[:-1], "x": towards.shape[:-1]})
        across = _across(along, towards)
        return cls(across, np.cross(along, across), along, max(rounding, of_x))

    def turned(self, angle: npt.ArrayLike) -> Frame:
        """Return this frame turned about its z by an angle in radians (right-hand rule).

        Examples
        --------
        >>> Frame().turned([0.0, "180 deg"]).x.shape
        (2, 3)
        """
        what = "the angle of a turn"
        warn_of_degrees(what, angle)
        return self.turned_by(floats(what, ANGLE.read(what, angle))[0])

    def turned_by(self, a: npt.NDArray[Any]) -> Frame:
        """Return this frame turned by angles that have been read."""
        check_broadcast({"frame": self.z.shape[:-1], "angle": a.shape})
        a = a[..., np.newaxis]
        c, s = np.cos(a), np.sin(a)
        x, y = c * self.x + s * self.y, c * self.y - s * self.x
        return Frame(x, y, self.z, self.rounding)

    def rotated(self, rotation: npt.ArrayLike) -> Frame:
        """Return this frame carried along by a rotation of the world.

        Parameters
        ----------
        rotation : array_like, shape (..., 3, 3)
            A proper rotation matrix, applied to each axis.

        Examples
        --------
        >>> Frame().rotated([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).x
        array([0., 1., 0.])
        """
        matrix, rounding = floats("a rotation", rotation)
        if matrix.shape[-2:] != (3, 3):
            raise FrameError(f"a rotation must have shape (..., 3, 3), not {matrix.shape}")
        check_broadcast({"frame": self.z.shape[:-1], "rotation": matrix.shape[:-2]})
        x, y, z = (np.einsum("...ij,...j->...i", matrix, a) for a in (self.x, self.y, self.z))
        return Frame(x, y, z, max(self.rounding, rounding))

    def reversed(self) -> Frame:
        """Return the frame of light that goes back along this one: (x, -y, -z).

        Examples
        --------
        >>> Frame().turned(0.3).reversed() == Frame().reversed().turned(-0.3)
        True
        """
        return Frame.trusted(self.x, 0.0 - self.y, 0.0 - self.z, self.rounding)

    def rounding_to(self, other: Frame) -> float:
        """Return how far the axes of this frame and of another may be apart, and be the same.

        Examples
        --------
        >>> Frame().rounding_to(Frame())
        1e-08
        >>> single = Frame(x=np.float32([1, 0, 0]))
        >>> Frame().rounding_to(single) == 2.0**-22
        True
        """
        return max(_TOLERANCE, 2.0 * (self.rounding + other.rounding))

    def turn_to(self, other: Frame) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Return (cos 2a, sin 2a) of the turn a about z that takes this frame to another.

        Raises
        ------
        FrameError
            If the frames have different directions z.

        Examples
        --------
        >>> c, s = Frame().turn_to(Frame().turned(np.pi / 4))
        >>> float(abs(c)) < 1e-15, float(s)
        (True, 1.0)
        """
        if not isinstance(other, Frame):
            raise FrameError(f"a frame is aligned with a Frame, not with {shown(other)}")
        check_broadcast({"frame": self.z.shape[:-1], "other frame": other.z.shape[:-1]})
        apart = np.linalg.norm(self.z - other.z, axis=-1)
        if np.any(apart > self.rounding_to(other)):
            raise FrameError(_other_direction(self, other, apart))
        d = np.sum(self.x * other.x, axis=-1)
        e = np.sum(self.z * np.cross(self.x, other.x), axis=-1)
        c, s = ALIGN.made_for(NUMPY)(d, e)
        return c, s

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Frame):
            return NotImplemented
        pairs = ((self.x, other.x), (self.y, other.y), (self.z, other.z))
        return all(np.array_equal(first, second) for first, second in pairs)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Frame, (self.x, self.y, self.z, self.rounding)

    def __repr__(self) -> str:
        if self.z.ndim > 1:
            return f"<Frame batch of shape {self.z.shape[:-1]}>"
        return f"Frame(x={_text(self.x)}, y={_text(self.y)}, z={_text(self.z)})"


def _keep(frame: Frame, axes: list[Array], rounding: float) -> Frame:
    for name, axis in zip("xyz", axes, strict=True):
        object.__setattr__(frame, name, locked(axis))
    object.__setattr__(frame, "rounding", rounding)
    return frame


def _other_direction(first: Frame, second: Frame, apart: Array) -> str:
    """Say of two frames that they cannot be aligned, where their directions differ most."""
    where = np.unravel_index(np.argmax(apart), apart.shape)
    one, other = (_text(np.broadcast_to(f.z, (*apart.shape, 3))[where]) for f in (first, second))
    return (
        f"light that travels along {one} cannot be aligned with a frame that travels along "
        f"{other}, {apart[where]:.2g} beside it; only frames with one direction can be aligned"
    )


def _check(axes: npt.NDArray[np.float64], tolerance: float) -> float:
    """Refuse axes, shape (..., 3, 3), that are no right-handed set; return how far they are off."""
    if np.any(np.abs(axes) > 2.0):
        raise FrameError("the axes of a frame must be unit vectors; use Frame.from_direction")
    off = np.abs(axes @ np.swapaxes(axes, -1, -2) - np.eye(3)).max(axis=(-1, -2), initial=0.0)
    if np.any(~(off <= tolerance)):
        raise FrameError(
            f"the axes of a frame must be orthogonal unit vectors, and are off by "
            f"{np.max(off):.2g}; use Frame.from_direction(z, x)"
        )
    if np.any(np.linalg.det(axes) < 0.0):
        raise FrameError("the axes of a frame must be right-handed, y = z cross x; turn y round")
    return float(np.max(off, initial=0.0))


def _across(along: Array, towards: Array) -> Array:
    """Return the unit vectors across some that are nearest to others."""
    across = towards
    for _ in range(2):  # The second time mends what the first rounds, where x is near z.
        across = across - np.sum(across * along, axis=-1, keepdims=True) * along
        if np.any(np.max(np.abs(across), axis=-1) < _PARALLEL):
            raise FrameError("x has no part perpendicular to z; give an x that is not along z")
        across = _unit("x", across)
    return across


def _unit(name: str, vectors: Array) -> Array:
    scale = np.max(np.abs(vectors), axis=-1, keepdims=True)
    if np.any(scale == 0.0):
        raise FrameError(f"{name} has no length; give a vector with a direction of its own")
    scaled = vectors / scale
    return scaled / np.linalg.norm(scaled, axis=-1, keepdims=True)  # type: ignore[no-any-return,unused-ignore]


def _text(vector: npt.NDArray[np.float64]) -> str:
    return "(" + ", ".join(f"{float(component) + 0.0:.6g}" for component in vector) + ")"


def vectors(what: str, value: npt.ArrayLike) -> tuple[npt.NDArray[np.float64], float]:
    """Return vectors (..., 3) of finite components, and their rounding, as `floats` does."""
    array, rounding = floats(what, value)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise FrameError(f"{what} must have shape (..., 3), not {array.shape}")
    return array, rounding


def floats(what: str, value: npt.ArrayLike) -> tuple[npt.NDArray[np.float64], float]:
    """Return finite numbers as doubles, and the rounding of what has less precision; else 0."""
    argument = as_argument(what, value, FrameError)
    if argument.dtype.kind not in "iufb":
        raise FrameError(f"{what} must be numbers, not {shown(value)}")
    array = as_doubles(doubles(argument))
    if not np.all(np.isfinite(array)):
        raise FrameError(f"{what} must be finite; check for NaN and infinity")
    return array, rounding_of(argument)


# A sine below this is the rounding of the directions, and tells no plane.
_PARALLEL_AXES = 2.0**-50


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
    k, rounding = _vector_argument("the direction of light", direction)
    n, of_normal = _vector_argument("a normal", normal)
    rounding = max(rounding, of_normal)
    check_broadcast({"direction": k.shape[:-1], "normal": n.shape[:-1]})
    k, n = np.broadcast_arrays(k, n)
    along = np.asarray(dot(_doubled(k), _doubled(n)).high)
    n = np.where((along > 0.0)[..., np.newaxis], -n, n)
    across = np.stack([part.high for part in cross(_doubled(n), _doubled(k))], axis=-1)
    lengths = _length(k) * _length(n)
    sin, cos = _length(across) / lengths, np.abs(along) / lengths
    parallel = sin < _PARALLEL_AXES
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
            "light along the normal has no plane of incidence; give keep=, whose x it keeps"
        )
    check_broadcast({"direction": k.shape[:-1], "keep": keep.z.shape[:-1]})
    # Only the frame of this very light says what is kept; the others keep nothing.
    z = np.where(parallel[..., np.newaxis], k, keep.z)
    stored = Frame.from_direction(z, keep.x)
    keep.turn_to(Frame(stored.x, stored.y, stored.z, rounding))
    return np.where(parallel[..., np.newaxis], stored.x, x)


def _doubled(vector: Any) -> Vector:
    x, y, z = (DoubleDouble(NUMPY, vector[..., axis]) for axis in range(3))
    return x, y, z


def _length(vector: Any) -> npt.NDArray[np.float64]:
    return np.asarray(np.linalg.norm(vector, axis=-1))


def _vector_argument(what: str, value: npt.ArrayLike) -> tuple[npt.NDArray[np.float64], float]:
    """Return `vectors` over a power of two: exact, and their squares do not overflow."""
    vector, rounding = vectors(what, value)
    if not np.all(np.any(vector, axis=-1)):
        raise FrameError(f"{what} has no length; give a vector with a direction of its own")
    largest = np.max(np.abs(vector), axis=-1, keepdims=True)
    return np.ldexp(vector, -np.frexp(largest)[1]), rounding
