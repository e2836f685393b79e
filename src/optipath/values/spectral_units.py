"""Wavelengths in vacuum by what else names light: photon energy, wave number and frequency."""

from __future__ import annotations

import math
import re

from optipath.errors import UnitError
from optipath.values.ratios import NUMBER
from optipath.values.units import UNITS, unit_of

_SPEED = 299792458.0
HC = 6.62607015e-34 * _SPEED / 1.602176634e-19
"""h c / e, exact by the definitions of the SI (BIPM, 2019): electronvolts times metres."""

_TIMES_WAVELENGTH = {
    "meV": HC * 1e3,
    "eV": HC,
    "keV": HC / 1e3,
    "1/um": 1e-6,
    "1/mm": 1e-3,
    "1/cm": 1e-2,
    "cm^-1": 1e-2,
    "cm-1": 1e-2,
    "1/m": 1.0,
    "GHz": _SPEED / 1e9,
    "THz": _SPEED / 1e12,
    "PHz": _SPEED / 1e15,
    "Hz": _SPEED,
}
"""What a number in a unit and the wavelength in metres come to when they are multiplied."""

_TEXT = re.compile(rf"([-+]?{NUMBER})\s*(\S+)", re.ASCII)


def wavelength_of(text: str) -> float | None:
    """Return the wavelength that a photon energy, a wave number or a frequency stands for.

    Units: the result in metres.

    Examples
    --------
    >>> round(wavelength_of("2.4 eV") * 1e9, 3), wavelength_of("20000 1/cm")
    (516.601, 5e-07)
    """
    match = _TEXT.fullmatch(text.strip())
    if match is None or match[2] not in _TIMES_WAVELENGTH:
        return None
    number = float(match[1])
    if not 0.0 < number < math.inf:
        raise UnitError(f"'{text}' stands for no wavelength; give a number above 0")
    return _TIMES_WAVELENGTH[match[2]] / number


def falls_with_wavelength(text: object) -> bool:
    """Tell whether a text is a photon energy, a wave number or a frequency.

    Examples
    --------
    >>> falls_with_wavelength("2.4 eV"), falls_with_wavelength("516 nm")
    (True, False)
    """
    match = _TEXT.fullmatch(text.strip()) if isinstance(text, str) else None
    return match is not None and match[2] in _TIMES_WAVELENGTH


def with_other_units(fault: UnitError, text: str) -> UnitError:
    """Return what is said of a text that is no length, with what else a wavelength may be in."""
    if (unit := unit_of(text)) and unit not in UNITS:
        return fault
    return UnitError(*[f"{sentence}, or eV, 1/cm, THz" for sentence in fault.faults])


def spectral_unit_meant(word: str) -> str | None:
    """Return the unit of `wavelength_of` that differs in capital letters alone, if any.

    Examples
    --------
    >>> spectral_unit_meant("ev"), spectral_unit_meant("nm")
    ('eV', None)
    """
    return next((unit for unit in _TIMES_WAVELENGTH if unit.lower() == word.lower()), None)
