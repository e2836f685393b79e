"""Sums, products and quotients of spectra: which kinds fit, and what they come to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.values.curves.wavelength_range import is_within
from optipath.values.displayed import displayed
from optipath.values.spectra.even_spectrum import EvenSpectrum
from optipath.values.spectra.gaussian_line import GaussianLine
from optipath.values.spectra.histogram import Histogram
from optipath.values.spectra.lines import Lines
from optipath.values.spectra.sampled import Sampled
from optipath.values.spectra.spectral_values import values_at
from optipath.values.spectra.sum_of_kinds import SumOfKinds

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.values.spectra.spectrum_kind import SpectrumKind

    Array = np.ndarray[Any, Any]

_AROUND = np.arange(-3.0, 3.01, 0.125)
"""Samples of a diode, in widths from its peak, between which straight lines keep its power."""
_ROUNDING = 4.0 * np.finfo(float).eps
_RESAMPLE = "spectrum.resample(op.wavelengths('380 nm', '700 nm', '5 nm'))"


def sum_of(first: SpectrumKind, second: SpectrumKind) -> SpectrumKind:
    """Return the sum of two spectra: one of their kind where both are of one, else of both."""
    terms: list[SpectrumKind] = []
    for term in (*first.terms, *second.terms):
        joined = [_joined(other, term) for other in terms]
        place = next((i for i, one in enumerate(joined) if one is not None), None)
        if place is None:
            terms.append(term)
        else:
            terms[place] = joined[place]  # type: ignore[assignment]
    return _total(terms)


def product_of(first: SpectrumKind, second: SpectrumKind) -> SpectrumKind:
    """Return the product of two spectra, sample by sample."""
    for one, other in ((first, second), (second, first)):
        if isinstance(one, SumOfKinds):
            return _total([product_of(term, other) for term in one.terms])
    for one, other in ((first, second), (second, first)):
        if isinstance(one, Lines) and other.is_pointwise:
            return _lines_through(one, other)
    for one, other in ((first, second), (second, first)):
        if isinstance(one, Sampled) and isinstance(other, EvenSpectrum):
            return one.times(other.value)
    places = _sampled_at(first, second, "multiplied")
    if not places.size:
        return EvenSpectrum(0.0)
    values = values_at(first, places) * values_at(second, places)
    endless = first.span[1] == second.span[1] == np.inf
    return Sampled(places, values, _outside(first, second, endless), _label(first, second))


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
    return Sampled(places, above / below, _outside(first, second, endless), _label(first, second))


def _total(terms: Sequence[SpectrumKind]) -> SpectrumKind:
    return terms[0] if len(terms) == 1 else SumOfKinds(terms)


def _joined(first: SpectrumKind, second: SpectrumKind) -> SpectrumKind | None:
    """Return the sum of two spectra of one kind that is of this kind again; else None."""
    if isinstance(first, Lines) and isinstance(second, Lines):
        return Lines([*first.lines, *second.lines])
    if isinstance(first, Sampled) and isinstance(second, Sampled):
        alike = np.array_equal(first.wavelengths, second.wavelengths)
        if alike and first.outside == second.outside != "linear":
            return first.with_values(first.values + second.values)
    if isinstance(first, Histogram) and isinstance(second, Histogram):
        alike = np.array_equal(first.edges, second.edges)
        if alike and first.outside == second.outside:
            return Histogram(first.edges, first.powers + second.powers, first.outside, first.label)
    return None


def _lines_through(lines: Lines, other: SpectrumKind) -> Lines:
    shares = values_at(other, np.array([line.wavelength for line in lines.lines]))
    pairs = zip(lines.lines, shares.tolist(), strict=True)
    return Lines([line._replace(power=line.power * share) for line, share in pairs])


def _sampled_at(first: SpectrumKind, second: SpectrumKind, done: str) -> Array:
    """Return the wavelengths at which two spectra can be multiplied or divided."""
    both = f"{first.label} and {second.label}"
    for kind in (*first.terms, *second.terms):
        if not kind.is_pointwise:
            lines = isinstance(kind, Lines)
            cure = "spectrum.rebin(edges) and then " if lines else ""
            raise ValueFault(
                f"{both} cannot be {done} wavelength by wavelength, since {kind.label} is power "
                f"{'at single wavelengths' if lines else 'in bins'}; make samples of it, "
                f"{cure}{_RESAMPLE}"
            )
    sampled = [kind for kind in (first, second) if isinstance(kind, Sampled)]
    if not sampled:
        raise ValueFault(
            f"{both} have no samples at which they could be {done}; resample one of them, "
            f"{_RESAMPLE}"
        )
    narrow = [kind for kind in (*first.terms, *second.terms) if isinstance(kind, GaussianLine)]
    places = np.unique(
        np.concatenate(
            [kind.wavelengths for kind in sampled]
            + [kind.peak + kind.width * _AROUND for kind in narrow if _is_lost(kind, sampled[0])]
        )
    )
    places = places[np.diff(places, prepend=0.0) > _ROUNDING * places]
    for kind in sampled:
        places = places[is_within(places, kind.extent)]
    if not places.size and not first.span[1] == second.span[1] == np.inf:
        raise ValueFault(f"{both} have no wavelength in common; give outside=0.0 to one of them")
    return places


def _is_lost(line: GaussianLine, sampled: Sampled) -> bool:
    """Return whether straight lines between samples would not keep the power of a diode."""
    places = sampled.wavelengths[np.abs(sampled.wavelengths - line.peak) < 2.0 * line.width]
    steps = np.diff(
        places, prepend=line.peak - 2.0 * line.width, append=line.peak + 2.0 * line.width
    )
    return bool(np.max(steps) > 0.5 * line.width)


def _outside(first: SpectrumKind, second: SpectrumKind, endless: Any) -> float | str | None:
    """Return what a product or quotient is beyond its samples, None where that is not known."""
    outside = [getattr(kind, "outside", None) for kind in (first, second)]
    if endless and 0.0 in outside:
        return 0.0
    return "nearest" if outside == ["nearest", "nearest"] else None


def _label(first: SpectrumKind, second: SpectrumKind) -> str:
    return first.label if isinstance(first, Sampled) else second.label
