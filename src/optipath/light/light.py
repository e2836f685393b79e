"""Light: a Stokes vector in one reference frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError, ShapeError, shown
from optipath.kernels.carriers.structures import turn_linear
from optipath.light.array_axes import each_number
from optipath.light.array_of_light import stacked_components
from optipath.light.drawn_light import DrawnLight
from optipath.light.exchange import LightExchange
from optipath.light.frames import Frame
from optipath.light.inherited_noise import noise_in
from optipath.light.light_text import text_of
from optipath.light.physical_light import check_physical, nearest_light
from optipath.light.spectral_light import SpectralLight
from optipath.light.underflow import folded, normalise_exponent, times_two_to
from optipath.light.wavelength_on_demand import wavelengths_for
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import check_known, is_jax, is_traced, known, namespace
from optipath.values.arrays.read_only import Unchanging, locked, read_only, same
from optipath.values.arrays.shapes import check_broadcast, real_array
from optipath.values.precision import coarser

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

_LARGEST = 2.0**40


class Light(SpectralLight, LightExchange, DrawnLight, Unchanging):
    """A Stokes vector (S0, S1, S2, S3), or a batch of them, in one frame.

    Parameters
    ----------
    stokes : array_like, shape (..., 4)
        S0 the intensity, S1 horizontal over vertical (x over y), S2 diagonal over
        antidiagonal, S3 > 0 for a field that turns from x to y (see `handedness`). A
        component that a detector does not read is NaN.
    frame : Frame, optional
        The frame the components refer to; the unit frame by default. That of light from a path
        placed relatively is the one that leaves the last element, called the unit frame.
    exponent : int or array_like of int, shape (...), optional
        Light too faint, or bright, for a float is ``stokes`` times two to this power. The
        attribute `stokes` is 0, or infinite, then, but `normalized`, `dop` and `log10_intensity`
        are right all the same, and `mantissa` keeps what was given.
    physical : bool, optional
        Whether what no light can be is refused; False takes measured noise as it is. What is
        computed, by a path or from other light, is never refused, nor is what JAX traces.
    wavelength : array_like, optional
        In metres, or texts with units, of shape (...): see `at_wavelengths`.

    Raises
    ------
    ValueFault
        If it is of negative intensity, polarised by more than 100 % beyond the rounding of
        its precision, or not finite.
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

    def __init__(
        self,
        stokes: Any,
        frame: Frame | None = None,
        exponent: Any = 0,
        *,
        physical: bool = True,
        wavelength: Any = None,
    ) -> None:
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
        batch = check_broadcast(
            {
                "stokes": mantissa.shape[:-1],
                "exponent": exponent.shape,
                "frame": frame.z.shape[:-1],
            }
        )
        exponent = np.broadcast_to(exponent.astype(np.int64), batch)
        if mantissa.shape[:-1] != batch:
            xp = namespace(mantissa)
            mantissa = xp.broadcast_to(mantissa, (*batch, 4))
        # Whoever has given an array may change it.
        mantissa = mantissa if is_jax(mantissa) else read_only(mantissa, widened=False)
        if exponent.any():
            check_known("light with an exponent", mantissa)
        if physical and not is_traced(mantissa):
            check_physical(known(mantissa))
        plain = times_two_to(mantissa, exponent) if exponent.any() else mantissa
        self.__dict__.update(
            stokes=locked(plain), frame=frame, exponent=exponent, mantissa=mantissa
        )
        if not physical:
            self.__dict__["_measured"] = True
        if wavelength is not None:
            self.__dict__["_wavelength"] = wavelengths_for(self.shape, wavelength)

    @classmethod
    def of(
        cls,
        stokes: Any,
        frame: Frame | Callable[[], Frame],
        exponent: Any = 0,
        noise: Any = None,
        *,
        measured: bool = False,
        wavelength: Any = None,
    ) -> Light:
        """Return light out of what a plan has computed, which needs no check.

        Parameters
        ----------
        stokes : tuple or array_like
            S0, S1, S2 and S3 each by itself, or an array of shape (..., 4).
        frame : Frame or callable
            The frame, or what returns it when somebody asks for it.
        exponent : int or array_like, optional
            Of the power of two times the Stokes vectors.
        noise : ndarray of shape (...), or tuple, optional
            What of the vectors is noise, as `noise_in` takes it.
        measured : bool, optional
            Whether it may be no light, as what it is made of: see `is_measured`.
        wavelength : ndarray or callable, optional
            Its wavelengths, or what returns them when somebody asks.

        Returns
        -------
        Light
            A tuple becomes one array when somebody asks for it.
        """
        light = cls.__new__(cls)
        own = light.__dict__
        if not isinstance(exponent, int) or exponent:
            mantissa = stokes
            if type(stokes) is tuple:  # As it was carried, be it faint or not.
                mantissa, exponent = folded(stacked_components(stokes), exponent)
            exponent = np.broadcast_to(np.asarray(exponent), mantissa.shape[:-1])
            plain = times_two_to(mantissa, exponent) if exponent.any() else mantissa
            own.update(stokes=locked(plain), mantissa=locked(mantissa), exponent=exponent)
        else:
            own["_stokes"] = stokes
        own["frame" if type(frame) is Frame else "_frame"] = frame
        if noise is not None:
            own["_noise"] = noise
        if measured:
            own["_measured"] = True
        if wavelength is not None:
            own["_wavelength"] = wavelength
        return light

    if not TYPE_CHECKING:  # Else any name would do for who checks types.

        def __getattr__(self, name: str) -> Any:
            own = self.__dict__
            if "_stokes" not in own or name not in ("stokes", "mantissa", "exponent"):
                return super().__getattr__(name)
            if name == "exponent":
                own["exponent"] = np.broadcast_to(np.int64(0), self.stokes.shape[:-1])
            else:
                stokes = own["_stokes"]
                stokes = stacked_components(stokes) if type(stokes) is tuple else stokes
                own["stokes"] = own["mantissa"] = locked(stokes)
            return own[name]

    def __repr__(self) -> str:
        return text_of(self._numbers, self.frame, self.exponent)

    def __str__(self) -> str:
        """Return what `repr` does, with 0 for what is no more than rounding."""
        numbers, floor = self._numbers, self.noise_floor
        if is_traced(floor):
            return repr(self)
        quiet = np.where(np.abs(numbers) < floor[..., np.newaxis], 0.0, numbers)
        return text_of(quiet, self.frame, self.exponent)

    @property
    def noise(self) -> npt.NDArray[Any]:
        """Which numbers of `stokes` are no more than rounding: those below it, shape (...).

        Of light that a path gives, what is left of the roundings of all that was emitted, by
        running error analysis along the path: behind crossed polarisers it is larger than S0.
        Found when it is asked for; where all components are 0 or far above it, it is the rounding
        of S0 alone, as it is for light of any other origin. Elements that are unphysical and values
        that are not exact have more.

        Examples
        --------
        >>> print(Light([1.0, 0.0, 0.0, 0.0]).noise)
        2.220446049250313e-16
        """
        floor = self.noise_floor
        if is_traced(floor):
            return floor  # type: ignore[no-any-return]
        with np.errstate(under="ignore", over="ignore"):
            return np.asarray(np.ldexp(floor, self.exponent))

    @property
    def noise_floor(self) -> Any:
        """The noise in the mantissa, of shape (...)."""
        own = self.__dict__
        if "_floor" not in own:
            own["_floor"] = locked(noise_in(self._numbers, own.get("_noise"), self.exponent))
        return own["_floor"]

    def __getstate__(self) -> dict[str, Any]:
        # What computes the noise stays here.
        own = super().__getstate__()
        if "_noise" in own:
            own["_noise"] = self.noise_floor
        if "_wavelength" in own:
            own["_wavelength"] = self.wavelength
        return own

    def nearest_physical(self) -> Light:
        """Return the light that is nearest: S0 is kept, and the polarised part scaled to it.

        So the angles of the ellipse stay, and light polarised by more than 100 % is polarised by
        100 %. Negative intensities are dark. What is light already is the same.

        Examples
        --------
        >>> noisy = Light([1.0, 0.9, 0.0, 0.6], physical=False)
        >>> print(noisy.dop.round(4), noisy.nearest_physical().stokes.round(4))
        1.0817 [1.     0.8321 0.     0.5547]
        """
        nearest = nearest_light(self._numbers)
        origin = self.origin() | {"measured": False}
        frame = self._kept_frame("frame")
        return Light.of(nearest, frame, self.exponent, self._inherited(), **origin)

    def in_frame(self, frame: Frame) -> Light:
        """Return the same light with its components given in another frame.

        Raises
        ------
        FrameError
            If the other frame has another direction.
        """
        if frame is self._kept_frame("frame"):
            return self
        if isinstance(frame, Frame):
            check_broadcast({"light": self.stokes.shape[:-1], "frame": frame.z.shape[:-1]})
        stokes = self._numbers
        xp, (s0, s1, s2, s3) = namespace(stokes), (stokes[..., i] for i in range(4))
        turn = self.frame.turn_to(frame)
        with np.errstate(over="ignore", invalid="ignore"):
            parts = (s0, *turn_linear(turn, s1, s2), s3)
        turned = xp.stack(xp.broadcast_arrays(*parts), axis=-1)
        turned = turned.astype(coarser(turned, stokes), copy=False)
        return Light.of(turned, frame, self.exponent, self._inherited(), **self.origin())

    def _like(
        self, mantissa: Any, exponent: Any = 0, noise: Any = None, other: Any = None
    ) -> Light:
        frame, origin = self._kept_frame("frame"), self.origin(self._wavelength_with(other))
        return Light.of(mantissa, frame, exponent, noise, **origin)

    def _each(self, change: Callable[[Any], Any]) -> Light:
        exponent = change(self.exponent) if self.exponent.any() else 0
        check_known("an index of light with an exponent", exponent)
        noise = self._inherited(part=change)
        frame = self._part_of_frame("frame", self.shape, change)
        numbers = each_number(self._numbers, change)
        origin = self.origin(self._part_of_wavelength(change))
        return Light.of(numbers, frame, exponent, noise, **origin)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Light):
            return NotImplemented
        for light in (self, other):
            check_known("light == light", light.mantissa)
        mine, theirs = (
            (light.mantissa, light.exponent)
            if same(self.exponent, other.exponent)
            else normalise_exponent(light.mantissa, light.exponent)
            for light in (self, other)
        )
        # What a detector does not read is equal to itself.
        numbers = np.array_equal(mine[0], theirs[0], equal_nan=True)
        return numbers and same(mine[1], theirs[1]) and self.frame == other.frame

    __hash__ = None  # type: ignore[assignment]
