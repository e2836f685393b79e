"""Wavelength: the parameter by which light of a run has its colour."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from optipath.errors import ParameterError, UnitError
from optipath.values.cures import cure
from optipath.values.domains.wavelengths import LONGEST
from optipath.values.parameters import Parameter
from optipath.values.spectral_units import (
    falls_with_wavelength,
    spectral_unit_meant,
    wavelength_of,
    with_other_units,
)
from optipath.values.units import format_quantity, unit_of

_MICROMETRES, _MILLIMETRES = 1e-5, 1e-3
_MOST_NANOMETRES = 1e6
_SMALL, _SMALLER = ("nanometres", "nm", -9), ("micrometres", "um", -6)


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
            given = getattr(self, field)
            if isinstance(given, str) and (read := wavelength_of(given)) is not None:
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
            name, unit, power = _SMALLER if first < 1.0 else _SMALL
            raise ParameterError(
                f"parameter '{self.name}' is {first:g} metres, which is no wavelength of light; "
                f"for {name} write '{first:g} {unit}'{cure(f', or {first:g}e{power}', '')}; light "
                f"goes from {_written(self.minimum)} to {_written(self.maximum)}"
            ) from error


def read_within(span: tuple[float, float], given: Any) -> Any:
    """Return wavelengths in metres, as long as a curve is known for.

    Units: given in metres.

    Examples
    --------
    >>> print(read_within((44.3e-9, 2.0), "1.9 m"))
    1.9
    """
    most = max(LONGEST, span[1]) if span[1] < math.inf else LONGEST
    return Wavelength(maximum=most).resolve(given).value


def _written(length: float) -> str:
    """Return a wavelength in the unit in which it is usually written."""
    unit = "nm" if length < _MICROMETRES else "um" if length < _MILLIMETRES else "mm"
    return format_quantity(length, unit)
