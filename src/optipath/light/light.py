"""Light: a Stokes vector in one reference frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError, ShapeError, shown
from optipath.kernels.carriers.structures import turn_linear
from optipath.light.frames import Frame
from optipath.light.polarization_state import PolarizationState
from optipath.light.underflow import times_two_to
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import check_known, is_traced, known, namespace
from optipath.values.arrays.read_only import Unchanging, same
from optipath.values.arrays.shapes import check_broadcast, real_array

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

_LARGEST = 2.0**40


class Light(PolarizationState, Unchanging):
    """A Stokes vector (S0, S1, S2, S3), or a batch of them, in one frame.

    Parameters
    ----------
    stokes : array_like, shape (..., 4)
        S0 the intensity, S1 horizontal over vertical (x over y), S2 diagonal over
        antidiagonal, S3 > 0 for a field that turns from x to y (see `handedness`). A
        component that a detector does not read is NaN.
    frame : Frame, optional
        The frame the components refer to; the unit frame by default.
    exponent : int or array_like of int, shape (...), optional
        Light too faint for a float is given as ``stokes`` times two to this power. The
        attribute `stokes` is 0 then, but `normalized`, `dop` and `log10_intensity`
        are right all the same, and `mantissa` keeps what was given.

    Raises
    ------
    ShapeError
        If the last axis has not four elements, or the exponent is no integer.
    ParameterError
        If there is an exponent, and JAX traces it or the Stokes vector.

    Examples
    --------
    >>> light = Light([1.0, 1.0, 0.0, 0.0])
    >>> light.in_frame(Frame().turned(np.pi / 4)).stokes.round(12)
    array([ 1.,  0., -1.,  0.])
    >>> faint = Light([1.0, 0.6, 0.0, 0.8], exponent=-332193)
    >>> print(faint.intensity, faint.log10_intensity.round(), faint.normalized)
    0.0 -100000.0 [1.  0.6 0.  0.8]
    """

    stokes: npt.NDArray[Any]
    frame: Frame
    exponent: npt.NDArray[np.int64]
    mantissa: npt.NDArray[Any]

    def __init__(self, stokes: Any, frame: Frame | None = None, exponent: Any = 0) -> None:
        frame = Frame() if frame is None else frame
        if not isinstance(frame, Frame):
            raise FrameError(f"the frame of a light must be a Frame, not {shown(frame)}")
        mantissa = real_array("a Stokes vector", stokes, (4,))
        check_known("the exponent of a light", exponent)
        given, exponent = exponent, as_given("the exponent of a light", exponent, ShapeError)
        if exponent.dtype.kind not in "iu" or np.any(np.abs(exponent.astype(float)) > _LARGEST):
            raise ShapeError(
                f"the exponent of a light must be an integer within -2^40 .. 2^40, "
                f"not {shown(given)}"
            )
        batch = check_broadcast({"stokes": mantissa.shape[:-1], "exponent": exponent.shape})
        exponent = np.broadcast_to(exponent.astype(np.int64), batch)
        if mantissa.shape[:-1] != batch:
            xp = namespace(mantissa)
            mantissa = xp.broadcast_to(mantissa, (*batch, 4)).copy()
        if exponent.any():
            check_known("light with an exponent", mantissa)
        plain = times_two_to(mantissa, exponent) if exponent.any() else mantissa
        self.__dict__.update(stokes=plain, frame=frame, exponent=exponent, mantissa=mantissa)

    @classmethod
    def of(cls, stokes: Any, frame: Frame | Callable[[], Frame], exponent: Any = 0) -> Light:
        """Return light out of what a plan has computed, which needs no check.

        Parameters
        ----------
        stokes : tuple or array_like
            S0, S1, S2 and S3 each by itself, or an array of shape (..., 4).
        frame : Frame or callable
            The frame, or what returns it when somebody asks for it.
        exponent : int or array_like, optional
            Of the power of two times the Stokes vectors.

        Returns
        -------
        Light
            A tuple becomes one array when somebody asks for it.
        """
        if not isinstance(exponent, int) or exponent:
            light = cls(_stacked(stokes) if type(stokes) is tuple else stokes, None, exponent)
            own = light.__dict__
            del own["frame"]
        else:
            light = cls.__new__(cls)
            own = light.__dict__
            own["_stokes"] = stokes
        own["frame" if type(frame) is Frame else "_frame"] = frame
        return light

    def __getattr__(self, name: str) -> Any:
        own = self.__dict__
        if name == "frame" and "_frame" in own:
            own["frame"] = own["_frame"]()
            return own["frame"]
        if "_stokes" not in own or name not in ("stokes", "mantissa", "exponent"):
            raise AttributeError(f"a Light has no attribute '{name}'")
        if name == "exponent":
            own["exponent"] = np.broadcast_to(np.int64(0), self.stokes.shape[:-1])
        else:
            stokes = own["_stokes"]
            own["stokes"] = own["mantissa"] = _stacked(stokes) if type(stokes) is tuple else stokes
        return own[name]

    def __repr__(self) -> str:
        faint = f", exponent={self.exponent!r}" if self.exponent.any() else ""
        return f"Light(stokes={self.mantissa!r}, frame={self.frame!r}{faint})"

    @property
    def intensity(self) -> npt.NDArray[Any]:
        """S0, of shape (...)."""
        parts = self.__dict__.get("_stokes")
        if type(parts) is tuple and "stokes" not in self.__dict__:
            return np.asarray(parts[0])
        stokes = known(self.stokes)
        return namespace(stokes).asarray(stokes[..., 0])  # type: ignore[no-any-return]

    @property
    def log10_intensity(self) -> npt.NDArray[Any]:
        """The decimal logarithm of S0, of shape (...), however faint; -inf where it is dark."""
        s0 = self._numbers[..., 0]
        xp = namespace(s0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return xp.asarray(xp.log10(s0) + self.exponent * np.log10(2.0))  # type: ignore[no-any-return]

    def in_frame(self, frame: Frame) -> Light:
        """Return the same light with its components given in another frame.

        Raises
        ------
        FrameError
            If the other frame has another direction.
        """
        if isinstance(frame, Frame):
            check_broadcast({"light": self.stokes.shape[:-1], "frame": frame.z.shape[:-1]})
        stokes = self._numbers
        xp, (s0, s1, s2, s3) = namespace(stokes), (stokes[..., i] for i in range(4))
        turn = self.frame.turn_to(frame)
        with np.errstate(over="ignore", invalid="ignore"):
            parts = (s0, *turn_linear(turn, s1, s2), s3)
        return Light(xp.stack(xp.broadcast_arrays(*parts), axis=-1), frame, self.exponent)

    def __add__(self, other: object) -> Light:
        if not isinstance(other, Light):
            return NotImplemented
        shapes = {"light": self.stokes.shape[:-1], "other light": other.stokes.shape[:-1]}
        check_broadcast(shapes)
        aligned = other.in_frame(self.frame)
        if is_traced(self.mantissa) or is_traced(aligned.mantissa):
            return Light(self.stokes + aligned.stokes, self.frame)
        one, two = self._numbers, aligned._numbers
        # Dark light has no exponent of its own.
        mine = np.where(one[..., 0] == 0.0, aligned.exponent, self.exponent)
        theirs = np.where(two[..., 0] == 0.0, self.exponent, aligned.exponent)
        power = np.maximum(mine, theirs)
        with np.errstate(over="ignore", invalid="ignore"):
            total = times_two_to(one, self.exponent - power)
            total = total + times_two_to(two, aligned.exponent - power)
        return Light(total, self.frame, power)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Light):
            return NotImplemented
        # What a detector does not read is equal to itself.
        return (
            np.array_equal(self.mantissa, other.mantissa, equal_nan=True)
            and same(self.exponent, other.exponent)
            and self.frame == other.frame
        )

    __hash__ = None  # type: ignore[assignment]


def _stacked(components: tuple[Any, Any, Any, Any]) -> npt.NDArray[Any]:
    """Return four components, floats or arrays of one shape, as one array (..., 4)."""
    arrays = [component for component in components if isinstance(component, np.ndarray)]
    if not arrays:
        return np.array(components)
    stokes = np.empty((4, *arrays[0].shape), arrays[0].dtype)
    for row, component in enumerate(components):
        stokes[row] = component
    return np.moveaxis(stokes, 0, -1)
