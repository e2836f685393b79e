"""WavelengthRange: at which wavelengths a curve is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from optipath.values.domains.wavelengths import WavelengthDomain

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
        low, high = self._text(self.minimum), self._text(self.maximum)
        return f"a wavelength within {low} .. {high}, for which {self.label} is known{otherwise}"
