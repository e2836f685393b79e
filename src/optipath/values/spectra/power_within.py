"""The power of a spectrum between two wavelengths, or at all of them together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.values.displayed import displayed
from optipath.values.spectra.integrals import smooth_powers
from optipath.values.spectra.spectral_values import check_known_at, one_wavelength

if TYPE_CHECKING:
    from optipath.values.spectra.spectrum_kind import SpectrumKind


def power_within(kind: SpectrumKind, low: Any = None, high: Any = None) -> float:
    """Return the power of a spectrum between two wavelengths.

    Units: low, high in metres.
    """
    if low is None and high is None and (whole := _whole(kind)) is not None:
        return whole
    least, most = kind.extent
    ends = np.array(
        [
            least if low is None else one_wavelength("low", low),
            most if high is None else one_wavelength("high", high),
        ]
    )
    if not 0.0 < ends[0] <= ends[1] < np.inf:
        fault = "does not end there" if ends[0] <= ends[1] else "are no range"
        raise ValueFault(
            f"power of {kind.label} from {displayed(float(ends[0]), 'nm')} to "
            f"{displayed(float(ends[1]), 'nm')}: {fault}; give two ends, the lower one first, as "
            f"in spectrum.power('380 nm', '700 nm')"
        )
    check_known_at(kind, ends)
    above = np.inf if high is None else ends[1]
    of_lines = sum(line.power for line in kind.lines if ends[0] <= line.wavelength < above)
    return of_lines + (float(smooth_powers(kind, ends)[0]) if ends[0] < ends[1] else 0.0)


def _whole(kind: SpectrumKind) -> float | None:
    """Return the power at all wavelengths together, of what is known at all of them.

    None where a term has no end, and no integral either.
    """
    if kind.span != (0.0, np.inf):
        return None
    powers = [_power_of(term) for term in kind.terms]
    return None if None in powers else sum(powers)  # type: ignore[arg-type]


def _power_of(term: SpectrumKind) -> float | None:
    """Return the power of a spectrum of one kind at all wavelengths together."""
    if term.integral is not None:
        return term.integral
    low, high = term.extent
    if not high < np.inf:
        return None
    smooth = float(smooth_powers(term, np.array([low, high]))[0]) if low < high else 0.0
    return smooth + sum(line.power for line in term.lines)
