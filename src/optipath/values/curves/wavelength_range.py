"""WavelengthRange: at which wavelengths a curve is known."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.domains.wavelengths import WAVELENGTH, WavelengthDomain
from optipath.values.units import format_quantity

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.curves.curve import Curve

_MOST_CHARACTERS = 12
"""How many characters an end of a range may have."""

_PICOMETRES = 1e12


_ROUNDING = 4.0 * sys.float_info.epsilon
"""How far beyond an end, as a share of it, a wavelength is that was meant to be the end."""


def is_within(wavelength: Any, span: tuple[float, float]) -> Any:
    """Tell which wavelengths are within a range, both ends and their rounding included.

    Units: wavelength in metres.

    Examples
    --------
    >>> is_within(830 * 1e-9, (300e-9, 830e-9)), 830 * 1e-9 <= 830e-9
    (True, False)
    """
    low, high = span
    return (wavelength >= low * (1.0 - _ROUNDING)) & (wavelength <= high * (1.0 + _ROUNDING))


@dataclass(frozen=True)
class WavelengthRange(WavelengthDomain):
    """Wavelengths that a curve may be asked for."""

    label: str = ""
    beyond: str = ""

    @classmethod
    def of(cls, curve: Curve) -> WavelengthRange:
        """Return the range of a curve."""
        low, high = curve.span
        return cls("wavelength", "length", low, high, label=curve.label, beyond=curve.beyond)

    def allows(self, numbers: Any) -> Any:
        if numbers.dtype.kind == "c":
            return super().allows(numbers)
        return self.are_numbers(numbers) & is_within(numbers, self.interval)

    def described(self) -> str:
        """Say in words which values are allowed."""
        otherwise = f", or {self.beyond}" if self.beyond else ""
        known = span_text((self.minimum, self.maximum))
        return f"a wavelength within {known}, for which {self.label} is known{otherwise}"


def span_text(span: tuple[float, float]) -> str:
    """Return a range of wavelengths in nanometres.

    Examples
    --------
    >>> span_text((1.88e-7, 1.937e-6)), span_text((0.0, np.inf))
    ('188 nm .. 1937 nm', 'any wavelength')
    >>> span_text((4.959367937328011e-07, 1e-6))
    '495.937 nm .. 1000 nm'
    """
    if span == (0.0, np.inf):
        return "any wavelength"
    return " .. ".join([_end(span[0], math.ceil), _end(span[1], math.floor)])


def _end(wavelength: float, inward: Callable[[float], int]) -> str:
    """Return an end of a range; one of many digits as a wavelength within the range."""
    text = format_quantity(wavelength, WAVELENGTH.unit)
    if len(text) <= _MOST_CHARACTERS or not math.isfinite(wavelength):
        return text
    return f"{inward(wavelength * _PICOMETRES) / 1e3:.10g} nm"
