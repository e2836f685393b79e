"""Kinds of spectra: even, sampled, histogram, Gaussian, lines, black body, and their sums."""

from __future__ import annotations

import math
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.errors import ParameterError, ValueFault, shown
from optipath.materials.illuminants import (
    NANOMETRES,
    EmissionLine,
    SpectrumKind,
    grid_edges,
    grid_fault,
)
from optipath.materials.quantities import NON_NEGATIVE
from optipath.materials.tables import Tabulated
from optipath.values.arrays import first_place, locked
from optipath.values.curve import WavelengthRange, is_within, span_text
from optipath.values.parameters import Parameter
from optipath.values.units import displayed
from optipath.values.wavelength import LONGEST, WAVELENGTH

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from optipath.values.curve import Curve
    from optipath.values.domains import Domain

    Array = np.ndarray[Any, Any]


LENGTH_CURE = "for nanometres write '{0:g} nm', or {0:g}e-9"


def one_number(owner: str, value: Any, domain: Domain = NON_NEGATIVE) -> float:
    """Return one number of a spectrum.

    >>> one_number("power of a line", 2)
    2.0
    """
    array = several_numbers(owner, value, domain)
    if array.ndim:
        raise ValueFault(f"{owner} must be one number, not an array of shape {array.shape}")
    return float(array)


def several_numbers(owner: str, value: Any, domain: Domain = NON_NEGATIVE) -> Array:
    """Return numbers of a spectrum."""
    if isinstance(value, Parameter):
        raise ValueFault(
            f"{owner} cannot be the parameter '{value.name}'; give a number here, and a parameter "
            f"to Source(intensity=...), which a spectrum is multiplied by"
        )
    try:
        array = domain.check(owner, value)
        return np.array(array, np.float64)
    except (TypeError, ValueError):
        raise ValueFault(f"{owner} must be {domain.described()}, not {shown(value)}") from None


def some_wavelengths(owner: str, value: Any) -> Array:
    """Return wavelengths in metres, of numbers in metres or of texts.

    >>> some_wavelengths("a grid", ["500 nm", "2.4 eV"]).round(10)
    array([5.000e-07, 5.166e-07])
    """
    array = several_numbers(owner, value, WAVELENGTH)
    refuse_longest(owner, array)
    return array


def refuse_longest(owner: str, metres: Any) -> None:
    """Raise where lengths are so large that they must be in another unit."""
    if np.size(metres) and (longest := float(np.max(metres))) > LONGEST:
        raise ValueFault(
            f"{owner} is {longest:g} metres, which is no wavelength of light; "
            f"{LENGTH_CURE.format(longest)}"
        )


def one_wavelength(owner: str, value: Any) -> float:
    """Return one wavelength in metres.

    >>> one_wavelength("a line", "633 nm")
    6.33e-07
    """
    array = some_wavelengths(owner, value)
    if array.ndim:
        raise ValueFault(f"{owner} must be one wavelength, not an array of shape {array.shape}")
    return float(array)


def rising_edges(owner: str, value: Any) -> tuple[Array, bool]:
    """Return rising bin edges (n + 1,) in metres, and whether they were given falling."""
    edges = some_wavelengths(owner, value)
    if edges.ndim != 1 or edges.size < 2:
        raise ValueFault(
            f"{owner} must be a row of two wavelengths or more, not of shape {edges.shape}"
        )
    steps = np.diff(edges)
    turned = bool(steps[0] < 0.0)
    if not np.all(steps < 0.0 if turned else steps > 0.0):
        raise ValueFault(f"{owner} neither rise nor fall throughout; sort them, each once")
    return (edges[::-1].copy() if turned else edges), turned


def value_outside(owner: str, outside: Any) -> float | None:
    """Return what a spectrum is beyond what it is known for; None where nobody says."""
    if outside is None:
        return None
    if np.ndim(outside) == 0 and not isinstance(outside, (str, bool)) and outside == 0.0:
        return 0.0
    raise ValueFault(
        f"outside of {owner} is {shown(outside)}; give 0.0 where nothing is there, or leave it out "
        f"(of samples 'nearest' and 'linear' may be given, too)"
    )


def values_at(kind: SpectrumKind, wavelengths: Array) -> Array:
    """Return what a spectrum is at wavelengths, lines aside. Units: wavelengths in metres."""
    check_known_at(kind, wavelengths)
    row = np.ascontiguousarray(wavelengths, np.float64).reshape(-1)
    with np.errstate(all="ignore"):
        return np.asarray(kind.density(np, row)).reshape(np.shape(wavelengths))


def check_known_at(kind: SpectrumKind | Curve, wavelengths: Array) -> None:
    """Raise where a spectrum is not known. Units: wavelengths in metres."""
    low, high = kind.span
    known = WavelengthRange("wavelength", "length", low, high, label=kind.label, beyond=kind.beyond)
    known.check("a wavelength", wavelengths)


class EvenSpectrum(SpectrumKind):
    """One density at each wavelength."""

    value: float

    def __init__(self, value: float) -> None:
        vars(self).update(label=f"the constant spectrum of {value:g}", value=value)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "even", self.value

    def density(self, xp: Any, wavelength: Any) -> Any:
        return xp.full_like(wavelength, self.value)

    def times(self, factor: float) -> EvenSpectrum:
        return EvenSpectrum(factor * self.value)


_FOUR_LOG_2 = 4.0 * math.log(2.0)


class GaussianLine(SpectrumKind):
    """A Gaussian of a peak and a full width at half maximum in metres, its integral the power."""

    peak: float
    width: float
    power: float

    def __init__(self, peak: float, width: float, power: float) -> None:
        label = f"the diode at {displayed(peak, 'nm')}"
        vars(self).update(label=label, peak=peak, width=width, power=power)

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return self.peak + self.width * np.linspace(-6.0, 6.0, 13)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "gaussian", self.peak, self.width, self.power

    @property
    def integral(self) -> float:
        # All but what a very wide one has below 0.
        return 0.5 * self.power * math.erfc(-math.sqrt(_FOUR_LOG_2) * self.peak / self.width)

    def density(self, xp: Any, wavelength: Any) -> Any:
        area = self.width * NANOMETRES * math.sqrt(math.pi / _FOUR_LOG_2)
        away = (wavelength - self.peak) / self.width
        return self.power / area * xp.exp(-_FOUR_LOG_2 * away * away)

    def times(self, factor: float) -> GaussianLine:
        return GaussianLine(self.peak, self.width, factor * self.power)


class Histogram(SpectrumKind):
    """Power (n,) in bins of edges (n + 1,) in metres; its density is power by width."""

    is_pointwise: ClassVar[bool] = False
    edges: np.ndarray[Any, Any]
    powers: np.ndarray[Any, Any]
    outside: float | None

    def __init__(
        self, edges: Any, powers: Any, outside: Any = None, label: str = "a histogram"
    ) -> None:
        ends, turned = rising_edges(f"edges of {label}", edges)
        argument = several_numbers(f"powers of {label}", powers)
        if argument.shape != (ends.size - 1,):
            raise ValueFault(
                f"{label} has {ends.size} edges and powers of shape {argument.shape}; give "
                f"{ends.size - 1} powers, one for each bin"
            )
        argument = argument[::-1].copy() if turned else argument
        # Differences of neighbours are exact, before they are in nanometres.
        widths = np.diff(ends) * NANOMETRES
        vars(self).update(
            label=label,
            edges=locked(ends),
            powers=locked(argument),
            outside=value_outside(label, outside),
            beyond=OUTSIDE,
            _densities=locked(argument / widths),
        )

    _densities: np.ndarray[Any, Any]

    @property
    def span(self) -> tuple[float, float]:  # type: ignore[override]
        return self.extent if self.outside is None else (0.0, np.inf)

    @property
    def extent(self) -> tuple[float, float]:
        return float(self.edges[0]), float(self.edges[-1])

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return self.edges

    @property
    def content(self) -> tuple[Hashable, ...]:
        numbers = self.edges.tobytes(), self.powers.tobytes()
        return "histogram", self.label, *numbers, self.outside

    def density(self, xp: Any, wavelength: Any) -> Any:
        place = xp.searchsorted(xp.asarray(self.edges), wavelength, side="right") - 1
        # An edge is of the bin above it, but for the last one.
        result = xp.asarray(self._densities)[xp.clip(place, 0, self.powers.size - 1)]
        return xp.where(is_within(wavelength, self.extent), result, 0.0)

    def times(self, factor: float) -> Histogram:
        return Histogram(self.edges, factor * self.powers, self.outside, self.label)


_ROUNDING = 1e-12
"""How far, as a share of it, a line may be beyond the end of a grid that was meant to be there."""


class Lines(SpectrumKind):
    """Power at single wavelengths, and nothing between them."""

    is_pointwise: ClassVar[bool] = False

    def __init__(self, lines: Sequence[EmissionLine]) -> None:
        vars(self).update(lines=tuple(lines), label=called(lines))

    @property
    def extent(self) -> tuple[float, float]:
        places = [line.wavelength for line in self.lines]
        return min(places), max(places)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "lines", self.lines

    def density(self, xp: Any, wavelength: Any) -> Any:
        return xp.zeros_like(wavelength)

    def times(self, factor: float) -> Lines:
        return Lines([line._replace(power=factor * line.power) for line in self.lines])


def called(lines: Sequence[EmissionLine]) -> str:
    """Return what sentences call some lines.

    >>> called([EmissionLine(633e-9, 1.0)])
    'the line at 633 nm'
    """
    places = [displayed(line.wavelength, "nm") for line in lines]
    if len(places) == 1:
        return f"the line at {places[0]}"
    return f"the {len(places)} lines from {places[0]} on"


def density_of_lines(lines: Sequence[EmissionLine], wavelengths: Any) -> np.ndarray[Any, Any]:
    """Return the power per nm (n,) of lines, on the grid (n,) of wavelengths in metres.

    A line is within its bin of `grid_edges`, so that the trapezoidal rule gives its power.

    >>> density_of_lines([EmissionLine(500e-9, 2.0)], [400e-9, 490e-9, 600e-9]).round(9)
    array([0.  , 0.02, 0.  ])
    """
    if fault := grid_fault(wavelengths):
        raise ParameterError(
            f"{called(lines)} has its power in one bin of a grid, and the wavelengths of this run "
            f"{fault}; give two or more that rise or fall along one axis, with which all else "
            f"broadcasts, as numbers and not traced: in Python, "
            f"path.trace(wavelength=op.wavelengths('380 nm', '700 nm', '40 nm'))"
        )
    edges = grid_edges(wavelengths)
    result = np.zeros(edges.size - 1)
    widths, falling = np.abs(np.diff(edges)), edges[0] > edges[-1]
    rising = edges[::-1] if falling else edges
    low, high = rising[0] * (1.0 - _ROUNDING), rising[-1] * (1.0 + _ROUNDING)
    for line in lines:
        place = line.wavelength * NANOMETRES
        if low <= place <= high:
            bin_ = int(np.searchsorted(rising, place, side="right")) - 1
            bin_ = min(max(bin_, 0), result.size - 1)
            bin_ = result.size - 1 - bin_ if falling else bin_
            result[bin_] += line.power / widths[bin_]
        elif line.outside is None and line.power:
            raise ParameterError(
                f"{called([line])} is outside of the wavelengths of this run, {rising[0]:.10g} nm "
                f".. {rising[-1]:.10g} nm, so that none of its power is there; run it at "
                f"wavelengths around it, or give outside=0.0 to the line"
            )
    return result


OUTSIDE = "give outside=0.0 where the spectrum is made, if nothing is there"
HELD = ("nearest", "linear")
"""What a spectrum may be beyond its samples, besides 0: the last one, or the straight line on."""


class Sampled(SpectrumKind):
    """Densities (n,) at wavelengths (n,) in metres, linear between them."""

    wavelengths: np.ndarray[Any, Any]
    values: np.ndarray[Any, Any]
    outside: float | str | None

    def __init__(
        self, wavelengths: Any, values: Any, outside: Any = None, label: str = "a sampled spectrum"
    ) -> None:
        held = outside if isinstance(outside, str) and outside in HELD else ""
        table = Tabulated(label, ("value",), wavelengths, [values], extrapolate=held)
        (columns,) = table.columns
        if np.any(bad := columns < 0.0):
            raise ValueFault(
                f"value of {label} is {columns[bad][0]:g}{first_place(bad)}; give numbers of 0 or "
                f"more, such as np.maximum(values, 0.0) of what is measured with noise"
            )
        vars(self).update(
            label=label,
            wavelengths=table.wavelengths,
            values=columns,
            outside=held or value_outside(label, outside),
            beyond=f"{OUTSIDE}, or outside='nearest' or 'linear'",
            _table=table,
        )

    _table: Tabulated

    @property
    def span(self) -> tuple[float, float]:  # type: ignore[override]
        return self.extent if self.outside is None else (0.0, np.inf)

    @property
    def extent(self) -> tuple[float, float]:
        return (0.0, np.inf) if self.outside in HELD else self._table.known_span

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return self.wavelengths

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "sampled", *self._table.content, self.outside

    def density(self, xp: Any, wavelength: Any) -> Any:
        (result,) = self._table.numbers(xp, xp.clip(wavelength, *self.extent))
        if self.outside in HELD:
            return xp.maximum(result, 0.0)  # Where a straight line goes on there is no less power.
        return xp.where(is_within(wavelength, self.extent), result, 0.0)

    def times(self, factor: float) -> Sampled:
        return self.with_values(factor * self.values)

    def with_values(self, values: Any) -> Sampled:
        """Return the spectrum of other values at the same wavelengths."""
        return Sampled(self.wavelengths, values, self.outside, self.label)


_PLANCK, _SPEED, _BOLTZMANN = 6.62607015e-34, 299792458.0, 1.380649e-23
"""Exact by the definitions of the SI (BIPM, The International System of Units, 2019)."""
_FIRST = 2.0 * _PLANCK * _SPEED**2
_SECOND = _PLANCK * _SPEED / _BOLTZMANN
_AROUND_PEAK = np.geomspace(0.05, 2000.0, 24)


class BlackBody(SpectrumKind):
    """Spectral radiance of a black body, in W/(m2 sr nm).

    2 h c^2 / L^5 / (exp(h c / (L k T)) - 1) for a wavelength L (M. Planck, Ann. Phys. 309, 553
    (1901)), times a factor.
    """

    temperature: float
    factor: float

    def __init__(self, temperature: float, factor: float = 1.0) -> None:
        label = f"the black body of {temperature:g} K"
        vars(self).update(label=label, temperature=temperature, factor=factor)

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return 2.897771955e-3 / self.temperature * _AROUND_PEAK

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "black body", self.temperature, self.factor

    @property
    def integral(self) -> float:
        # By Stefan and Boltzmann, per steradian.
        of_unit = 2.0 * math.pi**4 * _BOLTZMANN**4 / (15.0 * _PLANCK**3 * _SPEED**2)
        return self.factor * of_unit * self.temperature**4

    def density(self, xp: Any, wavelength: Any) -> Any:
        exponent = _SECOND / (wavelength * self.temperature)
        # 1 / (exp(x) - 1), which overflows nowhere.
        occupation = xp.exp(-exponent) / -xp.expm1(-exponent)
        return (self.factor * _FIRST / NANOMETRES) * (occupation / wavelength**5)

    def times(self, factor: float) -> BlackBody:
        return BlackBody(self.temperature, factor * self.factor)


class SumOfKinds(SpectrumKind):
    """The sum of spectra, known where all of them are."""

    _terms: tuple[SpectrumKind, ...]

    def __init__(self, terms: Sequence[SpectrumKind]) -> None:
        low = max(term.span[0] for term in terms)
        high = min(term.span[1] for term in terms)
        label = " + ".join(term.label for term in terms)
        if low > high:
            spans = [span_text(term.span) for term in terms if np.isfinite(term.span[1])]
            raise ValueFault(
                f"{label} are known from {' and from '.join(spans)}, which have no wavelength in "
                f"common; give outside=0.0 to those that are 0 elsewhere"
            )
        cures = [term.beyond for term in terms if np.isfinite(term.span[1])]
        vars(self).update(
            _terms=tuple(terms),
            label=label,
            span=(low, high),
            beyond=", and ".join(dict.fromkeys(cures)),
        )

    @property
    def terms(self) -> tuple[SpectrumKind, ...]:
        return self._terms

    @property
    def lines(self) -> tuple[EmissionLine, ...]:  # type: ignore[override]
        return tuple([line for term in self.terms for line in term.lines])

    @property
    def extent(self) -> tuple[float, float]:
        ends = [term.extent for term in self.terms]
        return min(low for low, _ in ends), max(high for _, high in ends)

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return np.unique(np.concatenate([term.breaks for term in self.terms]))

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "sum", *[term.content for term in self.terms]

    def density(self, xp: Any, wavelength: Any) -> Any:
        return reduce(add, [term.density(xp, wavelength) for term in self.terms])

    def times(self, factor: float) -> SumOfKinds:
        return SumOfKinds([term.times(factor) for term in self.terms])
