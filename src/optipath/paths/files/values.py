"""Values in preset files: ``"30 deg"``, ``1.5``, ``"$name"``, ``{n = 1, k = 2}``."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import chain, repeat
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertex_chain import VerticesByAngles, VerticesDomain
from optipath.errors import OptipathError, PresetError, UnitError, did_you_mean, shown
from optipath.materials.index_domains import (
    FOLLOWED_OUTSIDE,
    FOLLOWS,
    INDEX,
    LENGTH_OF_LAYER,
    Followed,
    IndexDomain,
    IndicesDomain,
    LengthsDomain,
    OutsideDomain,
)
from optipath.materials.material import K, Material
from optipath.materials.quantities import AMPLITUDE, ANGLE, SpectralDomain
from optipath.paths.files.curve_tables import (
    FORMS,
    decode_curve,
    is_curve,
    material_table,
    number_table,
)
from optipath.paths.files.schema import Faults, checked_table, each_entry, each_key, number_of
from optipath.paths.files.spectrum_tables import decode_spectrum
from optipath.values.arrays import array_of
from optipath.values.curve_value import CurveValue
from optipath.values.domains import (
    Choice,
    Domain,
)
from optipath.values.parameters import Parameter
from optipath.values.units import format_quantity
from optipath.values.use import axes_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from optipath.values.use import Use


_AFFINE = {"parameter": str, "scale": object, "offset": object}
"""The keys of a multiple of a parameter with an offset."""


def decode(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    """Return the value of an element's field, in base units.

    >>> from optipath.materials.quantities import REAL
    >>> decode([1, 2.5], REAL, {})
    [1.0, 2.5]
    """
    if isinstance(domain, Choice):
        return domain.check("the value", raw)
    if entry_domain(domain) is not None:
        return _list(raw, domain, parameters)
    if isinstance(domain, Followed) and raw == FOLLOWS.word:
        return FOLLOWS
    if isinstance(raw, dict):
        return _of_table(raw, domain, parameters)
    if isinstance(raw, str):
        return _of_text(raw, domain, parameters)
    return _number(raw, domain.unit)


def _of_table(raw: dict[str, Any], domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    one = partial(decode, parameters=parameters)
    if isinstance(domain, SpectralDomain) and "parameter" not in raw:
        return decode_spectrum(raw, parameters, one)
    if is_curve(raw):
        return decode_curve(raw, domain, parameters, one)
    if raw.keys() & _AFFINE.keys():
        return _affine(raw, domain, parameters)
    if isinstance(domain, (IndexDomain, OutsideDomain)):
        parts = _parts(raw, domain, parameters)
        if parts.keys() == {"n"} and isinstance(parts["n"], list):
            return np.array(parts["n"])
        return Material(**parts)
    if domain.complex_parts:
        return _complex(_parts(raw, domain, {}))
    if isinstance(domain, VerticesDomain):
        return chain_by_angles(raw, partial(one, domain=ANGLE))
    return number_of(raw, domain.unit)  # Which it is not.


def _of_text(raw: str, domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    if "$" in raw:
        return referred(raw, parameters)
    try:
        return domain.parse(raw)
    except OptipathError:
        if raw.strip() in parameters:
            raise PresetError(
                f"'{raw}' is no number; write \"${raw.strip()}\" for the parameter"
            ) from None
        raise


def decode_argument(raw: Any, parameter: Parameter, uses: Iterable[Use] = ()) -> Any:
    """Return the value of a parameter, a default or one of a case, in base units."""
    if isinstance(raw, str):
        value = axes_for(parameter.name, raw, uses)
        return parameter.parse(value) if isinstance(value, str) else value
    if isinstance(raw, list):
        several = [decode_argument(entry, parameter, uses) for entry in raw]
        return array_of("the value", several) if {*map(type, several)} == {float} else several
    if isinstance(raw, dict):
        domain = AMPLITUDE if raw.keys() & AMPLITUDE.complex_parts else INDEX
        return _complex(_parts(raw, domain, {}))
    return _number(raw, parameter.unit)


def text_or_number(raw: Any, unit: str) -> Any:
    """Return a text as it is, which a `Parameter` reads, or a number, which has no unit."""
    return raw if isinstance(raw, str) else _number(raw, unit)


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


def referred(raw: str, parameters: Mapping[str, Parameter]) -> Parameter:
    """Return the parameter that ``"$name"`` or ``"-$name"`` stands for."""
    sign, _, name = raw.partition("$")
    if sign in ("", "-") and name in parameters:
        return -parameters[name] if sign else parameters[name]
    if sign in ("", "-") and name.isidentifier():
        known = [f"${parameter}" for parameter in parameters]
        raise PresetError(f"parameter '{raw}' is not declared{did_you_mean(raw, known)}")
    raise PresetError(
        f"'{raw}' is no name of a parameter; write a multiple of one, with an offset, as "
        f'{{ parameter = "NAME", scale = 0.5, offset = ... }}'
    )


def _affine(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> Parameter:
    """Return a multiple of a parameter with an offset that is written as a table."""
    checked_table(raw, _AFFINE, ("parameter",))
    faults, name = Faults(), raw["parameter"]
    if name not in parameters:
        faults.append(f"parameter '{name}' is not declared{did_you_mean(name, parameters)}")
    units = {"scale": "", "offset": domain.unit}
    numbers: dict[str, Any] = {
        key: faults.attempt(f".{key}", _one_number, raw[key], unit)
        for key, unit in units.items()
        if key in raw
    }
    faults.refuse()
    return replace(parameters[name], **numbers)


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
    of_index = names == INDEX.complex_parts
    checked_table(raw, (*names, *FORMS) if of_index else names, names[:1])
    domains = dict.fromkeys(names, Domain(domain.name)) | ({"k": K} if of_index else {})
    parts = {key: raw[key] for key in domains if key in raw}
    return each_key(parts, lambda key, part: decode(part, domains[key], parameters))


def _complex(parts: Mapping[str, Any]) -> Any:
    try:
        real, *imaginary = map(np.asarray, parts.values())
        return (real + 1j * sum(imaginary))[()]
    except ValueError:
        names = " and ".join(f"'{name}'" for name in parts)
        raise UnitError(f"the shapes of {names} do not fit; make all rows equally long") from None


def _one_number(raw: Any, unit: str) -> Any:
    if isinstance(raw, list):
        raise UnitError(f"{shown(raw)} must be one number")
    return _number(raw, unit)


def _number(raw: Any, unit: str) -> Any:
    if not isinstance(raw, list):
        return number_of(raw, unit)
    if not raw:
        raise UnitError("an empty list is no value; give at least one number")
    return [_number(entry, unit) for entry in raw]


def entry_domain(domain: Domain) -> Domain | None:
    """Return what each entry of a list may be; None where a value is no list of values."""
    if isinstance(domain, IndicesDomain):
        return INDEX
    return LENGTH_OF_LAYER if isinstance(domain, LengthsDomain) else None


def _list(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> list[Any]:
    """Return the values of a list of indices, or of lengths."""
    of_indices, each = isinstance(domain, IndicesDomain), entry_domain(domain) or domain
    if not isinstance(raw, list):
        example = "[1, 1.5, { n = 0.6, k = 2 }]" if of_indices else '["2 mm", "0.1 mm"]'
        raise PresetError(f"{shown(raw)} is no list; write one such as {example}")
    domains = chain([FOLLOWED_OUTSIDE if of_indices else each], repeat(each))
    pairs = zip(raw, domains, strict=False)
    return each_entry(pairs, lambda pair: decode(pair[0], pair[1], parameters))


def references_in(raw: Any) -> set[str]:
    """Return the names of the parameters that a part of a document refers to.

    >>> mirror = {"index": {"n": "$n1", "k": 0.1}, "azimuth": {"parameter": "rho", "scale": -2}}
    >>> sorted(references_in([mirror, "-$phi"]))
    ['n1', 'phi', 'rho']
    """
    result, left = set(), [raw]
    while left:
        entry = left.pop()
        if isinstance(entry, str):
            sign, dollar, name = entry.partition("$")
            if dollar and sign in ("", "-"):
                result.add(name)
        elif isinstance(entry, dict):
            left += entry.values()
            multiple = entry.get("parameter")
            if isinstance(multiple, str):
                result.add(multiple)
        elif isinstance(entry, list):
            left += entry
    return result


def wavelength_names(raw: Any) -> set[str]:
    """Return the names of parameters used as a wavelength; ``wavelength`` is always one.

    >>> sorted(wavelength_names([{"wavelength": "$lam"}, {"thickness": "$d"}]))
    ['lam', 'wavelength']
    """
    result, left = {"wavelength"}, [raw]
    while left:
        entry = left.pop()
        if isinstance(entry, dict):
            when = entry.get("wavelength")
            name = when.get("parameter") if isinstance(when, dict) else when
            if isinstance(name, str):
                result.add(name.lstrip("-").lstrip("$"))
            left += entry.values()
        elif isinstance(entry, list):
            left += entry
    return result


_ANGLES = ("incidences", "turns")
_BACKWARDS = "backwards"


def chain_by_angles(raw: Mapping[str, Any], decoded: Callable[[Any], Any]) -> VerticesByAngles:
    """Return the chain of a table.

    >>> chain_by_angles({"incidences": [0.5], "backwards": True}, float)
    VerticesByAngles(incidences=(0.5,), turns=(), backwards=True)
    """
    schema = {**dict.fromkeys(_ANGLES, list), _BACKWARDS: bool}
    checked_table(raw, schema)
    incidences, turns = (tuple(each_entry(raw.get(key, []), decoded, f".{key}")) for key in _ANGLES)
    return VerticesByAngles(incidences, turns, raw.get(_BACKWARDS, False))


def table_of_angles(chain: VerticesByAngles, encoded: Callable[[Any], Any]) -> dict[str, Any]:
    """Return the table of a chain.

    >>> table_of_angles(VerticesByAngles((0.5, 0.6), (0.1,)), str)
    {'incidences': ['0.5', '0.6'], 'turns': ['0.1']}
    """
    table: dict[str, Any] = {
        key: [encoded(angle) for angle in getattr(chain, key)] for key in _ANGLES
    }
    return table | {_BACKWARDS: True} if chain.backwards else table
