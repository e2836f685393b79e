"""Reference frames of polarised light, and the turn that aligns one with another."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError, ShapeError, shown
from optipath.kernels.catalogue import ALIGN
from optipath.kernels.numbers.primitives import NUMPY
from optipath.values.arrays.array_likes import array_of, as_given
from optipath.values.arrays.read_only import Unchanging, read_only
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.degree_warnings import warn_of_degrees
from optipath.values.domains.quantities import ANGLE
from optipath.values.roundings import Array, as_doubles, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt

_TOLERANCE = 1e-8
_PARALLEL = 1e-12


class Frame(Unchanging):
    """A right-handed frame (x, y, z) whose z is the direction in which light travels.

    Parameters
    ----------
    x, y, z : array_like, shape (..., 3), optional
        Unit vectors in world coordinates with ``y = z cross x``; by default the
        axes of the world itself. They broadcast together over the leading axes.

    Raises
    ------
    FrameError
        If the axes are no right-handed set of orthogonal unit vectors, to 1e-8, or to the
        rounding of less precision than double, out of which they are made orthogonal again.

    Examples
    --------
    >>> Frame().turned(np.pi / 2).x.round(12)
    array([0., 1., 0.])
    """

    __slots__ = ("x", "y", "z")

    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    z: npt.NDArray[np.float64]

    def __init__(
        self,
        x: npt.ArrayLike = (1.0, 0.0, 0.0),
        y: npt.ArrayLike = (0.0, 1.0, 0.0),
        z: npt.ArrayLike = (0.0, 0.0, 1.0),
    ) -> None:
        given = {
            name: as_given(f"axis {name} of a frame", axis, FrameError)
            for name, axis in zip("xyz", (x, y, z), strict=True)
        }
        rounding = max(map(rounding_of, given.values()))
        self._set([vectors(f"axis {name} of a frame", a) for name, a in given.items()], rounding)

    def _set(self, axes: list[npt.NDArray[np.float64]], rounding: float) -> None:
        """Check axes and keep them; those of less precision than double are made orthogonal."""
        try:
            check_broadcast({n: axis.shape[:-1] for n, axis in zip("xyz", axes, strict=True)})
        except ShapeError as fault:
            raise FrameError(f"axes of a frame: {fault}") from None
        x, y, z = np.broadcast_arrays(*axes)
        _check(np.stack([x, y, z], axis=-2), max(_TOLERANCE, 2.0 * rounding))
        if rounding:
            z = _unit("z", z)
            x = _across(z, x)
            y = np.cross(z, x)
        for name, axis in zip("xyz", (x, y, z), strict=True):
            object.__setattr__(self, name, read_only(axis))

    @classmethod
    def trusted(cls, x: Array, y: Array, z: Array) -> Frame:
        """Return the frame of axes of one shape that are known to be right, unchecked.

        Parameters
        ----------
        x, y, z : ndarray, shape (..., 3)
            The axes, which become read-only.

        Returns
        -------
        Frame
            Of these very arrays.
        """
        frame = cls.__new__(cls)
        for name, axis in zip("xyz", (x, y, z), strict=True):
            axis.flags.writeable = False
            object.__setattr__(frame, name, axis)
        return frame

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
        along = _unit("z", vectors("axis z of a frame", z))
        towards = _unit("x", vectors("axis x of a frame", x))
        check_broadcast({"z": along.shape[:-1], "x": towards.shape[:-1]})
        across = _across(along, towards)
        return cls(across, np.cross(along, across), along)

    def turned(self, angle: npt.ArrayLike) -> Frame:
        """Return this frame turned about its z by an angle in radians (right-hand rule).

        Examples
        --------
        >>> Frame().turned([0.0, "180 deg"]).x.shape
        (2, 3)
        """
        warn_of_degrees("the angle of a turn", angle)
        a = _floats("the angle of a turn", ANGLE.read("the angle of a turn", angle))
        check_broadcast({"frame": self.z.shape[:-1], "angle": a.shape})
        a = a[..., np.newaxis]
        c, s = np.cos(a), np.sin(a)
        return Frame(c * self.x + s * self.y, c * self.y - s * self.x, self.z)

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
        given = as_given("a rotation", rotation, FrameError)
        matrix = _floats("a rotation", given)
        if matrix.shape[-2:] != (3, 3):
            raise FrameError(f"a rotation must have shape (..., 3, 3), not {matrix.shape}")
        check_broadcast({"frame": self.z.shape[:-1], "rotation": matrix.shape[:-2]})
        axes = [np.einsum("...ij,...j->...i", matrix, axis) for axis in (self.x, self.y, self.z)]
        frame = Frame.__new__(Frame)
        frame._set(axes, rounding_of(given))  # noqa: SLF001 - its own
        return frame

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
        if np.any(apart > _TOLERANCE):
            where = np.unravel_index(np.argmax(apart), apart.shape)
            first = np.broadcast_to(self.z, (*apart.shape, 3))[where]
            second = np.broadcast_to(other.z, (*apart.shape, 3))[where]
            raise FrameError(
                f"light that travels along {_text(first)} cannot be aligned with a frame that "
                f"travels along {_text(second)}; only frames with one direction can be aligned"
            )
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
        return Frame, (self.x, self.y, self.z)

    def __repr__(self) -> str:
        if self.z.ndim > 1:
            return f"<Frame batch of shape {self.z.shape[:-1]}>"
        return f"Frame(x={_text(self.x)}, y={_text(self.y)}, z={_text(self.z)})"


def vectors(what: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return vectors of three finite components.

    Parameters
    ----------
    what : str
        What a sentence calls them.
    value : array_like, shape (..., 3)
        The vectors.

    Returns
    -------
    ndarray of float64
        Of the same shape.

    Raises
    ------
    FrameError
        If they are none.

    Examples
    --------
    >>> vectors("a normal", [0, 0, 1])
    array([0., 0., 1.])
    """
    array = _floats(what, value)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise FrameError(f"{what} must have shape (..., 3), not {array.shape}")
    return array


def _floats(what: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    array = array_of(what, value, FrameError)
    if array.dtype.kind not in "iufb":
        raise FrameError(f"{what} must be numbers, not {shown(value)}")
    array = as_doubles(array)
    if not np.all(np.isfinite(array)):
        raise FrameError(f"{what} must be finite; check for NaN and infinity")
    return array


def _check(axes: npt.NDArray[np.float64], tolerance: float) -> None:
    """Refuse axes, shape (..., 3, 3), that are no right-handed set of unit vectors."""
    if np.any(np.abs(axes) > 2.0):
        raise FrameError("the axes of a frame must be unit vectors; use Frame.from_direction")
    off = np.abs(axes @ np.swapaxes(axes, -1, -2) - np.eye(3)).max(axis=(-1, -2), initial=0.0)
    if np.any(~(off <= tolerance)):
        raise FrameError(
            f"the axes of a frame must be orthogonal unit vectors; these are off by "
            f"{np.max(off):.2g}: use Frame.from_direction(z, x) to make them so"
        )
    if np.any(np.linalg.det(axes) < 0.0):
        raise FrameError("the axes of a frame must be right-handed, y = z cross x; turn y round")


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
