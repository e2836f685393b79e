"""Schema: which keys the tables of a preset file may have, and the faults found while reading."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from optipath.errors import (
    Fault,
    OptipathError,
    PresetError,
    UnitError,
    did_you_mean,
    listed,
    shown,
)
from optipath.values.units import dimension_of, parse_quantity, with_article

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable


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


def type_faults(where: str, table: Mapping[str, Any], known: Collection[str]) -> list[Fault]:
    """Return a fault for each key that is unknown, or has another type than a mapping says.

    >>> type_faults("links[0]", {"form": "a.out", "to": 3}, {"from": str, "to": str})[0]
    "links[0]: key 'form' is unknown; did you mean 'from'?"
    """
    schema = known if isinstance(known, Mapping) else dict.fromkeys(known, object)
    faults = [
        f"key '{key}' is unknown{did_you_mean(key, known)}" for key in table if key not in known
    ]
    faults += [
        f"'{key}' must be {_EXAMPLES.get(key, _WORDS[kind])}, not {shown(table[key])}"
        for key, kind in schema.items()
        if key in table and kind not in (object, type(table[key]))
    ]
    return [Fault(fault, place=where) for fault in faults]


def checked_table(raw: Any, known: Collection[str], needed: Iterable[str] = ()) -> dict[str, Any]:
    """Return a table that has known keys alone, of their types, and those that it needs."""
    if not isinstance(raw, dict):
        raise PresetError(f"{shown(raw)} must be a table")
    missing = [Fault(f"'{key}' is missing") for key in needed if key not in raw]
    if faults := type_faults("", raw, known) or missing:
        raise PresetError(*faults)
    return raw


def number_of(raw: Any, unit: str) -> float | complex:
    """Return a number in base units, which is written with its unit where it has one.

    >>> number_of("1 mm", "m"), number_of(1.5, "")
    (0.001, 1.5)
    """
    if isinstance(raw, str):
        return parse_quantity(raw, dimension_of(unit))
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        written = str(raw).lower() if isinstance(raw, bool) else shown(raw)
        raise UnitError(f"{written} is not a number")
    try:
        number = float(raw)
    except OverflowError:
        raise UnitError(f"{shown(raw)} is too large a number") from None
    if unit and math.isfinite(number):
        request = with_article(dimension_of(unit))
        raise UnitError(
            f"{shown(raw)} has no unit, but {request} is asked for; write '{raw} {unit}'"
        )
    return number


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
            self += [fault.under(where) for fault in error.faults]
            return None

    def refuse(self, most: int = 0) -> None:
        """Raise where there are more faults than so many."""
        if len(self) > most:
            raise PresetError(*joined(self))


def each_entry(entries: Iterable[Any], action: Callable[[Any], T], where: str = "") -> list[T]:
    """Return what an action makes of each entry of a list, or raise with all faults."""
    faults = Faults()
    results = [faults.attempt(f"{where}[{i}]", action, entry) for i, entry in enumerate(entries)]
    faults.refuse()
    return results  # type: ignore[return-value] # none without faults


def each_key(
    table: Mapping[str, Any], action: Callable[[str, Any], T], where: str = ""
) -> dict[str, T]:
    """Return what an action makes of each key of a table and its value, or raise with all faults.

    >>> each_key({"n": "1.5", "k": 2}, lambda key, raw: number_of(raw, ""))
    {'n': 1.5, 'k': 2.0}
    """
    faults = Faults()
    results = {
        key: faults.attempt(f"{where}.{key}", action, key, raw) for key, raw in table.items()
    }
    faults.refuse()
    return results  # type: ignore[return-value] # none without faults


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
