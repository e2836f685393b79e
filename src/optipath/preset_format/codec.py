"""Values as preset files write them: ``"30 deg"``, ``1.5``, ``"$name"``, ``{n = 1, k = 2}``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.domains import ANGLE, REAL, Choice, Domain, IndexDomain, OutsideDomain
from optipath.errors import OptipathError, PresetError, UnitError, did_you_mean
from optipath.materials import Material
from optipath.parameters import Parameter
from optipath.units import USUAL_UNITS, dimension_of, format_quantity, parse_quantity
from optipath.vertices import VerticesByAngles, VerticesDomain

if TYPE_CHECKING:
    from collections.abc import Mapping

_INDEX = ("n", "k")
_ANGLES = ("incidences", "turns")


def decode(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    """Return the value of an element's field.

    Parameters
    ----------
    raw : Any
        What stands in the file.
    domain : Domain
        What the field may be.
    parameters : mapping of str to Parameter
        What ``"$name"`` can refer to.

    Raises
    ------
    OptipathError
        If it is none of these, or its unit does not fit.

    Examples
    --------
    >>> from optipath.domains import REAL
    >>> decode([1, 2.5], REAL, {})
    [1.0, 2.5]
    """
    if isinstance(domain, Choice):
        return domain.check("the value", raw)
    if isinstance(raw, str) and raw.lstrip("-").startswith("$"):
        return _reference(raw, parameters)
    if isinstance(raw, dict) and isinstance(domain, (IndexDomain, OutsideDomain)):
        return _material(raw, domain, parameters)
    if isinstance(raw, dict) and isinstance(domain, VerticesDomain):
        return _by_angles(raw, parameters)
    return _number(raw, domain.dimension)


def decode_given(raw: Any, parameter: Parameter) -> Any:
    """Return a value given for a parameter: a default, or one of a case.

    Raises
    ------
    OptipathError
        If it is no word of the parameter and no quantity of its dimension.
    """
    if isinstance(raw, str):
        return parameter.parse(raw)
    if isinstance(raw, list):
        return [decode_given(entry, parameter) for entry in raw]
    if isinstance(raw, dict):
        index = _material(raw, REAL, {})
        return np.asarray(index.n) + 1j * np.asarray(index.k)
    return _number(raw, dimension_of(parameter.unit))


def encode(value: Any, dimension: str) -> Any:
    """Write a value so that decoding gives it back.

    Raises
    ------
    PresetError
        If it has no form in TOML.
    """
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, Parameter):
        return f"{'-' * value.negative}${value.name}"
    if isinstance(value, Material):
        return {"n": encode(value.n, dimension), "k": encode(value.k, dimension)}
    if isinstance(value, VerticesByAngles):
        return {key: [encode(a, "angle") for a in getattr(value, key)] for key in _ANGLES}
    if isinstance(value, str):
        return value
    if isinstance(value, np.ndarray) and value.dtype.kind != "c":
        return [encode(entry, dimension) for entry in value.tolist()]
    if isinstance(value, list):
        return [encode(entry, dimension) for entry in value]
    if isinstance(value, np.ndarray):
        return {"n": value.real.tolist(), "k": value.imag.tolist()}
    if isinstance(value, complex):
        return {"n": value.real, "k": value.imag}
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        if not dimension or np.isinf(value):
            return value
        return format_quantity(value, USUAL_UNITS[dimension])
    raise PresetError(f"{value!r} has no form in a preset file; use numbers or parameters")


def _reference(raw: str, parameters: Mapping[str, Parameter]) -> Parameter:
    sign, _, name = raw.partition("$")
    if sign not in ("", "-") or name not in parameters:
        known = [f"${parameter}" for parameter in parameters]
        raise PresetError(f"parameter '{raw}' is not declared{did_you_mean(raw, known)}")
    return -parameters[name] if sign else parameters[name]


def _material(raw: Any, domain: Domain, parameters: Mapping[str, Parameter]) -> Material:
    faults = [
        f"key '{key}' is unknown{did_you_mean(key, _INDEX)}" for key in raw if key not in _INDEX
    ]
    if "n" not in raw:
        faults.append("an index written as a table needs 'n'")
    parts = {}
    for key in [key for key in _INDEX if key in raw]:
        try:
            parts[key] = decode(raw[key], Domain(domain.name), parameters)
        except OptipathError as fault:
            faults += [f"{key}: {sentence}" for sentence in fault.faults]
    if faults:
        raise PresetError(*faults)
    return Material(**parts)


def _by_angles(raw: Any, parameters: Mapping[str, Parameter]) -> VerticesByAngles:
    faults = [
        f"key '{key}' is unknown{did_you_mean(key, _ANGLES)}" for key in raw if key not in _ANGLES
    ]
    angles: dict[str, list[Any]] = {}
    for key in _ANGLES:
        several = raw.get(key, [])
        if not isinstance(several, list):
            faults.append(f"{key} must be a list of angles, not {several!r}")
            continue
        for place, angle in enumerate(several):
            try:
                angles.setdefault(key, []).append(decode(angle, ANGLE, parameters))
            except OptipathError as fault:
                faults += [f"{key}[{place}]: {sentence}" for sentence in fault.faults]
    if faults:
        raise PresetError(*faults)
    return VerticesByAngles(tuple(angles.get("incidences", ())), tuple(angles.get("turns", ())))


def _number(raw: Any, dimension: str) -> Any:
    if isinstance(raw, list) and not raw:
        raise UnitError("an empty list is no value; give at least one number")
    if isinstance(raw, list):
        return [_number(entry, dimension) for entry in raw]
    if isinstance(raw, str):
        return parse_quantity(raw, dimension)
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        raise UnitError(f"{raw!r} is not a number")
    try:
        number = float(raw)
    except OverflowError:
        raise UnitError(f"{raw} is too large a number") from None
    if dimension and np.isfinite(number):
        unit = USUAL_UNITS[dimension]
        raise UnitError(
            f"{raw!r} has no unit, but an {dimension} is asked for; write '{raw} {unit}'"
        )
    return number
