"""Wavelength: the parameter for the wavelength of a run, and what else names it."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

from optipath.errors import ParameterError, UnitError
from optipath.values.domains import Domain
from optipath.values.parameters import Parameter
from optipath.values.units import NUMBER, UNITS, format_quantity, unit_of

LONGEST = 0.1
"""Above this many metres, a number is no wavelength: materials are known up to microwaves."""

LONGEST_FIRST = 0.01
"""Above this many metres, the least wavelength of a table was most likely in another unit."""


def too_long(wavelength: float) -> str:
    """Say of a number that is too large that it is no wavelength, and what it may have been.

    >>> too_long(188.0).partition(";")[0]
    '188 metres, which is no wavelength of light'
    """
    return (
        f"{wavelength:g} metres, which is no wavelength of light; multiply those in nanometres by "
        f"1e-9, and those in micrometres by 1e-6"
    )


class WavelengthDomain(Domain):
    """Wavelengths in vacuum, above 0 and in metres.

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


_MICROMETRES, _MILLIMETRES = 1e-5, 1e-3
_MOST_NANOMETRES = 1e6
_SMALL, _SMALLER = ("nanometres", "nm"), ("micrometres", "um")


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
        if all(map(falls_with_wavelength, ends := (self.minimum, self.maximum))):
            # In the order in which these rise, wavelengths fall.
            low, high = sorted(map(wavelength_of, ends))  # type: ignore[arg-type, type-var]
            object.__setattr__(self, "minimum", low)
            object.__setattr__(self, "maximum", high)
        for field in ("default", "minimum", "maximum"):
            argument = getattr(self, field)
            if isinstance(argument, str) and (read := wavelength_of(argument)) is not None:
                object.__setattr__(self, field, read)
        super().__post_init__()

    @property
    def yields(self) -> bool:
        """Whether it has nothing of its own, so that another of its name may say all of it."""
        return self.same_specification(Wavelength(self.name))

    def parse(self, text: str, default_unit: str = "") -> Any:
        try:
            read = wavelength_of(text)
        except UnitError as error:
            raise UnitError(f"parameter '{self.name}': {error}") from None
        if read is None and (meant := spectral_unit_meant(unit_of(text))):
            raise UnitError(
                f"parameter '{self.name}': unit '{unit_of(text)}' of '{text}' is unknown; did you "
                f"mean '{meant}'?"
            )
        if read is not None:
            return read
        try:
            return super().parse(text, default_unit)
        except UnitError as fault:
            raise with_other_units(fault, text) from None

    def _check_range(self, array: Any) -> None:
        try:
            super()._check_range(array)
        except ParameterError as error:
            if array.dtype.kind == "c":
                raise
            first = float(array[~self.allows(array)].ravel()[0])
            if not LONGEST < first <= _MOST_NANOMETRES:
                raise
            name, unit = _SMALLER if first < 1.0 else _SMALL
            raise ParameterError(
                f"parameter '{self.name}' is {first:g} metres, which is no wavelength of light; "
                f"for {name} write '{first:g} {unit}'; light "
                f"goes from {_written(self.minimum)} to {_written(self.maximum)}"
            ) from error


def read_within(span: tuple[float, float], argument: Any) -> Any:
    """Return wavelengths in metres that are within the span of a curve.

    >>> print(read_within((44.3e-9, 2.0), "1.9 m"))
    1.9
    """
    most = max(LONGEST, span[1]) if span[1] < math.inf else LONGEST
    return Wavelength(maximum=most).resolve(argument).value


def _written(length: float) -> str:
    """Return a wavelength in the unit in which it is usually written."""
    unit = "nm" if length < _MICROMETRES else "um" if length < _MILLIMETRES else "mm"
    return format_quantity(length, unit)


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


def falls_with_wavelength(text: object) -> bool:
    """Tell whether a text is a photon energy, a wave number or a frequency.

    >>> falls_with_wavelength("2.4 eV"), falls_with_wavelength("516 nm")
    (True, False)
    """
    match = _TEXT.fullmatch(text.strip()) if isinstance(text, str) else None
    return match is not None and match[2] in _TIMES_WAVELENGTH


def with_other_units(fault: UnitError, text: str) -> UnitError:
    """Return what is said of a text that is no length, with what else a wavelength may be in."""
    if (unit := unit_of(text)) and unit not in UNITS:
        return fault
    others = "eV, 1/cm, THz"
    return UnitError(*[each.but(reason=f"{each.reason}, or {others}") for each in fault.faults])


def spectral_unit_meant(word: str) -> str | None:
    """Return the unit of `wavelength_of` that differs in capital letters alone, if any.

    >>> spectral_unit_meant("ev"), spectral_unit_meant("nm")
    ('eV', None)
    """
    return next((unit for unit in _TIMES_WAVELENGTH if unit.lower() == word.lower()), None)
