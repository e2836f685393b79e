"""SpectralDomain: a spectrum, or what it comes to at the wavelength of a run."""

from __future__ import annotations

from typing import Any

from optipath.values.curves.curve import Curve
from optipath.values.curves.curve_value import curve_values
from optipath.values.domains.optional import OptionalDomain
from optipath.values.wavelength import Wavelength


class SpectralDomain(OptionalDomain):
    """Numbers that are not negative, of which a spectrum gives one for each wavelength; or None.

    Examples
    --------
    >>> SPECTRAL.parts("spectrum", None)
    []
    """

    def kept(self, value: Any) -> Any:
        """Return what stands for a spectrum, at the parameter ``wavelength``."""
        if isinstance(value, Curve) and len(value.parts) == 1:
            return curve_values(value, Wavelength())[0]
        return super().kept(value)

    def described(self) -> str:
        return f"a Spectrum, or {super().described()}"


SPECTRAL = SpectralDomain("number", minimum=0.0)
