"""Wavelength: the parameter for the wavelength of a run, and what else names it."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, UnitError
from optipath.values.domains import Domain
from optipath.values.parameters import Parameter
from optipath.values.units import NUMBER, UNITS, unit_of

if TYPE_CHECKING:
    from collections.abc import Callable


LONGEST = 0.1
"""Above this many metres, a number is no wavelength: materials are known up to microwaves."""

LONGEST_FIRST = 0.01
"""Above this many metres, the least wavelength of a table was most likely in another unit."""


def too_long(wavelength: float) -> str:
    """Say of a number that is too large that it is no wavelength, and what it may have been."""
    return (
        f"{wavelength:g} metres, which is no wavelength of light; for nanometres write "
        f"'{wavelength:g} nm', and for micrometres '{wavelength:g} um'"
    )


class WavelengthDomain(Domain):
    """Wavelengths in vacuum, above 0 and in metres."""

    def parse(self, text: str) -> Any:
        return _read(text, super().parse)

    def described(self) -> str:
        return "a wavelength above 0, in metres or as a text such as '516 nm'"


WAVELENGTH = WavelengthDomain("wavelength", "length", minimum=5e-324)


@dataclass(frozen=True, eq=False)
class Wavelength(Parameter):
    """The wavelength in vacuum, as a parameter that is given when a path is traced.

    Materials, spectra and whatever else depends on it share the one that is called
    ``wavelength``. Numbers are in metres, texts have a unit: ``"516 nm"``, or a photon energy
    (``"2.4 eV"``), a wave number (``"19380 1/cm"``) or a frequency (``"581 THz"``).

    Parameters
    ----------
    name : str, optional
        The keyword that gives it.
    unit : str, optional
        The unit of length in which files and the command line give it.
    minimum, maximum : float, optional
        The range; from X-rays to microwaves.
    help : str, optional
        One line for the command line. All else, as the default, is that of a `Parameter`.

    Raises
    ------
    ParameterError
        As a `Parameter`.

    Examples
    --------
    >>> float(Wavelength().resolve("2.4 eV").value).__round__(12)
    5.16601e-07
    """

    name: str = "wavelength"
    unit: str = "nm"
    minimum: float = 1e-12
    maximum: float = LONGEST
    help: str = "wavelength in vacuum"

    def __post_init__(self) -> None:
        ends: tuple[Any, ...] = self.minimum, self.maximum
        read = [wavelength_of(end) for end in ends if isinstance(end, str)]
        energies = [each for each in read if each is not None]
        if len(energies) == 2:
            # In the order in which they rise, wavelengths fall.
            vars(self).update(minimum=min(energies), maximum=max(energies))
        super().__post_init__()

    @property
    def yields(self) -> bool:
        """Whether it has nothing of its own, so that another of its name may say all of it."""
        return self.same_specification(Wavelength(self.name))

    def _quantity(self, text: str, default_unit: str) -> Any:
        return _read(text, lambda length: super(Wavelength, self)._quantity(length, default_unit))

    def _check_range(self, array: Any) -> None:
        if array.dtype.kind != "c":
            long = (array > max(LONGEST, self.maximum)) & (array < np.inf)
            if np.any(long):
                first = float(array[long].ravel()[0])
                raise ParameterError(f"{self.called} is {too_long(first)}")
        super()._check_range(array)


def read_within(span: tuple[float, float], argument: Any) -> Any:
    """Return wavelengths in metres that are within the span of a curve."""
    most = max(LONGEST, span[1]) if span[1] < math.inf else LONGEST
    return Wavelength(maximum=most).resolve(argument).value


_SPEED = 299792458.0
HC = 6.62607015e-34 * _SPEED / 1.602176634e-19
"""h c / e, exact by the definitions of the SI (BIPM, 2019): electronvolts times metres."""

SPECTRAL = {
    "photon energy": {"eV": HC, "meV": HC * 1e3, "keV": HC / 1e3},
    "wave number": {
        **dict.fromkeys(("1/cm", "cm^-1", "cm-1"), 1e-2),
        "1/um": 1e-6,
        "1/mm": 1e-3,
        "1/m": 1.0,
    },
    "frequency": {"THz": _SPEED / 1e12, "GHz": _SPEED / 1e9, "PHz": _SPEED / 1e15, "Hz": _SPEED},
}
"""What a number in a unit and the wavelength in metres come to when they are multiplied."""

_TIMES_WAVELENGTH = {unit: size for units in SPECTRAL.values() for unit, size in units.items()}

_TEXT = re.compile(rf"([-+]?{NUMBER})\s*(\S+)", re.ASCII)


def wavelength_of(text: str) -> float | None:
    """Return the wavelength in metres of a photon energy, a wave number or a frequency.

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


def _read(text: str, as_length: Callable[[str], Any]) -> Any:
    """Return the wavelength that a text stands for, be it a length or what falls with one."""
    if (read := wavelength_of(text)) is not None:
        return read
    unit = unit_of(text)
    for known in _TIMES_WAVELENGTH:
        if known.lower() == unit.lower():
            raise UnitError(f"unit '{unit}' of '{text}' is unknown; did you mean '{known}'?")
    try:
        return as_length(text)
    except UnitError as fault:
        if unit and unit not in UNITS:
            raise
        others = [each.but(reason=f"{each.reason}, or eV, 1/cm, THz") for each in fault.faults]
        raise UnitError(*others) from None
