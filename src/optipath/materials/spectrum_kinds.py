"""Kinds of spectra: even, sampled, histogram, Gaussian, lines, black body; arithmetic with them."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, fields, replace
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from optipath.errors import ParameterError, ValueFault
from optipath.faults import shown, unknown
from optipath.materials.illuminants import (
    DAYLIGHT,
    ILLUMINANTS,
    KNOWN_SPAN,
    NANOMETRES,
    grid_edges,
    grid_fault,
    illuminant_density,
)
from optipath.materials.quantities import NON_NEGATIVE
from optipath.materials.tables import Tabulated
from optipath.values.arrays import Unchanging, first_place, locked
from optipath.values.curve import WavelengthRange, is_within, span_text
from optipath.values.domains import Domain, one_number
from optipath.values.units import displayed
from optipath.values.wavelength import LONGEST, WavelengthDomain

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from optipath.values.curve import Curve

    Array = np.ndarray[Any, Any]


class _Places(WavelengthDomain):
    """Wavelengths of light: numbers beyond are most likely in another unit."""

    def described(self) -> str:
        return f"a wavelength above 0 and below {LONGEST:g} m, such as '516 nm' or 516e-9"


PLACES = _Places("wavelength", "length", minimum=5e-324, maximum=LONGEST)


def several(owner: str, value: Any, domain: Domain = NON_NEGATIVE) -> Array:
    """Return numbers of a spectrum; wavelengths in metres, by the domain `PLACES`.

    >>> several("a grid", ["500 nm", "2.4 eV"], PLACES).round(10)
    array([5.000e-07, 5.166e-07])
    """
    return np.array(domain.check(owner, value), np.float64)


def single(owner: str, value: Any, domain: Domain = NON_NEGATIVE) -> float:
    """Return one number of a spectrum.

    >>> single("a line", "633 nm", PLACES)
    6.33e-07
    """
    return one_number(owner, value, domain)


def edges_of(owner: str, value: Any) -> Array:
    """Return the edges (n + 1,) of bins in metres, rising or falling."""
    edges = several(owner, value, PLACES)
    steps = np.diff(edges) if edges.ndim == 1 else np.zeros(0)
    if not steps.size or not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        raise ValueFault(
            f"{owner} must be a row of two wavelengths or more that rise or fall throughout, not "
            f"{shown(value)}"
        )
    return edges


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
    if ((wavelengths >= low) & (wavelengths <= high)).all():
        return
    known = WavelengthRange("wavelength", "length", low, high, label=kind.label, beyond=kind.beyond)
    known.check("a wavelength", wavelengths)


class EmissionLine(NamedTuple):
    """Power at one wavelength. Units: wavelength in metres."""

    wavelength: float
    power: float
    outside: float | None = None


class SpectrumKind(Unchanging, ABC):
    """One distribution of power over wavelengths in metres; a `Spectrum` has one.

    It is known within its span, and may be above 0 within its extent. It is smooth between its
    breaks.
    """

    is_pointwise: ClassVar[bool] = True
    """Whether what it is at each wavelength says all, so that it can be multiplied by others."""
    scaled: ClassVar[str] = "factor"
    """The field that a multiple has another value of."""
    label: str
    span: tuple[float, float] = (0.0, np.inf)
    extent: tuple[float, float] = (0.0, np.inf)
    breaks: Array = np.empty(0)
    integral: float | None = None
    beyond: str = ""
    lines: tuple[EmissionLine, ...] = ()

    @property
    def terms(self) -> tuple[SpectrumKind, ...]:
        """What it is the sum of; itself where it is of one kind."""
        result: tuple[SpectrumKind, ...] = vars(self).get("_terms", (self,))
        return result

    @property
    def content(self) -> tuple[Hashable, ...]:
        """All that it is made of."""
        values = [getattr(self, field.name) for field in fields(self)]  # type: ignore[arg-type]
        numbers = [v.tobytes() if isinstance(v, np.ndarray) else v for v in values]
        return type(self).__name__, *numbers

    @abstractmethod
    def density(self, xp: Any, wavelength: Any) -> Any:
        """Return its power per nanometre, lines aside. Units: wavelength in metres."""

    def times(self, factor: float) -> SpectrumKind:
        """Return a multiple of it."""
        changes = {self.scaled: factor * getattr(self, self.scaled)}
        return replace(self, **changes)  # type: ignore[type-var]


@dataclass(frozen=True, eq=False)
class EvenSpectrum(SpectrumKind):
    """One density at each wavelength."""

    value: float
    scaled = "value"

    def __post_init__(self) -> None:
        vars(self).update(label=f"the constant spectrum of {self.value:g}")

    def density(self, xp: Any, wavelength: Any) -> Any:
        return xp.full_like(wavelength, self.value)


_FOUR_LOG_2 = 4.0 * math.log(2.0)


@dataclass(frozen=True, eq=False)
class GaussianLine(SpectrumKind):
    """A Gaussian of a peak and a full width at half maximum in metres, its integral the power."""

    peak: float
    width: float
    power: float
    scaled = "power"

    def __post_init__(self) -> None:
        # All but what a very wide one has below 0.
        share = 0.5 * math.erfc(-math.sqrt(_FOUR_LOG_2) * self.peak / self.width)
        vars(self).update(
            label=f"the diode at {displayed(self.peak, 'nm')}",
            breaks=self.peak + self.width * np.linspace(-6.0, 6.0, 13),
            integral=self.power * share,
        )

    def density(self, xp: Any, wavelength: Any) -> Any:
        area = self.width * NANOMETRES * math.sqrt(math.pi / _FOUR_LOG_2)
        away = (wavelength - self.peak) / self.width
        return self.power / area * xp.exp(-_FOUR_LOG_2 * away * away)


@dataclass(frozen=True, eq=False)
class Illuminant(SpectrumKind):
    """A standard illuminant: relative powers, 100 at 560 nm, from 300 to 830 nm."""

    name: str
    factor: float = 1.0

    def __post_init__(self) -> None:
        ValueFault.raise_for(unknown("illuminant", self.name, ILLUMINANTS))
        vars(self).update(
            label=f"illuminant {self.name}",
            span=KNOWN_SPAN,
            extent=KNOWN_SPAN,
            beyond="take a lamp of another kind, such as Spectrum.black_body(2856)",
            breaks=DAYLIGHT.wavelengths if self.name == "D65" else np.empty(0),
        )

    def density(self, xp: Any, wavelength: Any) -> Any:
        return self.factor * illuminant_density(self.name, xp, wavelength)


_PLANCK, _SPEED, _BOLTZMANN = 6.62607015e-34, 299792458.0, 1.380649e-23
"""Exact by the definitions of the SI (BIPM, The International System of Units, 2019)."""
_FIRST = 2.0 * _PLANCK * _SPEED**2
_SECOND = _PLANCK * _SPEED / _BOLTZMANN
_AROUND_PEAK = np.geomspace(0.05, 2000.0, 24)


@dataclass(frozen=True, eq=False)
class BlackBody(SpectrumKind):
    """Spectral radiance of a black body, in W/(m2 sr nm).

    2 h c^2 / L^5 / (exp(h c / (L k T)) - 1) for a wavelength L (M. Planck, Ann. Phys. 309, 553
    (1901)), times a factor.
    """

    temperature: float
    factor: float = 1.0

    def __post_init__(self) -> None:
        # The integral is that of Stefan and Boltzmann, per steradian.
        of_unit = 2.0 * math.pi**4 * _BOLTZMANN**4 / (15.0 * _PLANCK**3 * _SPEED**2)
        vars(self).update(
            label=f"the black body of {self.temperature:g} K",
            breaks=2.897771955e-3 / self.temperature * _AROUND_PEAK,
            integral=self.factor * of_unit * self.temperature**4,
        )

    def density(self, xp: Any, wavelength: Any) -> Any:
        exponent = _SECOND / (wavelength * self.temperature)
        # 1 / (exp(x) - 1), which overflows nowhere.
        occupation = xp.exp(-exponent) / -xp.expm1(-exponent)
        return (self.factor * _FIRST / NANOMETRES) * (occupation / wavelength**5)


OUTSIDE = "give outside=0.0 where the spectrum is made, if nothing is there"
EVERYWHERE = (0.0, np.inf)


@dataclass(frozen=True, eq=False)
class Histogram(SpectrumKind):
    """Power (n,) in bins of edges (n + 1,) in metres; its density is power by width."""

    edges: Array
    powers: Array
    outside: float | None = None
    label: str = "a histogram"
    scaled = "powers"
    is_pointwise = False

    def __post_init__(self) -> None:
        edges = edges_of(f"edges of {self.label}", self.edges)
        powers = several(f"powers of {self.label}", self.powers)
        if powers.shape != (edges.size - 1,):
            raise ValueFault(
                f"{self.label} has {edges.size} edges and powers of shape {powers.shape}; give "
                f"{edges.size - 1} powers, one for each bin"
            )
        if edges[0] > edges[-1]:
            edges, powers = edges[::-1].copy(), powers[::-1].copy()
        extent = float(edges[0]), float(edges[-1])
        outside = value_outside(self.label, self.outside)
        vars(self).update(
            edges=locked(edges),
            powers=locked(powers),
            outside=outside,
            span=extent if outside is None else EVERYWHERE,
            extent=extent,
            breaks=edges,
            beyond=OUTSIDE,
        )

    def density(self, xp: Any, wavelength: Any) -> Any:
        # Differences of neighbours are exact, before they are in nanometres.
        densities = self.powers / (np.diff(self.edges) * NANOMETRES)
        place = xp.searchsorted(xp.asarray(self.edges), wavelength, side="right") - 1
        # An edge is of the bin above it, but for the last one.
        result = xp.asarray(densities)[xp.clip(place, 0, self.powers.size - 1)]
        return xp.where(is_within(wavelength, self.extent), result, 0.0)


HELD = ("nearest", "linear")
"""What a spectrum may be beyond its samples, besides 0: the last one, or the straight line on."""


@dataclass(frozen=True, eq=False)
class Sampled(SpectrumKind):
    """Densities (n,) at wavelengths (n,) in metres, linear between them."""

    wavelengths: Array
    values: Array
    outside: float | str | None = None
    label: str = "a sampled spectrum"
    scaled = "values"

    def __post_init__(self) -> None:
        held: Any = self.outside if isinstance(self.outside, str) and self.outside in HELD else ""
        outside = held or value_outside(self.label, self.outside)
        samples = self.wavelengths, [self.values]
        table = Tabulated(self.label, ("value",), *samples, extrapolate=held)
        (values,) = table.columns
        if np.any(bad := values < 0.0):
            raise ValueFault(
                f"value of {self.label} is {values[bad][0]:g}{first_place(bad)}; give numbers of 0 "
                f"or more, such as np.maximum(values, 0.0) of what is measured with noise"
            )
        vars(self).update(
            wavelengths=table.wavelengths,
            values=values,
            outside=outside,
            span=table.known_span if outside is None else EVERYWHERE,
            extent=EVERYWHERE if held else table.known_span,
            breaks=table.wavelengths,
            beyond=f"{OUTSIDE}, or outside='nearest' or 'linear'",
            _table=table,
        )

    def density(self, xp: Any, wavelength: Any) -> Any:
        (result,) = vars(self)["_table"].numbers(xp, xp.clip(wavelength, *self.extent))
        if self.outside in HELD:
            return xp.maximum(result, 0.0)  # Where a straight line goes on there is no less power.
        return xp.where(is_within(wavelength, self.extent), result, 0.0)


@dataclass(frozen=True, eq=False)
class Lines(SpectrumKind):
    """Power at single wavelengths, and nothing between them."""

    lines: tuple[EmissionLine, ...]
    is_pointwise = False

    def __post_init__(self) -> None:
        places = [line.wavelength for line in self.lines]
        vars(self).update(label=called(self.lines), extent=(min(places), max(places)))

    def density(self, xp: Any, wavelength: Any) -> Any:
        return xp.zeros_like(wavelength)

    def times(self, factor: float) -> Lines:
        return Lines(tuple([line._replace(power=factor * line.power) for line in self.lines]))


class SumOfKinds(SpectrumKind):
    """The sum of spectra, known where all of them are."""

    def __init__(self, terms: Sequence[SpectrumKind]) -> None:
        ends = [term for term in terms if np.isfinite(term.span[1])]
        low, high = max(term.span[0] for term in terms), min(term.span[1] for term in terms)
        label = " + ".join(term.label for term in terms)
        if low > high:
            spans = [span_text(term.span) for term in ends]
            raise ValueFault(
                f"{label} are known from {' and from '.join(spans)}, which have no wavelength in "
                f"common; give outside=0.0 to those that are 0 elsewhere"
            )
        lows, highs = zip(*[term.extent for term in terms], strict=True)
        vars(self).update(
            _terms=tuple(terms),
            label=label,
            span=(low, high),
            extent=(min(lows), max(highs)),
            breaks=np.unique(np.concatenate([term.breaks for term in terms])),
            lines=tuple([line for term in terms for line in term.lines]),
            beyond=", and ".join(dict.fromkeys(term.beyond for term in ends)),
        )

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "sum", *[term.content for term in self.terms]

    def density(self, xp: Any, wavelength: Any) -> Any:
        return reduce(add, [term.density(xp, wavelength) for term in self.terms])

    def times(self, factor: float) -> SumOfKinds:
        return SumOfKinds([term.times(factor) for term in self.terms])


def called(lines: Sequence[EmissionLine]) -> str:
    """Return what sentences call some lines.

    >>> called([EmissionLine(633e-9, 1.0)])
    'the line at 633 nm'
    """
    first = displayed(lines[0].wavelength, "nm")
    return f"the {len(lines)} lines from {first} on" if lines[1:] else f"the line at {first}"


_ROUNDING = 1e-12
"""How far, as a share of it, a line may be beyond the end of a grid that was meant to be there."""


def density_of_lines(lines: Sequence[EmissionLine], wavelengths: Any) -> Array:
    """Return the power per nm (n,) of lines, on the grid (n,) of wavelengths in metres.

    A line is within its bin of `grid_edges`, so that the trapezoidal rule gives its power.

    >>> density_of_lines([EmissionLine(500e-9, 2.0)], [400e-9, 490e-9, 600e-9]).round(9)
    array([0.  , 0.02, 0.  ])
    """
    if fault := grid_fault(wavelengths):
        raise ParameterError(
            f"{called(lines)} has its power in one bin of a grid, and the wavelengths of this run "
            f"{fault}; give two or more numbers that rise or fall along one axis, in Python "
            f"path.trace(wavelength=op.wavelengths('380 nm', '700 nm', '40 nm'))"
        )
    edges = grid_edges(wavelengths)
    turn = slice(None, None, -1 if edges[0] > edges[-1] else 1)
    edges = edges[turn]
    widths, result = np.diff(edges), np.zeros(edges.size - 1)
    low, high = edges[0] * (1.0 - _ROUNDING), edges[-1] * (1.0 + _ROUNDING)
    for line in lines:
        place = line.wavelength * NANOMETRES
        if low <= place <= high:
            bin_ = int(np.searchsorted(edges, place, side="right")) - 1
            bin_ = min(max(bin_, 0), result.size - 1)
            result[bin_] += line.power / widths[bin_]
        elif line.outside is None and line.power:
            raise ParameterError(
                f"{called([line])} is outside of the wavelengths of this run, {edges[0]:.10g} nm "
                f".. {edges[-1]:.10g} nm; give some around it, or outside=0.0 to the line"
            )
    return result[turn]


_AROUND = np.arange(-3.0, 3.01, 0.125)
"""Samples of a diode, in widths from its peak, between which straight lines keep its power."""
_SAME_PLACE = 4.0 * np.finfo(float).eps
_RESAMPLE = "spectrum.resample(op.wavelengths('380 nm', '700 nm', '5 nm'))"


def sum_of(first: SpectrumKind, second: SpectrumKind) -> SpectrumKind:
    """Return the sum of two spectra: one of their kind where both are of one, else of both."""
    terms: list[SpectrumKind] = []
    for term in (*first.terms, *second.terms):
        for place, other in enumerate(terms):
            if (joined := _joined(other, term)) is not None:
                terms[place] = joined
                break
        else:
            terms.append(term)
    return _total(terms)


def product_of(first: SpectrumKind, second: SpectrumKind) -> SpectrumKind:
    """Return the product of two spectra, sample by sample."""
    for one, other in ((first, second), (second, first)):
        if isinstance(one, SumOfKinds):
            return _total([product_of(term, other) for term in one.terms])
    for one, other in ((first, second), (second, first)):
        if isinstance(one, Lines) and other.is_pointwise:
            shares = values_at(other, np.array([line.wavelength for line in one.lines]))
            pairs = zip(one.lines, shares.tolist(), strict=True)
            return Lines(tuple([line._replace(power=line.power * share) for line, share in pairs]))
        if isinstance(one, Sampled) and isinstance(other, EvenSpectrum):
            return one.times(other.value)
    places = _sampled_at(first, second, "multiplied")
    if not places.size:
        return EvenSpectrum(0.0)
    values = values_at(first, places) * values_at(second, places)
    endless = first.span[1] == second.span[1] == np.inf
    return _sampled(first, second, places, values, endless=endless)


def quotient_of(first: SpectrumKind, second: SpectrumKind) -> SpectrumKind:
    """Return the quotient of two spectra, such as of what is measured by that of the lamp."""
    places = _sampled_at(first, second, "divided")
    above, below = values_at(first, places), values_at(second, places)
    if np.any(dark := below == 0.0):
        place = displayed(float(places[dark][0]), "nm")
        raise ValueFault(
            f"{second.label} is 0 at {place}, where nothing can be divided by it; resample both "
            f"to wavelengths at which it is above 0"
        )
    endless = second.span[1] == np.inf and getattr(second, "outside", None) != 0.0
    return _sampled(first, second, places, above / below, endless=endless)


def _sampled(
    first: SpectrumKind, second: SpectrumKind, places: Array, values: Array, *, endless: bool
) -> Sampled:
    """Return a product or quotient, beyond its samples what is known of both."""
    outside = [getattr(kind, "outside", None) for kind in (first, second)]
    beyond: float | str | None = "nearest" if outside == ["nearest", "nearest"] else None
    if endless and 0.0 in outside:
        beyond = 0.0
    label = first.label if isinstance(first, Sampled) else second.label
    return Sampled(places, values, beyond, label)


def _total(terms: list[SpectrumKind]) -> SpectrumKind:
    return terms[0] if len(terms) == 1 else SumOfKinds(terms)


def _joined(first: SpectrumKind, second: SpectrumKind) -> SpectrumKind | None:
    """Return the sum of two spectra of one kind that is of this kind again; else None."""
    if isinstance(first, Lines) and isinstance(second, Lines):
        return Lines((*first.lines, *second.lines))
    if isinstance(first, Sampled | Histogram) and isinstance(second, type(first)):
        alike = np.array_equal(first.breaks, second.breaks)
        if alike and first.outside == second.outside != "linear":
            total = getattr(first, first.scaled) + getattr(second, first.scaled)
            return replace(first, **{first.scaled: total})
    return None


def _sampled_at(first: SpectrumKind, second: SpectrumKind, done: str) -> Array:
    """Return the wavelengths at which two spectra can be multiplied or divided."""
    both = f"{first.label} and {second.label}"
    sampled = [kind for kind in (first, second) if isinstance(kind, Sampled)]
    columns = [kind.wavelengths for kind in sampled]
    for kind in (*first.terms, *second.terms):
        if not kind.is_pointwise:
            raise ValueFault(
                f"{both} cannot be {done}, since {kind.label} is power in bins or at single "
                f"wavelengths; make samples of it, spectrum.rebin(edges) and then {_RESAMPLE}"
            )
        if isinstance(kind, GaussianLine) and sampled and _is_missed(kind, sampled[0]):
            columns.append(kind.peak + kind.width * _AROUND)
    if not sampled:
        raise ValueFault(
            f"{both} have no samples at which they could be {done}; resample one of them, "
            f"{_RESAMPLE}"
        )
    places = np.unique(np.concatenate(columns))
    places = places[np.diff(places, prepend=0.0) > _SAME_PLACE * places]
    for kind in sampled:
        places = places[is_within(places, kind.extent)]
    if not places.size and not first.span[1] == second.span[1] == np.inf:
        raise ValueFault(f"{both} have no wavelength in common; give outside=0.0 to one of them")
    return places


def _is_missed(line: GaussianLine, sampled: Sampled) -> bool:
    """Return whether straight lines between samples would not keep the power of a diode."""
    reach = 2.0 * line.width
    places = sampled.wavelengths[np.abs(sampled.wavelengths - line.peak) < reach]
    steps = np.diff(places, prepend=line.peak - reach, append=line.peak + reach)
    return bool(np.max(steps) > 0.5 * line.width)


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_ROUNDS = 40
_AGREES = 4e-15


def powers_between(kind: SpectrumKind, edges: Array) -> Array:
    """Return the power (n,) of a spectrum between edges (n + 1,) in metres, lines included.

    Gauss-Legendre with 16 nodes on pieces halved until it converges; exact for straight lines.
    """
    result = smooth_powers(kind, edges)
    for line in kind.lines:
        if edges[0] <= line.wavelength <= edges[-1]:
            place = int(np.searchsorted(edges, line.wavelength, side="right")) - 1
            result[min(place, result.size - 1)] += line.power
    return result


def smooth_powers(kind: SpectrumKind, edges: Array) -> Array:
    """Return what `powers_between` does, lines aside."""
    inner = kind.breaks[(kind.breaks > edges[0]) & (kind.breaks < edges[-1])]
    ends = np.union1d(edges, inner)
    low, high = ends[:-1], ends[1:]
    whole = _by_gauss(kind, low, high)
    result, least = np.zeros(edges.size - 1), 1e-17 * float(whole.sum())
    for _ in range(_ROUNDS):
        middle = 0.5 * (low + high)
        halves = _by_gauss(kind, low, middle), _by_gauss(kind, middle, high)
        finer = halves[0] + halves[1]
        good = np.abs(finer - whole) <= np.maximum(_AGREES * finer, least)
        np.add.at(result, np.searchsorted(edges, low[good], side="right") - 1, finer[good])
        if good.all():
            return result
        rough = ~good
        whole = np.concatenate([half[rough] for half in halves])
        low = np.concatenate([low[rough], middle[rough]])
        high = np.concatenate([middle[rough], high[rough]])
    np.add.at(result, np.searchsorted(edges, low, side="right") - 1, whole)
    return result


def _by_gauss(kind: SpectrumKind, low: Array, high: Array) -> Array:
    half = 0.5 * (high - low)
    places = 0.5 * (low + high)[:, None] + half[:, None] * _NODES
    density = kind.density(np, places.ravel()).reshape(places.shape)
    return np.asarray(half * NANOMETRES * (density @ _WEIGHTS))


def smooth_power(kind: SpectrumKind, low: float, high: float) -> float:
    """Return the power between two wavelengths in metres, lines aside; 0 where there are none."""
    return float(smooth_powers(kind, np.array([low, high]))[0]) if low < high else 0.0


def whole_power(kind: SpectrumKind) -> float | None:
    """Return the power at all wavelengths; None where a term has no end and no integral."""
    powers = []
    for term in kind.terms:
        if kind.span != EVERYWHERE or (term.integral is None and term.extent[1] == np.inf):
            return None
        of_lines = sum(line.power for line in term.lines)
        smooth = smooth_power(term, *term.extent) if term.integral is None else term.integral
        powers.append(smooth + of_lines)
    return sum(powers)


def power_beyond(kind: SpectrumKind, low: float, high: float) -> float:
    """Return the power beyond two wavelengths in metres, of what of a spectrum ends somewhere."""
    missing = 0.0
    for term in kind.terms:
        first, last = term.extent
        if last < np.inf:
            below, above = (first, min(last, low)), (max(first, high), last)
            missing += smooth_power(term, *below) + smooth_power(term, *above)
            missing += sum(e.power for e in term.lines if not low <= e.wavelength <= high)
    return missing
