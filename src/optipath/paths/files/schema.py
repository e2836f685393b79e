"""Schema: which keys a preset file may have, and the faults found while reading it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from optipath.errors import (
    Fault,
    OptipathError,
    PathError,
    closest,
    did_you_mean,
    listed,
    shown,
)

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


def type_faults(where: str, table: Mapping[str, Any], schema: Mapping[str, Any]) -> Faults:
    """Return a sentence for each key that is unknown or has a value of another type."""
    faults = unknown_keys(table, schema, where)
    for key, kind in schema.items():
        if key in table and kind not in (object, type(table[key])):
            wanted = _EXAMPLES.get(key, _WORDS[kind])
            faults.add(where, f"'{key}' must be {wanted}, not {shown(table[key])}")
    return faults


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

_ENOUGH = 100
"""After how many faults a file is not read on: each suggestion takes its time."""


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
            self += [fault.under(where) for fault in error.faults]
            return None

    def add(self, where: str, reason: str) -> None:
        """Add what is wrong at a place."""
        self.append(Fault(reason, place=where))

    def refuse_many(self) -> None:
        """Raise where there are more faults than anybody reads."""
        if len(self) > _ENOUGH:
            raise PathError(*joined(self))


def unknown_keys(table: Mapping[str, Any], known: Collection[str], where: str = "") -> Faults:
    """Return a sentence for each key of a table that is none of those that there are.

    >>> unknown_keys({"form": "a.out"}, ["from", "to"], "links[0]")
    ["links[0]: key 'form' is unknown; did you mean 'from'?"]
    """
    return Faults(
        Fault(f"key '{key}' is unknown{did_you_mean(key, known)}", place=where)
        for key in table
        if key not in known
    )


def joined(faults: Iterable[str]) -> list[Fault]:
    """Return faults, one for all the places where the same is wrong.

    >>> z, y = Fault("'z' is unknown"), Fault("'y' is unknown")
    >>> joined([z.under("a.x"), y.under("b"), z.under("c"), "no lamp"])
    ["a.x and c: 'z' is unknown", "b: 'y' is unknown", 'no lamp']
    """
    places: dict[Fault, list[str]] = {}
    for fault in map(Fault.of, dict.fromkeys(faults)):
        places.setdefault(fault.but(place=""), []).append(fault.place)
    return [fault.under(listed(_few(where))) for fault, where in places.items()]


def _few(places: list[str]) -> list[str]:
    if len(places) <= _MOST:
        return places
    return [*places[: _MOST - 1], f"{len(places) - _MOST + 1} more places"]
