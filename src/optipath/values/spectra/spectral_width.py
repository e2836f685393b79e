"""WidthAtPeak: widths along the wavelength, given as lengths or as what else names light."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from optipath.errors import ValueFault
from optipath.values.domains.domain import Domain
from optipath.values.spectral_units import wavelength_of


@dataclass(frozen=True)
class WidthAtPeak(Domain):
    """Full widths around a peak, in metres.

    A width in photon energy, wave number or frequency is the distance between the wavelengths
    half of it above and half of it below the peak: for a width d and a peak p, both per metre,
    d / (p^2 - d^2 / 4).

    Units: peak in metres.

    Examples
    --------
    >>> round(WidthAtPeak("width", "length", peak=620e-9).parse("0.1 eV") * 1e9, 3)
    31.023
    """

    peak: float = 0.0

    def parse(self, text: str) -> Any:
        as_wavelength = wavelength_of(text)
        if as_wavelength is None:
            return super().parse(text)
        # Of the peak: half of the width, as a share of what the peak is in its unit.
        half = 0.5 * self.peak / as_wavelength
        if half >= 1.0:
            raise ValueFault(
                f"'{text}' around a peak at {1e9 * self.peak:.10g} nm reaches down to 0, where "
                f"there is no wavelength; give a width below twice the peak, or one in nanometres"
            )
        return 2.0 * self.peak * half / (1.0 - half * half)

    def described(self) -> str:
        return "a width above 0, in metres or as a text such as '30 nm'"
