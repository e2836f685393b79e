"""Schema: which keys a preset file may have, and the faults found while reading it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from optipath.errors import OptipathError, closest, did_you_mean, listed, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping


FORMAT = 1

TOP = {"format": int, "description": str, "parameters": dict, "elements": dict, "links": list}
TOP |= {"cases": dict, "choices": dict, "loops": str}
PARAMETER = {"default": object, "unit": str, "range": list, "help": str, "words": dict}
PARAMETER |= {"optional": bool, "bound": bool}
LINK = {"from": str, "to": str, "azimuth": object, "tap": bool}
CHOICE = {"element": str, "behind": dict, "help": str}
CASE = {"values": dict, "published": dict, "note": str}

_EXAMPLES = {
    **{name: f"a list of tables, each headed [[{name}]]" for name in ("links", "layers")},
    **{name: f"tables headed [{name}.NAME]" for name in ("elements", "parameters", "cases")},
    "loops": 'a text, "refuse" or "sum"',
    "range": 'a list of two values, such as ["0 deg", "90 deg"]',
}
_WORDS = {
    int: "a whole number",
    str: "a text",
    dict: "a table",
    list: "a list",
    bool: "true or false",
}


def type_faults(where: str, table: Mapping[str, Any], schema: Mapping[str, Any]) -> list[str]:
    """Return a sentence for each key that is unknown or has a value of another type."""
    at = f"{where}: " if where else ""
    wrong = [
        f"{at}'{key}' must be {_EXAMPLES.get(key, _WORDS[kind])}, not {shown(table[key])}"
        for key, kind in schema.items()
        if key in table and kind not in (object, type(table[key]))
    ]
    return unknown_keys(table, schema, where) + wrong


def as_meant(table: Mapping[str, Any], known: Iterable[str]) -> dict[str, Any]:
    """Return a table with misspelled keys under the meant names, for none to be missing too.

    >>> as_meant({"knd": "source", "frames": {}, "colour": 3}, ["kind", "frames"])
    {'frames': {}, 'kind': 'source'}
    """
    names = list(known)
    results = {key: value for key, value in table.items() if key in names}
    for key, value in table.items():
        name = key if key in names else closest(key, names)
        if name is None or name == key:
            continue
        here = results.setdefault(name, value)
        if here is not value and isinstance(here, dict) and isinstance(value, dict):
            results[name] = {**value, **here}
    return results


def readable(table: Mapping[str, Any], schema: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a table has by keys that are known or meant, where it is of the right type."""
    meant = as_meant(table, schema)
    return {key: value for key, value in meant.items() if schema[key] in (object, type(value))}


def checked(
    where: str, table: dict[str, Any], schema: Mapping[str, Any], faults: list[str]
) -> dict[str, Any] | None:
    """Return a table with its keys as they were meant; None where a value has another type."""
    result = type_faults(where, table, schema)
    if not result:
        return table
    faults += result
    table = as_meant(table, schema)
    return None if type_faults(where, table, schema) else table


def texts_in(raw: Any) -> list[str]:
    """Return the texts that stand anywhere in a value.

    >>> texts_in({"index": {"n": "$n1", "k": 0.1}, "range": ["0 deg", "90 deg"]})
    ['0 deg', '90 deg', '$n1']
    """
    result, left = [], [raw]
    while left:
        entry = left.pop()
        if isinstance(entry, str):
            result.append(entry)
        elif isinstance(entry, dict):
            left += entry.values()
        elif isinstance(entry, list):
            left += reversed(entry)
    return result


T = TypeVar("T")
P = ParamSpec("P")

_MOST = 4
"""How many places are named where the same is wrong."""


class Faults(list[str]):
    """A list of sentences, each with its place in the file."""

    def attempt(
        self, where: str, action: Callable[P, T], *arguments: P.args, **keywords: P.kwargs
    ) -> T | None:
        """Return what an action gives, or None after keeping its faults.

        >>> from optipath.values.units import dimension_of
        >>> faults = Faults()
        >>> faults.attempt("parameters.delta", dimension_of, "degg")
        >>> faults
        ["parameters.delta: unit 'degg' is unknown; did you mean 'deg'?"]
        """
        try:
            return action(*arguments, **keywords)
        except OptipathError as error:
            self += [_placed(where, fault) for fault in error.faults]
            return None


def unknown_keys(table: Mapping[str, Any], known: Collection[str], where: str = "") -> Faults:
    """Return a sentence for each key of a table that is none of those that there are.

    >>> unknown_keys({"form": "a.out"}, ["from", "to"], "links[0]")
    ["links[0]: key 'form' is unknown; did you mean 'from'?"]
    """
    at = f"{where}: " if where else ""
    unknown = [key for key in table if key not in known]
    return Faults(f"{at}key '{key}' is unknown{did_you_mean(key, known)}" for key in unknown)


def _placed(where: str, fault: str) -> str:
    """Return a fault with its place, which is not named twice."""
    if not where:
        return fault
    named = f"parameter '{where.rpartition('.')[2]}' "
    if fault.startswith(named):
        return f"{where} {fault.removeprefix(named)}"
    # A fault within the value begins with its place there, such as ".n".
    return f"{where}{fault}" if fault.startswith(".") else f"{where}: {fault}"


def joined(faults: Iterable[str]) -> list[str]:
    """Return faults, one sentence for all the places where the same is wrong.

    >>> joined(["a.x: 'z' is unknown", "b: 'y' is unknown", "c: 'z' is unknown", "no lamp"])
    ["a.x and c: 'z' is unknown", "b: 'y' is unknown", 'no lamp']
    """
    places: dict[tuple[str, str], list[str]] = {}
    for fault in dict.fromkeys(faults):
        where, colon, sentence = fault.partition(": ")
        places.setdefault((colon, sentence) if colon else ("", fault), []).append(where)
    return [
        f"{listed(_few(where))}: {sentence}" if colon else sentence
        for (colon, sentence), where in places.items()
    ]


def _few(places: list[str]) -> list[str]:
    if len(places) <= _MOST:
        return places
    return [*places[: _MOST - 1], f"{len(places) - _MOST + 1} more places"]
