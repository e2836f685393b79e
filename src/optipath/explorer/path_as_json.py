"""A path as the page opens it: what can be chosen, and between which values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError
from optipath.explorer.light_as_json import quantities_as_json
from optipath.explorer.slider_range import slider_range
from optipath.paths.lights_along import lights_along
from optipath.paths.usual_range import VISIBLE
from optipath.values.named_materials import WAVELENGTH
from optipath.values.plain_json import plain
from optipath.values.units import dimension_of, in_unit, units_of

if TYPE_CHECKING:
    from optipath.explorer.explored_path import ExploredPath
    from optipath.values.cases import Case
    from optipath.values.parameters import Parameter


def path_as_json(explored: ExploredPath) -> dict[str, Any]:
    """Return what the page is told of a path when it opens it."""
    explored.warm_up()
    path = explored.path
    parameters = [_parameter(explored, each) for each in explored.parameters.values()]
    if explored.offers_wavelength:
        light = [in_unit(end, WAVELENGTH.unit) for end in VISIBLE]
        parameters.append(_told(WAVELENGTH, "") | {"slider": [*light, 1.0], "offered": True})
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
        "cases": [_case(explored, name, case) for name, case in path.cases.items()],
        "detectors": [*explored.detectors],
        "quantities": quantities_as_json(),
        "links": _links(explored),
    }


def _parameter(explored: ExploredPath, parameter: Parameter) -> dict[str, Any]:
    name, unit = parameter.name, parameter.unit
    inputs = explored.plan.inputs
    low, high = inputs.limits.get(name, (parameter.minimum, parameter.maximum))
    default = parameter.default
    text = "" if default is None else parameter.text(default)
    return _told(parameter, text) | {
        "minimum": plain(low, unit),
        "maximum": plain(high, unit),
        "slider": slider_range(explored, name),
        "materials": name in explored.media,
        "bound": parameter.bound,
        "array": np.ndim(default) > 0 or bool(inputs.tails.get(name)),
    }


def _told(parameter: Parameter, default: str) -> dict[str, Any]:
    dimension = dimension_of(parameter.unit)
    units = units_of(dimension) if dimension else []
    return {
        "name": parameter.name,
        "help": parameter.help,
        "unit": parameter.unit,
        "units": sorted(units, key=lambda unit: unit != parameter.unit),
        "minimum": plain(parameter.minimum, parameter.unit),
        "maximum": plain(parameter.maximum, parameter.unit),
        "slider": None,
        "default": default.removesuffix(f" {parameter.unit}"),
        "words": [*parameter.all_words],
        "materials": False,
        "bound": False,
        "array": False,
        "offered": False,
    }


def _case(explored: ExploredPath, name: str, case: Case) -> dict[str, Any]:
    known = explored.parameters
    values = {
        given: known[given].text(value) if given in known else str(value)
        for given, value in case.values.items()
    }
    published = {end: [*stokes] for end, stokes in case.published.items()}
    return {"name": name, "values": values, "note": case.note, "published": published}


def _links(explored: ExploredPath) -> list[str]:
    """Return the links in the order of travel; none where a value must be given first."""
    try:
        return [each.name for each in lights_along(explored.path) if each.end]
    except OptipathError:
        return []
