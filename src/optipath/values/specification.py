"""What a parameter is specified by, where texts with units stand for its numbers."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError, shown
from optipath.values.arrays.array_likes import array_of
from optipath.values.degree_warnings import (
    warn_of_degrees,
)
from optipath.values.degrees import is_within_a_turn
from optipath.values.ratios import is_of_decibels
from optipath.values.texts import numbers_for
from optipath.values.units import dimension_of, parse_quantity, unit_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.affine import Affine


_KINDS: dict[str, tuple[type, str]] = {
    **dict.fromkeys(("help", "offset_dimension"), (str, "a text")),
    "words": (dict, "a dict from word to number"),
    **dict.fromkeys(("optional", "bound"), (bool, "True or False")),
}


def check_types(parameter: Any) -> None:
    """Check what a parameter is specified by that is no number."""
    for name, (kind, described) in _KINDS.items():
        if not isinstance(value := getattr(parameter, name), kind):
            raise ParameterError(
                f"{name} of parameter '{parameter.name}' must be {described}, not {shown(value)}"
            )


def checked_name(name: Any) -> str:
    """Return the name of a parameter."""
    if isinstance(name, str) and name.isidentifier():
        return name
    raise ParameterError(
        f"parameter name {shown(name)} must be letters, digits and underscores, "
        f"not starting with a digit"
    )


def limit_of(name: str, value: Any) -> float:
    """Return an end of the range of a parameter as a number."""
    if type(value) is float:
        return value
    what = f"the range of parameter '{name}'"
    array = array_of(what, value, ParameterError)
    if array.ndim or array.dtype.kind not in "iuf":
        raise ParameterError(f"{what} must be numbers, not {shown(value)}")
    return float(array)


def read_specification(parameter: Any) -> dict[str, Any]:
    """Return the unit, the limits and the words of a parameter, numbers in place of texts.

    The unit is that of the first text that has one, where none is given. A default stays a text,
    which may be a word.
    """
    name, words = parameter.name, parameter.words
    named = words if isinstance(words, dict) else {}
    limits = {"minimum": parameter.minimum, "maximum": parameter.maximum}
    unit = parameter.unit
    if isinstance(unit, str) and not unit:
        unit = _first_unit([parameter.default, *limits.values(), *named.values()])
    dimension = dimension_of(unit)
    faults: list[str] = []
    places: dict[str, tuple[Any, str]] = {
        f"the {end} of parameter '{name}'": (limits, end)
        for end, limit in limits.items()
        if type(limit) is not float
    }
    if named:
        places |= {f"the word '{word}' of parameter '{name}'": (words, word) for word in named}
    found = {"unit": unit, **limits, "words": {**named} if named else words}
    parse = partial(parse_quantity, dimension=dimension)
    for what, (several, key) in places.items():
        try:
            number = numbers_for(what, several[key], parse, ParameterError)
        except ParameterError as fault:
            faults += fault.faults
        else:
            (found if several is limits else found["words"])[key] = number
    if faults:
        raise ParameterError(*faults)
    # Whoever binds a value looks at it where it stands.
    if dimension == "angle" and parameter.bound is not True:
        _warn_of(name, limits | _by_phrase(named))
        if not is_within_a_turn(found["minimum"], found["maximum"]):
            warn_of_degrees(f"parameter '{name}'", parameter.default)
    return found


def warn_where_it_stands(parameter: Any) -> None:
    """Warn of limits and words of a parameter that is an angle since it stands for one."""
    limits = {end: getattr(parameter, end) for end in ("minimum", "maximum")}
    _warn_of(parameter.name, limits | _by_phrase(parameter.words), parameter)


def _warn_of(name: str, numbers: Mapping[str, Any], place: Affine | None = None) -> None:
    """Warn of each number beyond a whole turn, by what it is of an angle of this name."""
    for what, number in numbers.items():
        warn_of_degrees(f"the {what} of parameter '{name}'", number, place)


def _by_phrase(words: Mapping[str, Any]) -> dict[str, Any]:
    return {f"word '{word}'": number for word, number in words.items()}


def _first_unit(values: list[Any]) -> str:
    """Return the unit of the first text that has one; none where there is none."""
    for value in values:
        several = value if isinstance(value, (list, tuple)) else [value]
        for text in several:
            unit = unit_of(text) if isinstance(text, str) else ""
            if unit and not is_of_decibels(unit):
                return unit
    return ""
