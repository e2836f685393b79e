"""Where the power of the light goes, as the page has it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import listed
from optipath.explorer.light_as_json import PRINTED
from optipath.paths.energy_along import energy_along
from optipath.values.plain_json import plain

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.paths.path_graph import PathGraph


def energy_as_flows(path: PathGraph, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the power on links, and what elements, outlets and ends take of it.

    Examples
    --------
    >>> import optipath as op
    >>> energy_as_flows(op.load_preset("malus"), {})["text"]
    'Sources give 1; polarizer takes 0.5, analyzer takes 0.125 and eye gets 0.375.'
    """
    found = energy_along(path, **values)
    links = [
        {"start": each.start, "end": each.end, "name": each.name, "tap": each.tap}
        | _power(each.power)
        for each in found.links
        if each.end
    ]
    given = sum(float(power) for power in found.given.values())
    told = [
        *(f"{node} takes {_text(power)}" for node, power in found.taken.items() if power),
        *(f"{_text(power)} leaves at {name}" for name, power in found.left.items() if power),
        *(f"{node} gets {_text(power)}" for node, power in found.ended.items()),
    ]
    return {
        "links": links,
        "given": [{"node": node} | _power(power) for node, power in found.given.items()],
        "taken": [{"node": node} | _power(power) for node, power in found.taken.items()],
        "leaves": [{"name": name} | _power(power) for name, power in found.left.items()],
        "ends": [{"node": node} | _power(power) for node, power in found.ended.items()],
        "text": f"Sources give {_text(given)}; {listed(told)}.",
        "notes": [*found.notes],
    }


def _power(power: Any) -> dict[str, Any]:
    return {"power": plain(float(power)), "text": _text(power)}


def _text(power: Any) -> str:
    return PRINTED.text(float(power))
