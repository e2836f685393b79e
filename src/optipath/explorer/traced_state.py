"""What the page shows of a state: the light at the ends and on the way, and what else is asked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import numpy as np

from optipath.errors import OptipathError, unknown
from optipath.explorer.curve_as_json import curve_as_json
from optipath.explorer.energy_as_json import energy_as_flows
from optipath.explorer.light_as_json import PRINTED, end_as_json, link_as_json
from optipath.explorer.read_values import FieldFault, FieldFaults
from optipath.explorer.traced_once import TracedOnce
from optipath.paths.bound_materials import given_by_materials
from optipath.paths.lights_along import lights_along
from optipath.plots.space.scene_of import scene_of
from optipath.values.named_materials import WAVELENGTH, material_as_json, materials_among
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from optipath.explorer.read_values import ReadState
    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph


def traced_as_json(state: ReadState) -> dict[str, Any]:
    """Return what the page shows of a state."""
    explored, asked = state.explored, state.asked
    lights = traced(state)
    found: dict[str, Any] = {
        "faults": [],
        "notes": [*state.notes],
        "values": values_as_json(state),
        "detectors": {
            name: end_as_json(lights[name], state.published.get(name))
            for name in explored.detectors
        },
    }
    # It stands for the path wherever pictures ask for the light on its links.
    path = cast("PathGraph", TracedOnce(explored.path, state.values))
    along = lights_along(path, **state.values)
    found["along"] = [link_as_json(e.name, e.start, e.end, e.light) for e in along]
    plan = explored.plan
    found |= {"model": plan.model, "method": plan.method}
    found["engine"] = " and ".join(plan.answers.ran_by)
    found |= _curve(state)
    want = asked.want
    found["scene"] = _scene(path, state, found["notes"]) if "scene" in want else None
    found["energy"] = energy_as_flows(path, state.values) if "energy" in want else None
    found["explanation"] = explored.explanation if "explanation" in want else None
    return found


def _curve(state: ReadState) -> dict[str, Any]:
    """Return the curve, or what is wrong with it, on which nothing else depends."""
    asked = state.asked.curve
    try:
        detector = curve_detector(state)
        curve = None if asked is None else curve_as_json(state, asked, detector)
    except FieldFaults as found:
        return {"curve": None, "curve_faults": [fault._asdict() for fault in found.faults]}
    return {"curve": curve, "curve_faults": []}


def _scene(path: PathGraph, state: ReadState, notes: list[str]) -> dict[str, Any] | None:
    """Return the path in space; a note where it cannot be laid out."""
    try:
        return scene_of(path, **state.values).as_json()
    except OptipathError as error:
        notes += error.faults
        return None


def traced(state: ReadState) -> dict[str, Light]:
    """Return the light at every end."""
    try:
        lights = state.explored.plan.run_all(**state.values)
    except OptipathError as error:
        raise FieldFaults(state.faults(error)) from None
    if any(light.stokes.ndim > 1 for light in lights.values()):
        inputs = state.explored.plan.inputs
        several = {
            name
            for name, parameter in inputs.open.items()
            if np.ndim(state.values.get(name, parameter.default)) > len(inputs.tails.get(name, ()))
        }
        sentence = "has several values, and the page shows one path; give one value"
        raise FieldFaults(
            [FieldFault(name, f"parameter '{name}' {sentence}") for name in sorted(several)]
            or [FieldFault(None, f"the path {sentence} each in its file")]
        )
    return lights


def curve_detector(state: ReadState) -> str:
    """Return whose light the curve is of: the detector that is asked for, or else the first."""
    known, name = state.explored.detectors, state.asked.detector
    if name is not None and (faults := unknown("detector", name, known)):
        raise FieldFaults(FieldFault("detector", each) for each in faults)
    return known[0] if name is None else name


def values_as_json(state: ReadState) -> dict[str, dict[str, Any]]:
    """Return the value of each parameter, as a text, a number or a word."""
    found: dict[str, dict[str, Any]] = {}
    for name, parameter in state.explored.parameters.items():
        value = state.values.get(name, parameter.default)
        word = value if isinstance(value, str) else None
        number = None
        if word is not None:
            number = parameter.words.get(word)
        elif value is not None and np.ndim(value) == 0 and not np.iscomplexobj(value):
            number = float(value)
        text = "" if value is None else parameter.text(_single(value))
        shown = None if number is None else in_unit(number, parameter.unit)
        found[name] = {"text": text, "number": shown, "unit": parameter.unit, "word": word}
    if state.base.offers_wavelength and WAVELENGTH.name not in found:
        found[WAVELENGTH.name] = {"text": "", "number": None, "unit": WAVELENGTH.unit, "word": None}
    if given := state.materials:
        found |= _materials(state, given)
    return found


def _single(value: Any) -> Any:
    """Return a number of NumPy as one of Python."""
    is_number = isinstance(value, np.ndarray | np.generic) and np.ndim(value) == 0
    return value.item() if is_number else value


def _materials(state: ReadState, given: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the materials that are given, each with its n and k, and what k they stand for."""
    light = state.explored.parameters.get(WAVELENGTH.name)
    at = None if light is None else state.values.get(WAVELENGTH.name, light.default)
    plain = {"number": None, "unit": "", "word": None}
    found = {}
    for name, label, material in materials_among(given):
        told = material_as_json(label, material, at)
        text = state.asked.values[name].strip()
        found[name] = {**plain, "text": text, "material": label, "n": told["n"], "k": told["k"]}
        for k in given_by_materials(state.base.path.graph, {name: material}):
            number = told["k"] if isinstance(told["k"], float) else None
            text = "" if number is None else PRINTED.text(number)
            found[k] = {**plain, "text": text, "number": number, "by": name}
    return found
