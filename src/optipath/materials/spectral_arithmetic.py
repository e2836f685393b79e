"""Arithmetic with spectra: sums, products, integrals and resampling."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.materials.illuminants import NANOMETRES
from optipath.materials.spectrum_kinds import (
    EVERYWHERE,
    EvenSpectrum,
    GaussianLine,
    Histogram,
    Lines,
    Sampled,
    SumOfKinds,
    values_at,
)
from optipath.values.curve import is_within
from optipath.values.units import displayed

if TYPE_CHECKING:
    from optipath.materials.spectrum_kinds import SpectrumKind

    Array = np.ndarray[Any, Any]


_AROUND = np.arange(-3.0, 3.01, 0.125)
"""Samples of a diode, in widths from its peak, between which straight lines keep its power."""
_ROUNDING = 4.0 * np.finfo(float).eps
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
    if isinstance(first, Sampled) and isinstance(second, Sampled):
        alike = np.array_equal(first.wavelengths, second.wavelengths)
        if alike and first.outside == second.outside != "linear":
            return replace(first, values=first.values + second.values)
    if isinstance(first, Histogram) and isinstance(second, Histogram):
        alike = np.array_equal(first.edges, second.edges)
        if alike and first.outside == second.outside:
            return replace(first, powers=first.powers + second.powers)
    return None


def _sampled_at(first: SpectrumKind, second: SpectrumKind, done: str) -> Array:
    """Return the wavelengths at which two spectra can be multiplied or divided."""
    both = f"{first.label} and {second.label}"
    sampled = [kind for kind in (first, second) if isinstance(kind, Sampled)]
    columns = [kind.wavelengths for kind in sampled]
    for kind in (*first.terms, *second.terms):
        if not kind.is_pointwise:
            raise ValueFault(
                f"{both} cannot be {done} wavelength by wavelength, since {kind.label} is power "
                f"in bins or at single wavelengths; make samples of it, spectrum.rebin(edges) and "
                f"then {_RESAMPLE}"
            )
        if isinstance(kind, GaussianLine) and sampled and _is_missed(kind, sampled[0]):
            columns.append(kind.peak + kind.width * _AROUND)
    if not sampled:
        raise ValueFault(
            f"{both} have no samples at which they could be {done}; resample one of them, "
            f"{_RESAMPLE}"
        )
    places = np.unique(np.concatenate(columns))
    places = places[np.diff(places, prepend=0.0) > _ROUNDING * places]
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
