"""Samples of curves in preset files: wavelengths with their unit, and numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import PresetError, UnitError, shown
from optipath.paths.format.faults import Faults
from optipath.values.curves.doubtful_units import unit_doubted
from optipath.values.curves.tabulated import Tabulated
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.materials import K, N
from optipath.values.units import dimension_of, format_quantity, parse_quantity, with_article

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.domains.domain import Domain

_NM = "nm"


def sampled_curve(raw: Mapping[str, Any], columns: tuple[str, ...], domain: Domain) -> Tabulated:
    """Return the curve through the samples of a table."""
    faults, domains = Faults(), {"n": N, "k": K, "values": domain}
    of_numbers = columns == ("values",)
    given = [key for key in columns if key in raw or of_numbers]
    axis = faults.attempt(".wavelengths", wavelengths_of, raw["wavelengths"], raw.get("unit"))
    samples = []
    for key in given:
        read = faults.attempt(f".{key}", samples_of, raw.get(key), domains[key].unit)
        samples.append(read)
        if read is not None and not of_numbers:
            faults.attempt(f".{key}", domains[key].check, key, read)
    if faults:
        raise PresetError(*faults)
    how = {key: raw[key] for key in ("interpolation", "extrapolate") if key in raw}
    usual = f"{domain.name} by wavelength" if of_numbers else "the table"
    parts = tuple(key.removesuffix("s") for key in given)
    return Tabulated(raw.get("name", usual), parts, axis, samples, **how)


def wavelengths_of(raw: Any, unit: Any = None) -> list[float]:
    """Return wavelengths in metres.

    Examples
    --------
    >>> wavelengths_of([500, 520], "nm"), wavelengths_of(["0.5 um"])
    ([5e-07, 5.2e-07], [5e-07])
    """
    entries = _list(raw)
    found = [_wavelength(entry, place, unit) for place, entry in enumerate(entries)]
    if not any(isinstance(entry, str) for entry in entries) and (
        doubt := unit_doubted(found, unit)
    ):
        raise PresetError(doubt)
    return found


def _wavelength(entry: Any, place: int, unit: Any) -> float:
    if unit is not None and not isinstance(unit, str):
        raise PresetError(f'the unit must be a text, such as "nm", not {shown(unit)}')
    if isinstance(entry, str):
        return float(WAVELENGTH.parse(entry))
    number = _real(entry, place)
    if unit is None:
        raise UnitError(
            f'{shown(entry)} has no unit, but a wavelength is asked for; add unit = "nm" to the '
            f'table, or write "{entry} nm"'
        )
    return float(WAVELENGTH.parse(f"{number} {unit}"))


def samples_of(raw: Any, unit: str) -> list[float]:
    """Return the samples of one quantity in base units.

    Examples
    --------
    >>> samples_of([1.5, 1.6], ""), samples_of(["1 mm"], "mm")
    ([1.5, 1.6], [0.001])
    """
    return [
        _sample(entry, place, unit)
        for place, entry in enumerate(_list(raw, "with a number for each wavelength or bin"))
    ]


def _sample(entry: Any, place: int, unit: str) -> float:
    if isinstance(entry, str):
        number = parse_quantity(entry, dimension_of(unit))
        if isinstance(number, complex):
            raise PresetError(f"[{place}] is {shown(entry)}, but a real number is asked for")
        return number
    number = _real(entry, place)
    if unit:
        asked = with_article(dimension_of(unit))
        raise UnitError(
            f'{shown(entry)} has no unit, but {asked} is asked for; write "{entry} {unit}"'
        )
    return number


def _list(raw: Any, of: str = "of one wavelength or more") -> list[Any]:
    if isinstance(raw, list) and raw:
        return raw
    raise PresetError(f"must be a list {of}, not {shown(raw)}")


def _real(entry: Any, place: int) -> float:
    if isinstance(entry, bool) or not isinstance(entry, (int, float)) or not np.isfinite(entry):
        raise PresetError(f"[{place}] is {shown(entry)}, but a finite number is asked for")
    return float(entry)


def written_wavelengths(metres: Any) -> dict[str, Any]:
    """Return wavelengths as a table has them, from which the same numbers are read.

    Shape: metres (n,). Units: metres in metres.

    Examples
    --------
    >>> written_wavelengths([5e-07, 5.2e-07])
    {'wavelengths': [500.0, 520.0], 'unit': 'nm'}
    """
    metres = np.asarray(metres).tolist()
    texts = [format_quantity(one, _NM) for one in metres]
    numbers = [float(text.split()[0]) for text in texts]
    if not unit_doubted(metres, _NM) and wavelengths_of(numbers, _NM) == metres:
        return {"wavelengths": numbers, "unit": _NM}
    return {"wavelengths": texts}
