"""Values in preset files: ``"30 deg"``, ``1.5``, ``"$name"``, ``{n = 1, k = 2}``."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertex_chain import VerticesByAngles, VerticesDomain
from optipath.errors import OptipathError, PresetError, UnitError, closest, did_you_mean, shown
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
from optipath.paths.files.schema import Faults, as_meant, unknown_keys
from optipath.paths.files.spectrum_tables import decode_spectrum
from optipath.values.arrays import array_of
from optipath.values.curve_value import CurveValue
from optipath.values.domains import (
    Choice,
    Domain,
    FirstComponentDomain,
    IntensityDomain,
    is_pair,
    pair_in,
)
from optipath.values.parameters import Parameter
from optipath.values.units import dimension_of, format_quantity, parse_quantity, with_article
from optipath.values.use import axes_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from optipath.values.use import Use


_AFFINE = ("parameter", "scale", "offset")
"""The keys of a multiple of a parameter with an offset."""

_LISTED = (IntensityDomain, FirstComponentDomain)
"""Domains whose lists are of several paths in a file, which has a key for each part."""


def decode(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    """Return the value of an element's field, in base units.

    >>> from optipath.materials.quantities import REAL
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


def decode_argument(raw: Any, parameter: Parameter, uses: Iterable[Use] = ()) -> Any:
    """Return the value of a parameter, a default or one of a case, in base units."""
    if isinstance(raw, str):
        value = axes_for(parameter.name, raw, uses)
        return parameter.parse(value) if isinstance(value, str) else value
    if isinstance(raw, list):
        several = [decode_argument(entry, parameter, uses) for entry in raw]
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
    results: dict[str, Any] = {}
    for key, unit in (("scale", ""), ("offset", domain.unit)):
        if isinstance(raw.get(key), (list, dict)):
            faults.append(f"'{key}' must be one number, not {shown(raw[key])}")
        elif key in raw:
            results[key] = faults.attempt(f"'{key}'", _number, raw[key], unit)
    if faults:
        raise PresetError(*faults)
    return replace(parameters[raw["parameter"]], **results)


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
        request = with_article(dimension_of(unit))
        raise UnitError(
            f"{shown(raw)} has no unit, but {request} is asked for; write '{raw} {unit}'"
        )
    return number


def entry_domain(domain: Domain) -> Domain | None:
    """Return what each entry of a list may be; None where a value is no list of values."""
    if isinstance(domain, IndicesDomain):
        return INDEX
    return LENGTH_OF_LAYER if isinstance(domain, LengthsDomain) else None


def decode_list(raw: Any, domain: Domain, decode: Callable[[Any, Domain], Any]) -> list[Any]:
    """Return the values of a list."""
    of_indices, each = isinstance(domain, IndicesDomain), entry_domain(domain)
    assert each is not None  # noqa: S101 - asked for lists alone
    if not isinstance(raw, list):
        what, example = (
            ("indices", "[1, 1.5, { n = 0.6, k = 2 }]")
            if of_indices
            else ("lengths", '["2 mm", "0.1 mm"]')
        )
        raise PresetError(f"{shown(raw)} is no list of {what}; write {example}")
    faults, result = Faults(), []
    for place, entry in enumerate(raw):
        # The medium in front may be misspelt as well.
        of_entry = FOLLOWED_OUTSIDE if of_indices and not place else each
        follows = of_indices and entry == FOLLOWS.word
        result.append(FOLLOWS if follows else faults.attempt(f"[{place}]", decode, entry, of_entry))
    if faults:
        raise PresetError(*faults)
    return result


def named(raw: str, domain: Domain) -> Any:
    """Return what a word stands for that is the name of a parameter, too."""
    try:
        return domain.parse(raw)
    except OptipathError:
        raise PresetError(
            f"'{raw}' is no number; write \"${raw.strip()}\" for the parameter"
        ) from None


def referred(raw: str, parameters: Mapping[str, Parameter]) -> Parameter:
    """Return the parameter that ``"$name"`` or ``"-$name"`` stands for."""
    sign, _, name = raw.partition("$")
    if sign in ("", "-") and name in parameters:
        return -parameters[name] if sign else parameters[name]
    if raw.count("$") > 1:
        raise PresetError(
            f"'{raw}' is of several parameters, but a value takes one; declare a parameter for "
            f"the whole"
        )
    if is_arithmetic(raw):
        raise PresetError(f"'{raw}' is no name of a parameter; write {table_for(raw)}")
    known = [f"${parameter}" for parameter in parameters]
    raise PresetError(f"parameter '{raw}' is not declared{did_you_mean(raw, known)}")


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
            result |= references_in(entry["wavelength"]) if "wavelength" in entry else set()
            left += entry.values()
        elif isinstance(entry, list):
            left += entry
    return result


_NUMBER = r"\d+\.?\d*(?:e[-+]?\d+)?|\.\d+(?:e[-+]?\d+)?"
_AFFINE_TEXT = re.compile(
    rf"""
    (?P<sign>-?) \s* (?:(?P<before>{_NUMBER}) \s* \*? \s*)?
    \$?(?P<name>[^\W\d]\w*) \s* (?:(?P<way>[*/]) \s* (?P<behind>{_NUMBER}))? \s*
    (?:(?P<plus>[-+]) \s* (?P<offset>(?:{_NUMBER}) [^$*/()+]*))?
    """,
    re.VERBOSE | re.IGNORECASE | re.ASCII,
)
_OFFSET_FIRST = re.compile(
    rf"((?:{_NUMBER})[^$*/()+-]*)([-+])\s*([\d$.].*)", re.IGNORECASE | re.ASCII
)
_SIGNS = re.compile(r"[*/+()^\s\d]|(?<=.)-|\$.*\$")


def table_for(text: str) -> str:
    """Return how a file writes a multiple of a parameter with an offset; an example for others.

    >>> table_for("$theta/2"), table_for("10 * $a - 5 deg")
    ('{ parameter = "theta", scale = 0.5 }', '{ parameter = "a", scale = 10, offset = "-5 deg" }')
    >>> table_for("90 deg - $theta")
    '{ parameter = "theta", scale = -1, offset = "90 deg" }'
    """
    text = text.strip()
    if first := _OFFSET_FIRST.fullmatch(text):
        text = f"{first[2].replace('+', '')}{first[3]} + {first[1].strip()}"
    result = _AFFINE_TEXT.fullmatch(text)
    if result is None:
        return '{ parameter = "NAME", scale = 0.5, offset = ... }'
    scale = float(result["before"] or 1.0) * (-1.0 if result["sign"] else 1.0)
    number = float(result["behind"] or 1.0)
    if result["way"] == "*":
        scale *= number
    elif number:
        scale /= number
    row = f'{{ parameter = "{result["name"]}"'
    if scale != 1.0:
        row += f", scale = {scale:.12g}"
    if result["offset"]:
        offset = (result["plus"].replace("+", "") + result["offset"]).strip()
        row += f', offset = "{offset}"' if offset[-1].isalpha() else f", offset = {offset}"
    return row + " }"


def is_arithmetic(text: str) -> bool:
    """Tell whether a text with a ``$`` is more than one name.

    >>> is_arithmetic("$theta/2"), is_arithmetic("$a + $b"), is_arithmetic("-$thta")
    (True, True, False)
    """
    return _SIGNS.search(text.partition("$")[2] if text[:2] == "-$" else text) is not None


_ANGLES = ("incidences", "turns")
_BACKWARDS = "backwards"


def chain_by_angles(raw: Mapping[str, Any], decoded: Callable[[Any], Any]) -> VerticesByAngles:
    """Return the chain of a table.

    >>> chain_by_angles({"incidences": [0.5], "backwards": True}, float)
    VerticesByAngles(incidences=(0.5,), turns=(), backwards=True)
    """
    faults = unknown_keys(raw, (*_ANGLES, _BACKWARDS))
    angles = []
    for key in _ANGLES:
        several = raw.get(key, [])
        if not isinstance(several, list):
            faults.append(f"{key} must be a list of angles, not {shown(several)}")
            continue
        places = [(f".{key}[{place}]", angle) for place, angle in enumerate(several)]
        angles.append(tuple(faults.attempt(at, decoded, angle) for at, angle in places))
    backwards = raw.get(_BACKWARDS, False)
    if not isinstance(backwards, bool):
        faults.append(f"{_BACKWARDS} must be true or false, not {shown(backwards)}")
    if faults:
        raise PresetError(*faults)
    incidences, turns = angles
    return VerticesByAngles(incidences, turns, backwards)


def table_of_angles(chain: VerticesByAngles, encoded: Callable[[Any], Any]) -> dict[str, Any]:
    """Return the table of a chain.

    >>> table_of_angles(VerticesByAngles((0.5, 0.6), (0.1,)), str)
    {'incidences': ['0.5', '0.6'], 'turns': ['0.1']}
    """
    table: dict[str, Any] = {
        key: [encoded(angle) for angle in getattr(chain, key)] for key in _ANGLES
    }
    return table | {_BACKWARDS: True} if chain.backwards else table
