"""Light: a Stokes vector in one reference frame."""

from __future__ import annotations

from functools import cached_property
from inspect import signature
from typing import TYPE_CHECKING, Any, Literal, Never, NoReturn, Self, TypeAlias, get_args

import numpy as np

from optipath.errors import FrameError, LightError, ParameterError
from optipath.faults import shown, unknown
from optipath.light.array_axes import (
    OPERATORS,
    TAKES_NUMBERS,
    ArrayAxes,
    each_number,
    factor_of_light,
    handed_out,
    numbers_within,
    refuse,
    refuse_call,
    stacked_components,
    why_refused,
)
from optipath.light.conventions import EllipsometricAngles, changed_stokes
from optipath.light.frame import Frame
from optipath.light.on_demand import (
    FramesOnDemand,
    common_wavelength,
    inherited_noise,
    noise_in,
    part_of_wavelength,
    wavelengths_for,
)
from optipath.light.polarization_state import (
    check_physical,
    direction,
    ellipse_of,
    length,
    minor_over_major,
    nearest_light,
    polarised,
    shares,
    turned_stokes,
    where_there,
)
from optipath.values.arrays import Unchanging, check_broadcast, locked, read_only, real_array
from optipath.values.jax_values import check_known, is_jax, is_traced, known, namespace
from optipath.values.precision import coarser

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.light.color import Beyond, OutOfGamut, Srgb, Standard
    from optipath.light.conventions import Software
    from optipath.values.precision import Array


Picture: TypeAlias = Literal["ellipse", "poincare", "stokes"]


class Light(FramesOnDemand, ArrayAxes, EllipsometricAngles, Unchanging):
    """A Stokes vector (S0, S1, S2, S3), or a batch of them, in one frame.

    Light does not change. `stokes` is read-only; a component is a copy, which may be scaled in
    place, but of more than 65536 lights, where it is read-only, too.

    Parameters
    ----------
    stokes : array_like, shape (..., 4)
        S0 the intensity, S1 horizontal over vertical (x over y), S2 diagonal over
        antidiagonal, S3 > 0 for a field that turns from x to y (see `handedness`). A
        component that a detector does not read is NaN.
    frame : Frame, optional
        The frame the components refer to; the unit frame by default. That of light from a path
        placed relatively is the one that leaves the last element, called the unit frame.
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
        If the last axis has not four elements.

    Examples
    --------
    >>> light = Light([1.0, 1.0, 0.0, 0.0])
    >>> light.in_frame(Frame().turned(np.pi / 4)).stokes.round(12)
    array([ 1.,  0., -1.,  0.])
    """

    _kind, _several = "light", "lights"
    _attribute, _axes = "stokes", 1
    instead_of_numbers = "so give light.stokes, as in op.Source(stokes=light.stokes)"
    _written, _entry = "light.stokes", "light.S0 .. light.S3, or light.stokes[..., 0]"

    def __init__(
        self,
        stokes: Any,
        frame: Frame | None = None,
        *,
        physical: bool = True,
        wavelength: Any = None,
    ) -> None:
        frame = Frame() if frame is None else frame
        if not isinstance(frame, Frame):
            raise FrameError(f"the frame of a light must be a Frame, not {shown(frame)}")
        stokes = real_array("a Stokes vector", stokes, (4,))
        batch = check_broadcast({"stokes": stokes.shape[:-1], "frame": frame.z.shape[:-1]})
        if stokes.shape[:-1] != batch:
            stokes = namespace(stokes).broadcast_to(stokes, (*batch, 4))
        # Whoever has given an array may change it.
        stokes = stokes if is_jax(stokes) else read_only(stokes, widened=False)
        if physical and not is_traced(stokes):
            check_physical(known(stokes))
        self.__dict__.update(stokes=stokes, frame=frame)
        if not physical:
            self.__dict__["_measured"] = True
        if wavelength is not None:
            self.__dict__["_wavelength"] = wavelengths_for(self.shape, wavelength)

    @classmethod
    def of(
        cls,
        stokes: Any,
        frame: Frame | Callable[[], Frame],
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
        noise : ndarray of shape (...), callable or tuple, optional
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
        own["_stokes"] = stokes
        own["frame" if type(frame) is Frame else "_frame"] = frame
        if noise is not None:
            own["_noise"] = noise
        if measured:
            own["_measured"] = True
        if wavelength is not None:
            own["_wavelength"] = wavelength
        return light

    @classmethod
    def from_(
        cls, convention: Software, stokes: Any, frame: Frame | None = None, **options: Any
    ) -> Self:
        """Return light out of Stokes vectors of other software.

        Parameters
        ----------
        convention : str
            As in `to`.
        stokes : array_like, shape (..., 4)
            As that software writes them.
        frame : Frame, optional
            The frame of the light, its x along s where the convention has x along p.
        **options
            What `Light` takes besides: ``physical=False`` for measured noise.

        Returns
        -------
        Light

        Examples
        --------
        >>> right = Light.from_("hecht", [1.0, 0.0, 0.0, 1.0])
        >>> print(right.stokes, right.handedness)
        [ 1.  0.  0. -1.] -1
        """
        argument = real_array("a Stokes vector", stokes, (4,))
        return cls(changed_stokes(convention, argument), frame, **options)

    # What is there already is in `__dict__`, and what makes the rest has a name with an underscore.

    @cached_property
    def frame(self) -> Frame:
        """The frame that the components refer to."""
        return self.__dict__["_frame"]()  # type: ignore[no-any-return]

    @cached_property
    def stokes(self) -> npt.NDArray[Any]:
        """The Stokes vectors, of shape (..., 4); read-only."""
        stokes = self.__dict__["_stokes"]
        stacked = stacked_components(stokes) if type(stokes) is tuple else stokes
        return locked(stacked)  # type: ignore[no-any-return]

    @property
    def S0(self) -> Array:  # noqa: N802 - as everybody writes it
        """The intensity, of shape (...)."""
        return self._component(0)

    @property
    def S1(self) -> Array:  # noqa: N802
        """The intensity along x less that along y, of shape (...)."""
        return self._component(1)

    @property
    def S2(self) -> Array:  # noqa: N802
        """The intensity along x + y less that along y - x, of shape (...)."""
        return self._component(2)

    @property
    def S3(self) -> Array:  # noqa: N802
        """The intensity that turns from x to y less that which turns back, of shape (...)."""
        return self._component(3)

    @property
    def intensity(self) -> Array:
        """S0, of shape (...)."""
        return self._component(0)

    @property
    def log10_intensity(self) -> Array:
        """The decimal logarithm of S0, of shape (...); -inf where it is dark."""
        s0 = self._numbers[..., 0]
        xp = namespace(s0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return xp.asarray(xp.log10(s0))  # type: ignore[no-any-return]

    @cached_property
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
        numbers = self._numbers
        noise = noise_in(numbers, self.__dict__.get("_noise"))
        return locked(namespace(numbers).asarray(noise))  # type: ignore[no-any-return]

    @property
    def wavelength(self) -> Array | None:
        """The wavelengths in vacuum, in metres; None of light that is of no known ones.

        They broadcast to the shape of the light. Those of a run that was given its
        `Wavelength`, or was bound to it. An index takes its part of them; a sum has those
        that both lights have; lights of different wavelengths are not added, and with light
        of no known ones a sum has none.

        Examples
        --------
        >>> light = Light([[1.0, 0.0, 0.0, 0.0]] * 2, wavelength=["500 nm", "600 nm"])
        >>> light.wavelength, light[1].wavelength
        (array([5.e-07, 6.e-07]), array(6.e-07))
        """
        stored = self.kept_wavelength
        if callable(stored) and (made := stored()) is not None:
            self.__dict__["_wavelength"] = made
        # Where none is made, what is kept says which ones are in doubt.
        return made if callable(stored) else stored  # type: ignore[no-any-return]

    @property
    def normalized(self) -> Array:
        """The Stokes vector over S0, of shape (..., 4); NaN where it is dark."""
        stokes = self._numbers
        there = (stokes[..., 0] > self.noise)[..., np.newaxis]
        return namespace(stokes).where(there, shares(stokes), np.nan)  # type: ignore[no-any-return]

    @property
    def dop(self) -> Array:
        """The degree of polarisation, of shape (...); NaN where it is dark."""
        return self._where_there(length(*polarised(self._numbers)))

    @property
    def dolp(self) -> Array:
        """The degree of linear polarisation, hypot(S1, S2) / S0, shape (...); NaN where dark."""
        return self._where_there(length(*polarised(self._numbers)[:2]))

    @property
    def docp(self) -> Array:
        """The signed degree of circular polarisation, S3 / S0, shape (...); NaN where dark."""
        return self._where_there(shares(self._numbers)[..., 3])

    @property
    def aop(self) -> Array:
        """The angle of polarisation, of shape (...): of the major axis, from x towards y.

        In radians, in (-pi/2, pi/2]; NaN where S1 and S2 are no more than noise, as in
        circular and in unpolarised light.

        Examples
        --------
        >>> print(Light([1.0, 0.0, 1.0, 0.0]).aop.round(4))
        0.7854
        """
        s1, s2, _ = self._ellipse
        return self._where_there(0.5 * direction(s2, s1), 1, 2)

    @property
    def ellipticity(self) -> Array:
        """The minor axis over the major axis, in [-1, 1], with the sign of S3; shape (...).

        Of the polarised part; 0 where the light is linear, NaN where it is unpolarised. It is
        tan(asin(S3 / p) / 2) = S3 / (p + hypot(S1, S2)), p the length of (S1, S2, S3), with all
        the digits that S3 has.

        Examples
        --------
        >>> print(Light([2.0, 0.6, 0.0, -0.8]).ellipticity)
        -0.5
        """
        return self._where_there(minor_over_major(*self._ellipse), 1, 2, 3)

    @property
    def ellipticity_angle(self) -> Array:
        """The arctangent of `ellipticity`, in [-pi/4, pi/4], of shape (...)."""
        s1, s2, s3 = self._ellipse
        return self._where_there(0.5 * direction(s3, length(s1, s2)), 1, 2, 3)

    @property
    def handedness(self) -> Array:
        """Integers of shape (...): 1 right-handed about the direction of travel, -1 left-handed.

        The sign of S3; 0 where S3 is no more than noise, or not read. By IEEE and the IAU: 1 is
        a field that turns counter-clockwise to who looks at the source, which Hecht, and
        Born & Wolf (sec. 1.4.2), call left-handed.

        Examples
        --------
        A quarter-wave plate whose fast axis is x makes light of +45 degrees right-handed:

        >>> quarter = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]]
        >>> print(Light(np.array(quarter) @ [1.0, 0.0, 1.0, 0.0]).handedness)
        1
        """
        s3, floor = self._numbers[..., 3], self.noise
        return namespace(s3).asarray((s3 > floor).astype(int) - (s3 < -floor).astype(int))  # type: ignore[no-any-return]

    @property
    def psi(self) -> Array:
        """The ellipsometric psi of the polarised part, of shape (...), in [0, pi/2].

        tan psi = abs(Ey) / abs(Ex), of partly polarised light those of its polarised part alone;
        NaN where it has none. Behind a sample that light of +45 degrees has met, with
        x along s and y along p, psi and `delta` are those of the sample.

        Examples
        --------
        >>> mirror = [[1, 0.6, 0, 0], [0.6, 1, 0, 0], [0, 0, -0.8, 0], [0, 0, 0, -0.8]]
        >>> stokes = np.array(mirror) @ [1.0, 0.0, 1.0, 0.0]
        >>> print(np.tan(Light(stokes).psi).round(12), Light(stokes).delta.round(4))
        0.5 3.1416
        """
        s1, s2, s3 = self._ellipse
        return self._where_there(0.5 * direction(length(s2, s3), s1), 1, 2, 3)

    @property
    def delta(self) -> Array:
        """The ellipsometric Delta of the polarised part, of shape (...), in (-pi, pi].

        The phase of Ey / Ex in the exp(+i w t) of ellipsometry, atan2(-S3, S2); that of the
        field exp(-i w t) of this library has the opposite sign. NaN where Ex or Ey of the
        polarised part is 0, in light along x, along y, or unpolarised.
        """
        _, s2, s3 = self._ellipse
        return self._where_there(direction(0.0 - s3, s2), 2, 3)

    def in_frame(self, frame: Frame) -> Light:
        """Return the same light with its components given in another frame.

        Raises
        ------
        FrameError
            If the other frame has another direction.
        """
        if frame is self._cached_frame("frame"):
            return self
        if isinstance(frame, Frame):
            check_broadcast({"light": self.stokes.shape[:-1], "frame": frame.z.shape[:-1]})
        turned = turned_stokes(self._numbers, self.frame.turn_to(frame))
        return Light.of(turned, frame, self._inherited(), **self.origin())

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
        frame = self._cached_frame("frame")
        return Light.of(nearest, frame, self._inherited(), wavelength=self.kept_wavelength)

    def to(self, convention: Software) -> Array:
        """Return the Stokes vectors as other software writes them, of shape (..., 4).

        In the frame of this light: where the convention has x along p, ours is taken to be along
        s. ``docs/other-software.md`` says what differs, and where that comes from.

        Parameters
        ----------
        convention : str
            ``"mitsuba"``, ``"hecht"``, ``"ellipsometry"``, ``"py_pol"``, ``"pypolar"``,
            ``"pyelli"``, ``"scatmech"`` or ``"tmm"``.

        Returns
        -------
        ndarray, shape (..., 4)

        Examples
        --------
        >>> Light([1.0, 0.0, 0.6, 0.8]).to("mitsuba")
        array([ 1. ,  0. ,  0.6, -0.8])
        """
        return changed_stokes(convention, self.stokes)

    def at_wavelengths(self, wavelengths: Any) -> Self:
        """Return the same light, known to be of some wavelengths.

        Parameters
        ----------
        wavelengths : array_like
            In metres, or texts with units; they broadcast to the shape of the light.

        Returns
        -------
        Light

        Raises
        ------
        ParameterError
            If they are no wavelengths.
        ShapeError
            If they do not broadcast to the shape of the light.

        Examples
        --------
        >>> light = Light([[1.0, 0.2, 0.0, 0.0], [3.0, 0.0, 0.0, 0.0]])
        >>> light.at_wavelengths(["500 nm", "600 nm"]).integrate().stokes.round(9)
        array([200.,  10.,   0.,   0.])
        """
        light = object.__new__(type(self))
        vars(light).update(vars(self), _wavelength=wavelengths_for(self.shape, wavelengths))
        return light

    def integrate(self, response: Any = None, edges: Any = None) -> Light:
        """Return the light of all wavelengths together, without their axis.

        The light is per nanometre of wavelength, and linear between its wavelengths: the
        trapezoidal rule, of which each wavelength has the bin that reaches halfway to its
        neighbours. The result is the same alone and in batches, to the last bit.

        Parameters
        ----------
        response : float, array_like of shape (n,), Spectrum or Curve, optional
            What the light of each wavelength is multiplied by, as a `Detector` takes it: numbers
            that are not negative, or what gives them by ``response.at(wavelengths)``, and no
            power in bins or lines.
        edges : array_like, shape (n + 1,), optional
            The edges of the bins, in metres or as texts with units: what comes in each is
            the density there times the width. Light of one wavelength has one bin, two edges.

        Returns
        -------
        Light
            In the same frame, in the unit of the power.

        Raises
        ------
        LightError
            If the wavelengths are not known or no grid along one axis, or frames differ.
        ShapeError, ValueFault, ParameterError
            If the response or the edges do not fit.

        Examples
        --------
        >>> light = Light([[1.0, 0.2, 0.0, 0.0]] * 3, wavelength=["500 nm", "550 nm", "600 nm"])
        >>> light.integrate().stokes.round(9)
        array([100.,  20.,   0.,   0.])
        >>> print(light.integrate(response=[0.0, 1.0, 0.0]).intensity.round(9))
        50.0
        """
        from optipath.light.integration import integrated  # noqa: PLC0415 - hardly ever

        return self.of(*integrated(self, response, edges), measured=self.is_measured)

    def to_xyz(
        self, white: Any = None, observer: Standard = "CIE 1931 2 deg", *, outside: Beyond = "dark"
    ) -> Array:
        """Return the tristimulus values X, Y and Z of spectral light, of shape (..., 3).

        The light is linear between its wavelengths, and summed up with the colour-matching
        functions of CIE 018:2019 at every whole nanometre and at its own wavelengths.

        Parameters
        ----------
        white : Light or Spectrum, optional
            What has Y = 1, such as the light of the same path without the sample. Without it,
            the values are 683 lm/W times the integral: of a power in watts, Y is in lumens.
        observer : {"CIE 1931 2 deg"}, optional
            The standard observer.
        outside : {"dark", "nearest"}, optional
            What the light is beyond its wavelengths: there is none, or, as CIE 15:2018 allows
            for smooth spectra, as much as at the last one.

        Returns
        -------
        ndarray, shape (..., 3)
            Without the axis of the wavelengths.

        Raises
        ------
        LightError
            If the wavelengths are not known or no grid along one axis.
        ValueFault
            If the observer is unknown, or white is dark.

        Warns
        -----
        ColourWarning
            If the wavelengths leave out some of 380 .. 780 nm, or are more than 20 nm apart.

        Examples
        --------
        >>> grid = np.arange(360, 831) * 1e-9
        >>> X, Y, Z = Light([[1.0, 0.0, 0.0, 0.0]] * 471, wavelength=grid).to_xyz()
        >>> print(round(X / (X + Y + Z), 5), round(Y / (X + Y + Z), 5))
        0.33331 0.33329
        """
        from optipath.light.color import tristimulus  # noqa: PLC0415 - hardly ever

        return tristimulus(self, white, observer, outside)

    def to_srgb(
        self,
        white: Any = None,
        observer: Standard = "CIE 1931 2 deg",
        *,
        outside: Beyond = "dark",
        adapt: bool = False,
        out_of_gamut: OutOfGamut = "refuse",
    ) -> Srgb:
        """Return the colour of spectral light for a display, by IEC 61966-2-1.

        Parameters
        ----------
        white : Light or Spectrum
            What has Y = 1; see `to_xyz`.
        observer, outside
            As `to_xyz` takes them.
        adapt : bool, optional
            Whether white becomes the white of the display, D65, by the linear Bradford
            transform (ICC.1:2022, annex E); otherwise paper in candlelight is orange.
        out_of_gamut : {"refuse", "clip", "scale", "keep"}, optional
            What becomes of colours that no display of sRGB shows: an error that says how many
            and how far, each component cut to 0 .. 1, mixed with grey of the same Y until none
            is negative and dimmed until none is above 1, or values beyond 0 .. 1.

        Returns
        -------
        Srgb
            Its ``values``, of shape (..., 3), and where the light was ``outside`` of the gamut.

        Raises
        ------
        ValueFault
            If white is not given, or colours are out of gamut and nothing is said of them.
        LightError
            As `to_xyz`, which also warns.

        Examples
        --------
        >>> grid = np.arange(360, 831) * 1e-9
        >>> white = Light([[1.0, 0.0, 0.0, 0.0]] * 471, wavelength=grid)
        >>> (0.2 * white).to_srgb(white, adapt=True).hex
        '#7c7c7c'
        """
        from optipath.light.color import srgb_of  # noqa: PLC0415 - hardly ever

        return srgb_of(self, white, (observer, outside), adapt=adapt, out_of_gamut=out_of_gamut)

    def plot(self, kind: Picture = "ellipse", ax: Axes | None = None, **options: Any) -> Axes:
        r"""Draw the light with Matplotlib.

        Parameters
        ----------
        kind : {"ellipse", "poincare", "stokes"}, optional
            The polarisation ellipse, the point on the Poincaré sphere, or the Stokes vector as
            bars, as the functions of `optipath.plots` of these names draw them.
        ax : Axes, optional
            Where, of three dimensions for ``"poincare"``; a figure of its own by default,
            ``.figure`` of what is returned.
        **options
            What that function takes besides: ``labels`` of an ellipse, ``by`` and ``label`` on the
            sphere, ``published`` and ``labels`` of bars.

        Returns
        -------
        Axes

        Raises
        ------
        ParameterError
            If there is no such kind, it does not take an option, or JAX traces the light.
        OptipathError
            If the light, the axes or an option do not fit the picture.
        MissingExtraError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import optipath as op
        >>> op.Light([1.0, 0.0, 1.0, 0.0]).plot().get_title()
        'linear\nS0 = 1, DoP = 1, AoP = 45°'
        """
        ParameterError.raise_for(unknown("kind of picture", kind, get_args(Picture)))
        from optipath import plots  # noqa: PLC0415 - above light

        draw = getattr(plots, kind)
        known = [name for name in signature(draw).parameters if name not in ("light", "ax")]
        wrong = [fault for name in options for fault in unknown(f"{kind} option", name, known)]
        ParameterError.raise_for(wrong)
        return draw(self, ax, **options)  # type: ignore[no-any-return]

    @property
    def is_measured(self) -> bool:
        """Whether it is, or is made of, ``Light(..., physical=False)``."""
        return "_measured" in self.__dict__

    @property
    def kept_wavelength(self) -> Any:
        """The wavelengths as they are kept, which nobody has to find for it."""
        return self.__dict__.get("_wavelength")

    @property
    def wavelengths_in_doubt(self) -> tuple[str, ...]:
        """The parameters of a run of which any may be the wavelength of the light."""
        return getattr(self.kept_wavelength, "in_doubt", ())

    def origin(self) -> dict[str, Any]:
        """Return what light that is made of this one has of it, by the names of `Light.of`."""
        return {"measured": self.is_measured, "wavelength": self.kept_wavelength}

    def __add__(self, other: Light) -> Light:
        """Return the incoherent sum in the frame of this one, if no wavelengths differ."""
        if not isinstance(other, Light):
            refuse(f"{shown(other)} is no light to be added")
        check_broadcast({"light": self.shape, "other light": other.shape})
        # Frames that are known to be one need not be made.
        is_one = other._cached_frame("frame") is self._cached_frame("frame")
        aligned = other if is_one else other.in_frame(self.frame)
        one, two = self._numbers, aligned._numbers
        with np.errstate(over="ignore", invalid="ignore"):
            total = (one + two).astype(coarser(one, two), copy=False)
        noise = None if is_traced(total) else inherited_noise((self, aligned))
        return self._like(total, noise, common_wavelength(self, aligned))

    def __radd__(self, other: int) -> Light:
        """Begin a sum: 0 and light is light, so that ``sum(lights)`` has one."""
        if not (isinstance(other, (int, float)) and other == 0):
            refuse(f"{shown(other)} is no light to be added")
        return self

    def __mul__(self, factor: Any) -> Light:
        """Return the light times a number, or times numbers that broadcast over the batch."""
        return self._times(factor, multiplied=True)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Any) -> Light:
        """Return the light divided by a number, or by numbers that broadcast over the batch."""
        return self._times(divisor, multiplied=False)

    def _times(self, factor: Any, *, multiplied: bool) -> Light:
        if isinstance(factor, Light):
            refuse("light times light has no meaning")
        factor = factor_of_light(factor, dark=multiplied)
        check_broadcast({"light": self.shape, "factor": factor.shape})
        stokes, along = self._numbers, factor[..., np.newaxis]
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            product = stokes * along if multiplied else stokes / along
            share = factor if multiplied else 1.0 / factor
        product = product.astype(coarser(product, stokes), copy=False)
        noise = None if is_traced(product) else self._inherited(share)
        return self._like(product, noise, self.kept_wavelength)

    def __matmul__(self, other: Never) -> NoReturn:
        """Refuse: what light meets stands before it."""
        raise LightError("what light meets stands before it; write element @ light")

    def __rmatmul__(self, other: Never) -> NoReturn:
        """Refuse a matrix without frames, a path, a class."""
        raise LightError(why_refused(other))

    def _refused(self, *_: Never) -> NoReturn:
        """Refuse what would be no light."""
        refuse("differences, powers and divisors of light are no light")

    __sub__ = __rsub__ = __neg__ = __pow__ = __rtruediv__ = _refused

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Add, dim, compare; refuse what would lose the frame."""
        name = OPERATORS.get(ufunc)
        if name is not None and method == "__call__" and not options:
            first, second = inputs
            if isinstance(first, Light):
                return getattr(first, f"__{name}__")(second)
            return getattr(second, f"__r{name}__")(first)
        if all(kinds.endswith("?") for kinds in ufunc.types if "O" not in kinds):
            numbers = [np.asarray(i) if isinstance(i, Light) else i for i in inputs]
            return getattr(ufunc, method)(*numbers, **options)
        return refuse_call(ufunc.__name__ if method == "__call__" else f"{ufunc.__name__}.{method}")

    def __array_function__(self, function: Any, _: Any, argument: Any, options: Any) -> Any:
        """Compare, join and write numbers; refuse what would mix the components."""
        name = function.__name__
        if name in TAKES_NUMBERS:
            return function(*numbers_within(argument), **numbers_within(options))
        if name == "reshape":
            return self.reshape(*argument[1:], **options)
        if name in ("shape", "ndim", "size") and len(argument) == 1:
            return getattr(self, name)
        return refuse_call(name)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Light):
            return NotImplemented
        for light in (self, other):
            check_known("light == light", light.stokes)
        # What a detector does not read is equal to itself.
        same = np.array_equal(self.stokes, other.stokes, equal_nan=True)
        return same and self.frame == other.frame

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return _text_of(self._numbers, self.frame)

    def __str__(self) -> str:
        """Return what `repr` does, with 0 for what is no more than rounding."""
        numbers, floor = self._numbers, self.noise
        if is_traced(floor):
            return repr(self)
        quiet = np.where(np.abs(numbers) < floor[..., np.newaxis], 0.0, numbers)
        return _text_of(quiet, self.frame)

    def __getstate__(self) -> dict[str, Any]:
        # What computes the noise stays here.
        own = super().__getstate__()
        if "_noise" in own:
            own["_noise"] = self.noise
        if "_wavelength" in own:
            own["_wavelength"] = self.wavelength
        return own

    def _like(self, stokes: Any, noise: Any, wavelength: Any) -> Light:
        """Return light of other numbers in the frame of this one."""
        frame = self._cached_frame("frame")
        return Light.of(stokes, frame, noise, measured=self.is_measured, wavelength=wavelength)

    def _each(self, change: Callable[[Any], Any]) -> Light:
        frame = self._part_of_frame("frame", self.shape, change)
        numbers, noise = each_number(self._numbers, change), self._inherited(part=change)
        wavelength = part_of_wavelength(self, change)
        return Light.of(numbers, frame, noise, measured=self.is_measured, wavelength=wavelength)

    def _inherited(self, factor: Any = 1.0, part: Any = None) -> Callable[[Array], Array] | None:
        """Return what light that is made of this one has of its noise."""
        return None if is_traced(self.stokes) else inherited_noise((self,), factor, part=part)

    @property
    def _numbers(self) -> Array:
        """The Stokes vectors, for NumPy unless JAX traces them."""
        return known(self.stokes)  # type: ignore[no-any-return]

    def _component(self, place: int) -> Array:
        parts: Any = self.__dict__.get("_stokes")
        is_apart = type(parts) is tuple and "stokes" not in self.__dict__
        return handed_out(parts[place] if is_apart else self._numbers[..., place])  # type: ignore[no-any-return]

    def _where_there(self, value: Any, *components: int) -> Array:
        """Return a value, NaN where light is dark, or has none of some components, for noise."""
        return where_there(value, self._numbers, self.noise, *components)

    @property
    def _ellipse(self) -> tuple[Array, Array, Array]:
        """S1, S2 and S3 over S0, 0 where they are no more than noise."""
        return ellipse_of(self._numbers, self.noise)


_SHOWN = 6
"""How many lights of a batch are shown."""


def _text_of(numbers: Any, frame: Frame) -> str:
    """Return light (..., 4) as one writes it, a few of very many."""
    most = 4 * _SHOWN
    messages = [
        repr(numbers)
        if is_traced(numbers)
        else np.array2string(numbers, separator=", ", threshold=most, edgeitems=2, prefix="Light(")
    ]
    if frame != Frame():
        messages.append("frame=" + repr(frame))
    if numbers.size > most:
        messages.append(f"shape={numbers.shape[:-1]}")
    return f"Light({', '.join(messages)})"
