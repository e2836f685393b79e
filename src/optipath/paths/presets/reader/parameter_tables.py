"""Reading the declaration of a parameter."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from optipath.paths.format import schema
from optipath.paths.format.codec import decode, decode_given
from optipath.paths.format.schema import texts_in
from optipath.values.domains.domain import Domain
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.parameters import Parameter
from optipath.values.specification import checked_name
from optipath.values.spectral_units import falls_with_wavelength
from optipath.values.unit_names import unit_meant
from optipath.values.units import UNITS, dimension_of, units_of, with_article
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Container, Mapping

    from optipath.paths.format.faults import Faults

_WITH_UNIT = re.compile(rf"[-+.\d][-+.\deE]*\s*({'|'.join(map(re.escape, UNITS))})", re.ASCII)


def read_parameter(
    name: str, table: dict[str, Any], wavelengths: Container[str], faults: Faults
) -> Parameter | None:
    """Return the parameter that a table declares; None where the table is faulty."""
    where, before = f"parameters.{name}", len(faults)
    sound = schema.checked(where, table, schema.PARAMETER, faults)
    named = faults.attempt(where, checked_name, name) is not None
    if sound is None:
        return None
    usual = WAVELENGTH.unit if name in wavelengths else ""
    table, unit = sound, sound.get("unit", usual)
    fault = _unit_fault(where, unit, table)
    if usual and falls_with_wavelength(f"1 {unit}"):
        fault = _no_length(where, unit)
    if fault:
        faults.append(fault)
        return None
    dimension = faults.attempt(where, dimension_of, unit)
    if dimension is None or not named:
        return None
    of_light = name in wavelengths and dimension == "length"
    domain = WAVELENGTH if of_light else Domain("value", dimension, own_unit=unit)
    words = {
        word: faults.attempt(f"{where}.words.{word}", decode, raw, domain, {})
        for word, raw in table.get("words", {}).items()
    }
    keys: dict[str, Any] = {key: table[key] for key in ("help", "optional") if key in table}
    keys |= {"unit": unit, "words": {word: n for word, n in words.items() if n is not None}}
    keys |= _range(where, table, domain, faults)
    kind = Wavelength if of_light else Parameter
    keys.setdefault("help", "")
    default, bare = None, faults.attempt(where, kind, name, None, **keys)
    given = table.get("default")
    waits = isinstance(given, str) and given in words and words[given] is None
    if given is not None and bare is not None and not waits:
        default = faults.attempt(f"{where}.default", decode_given, given, bare)
    if len(faults) > before:
        return None
    bound = table.get("bound", False)
    return faults.attempt(where, kind, name, default, bound=bound, **keys)


def _range(where: str, table: Mapping[str, Any], domain: Domain, faults: Faults) -> dict[str, Any]:
    """Return the limits of a parameter; none where they are faulty."""
    if "range" not in table:
        return {}
    if len(table["range"]) != 2:
        faults.append(f"{where}: 'range' must have two ends, not {len(table['range'])}")
        return {}
    read = _ends_of_light if domain is WAVELENGTH else decode
    ends = faults.attempt(f"{where}.range", read, table["range"], domain, {})
    if ends is None:
        return {}
    if any(isinstance(end, list) for end in ends):
        faults.append(f"{where}: the ends of 'range' must be single values")
        return {}
    return dict(zip(("minimum", "maximum"), ends, strict=True))


def _ends_of_light(raw: list[Any], domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    """Return the two limits of a wavelength, the lower one first where photon energies rise."""
    ends = [decode(end, domain, parameters) for end in raw]
    return sorted(ends) if all(map(falls_with_wavelength, raw)) else ends


def _no_length(where: str, unit: str) -> str:
    """Say that a unit of photon energy or the like is for texts alone, where a wavelength is."""
    return (
        f"{where}: unit '{unit}' is none of length, in which wavelengths are told; leave unit out, "
        f'and write values as texts with it, such as "2.4 {unit}"'
    )


def _unit_fault(where: str, unit: str, table: Mapping[str, Any]) -> str:
    """Say that no value has the dimension of the unit, if so: it is the unit that is wrong."""
    given = texts_in([table.get(key) for key in ("default", "range", "words")])
    units = {text: match[1] for text in given if (match := _WITH_UNIT.fullmatch(text.strip()))}
    dimensions = [UNITS[name].dimension for name in units.values()]
    if not units or (unit in UNITS and dimension_of(unit) in dimensions):
        return ""
    text, found = next(iter(units.items()))
    if unit and unit not in UNITS:
        return f"{where}: unit '{unit}' is unknown{unit_meant(unit, units_of(dimensions[0]))}"
    if not unit:
        cure = f'add unit = "{found}", or give pure numbers if it is one'
        return f"{where} declares no unit, but its values have one; {cure}"
    dimension = with_article(dimension_of(found))
    return f"{where} is in {unit}, but '{text}' is {dimension}; let them agree"
