"""Values as preset files write them: ``"30 deg"``, ``1.5``, ``"$name"``, ``{n = 1, k = 2}``."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.elements.vertices.vertex_domain import VerticesDomain
from optipath.errors import OptipathError, PresetError, UnitError, did_you_mean, shown
from optipath.paths.format.curve_tables import FORMS, decode_curve, is_curve
from optipath.paths.format.faults import unknown_keys
from optipath.paths.format.lists import decode_list, entry_domain
from optipath.paths.format.references import named, referred
from optipath.paths.format.schema import as_meant
from optipath.paths.format.spectrum_tables import decode_spectrum
from optipath.paths.format.tables_of_angles import chain_by_angles, table_of_angles
from optipath.paths.format.written_curves import material_table, number_table
from optipath.spelling import closest
from optipath.values.arrays.array_likes import array_of
from optipath.values.curves.curve_value import CurveValue
from optipath.values.domains.axis import axes_for
from optipath.values.domains.choice import Choice
from optipath.values.domains.domain import Domain
from optipath.values.domains.followed import Followed
from optipath.values.domains.indices import INDEX, IndexDomain, OutsideDomain
from optipath.values.domains.pair import is_pair, pair_in
from optipath.values.domains.quantities import AMPLITUDE, ANGLE
from optipath.values.domains.rotation_vector import FirstComponentDomain
from optipath.values.domains.spectral import SpectralDomain
from optipath.values.domains.states import IntensityDomain
from optipath.values.follows import FOLLOWS
from optipath.values.materials import K, Material
from optipath.values.parameters import Parameter
from optipath.values.units import dimension_of, format_quantity, parse_quantity, with_article

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from optipath.values.use import Use

_AFFINE = ("parameter", "scale", "offset")
"""The keys of a multiple of a parameter with an offset."""

_LISTED = (IntensityDomain, FirstComponentDomain)
"""Domains whose lists are of several paths in a file, which has a key for each part."""


def decode(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    """Return the value of an element's field.

    Units: the result in radians.

    Examples
    --------
    >>> from optipath.values.domains.quantities import REAL
    >>> decode([1, 2.5], REAL, {})
    [1.0, 2.5]
    """
    if isinstance(domain, Choice):
        return domain.check("the value", raw)
    if entry_domain(domain) is not None:
        return decode_list(raw, domain, lambda entry, of: decode(entry, of, parameters))
    if isinstance(domain, Followed) and raw == FOLLOWS.word:
        return FOLLOWS
    if isinstance(raw, str) and "$" in raw:
        return referred(raw, parameters)
    if isinstance(raw, dict) and isinstance(domain, SpectralDomain) and "parameter" not in raw:
        return decode_spectrum(raw, parameters, lambda one, of: decode(one, of, parameters))
    if isinstance(raw, dict) and is_curve(raw):
        return decode_curve(raw, domain, parameters, lambda one, of: decode(one, of, parameters))
    if isinstance(raw, dict) and raw.keys() & _AFFINE:
        return _affine(raw, domain, parameters)
    if isinstance(raw, dict) and isinstance(domain, (IndexDomain, OutsideDomain)):
        parts = _parts(raw, domain, parameters)
        several = parts.keys() == {"n"} and is_pair(parts["n"])
        return np.array(parts["n"]) if several else Material(**parts)
    if isinstance(raw, dict) and domain.complex_parts:
        return _complex(_parts(raw, domain, {}))
    if isinstance(raw, dict) and isinstance(domain, VerticesDomain):
        return chain_by_angles(raw, lambda angle: decode(angle, ANGLE, parameters))
    if isinstance(raw, str) and raw.strip() in parameters:
        return named(raw, domain)
    if domain.complex_parts and pair_in(raw, domain):
        raise PresetError(which_pair(raw, domain.complex_parts))
    number = _several if isinstance(domain, _LISTED) else _number
    return domain.parse(raw) if isinstance(raw, str) else number(raw, domain.unit)


def which_pair(raw: Sequence[float], names: tuple[str, ...]) -> str:
    """Ask whether a pair of numbers is one complex number, or those of two paths."""
    (first, second), (real, imaginary) = raw, names
    return (
        f"{shown(raw)} may be {real} and {imaginary}, or the numbers of two paths; write "
        f"{{ {real} = {first}, {imaginary} = {second} }} for the one, "
        f"{{ {real} = [{first}, {second}] }} for the other"
    )


def decode_given(raw: Any, parameter: Parameter, uses: Iterable[Use] = ()) -> Any:
    """Return a value given for a parameter: a default, or one of a case.

    Units: the result in radians.
    """
    if isinstance(raw, str):
        try:
            value = axes_for(parameter.name, raw, uses)
            return parameter.parse(value) if isinstance(value, str) else value
        except OptipathError as error:
            # The place in the file has the name already.
            said = f"parameter '{parameter.name}': "
            raise type(error)(*(fault.removeprefix(said) for fault in error.faults)) from None
    if isinstance(raw, list):
        several = [decode_given(entry, parameter, uses) for entry in raw]
        return _several(several) if several and {*map(type, several)} == {float} else several
    if isinstance(raw, dict):
        domain = AMPLITUDE if raw.keys() & AMPLITUDE.complex_parts else INDEX
        return _complex(_parts(raw, domain, {}))
    return _number(raw, parameter.unit)


def encode(value: Any, unit: str, complex_parts: tuple[str, ...] = INDEX.complex_parts) -> Any:
    """Write a value so that decoding gives it back."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, CurveValue):
        return number_table(value, unit, encode)
    if isinstance(value, Parameter):
        return _parameter(value, unit)
    if value is FOLLOWS:
        return FOLLOWS.word
    if isinstance(value, Material):
        return material_table(value, encode)
    if isinstance(value, VerticesByAngles):
        return table_of_angles(value, lambda angle: encode(angle, ANGLE.unit))
    if isinstance(value, str):
        return value
    if isinstance(value, complex) or (isinstance(value, np.ndarray) and value.dtype.kind == "c"):
        number = np.asarray(value)
        return dict(zip(complex_parts, (number.real.tolist(), number.imag.tolist()), strict=True))
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [encode(entry, unit) for entry in value]
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return format_quantity(value, unit) if unit and np.isfinite(value) else value
    raise PresetError(f"{shown(value)} has no form in a preset file; use numbers or parameters")


def _affine(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> Parameter:
    """Return a multiple of a parameter with an offset that is written as a table."""
    faults = unknown_keys(raw, _AFFINE)
    raw = as_meant(raw, _AFFINE)
    name = raw.get("parameter")
    if name is None:
        faults.append("a table with 'scale' or 'offset' needs 'parameter', a name")
    elif not isinstance(name, str) or name not in parameters:
        faults.append(f"parameter {shown(name)} is not declared{did_you_mean(name, parameters)}")
    found: dict[str, Any] = {}
    for key, unit in (("scale", ""), ("offset", domain.unit)):
        if isinstance(raw.get(key), (list, dict)):
            faults.append(f"'{key}' must be one number, not {shown(raw[key])}")
        elif key in raw:
            found[key] = faults.attempt(f"'{key}'", _number, raw[key], unit)
    if faults:
        raise PresetError(*faults)
    return replace(parameters[raw["parameter"]], **found)


def _parameter(value: Parameter, unit: str) -> Any:
    """Write a parameter, or a multiple of one with an offset."""
    if value.is_signed:
        return f"{'-' * value.is_negative}${value.name}"
    row = {"parameter": value.name}
    if value.scale != 1.0:
        row["scale"] = encode(value.scale, "")
    if value.offset:
        row["offset"] = encode(value.offset, unit)
    return row


def _parts(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> dict[str, Any]:
    """Return the parts of a complex number or a material that is written as a table."""
    names = domain.complex_parts or INDEX.complex_parts
    faults = unknown_keys(raw, (*names, *FORMS) if names == INDEX.complex_parts else names)
    if names[0] not in raw and not any(closest(key, FORMS) for key in raw):
        faults.append(f"an {domain.name} written as a table needs '{names[0]}'")
    pure, of_index = Domain(domain.name), names == INDEX.complex_parts
    domains = {key: K if of_index and key == "k" else pure for key in names if key in raw}
    parts = {
        key: faults.attempt(f".{key}", decode, raw[key], of, parameters)
        for key, of in domains.items()
    }
    if faults:
        raise PresetError(*faults)
    return parts


def _complex(parts: Mapping[str, Any]) -> Any:
    try:
        real, *imaginary = map(np.asarray, parts.values())
        return (real + 1j * sum(imaginary))[()]
    except ValueError:
        names = " and ".join(f"'{name}'" for name in parts)
        raise UnitError(f"the shapes of {names} do not fit; make all rows equally long") from None


def _several(raw: Any, unit: str = "") -> Any:
    """Return a number, or an array of several: a file asks of pairs alone."""
    number = _number(raw, unit)
    return array_of("the value", number) if isinstance(number, list) else number


def _number(raw: Any, unit: str) -> Any:
    if isinstance(raw, list) and not raw:
        raise UnitError("an empty list is no value; give at least one number")
    if isinstance(raw, list):
        return [_number(entry, unit) for entry in raw]
    if isinstance(raw, str):
        return parse_quantity(raw, dimension_of(unit))
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        written = str(raw).lower() if isinstance(raw, bool) else shown(raw)
        raise UnitError(f"{written} is not a number")
    try:
        number = float(raw)
    except OverflowError:
        raise UnitError(f"{shown(raw)} is too large a number") from None
    if unit and np.isfinite(number):
        asked = with_article(dimension_of(unit))
        raise UnitError(f"{shown(raw)} has no unit, but {asked} is asked for; write '{raw} {unit}'")
    return number
