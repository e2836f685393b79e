"""WavelengthRange: at which wavelengths a curve is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from optipath.values.domains.wavelengths import WAVELENGTH, WavelengthDomain
from optipath.values.units import format_quantity

if TYPE_CHECKING:
    from optipath.values.curves.curve import Curve


@dataclass(frozen=True)
class WavelengthRange(WavelengthDomain):
    """Wavelengths that a curve may be asked for.

    Attributes
    ----------
    label : str
        What sentences call the curve.
    beyond : str
        What else to do than to stay within its range.
    """

    label: str = ""
    beyond: str = ""

    @classmethod
    def of(cls, curve: Curve) -> WavelengthRange:
        """Return the range of a curve."""
        low, high = curve.span
        return cls("wavelength", "length", low, high, label=curve.label, beyond=curve.beyond)

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
    """
    if span == (0.0, np.inf):
        return "any wavelength"
    return " .. ".join([format_quantity(end, WAVELENGTH.unit) for end in span])
