"""Wavelengths: lengths, given as photon energies, wave numbers and frequencies as well."""

from __future__ import annotations

from typing import Any

from optipath.errors import UnitError
from optipath.values.domains.domain import Domain
from optipath.values.spectral_units import wavelength_of, with_other_units

LONGEST = 0.1
"""Above this many metres, a number is no wavelength: materials are known up to microwaves."""

LONGEST_FIRST = 0.01
"""Above this many metres, the least wavelength of a table was most likely in another unit."""


def too_long(wavelength: float) -> str:
    """Say of a number that is too large that it is no wavelength, and what it may have been.

    Examples
    --------
    >>> too_long(188.0).partition(";")[0]
    '188 metres, which is no wavelength of light'
    """
    return (
        f"{wavelength:g} metres, which is no wavelength of light; multiply those in nanometres by "
        f"1e-9, and those in micrometres by 1e-6"
    )


class WavelengthDomain(Domain):
    """Wavelengths in vacuum, above 0 and in metres.

    Examples
    --------
    >>> WAVELENGTH.check("a line", "516 nm")
    array(5.16e-07)
    """

    def parse(self, text: str) -> Any:
        read = wavelength_of(text)
        if read is not None:
            return read
        try:
            return super().parse(text)
        except UnitError as fault:
            raise with_other_units(fault, text) from None

    def described(self) -> str:
        return "a wavelength above 0, in metres or as a text such as '516 nm'"


WAVELENGTH = WavelengthDomain("wavelength", "length", minimum=5e-324)
