"""SpectralDomain: a spectrum, or what it comes to at the wavelength of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, UnitError, ValueFault, shown
from optipath.spelling import closest
from optipath.values.cures import cure
from optipath.values.curves.curve import Curve
from optipath.values.curves.curve_value import curve_values
from optipath.values.domains.optional import OptionalDomain
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.spectra.illuminant import ILLUMINANTS
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    import numpy.typing as npt


def spectrum_meant(text: str) -> str:
    """Return the sentence for a text in place of a spectrum, if it names one.

    Examples
    --------
    >>> print(spectrum_meant("D65"))
    'D65' is no spectrum by itself; write op.Spectrum.illuminant("D65")
    """
    name = closest(text.strip(), ILLUMINANTS) or text.strip().upper()
    if name in ILLUMINANTS:
        made = cure(f'op.Spectrum.illuminant("{name}")', f'{{ illuminant = "{name}" }}')
    elif _is_wavelength(text):
        made = cure(f'op.Spectrum.line("{text.strip()}")', f'{{ line = "{text.strip()}" }}')
    else:
        return ""
    return f"{shown(text)} is no spectrum by itself; write {made}"


def _is_wavelength(text: str) -> bool:
    try:
        return bool(WAVELENGTH.parse(text) > 0.0)
    except OptipathError:
        return False


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

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        if isinstance(value, type):
            made = cure('op.Spectrum.illuminant("D65")', '{ illuminant = "D65" }')
            raise ValueFault(f"{owner} is the class {value.__name__}; give one of it, {made}")
        return super().check(owner, value)

    def parse(self, text: str) -> Any:
        try:
            return super().parse(text)
        except UnitError as fault:
            meant = spectrum_meant(text)
            raise UnitError(*([meant] if meant else fault.faults)) from None

    def described(self) -> str:
        return f"a Spectrum, or {super().described()}"


SPECTRAL = SpectralDomain("number", minimum=0.0)
