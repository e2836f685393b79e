"""Spectrum: power by wavelength of lamps, lines and bins, and responses of detectors."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING, Any, Literal, NoReturn, TypeAlias

import numpy as np

from optipath.errors import ValueFault
from optipath.faults import listed, shown, unknown
from optipath.materials.quantities import NON_NEGATIVE
from optipath.materials.spectrum_kinds import (
    PLACES,
    BlackBody,
    EmissionLine,
    EvenSpectrum,
    GaussianLine,
    Histogram,
    Illuminant,
    Lines,
    Sampled,
    SpectrumKind,
    called,
    check_known_at,
    density_of_lines,
    edges_of,
    power_beyond,
    powers_between,
    product_of,
    quotient_of,
    several,
    single,
    smooth_power,
    sum_of,
    value_outside,
    values_at,
    whole_power,
)
from optipath.values.columns import read_columns
from optipath.values.curve import Curve
from optipath.values.curve_value import curve_values
from optipath.values.domains import Domain
from optipath.values.jax_values import is_traced, known, namespace
from optipath.values.parameters import Parameter, label_of
from optipath.values.units import displayed
from optipath.values.wavelength import LONGEST, wavelength_of

if TYPE_CHECKING:
    from collections.abc import Hashable
    from os import PathLike
    from typing import Self


_LOST = 1e-14
"""The share of the power below which none is said to be lost."""
_ABOVE = Domain("number above 0", minimum=1e-300)
_TEMPERATURE = Domain("temperature in kelvins", minimum=1e-3, maximum=1e9)
_MAKERS = (
    "sampled(wavelengths, values), histogram, line, led, black_body, illuminant, constant or "
    "from_csv, as in Spectrum.line('633 nm')"
)


Outside: TypeAlias = float | Literal["nearest", "linear"] | None


class Spectrum(Curve):
    """Power per nanometre by wavelength, or a relative value such as a response.

    ``Spectrum(wavelengths, values)`` goes through samples, as `sampled` does. Others are made by
    `histogram`, `line`, `led`, `black_body`, `illuminant`, `constant` and `from_csv`, and by
    arithmetic: a sum, a product with a number, a product or a quotient sample by sample, of two
    sampled spectra at the wavelengths of both. Between these the product of two straight lines is
    a parabola, and is taken as a straight line; so integrals are those of the trapezoids at the
    wavelengths of both, and finer samples, `resample`, bring them closer.

    Parameters
    ----------
    wavelengths : array_like, shape (n,), or SpectrumKind
        Of the samples, in metres or as texts; or a way in which power is spread, alone.
    values : array_like, shape (n,), optional
        Of the samples.
    outside, name
        As `sampled` takes them.

    Attributes
    ----------
    kind : SpectrumKind
        In which way the power is spread.

    Raises
    ------
    ValueFault
        With all that is wrong; all that makes a spectrum raises it.

    Examples
    --------
    >>> lamp = Spectrum.sampled(["400 nm", "600 nm"], [1.0, 3.0])
    >>> float(lamp.at("500 nm").round(12)), round(lamp.power(), 9)
    (2.0, 400.0)
    >>> lamp + Spectrum.line("532 nm", power=50.0)
    <Spectrum: a sampled spectrum + the line at 532 nm>
    """

    __array_ufunc__ = None  # NumPy's arrays leave products to it.

    kind: SpectrumKind

    def __init__(
        self, wavelengths: Any, values: Any = None, *, outside: Outside = None, name: str = ""
    ) -> None:
        kind = wavelengths
        if values is not None:
            label = label_of("a spectrum", name, "a sampled spectrum")
            kind = Sampled(wavelengths, values, outside, label)
        if not isinstance(kind, SpectrumKind):
            raise ValueFault(f"a Spectrum is not made of {shown(kind)}; use Spectrum.{_MAKERS}")
        vars(self).update({name: getattr(kind, name) for name in ("label", "span", "beyond")})
        vars(self).update(kind=kind, takes_grid=bool(kind.lines))

    @classmethod
    def sampled(
        cls, wavelengths: Any, values: Any, *, outside: Outside = None, name: str = ""
    ) -> Self:
        """Return the spectrum through samples, linear between them.

        Parameters
        ----------
        wavelengths : array_like, shape (n,)
            In metres, or texts such as ``"516 nm"``; rising or falling.
        values : array_like, shape (n,)
            Power per nanometre, or relative values; not negative.
        outside : {0.0, "nearest", "linear"}, optional
            What is beyond the samples: nothing, as much as at the last one, or the last straight
            line on, as far as it is above 0; without it, to ask there is an error.
        name : str, optional
            What sentences call it.

        Returns
        -------
        Spectrum
        """
        return cls(wavelengths, () if values is None else values, outside=outside, name=name)

    @classmethod
    def from_csv(
        cls,
        path: str | PathLike[str],
        column: str = "power",
        *,
        unit: str = "",
        outside: Outside = None,
        name: str = "",
    ) -> Self:
        """Return the spectrum through the samples of a file, as `sampled` does.

        Parameters
        ----------
        path : str or PathLike
            Its first line has names: ``wavelength (nm), power``, or the unit stands behind each
            wavelength.
        column : str, optional
            The name of the column of values.
        unit : str, optional
            Of the wavelengths, where the first line has none.
        outside, name
            As `sampled` takes them; the name is that of the file by default.

        Returns
        -------
        Spectrum
        """
        read = read_columns(path, [column], unit=unit)
        values, title = read.columns[column], name or read.title
        with ValueFault.wrapping(str(path)):
            return cls.sampled(read.wavelengths, values, outside=outside, name=title)

    @classmethod
    def histogram(cls, edges: Any, powers: Any, *, outside: Any = None, name: str = "") -> Self:
        """Return the spectrum of bins; its density is the power of a bin by its width in nm.

        Parameters
        ----------
        edges : array_like, shape (n + 1,)
            In metres, or texts; rising or falling. An edge is of the bin above it.
        powers : array_like, shape (n,)
            The power in each bin; not negative.
        outside, name
            As `sampled` takes them, but for ``"nearest"`` and ``"linear"``.

        Returns
        -------
        Spectrum
        """
        return cls(Histogram(edges, powers, outside, label_of("a spectrum", name, "a histogram")))

    @classmethod
    def line(cls, wavelength: Any, power: Any = 1.0, *, outside: Outside = None) -> Self:
        """Return the spectrum of a line, such as that of a laser: all power at one wavelength.

        In a run, all of it stands in the bin of the grid of wavelengths that holds the line,
        however wide that is.

        Parameters
        ----------
        wavelength : float or str
            In metres, or a text such as ``"633 nm"``.
        power : float, optional
            All of it; not negative.
        outside : 0.0, optional
            Where a grid may leave the line out; without it, that is an error.

        Returns
        -------
        Spectrum

        Examples
        --------
        >>> Spectrum.line("500 nm").at(["400 nm", "500 nm", "600 nm"])
        array([0.  , 0.01, 0.  ])
        """
        place = single("wavelength of a line", wavelength, PLACES)
        all_of_it = single("power of a line", power)
        return cls(Lines((EmissionLine(place, all_of_it, value_outside("a line", outside)),)))

    @classmethod
    def led(cls, peak: Any, width: Any, power: Any = 1.0) -> Self:
        """Return the spectrum of a light-emitting diode: a Gaussian along the wavelength.

        Parameters
        ----------
        peak, width : float or str
            The wavelength of the maximum and the full width at half maximum, in metres or texts.
            A width in eV, 1/cm or THz is the distance between the wavelengths half of it above
            and half of it below the peak.
        power : float, optional
            The integral over all wavelengths.

        Returns
        -------
        Spectrum
        """
        place = single("peak of a diode", peak, PLACES)
        widths = WidthAtPeak("width", "length", minimum=5e-324, maximum=LONGEST, peak=place)
        wide = single("width of a diode", width, widths)
        return cls(GaussianLine(place, wide, single("power of a diode", power)))

    @classmethod
    def black_body(cls, temperature: Any) -> Self:
        """Return the spectral radiance of a black body, in W/(m2 sr nm), by Planck's law.

        Parameters
        ----------
        temperature : float
            In kelvins.

        Examples
        --------
        >>> float(Spectrum.black_body(5772).at("502 nm").round(3))
        26239.591
        """
        return cls(BlackBody(single("temperature of a black body", temperature, _TEMPERATURE)))

    @classmethod
    def illuminant(cls, name: Literal["A", "D65", "E"]) -> Self:
        """Return a standard illuminant of the CIE: relative powers, 100 at 560 nm.

        Parameters
        ----------
        name : {"A", "D65", "E"}
            Incandescent light, daylight, or the same everywhere; 300 to 830 nm (CIE 15:2018).
        """
        return cls(Illuminant(name))

    @classmethod
    def constant(cls, value: Any = 1.0) -> Self:
        """Return the spectrum that is the same at each wavelength.

        Parameters
        ----------
        value : float, optional
            Power per nanometre, or a relative value; not negative.
        """
        return cls(EvenSpectrum(single("value of a constant spectrum", value)))

    @property
    def content(self) -> tuple[Hashable, ...]:
        return self.kind.content

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        result = self.kind.density(xp, wavelength)
        if self.kind.lines:
            result = result + density_of_lines(self.kind.lines, wavelength)
        return (result,)

    def at(self, wavelength: Any) -> Any:
        """Return its power per nanometre, or what stands for it at a parameter.

        Parameters
        ----------
        wavelength : float, str, array_like or Parameter
            In metres or as texts, within the span. A line needs all of a grid at once.
        """
        if isinstance(wavelength, Parameter):
            return curve_values(self, wavelength)[0]
        argument = known(wavelength)
        if is_traced(argument):
            return self.numbers(namespace(argument), argument)[0]
        places = several("a wavelength", argument, PLACES)
        check_known_at(self, places)
        return self.evaluated(places)[0]

    def power(self, low: Any = None, high: Any = None) -> float:
        """Return the power between two wavelengths to about 1e-14, lines included.

        Parameters
        ----------
        low, high : float or str, optional
            In metres or as texts; by default, where the spectrum ends, and without both the whole
            power, that of a diode and a black body as well. A line at `low` counts, and one at a
            `high` that is given does not, so that parts sum up to the whole. (The last bin of
            `rebin` has the line at its end.)

        Returns
        -------
        float

        Examples
        --------
        >>> laser = Spectrum.line("500 nm", power=2.0)
        >>> laser.power("400 nm", "500 nm"), laser.power("500 nm", "600 nm"), laser.power()
        (0.0, 2.0, 2.0)
        """
        if low is None and high is None and (whole := whole_power(self.kind)) is not None:
            return whole
        least, most = self.kind.extent
        start = least if low is None else single("low", low, PLACES)
        end = most if high is None else single("high", high, PLACES)
        if not 0.0 < start <= end < np.inf:
            raise ValueFault(
                f"power of {self.label} from {displayed(start, 'nm')} to {displayed(end, 'nm')} is "
                f"none, or does not end there; give two ends, the lower one first"
            )
        check_known_at(self, np.array([start, end]))
        above = np.inf if high is None else end
        of_lines = sum(line.power for line in self.kind.lines if start <= line.wavelength < above)
        return of_lines + smooth_power(self.kind, start, end)

    def resample(self, wavelengths: Any, *, outside: Outside = None) -> Spectrum:
        """Return the sampled spectrum of the same values at other wavelengths.

        The power is that of straight lines between them; `rebin` keeps the power. Lines have no
        value at a wavelength.

        Parameters
        ----------
        wavelengths : array_like, shape (n,)
            In metres or as texts, within the span.
        outside : {0.0, "nearest", "linear"}, optional
            What is beyond the new samples, as in `sampled`.

        Returns
        -------
        Spectrum
        """
        if self.kind.lines:
            raise ValueFault(
                f"{called(self.kind.lines)} has no value at a wavelength, so that it cannot be "
                f"resampled; keep its power in bins, spectrum.rebin(edges)"
            )
        places = several("wavelengths", wavelengths, PLACES)
        return Spectrum(Sampled(places, values_at(self.kind, places), outside, self.label))

    def rebin(self, edges: Any, *, outside: Literal["refuse", "drop"] = "refuse") -> Spectrum:
        """Return the histogram of the same power in other bins.

        Power is kept, in each bin and in all of them to about 1e-14; `resample` keeps values. A
        line is in one bin, on an edge in the one above it.

        Parameters
        ----------
        edges : array_like, shape (n + 1,)
            In metres or as texts, within the span.
        outside : {"refuse", "drop"}, optional
            What becomes of power beyond the edges, of a spectrum that ends somewhere; one that
            does not is cut off.

        Returns
        -------
        Spectrum
        """
        ValueFault.raise_for(unknown("outside", outside, ("refuse", "drop")))
        ends = np.sort(edges_of("edges", edges))
        low, high = float(ends[0]), float(ends[-1])
        check_known_at(self, np.array([low, high]))
        powers = powers_between(self.kind, ends)
        missing = power_beyond(self.kind, low, high) if outside == "refuse" else 0.0
        if missing > _LOST * (missing + float(powers.sum())):
            raise ValueFault(
                f"{self.label} has a power of {missing:.6g} beyond the bins, which reach from "
                f"{displayed(low, 'nm')} to {displayed(high, 'nm')}; give edges around it all, "
                f"or outside='drop'"
            )
        least, most = self.kind.extent
        whole = low <= least and most <= high and self.span[1] == np.inf
        return Spectrum(Histogram(ends, powers, 0.0 if whole else None, self.label))

    @property
    def wavelengths(self) -> np.ndarray[Any, Any]:
        """The wavelengths of the samples, in metres and rising."""
        return self._of(Sampled, "wavelengths", "resample(wavelengths)")

    @property
    def values(self) -> np.ndarray[Any, Any]:
        """The values of the samples."""
        return self._of(Sampled, "values", "resample(wavelengths)")

    @property
    def edges(self) -> np.ndarray[Any, Any]:
        """The edges of the bins, in metres and rising."""
        return self._of(Histogram, "edges", "rebin(edges)")

    @property
    def powers(self) -> np.ndarray[Any, Any]:
        """The powers in the bins."""
        return self._of(Histogram, "powers", "rebin(edges)")

    def __add__(self, other: Any) -> Spectrum:
        if isinstance(other, Spectrum):
            return Spectrum(sum_of(self.kind, other.kind))
        if isinstance(other, (int, float)) and other == 0:
            return self  # With which Python's own sum begins.
        raise ValueFault(
            f"{self.label} + {shown(other)} is no spectrum; add a spectrum, such as "
            f"Spectrum.constant(1.5), which is the same at each wavelength"
        )

    __radd__ = __add__

    def __mul__(self, other: Any) -> Spectrum:
        if isinstance(other, Spectrum):
            return Spectrum(product_of(self.kind, other.kind))
        return self._by_number(other, "a factor")

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Spectrum:
        if isinstance(other, Spectrum):
            return Spectrum(quotient_of(self.kind, other.kind))
        return self._by_number(other, "a divisor", above=True)

    def __rtruediv__(self, other: Any) -> Spectrum:
        return Spectrum.constant(other) / self

    def __sub__(self, *_: Any) -> NoReturn:
        raise ValueFault(
            f"a difference of {self.label} is no spectrum, which is nowhere below 0; make one of "
            f"numbers, Spectrum(wavelengths, spectrum.at(wavelengths) - ...)"
        )

    __neg__ = __rsub__ = __sub__

    def _by_number(self, other: Any, what: str, *, above: bool = False) -> Spectrum:
        number = single(f"{what} of {self.label}", other, _ABOVE if above else NON_NEGATIVE)
        with np.errstate(over="ignore"):  # Samples that are not finite are refused.
            return Spectrum(self.kind.times(1.0 / number if above else number))

    def _of(self, kind: type[SpectrumKind], name: str, cure: str) -> np.ndarray[Any, Any]:
        if not isinstance(self.kind, kind):
            raise ValueFault(f"{self.label} has no {name}; ask for those of spectrum.{cure}")
        result: np.ndarray[Any, Any] = getattr(self.kind, name)
        return result

    def __repr__(self) -> str:
        return f"<Spectrum: {self.label}>"


def check_response(owner: str, response: Any) -> None:
    """Raise where a response is a spectrum with power in bins or lines.

    >>> check_response("the response", Spectrum.constant(0.5))
    """
    curve = getattr(response, "curve", response)
    terms = curve.kind.terms if isinstance(curve, Spectrum) else ()
    if powers := [term.label for term in terms if not term.is_pointwise]:
        raise ValueFault(
            f"{owner} has {listed(powers)}, which is power and no response; give relative values "
            f"at wavelengths, Spectrum.sampled(wavelengths, values)"
        )


_STEP = Domain("step of wavelengths", "length", minimum=1e-18)
_MOST = 10_000_000
_ROUNDING = 1e-9


def wavelengths(low: Any, high: Any, step: Any) -> np.ndarray[Any, Any]:
    """Return wavelengths in equal steps, both ends included.

    Each is the very number that its text stands for, ``"420 nm"``.

    Parameters
    ----------
    low, high, step : float or str
        In metres or as texts such as ``"380 nm"``; the range is a whole number of steps.

    Returns
    -------
    ndarray, shape (n,)
        In metres, rising.

    Examples
    --------
    >>> (wavelengths("380 nm", "700 nm", "40 nm") * 1e9).round().astype(int)
    array([380, 420, 460, 500, 540, 580, 620, 660, 700])
    """
    start, stop = single("low", low, PLACES), single("high", high, PLACES)
    along = single("step", step, _STEP)
    steps = (stop - start) / along
    count = round(steps)
    if not 1 <= count <= _MOST or abs(steps - count) > _ROUNDING * count:
        raise ValueFault(
            f"wavelengths {displayed(start, 'nm')} .. {displayed(stop, 'nm')} are {steps:.6g} "
            f"steps of {displayed(along, 'nm')}; give the lower end first, and a whole number of "
            f"steps, at most {_MOST}"
        )
    first, each = Decimal(repr(start)), Decimal(repr(along))
    results = [float(first + place * each) for place in range(count)]
    return np.array([*results, stop])


@dataclass(frozen=True)
class WidthAtPeak(Domain):
    """Full widths around a peak, in metres.

    A width d in photon energy, wave number or frequency, at a peak p, both per metre, is d / (p^2 -
    d^2 / 4): half of it above and half of it below the peak.

    >>> round(WidthAtPeak("width", "length", peak=620e-9).parse("0.1 eV") * 1e9, 3)
    31.023
    """

    peak: float = 0.0

    def parse(self, text: str) -> Any:
        as_wavelength = wavelength_of(text)
        if as_wavelength is None:
            return super().parse(text)
        # Of the peak: half of the width, as a share of what the peak is in its unit.
        half = 0.5 * self.peak / as_wavelength
        if half >= 1.0:
            raise ValueFault(
                f"'{text}' around a peak at {1e9 * self.peak:.10g} nm reaches down to 0, where "
                f"there is no wavelength; give a width below twice the peak, or one in nanometres"
            )
        return 2.0 * self.peak * half / (1.0 - half * half)

    def described(self) -> str:
        return "a width above 0, in metres or as a text such as '30 nm'"
