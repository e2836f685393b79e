"""Paths, light and energy as JSON for the page."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.explorer.paths import slider_range
from optipath.faults import listed
from optipath.light.quantities import QUANTITIES, LightQuantity, Numbers
from optipath.materials.named_materials import WAVELENGTH
from optipath.materials.quantities import plain
from optipath.paths.energy import energy_along
from optipath.paths.usual_range import VISIBLE
from optipath.plots.light_texts import ellipse_points
from optipath.values.units import dimension_of, in_unit, units_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.explorer.paths import ExploredPath
    from optipath.light.light import Light
    from optipath.paths.energy import LightOnLink
    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter


def path_as_json(explored: ExploredPath) -> dict[str, Any]:
    """Return what the page is told of a path when it opens it."""
    explored.warm_up()
    path = explored.path
    parameters = [_parameter(explored, each) for each in explored.parameters.values()]
    if explored.offers_wavelength:
        light = [in_unit(end, WAVELENGTH.unit) for end in VISIBLE]
        offered = {"slider": [*light, 1.0], "offered": True}
        parameters.append(_parameter(explored, WAVELENGTH) | offered)
    choices = [
        {
            "name": name,
            "help": choice.help,
            "words": [*choice.behind],
            "default": choice.place(path.graph),
        }
        for name, choice in path.choices.items()
    ]
    return {
        "preset": explored.preset,
        "description": path.description,
        "parameters": parameters,
        "choices": choices,
        "cases": [{"name": name, "note": case.note} for name, case in path.cases.items()],
        "detectors": [*explored.detectors],
        "quantities": [quantity_as_json(each) for each in QUANTITIES],
    }


def _parameter(explored: ExploredPath, parameter: Parameter) -> dict[str, Any]:
    name, unit = parameter.name, parameter.unit
    inputs = explored.plan.inputs
    default = parameter.default
    text = "" if default is None else parameter.text(default)
    dimension = dimension_of(unit)
    units = units_of(dimension) if dimension else []
    return {
        "name": name,
        "help": parameter.help,
        "unit": unit,
        "units": sorted(units, key=lambda other: other != unit),
        "slider": slider_range(explored, name),
        "default": text.removesuffix(f" {unit}"),
        "words": [*parameter.all_words],
        "materials": name in explored.media,
        "bound": parameter.bound,
        "array": np.ndim(default) > 0 or bool(inputs.tails.get(name)),
        "offered": False,
    }


PRINTED = Numbers(6)
"""How `optipath run` prints numbers where nobody says otherwise."""

_POINTS = 97
_HANDS = {1: "right-handed", -1: "left-handed", 0: "linear"}
_UNPOLARISED = "unpolarised"


def end_as_json(light: Light, published: Sequence[float] | None) -> dict[str, Any]:
    """Return the light at a detector."""
    texts = PRINTED.stokes(light)
    return {
        "stokes": plain(light.stokes),
        "texts": texts,
        "published": [*published] if published else None,
        "published_texts": [f"{number:g}" for number in published] if published else None,
        "quantities": _quantities(light, texts),
        "poincare": poincare(light),
        "ellipse": _ellipse(light),
    }


def link_as_json(name: str, start: str, end: str, light: Light) -> dict[str, Any]:
    """Return the light on a link."""
    return {
        "link": name,
        "start": start,
        "end": end,
        "dop": plain(light.dop),
        "poincare": poincare(light),
        "texts": PRINTED.stokes(light),
    }


def poincare(light: Light) -> list[float] | None:
    """Return (S1, S2, S3) over S0, a point within the sphere; None where there is none."""
    point = np.asarray(light.normalized, float)[1:]
    return (point + 0.0).tolist() if np.isfinite(point).all() else None


def _quantities(light: Light, stokes: Sequence[str]) -> list[dict[str, Any]]:
    results = []
    for quantity in QUANTITIES:
        number = plain(np.asarray(quantity.of(light), float), quantity.shown_unit)
        state = PRINTED.state(math.nan if number is None else number)
        text = stokes[int(quantity.attribute)] if quantity.attribute.isdigit() else state
        results.append(quantity_as_json(quantity) | {"number": number, "text": text})
    return results


def quantity_as_json(quantity: LightQuantity) -> dict[str, Any]:
    """Return what the page is told of a quantity of light."""
    return {"name": quantity.variable, "label": quantity.name, "unit": quantity.shown_unit}


def _ellipse(light: Light) -> dict[str, Any]:
    points = ellipse_points(light, _POINTS)
    there = bool(np.isfinite(points).all())
    hand = _HANDS[int(light.handedness)] if there else _UNPOLARISED
    return {
        "points": (points + 0.0).tolist() if there else None,
        "dop": plain(light.dop),
        "aop": plain(light.aop, "deg"),
        "handedness": hand,
    }


def energy_as_json(
    path: PathGraph, lights: Sequence[LightOnLink] = (), /, **values: Any
) -> dict[str, Any]:
    """Return the power on links, and what elements, outlets and ends take of it.

    >>> import optipath as op
    >>> energy_as_json(op.load_preset("malus"))["text"]
    'Sources give 1; polarizer takes 0.5, analyzer takes 0.125 and eye gets 0.375.'
    """
    result = energy_along(path, lights, **values)
    whole = sum(float(power) for power in result.given.values())
    messages = [
        *(f"{node} takes {_text(power)}" for node, power in result.taken.items() if power),
        *(f"{_text(power)} leaves at {name}" for name, power in result.left.items() if power),
        *(f"{node} gets {_text(power)}" for node, power in result.ended.items()),
    ]
    return {
        "links": [
            {"start": each.start, "end": each.end, "name": each.name, "tap": each.tap}
            | _power(each.power)
            for each in result.links
            if each.end
        ],
        "given": [{"node": node} | _power(power) for node, power in result.given.items()],
        "taken": [{"node": node} | _power(power) for node, power in result.taken.items()],
        "leaves": [{"name": name} | _power(power) for name, power in result.left.items()],
        "ends": [{"node": node} | _power(power) for node, power in result.ended.items()],
        "text": f"Sources give {_text(whole)}; {listed(messages)}.",
        "notes": [*result.notes],
    }


def _power(power: Any) -> dict[str, Any]:
    return {"power": plain(float(power)), "text": _text(power)}


def _text(power: Any) -> str:
    return PRINTED.text(float(power))
