"""Other samples of a spectrum, which keep its values, and other bins, which keep its power."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown, unknown
from optipath.values.displayed import displayed
from optipath.values.spectra.histogram import Histogram
from optipath.values.spectra.integrals import powers_between, smooth_powers
from optipath.values.spectra.lines import called
from optipath.values.spectra.sampled import Sampled
from optipath.values.spectra.spectral_values import (
    check_known_at,
    rising_edges,
    some_wavelengths,
    values_at,
)

if TYPE_CHECKING:
    from optipath.values.spectra.spectrum_kind import SpectrumKind

_LOST = 1e-14
"""The share of the power below which none is said to be lost."""
_CHOICES = ("refuse", "drop")


def resampled(kind: SpectrumKind, wavelengths: Any, outside: Any) -> Sampled:
    """Return the samples of a spectrum at wavelengths."""
    if kind.lines:
        raise ValueFault(
            f"{called(kind.lines)} has no value at a wavelength, so that it cannot be resampled; "
            f"keep its power in bins, spectrum.rebin(edges)"
        )
    places = some_wavelengths("wavelengths", wavelengths)
    try:
        values = values_at(kind, places)
    except ValueFault as fault:
        if outside is None:
            raise
        beside = f"outside={shown(outside)} of resample is for what is beyond the new samples"
        raise ValueFault(*[f"{sentence} ({beside})" for sentence in fault.faults]) from None
    return Sampled(places, values, outside, kind.label)


def rebinned(kind: SpectrumKind, edges: Any, outside: str) -> Histogram:
    """Return the power of a spectrum in bins.

    Shape: edges (n + 1,). Units: edges in metres.
    """
    if faults := unknown("outside", outside, _CHOICES):
        raise ValueFault(*faults)
    ends, _ = rising_edges("edges", edges)
    check_known_at(kind, ends[[0, -1]])
    powers = powers_between(kind, ends)
    if outside == "refuse":
        lost = _power_beyond(kind, ends)
        if lost > _LOST * (lost + float(powers.sum())):
            raise ValueFault(
                f"{kind.label} has a power of {lost:.6g} beyond the bins, which reach from "
                f"{displayed(float(ends[0]), 'nm')} to {displayed(float(ends[-1]), 'nm')}; give "
                f"edges around all of it, or outside='drop' to leave that out"
            )
    low, high = kind.extent
    whole = ends[0] <= low and high <= ends[-1] and kind.span[1] == np.inf
    return Histogram(ends, powers, 0.0 if whole else None, kind.label)


def _power_beyond(kind: SpectrumKind, ends: np.ndarray[Any, Any]) -> float:
    """Return the power beyond the ends of bins, of what of a spectrum ends somewhere."""
    lost = 0.0
    for term in kind.terms:
        low, high = term.extent
        if high < np.inf:
            sides = [(low, min(high, ends[0])), (max(low, ends[-1]), high)]
            rising = [np.array(side) for side in sides if side[0] < side[1]]
            lost += sum(float(smooth_powers(term, side)[0]) for side in rising)
            places = [line for line in term.lines if not ends[0] <= line.wavelength <= ends[-1]]
            lost += sum(line.power for line in places)
    return lost
