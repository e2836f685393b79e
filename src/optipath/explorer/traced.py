"""Traced states: light, pictures and curves for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ParameterError
from optipath.explorer.as_json import (
    PRINTED,
    end_as_json,
    energy_as_json,
    link_as_json,
    quantity_as_json,
)
from optipath.explorer.state import faults_as_json, single_text
from optipath.faults import Fault, shown, unknown
from optipath.light.quantities import QUANTITIES
from optipath.materials.named_materials import WAVELENGTH, material_as_json, materials_among
from optipath.materials.quantities import plain
from optipath.paths.binding import from_materials
from optipath.paths.energy import lights_along
from optipath.plots.scene.layout import scene_of
from optipath.sweeps.datasets import heading
from optipath.sweeps.grid import SweepGrid, sweep_axis
from optipath.values.text import read_axis_text
from optipath.values.units import in_unit, unit_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.explorer.state import ReadState, RequestedCurve
    from optipath.light.light import Light
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepAxis
    from optipath.values.parameters import Parameter


def traced_as_json(state: ReadState) -> dict[str, Any]:
    """Return what the page shows of a state."""
    explored, request = state.explored, state.asked
    lights = traced(state)
    results: dict[str, Any] = {
        "notes": [*state.notes],
        "values": values_as_json(state),
        "detectors": {
            name: end_as_json(lights[name], state.published.get(name))
            for name in explored.detectors
        },
    }
    path, along = explored.path, lights_along(explored.path, **state.values)
    results["along"] = [link_as_json(e.name, e.start, e.end, e.light) for e in along]
    plan = explored.plan
    results |= {"model": plan.model, "method": plan.method}
    results["engine"] = " and ".join(plan.answers.ran_by)
    results |= _curve(state)
    results |= {"scene": None, "energy": None, "explanation": None}
    if "scene" in request.want:
        with OptipathError.collecting(results["notes"]):
            results["scene"] = scene_of(path, "a scene", along, **state.values).as_json()
    if "energy" in request.want:
        results["energy"] = energy_as_json(path, along)
    if "explanation" in request.want:
        results["explanation"] = explored.explanation
    return results


def _curve(state: ReadState) -> dict[str, Any]:
    """Return the curve, or what is wrong with it, on which nothing else depends."""
    request = state.asked.curve
    try:
        detector = curve_detector(state)
        curve = None if request is None else curve_as_json(state, request, detector)
    except OptipathError as error:
        return {"curve": None, "curve_faults": faults_as_json(error)}
    return {"curve": curve, "curve_faults": []}


def traced(state: ReadState) -> dict[str, Light]:
    """Return the light at every end."""
    try:
        lights = state.explored.plan.run_all(**state.values)
    except OptipathError as error:
        raise ParameterError(*state.faults(error)) from None
    if any(light.stokes.ndim > 1 for light in lights.values()):
        inputs = state.explored.plan.inputs
        several = {
            name
            for name, parameter in inputs.open.items()
            if np.ndim(state.values.get(name, parameter.default)) > len(inputs.tails.get(name, ()))
        }
        sentence = "has several values, and the page shows one path; give one value"
        faults = [Fault(f"parameter '{name}' {sentence}", subject=name) for name in sorted(several)]
        raise ParameterError(*faults or [Fault(f"the path {sentence} each in its file")])
    return lights


def curve_detector(state: ReadState) -> str:
    """Return whose light the curve is of: the detector that is asked for, or else the first."""
    known, name = state.explored.detectors, state.asked.detector
    if name is not None and (faults := unknown("detector", name, known)):
        raise ParameterError(*(Fault(each, subject="detector") for each in faults))
    return known[0] if name is None else name


def values_as_json(state: ReadState) -> dict[str, dict[str, Any]]:
    """Return the value of each parameter, as a text, a number or a word."""
    results: dict[str, dict[str, Any]] = {}
    for name, parameter in state.explored.parameters.items():
        value = state.values.get(name, parameter.default)
        word = value if isinstance(value, str) else None
        number = _number(parameter, value)
        text = "" if value is None else parameter.text(_single(value))
        shown = None if number is None else in_unit(number, parameter.unit)
        results[name] = {"text": text, "number": shown, "unit": parameter.unit, "word": word}
    if state.base.offers_wavelength and WAVELENGTH.name not in results:
        results[WAVELENGTH.name] = _NO_VALUE | {"unit": WAVELENGTH.unit}
    return results | _materials(state)


def _number(parameter: Parameter, value: Any) -> float | None:
    """Return the one real number that a value is, or a word stands for."""
    number = np.asarray(parameter.words.get(value) if isinstance(value, str) else value)
    return None if number.dtype.kind not in "biuf" or number.ndim else float(number)


def _single(value: Any) -> Any:
    """Return a number of NumPy as one of Python."""
    is_number = isinstance(value, np.ndarray | np.generic) and np.ndim(value) == 0
    return value.item() if is_number else value


_NO_VALUE = {"text": "", "number": None, "unit": "", "word": None}


def _materials(state: ReadState) -> dict[str, dict[str, Any]]:
    """Return the materials that are given, each with its n and k, and what k they stand for."""
    light = state.explored.parameters.get(WAVELENGTH.name)
    at = None if light is None else state.values.get(WAVELENGTH.name, light.default)
    results: dict[str, dict[str, Any]] = {}
    for name, label, material in materials_among(state.given):
        message = material_as_json(label, material, at)
        text = state.asked.values[name].strip()
        numbers = {"n": message["n"], "k": message["k"]}
        results[name] = {**_NO_VALUE, "text": text, "material": label, **numbers}
        for k in from_materials(state.base.path.graph, {name: material}):
            number = message["k"] if isinstance(message["k"], float) else None
            text = "" if number is None else PRINTED.text(number)
            results[k] = {**_NO_VALUE, "text": text, "number": number, "by": name}
    return results


_NAMES = {quantity.variable: quantity for quantity in QUANTITIES}
_SEVERAL = ":,@"
"""What stands in a text of several values, or names a file, of which none is ever read."""


def curve_as_json(state: ReadState, request: RequestedCurve, detector: str) -> dict[str, Any]:
    """Return a curve for the page."""
    with ParameterError.wrapping(subject="curve"):
        grid = curve_grid(state, request)
        lines = _lines(state.explored.plan, grid, request.y, detector)
    (axis,) = grid.axes
    return {
        "x": axis.shown.tolist(),
        "x_label": heading(axis.name, axis.unit),
        "unit": axis.unit,
        "at": _at(state, axis),
        "lines": lines,
    }


def curve_grid(state: ReadState, request: RequestedCurve) -> SweepGrid:
    """Return the grid of a curve, beside which everything has one value."""
    explored, name = state.explored, request.x
    opened = explored.plan.inputs.open
    faults = [s for y in request.y for s in unknown("quantity", y, _NAMES)]
    faults += unknown("parameter of the curve", name, opened)
    for text in () if faults else (request.first, request.last):
        if any(sign in text for sign in _SEVERAL) or text in opened[name].all_words:
            faults.append(f"{shown(text)} is no end of a curve; give one number, with a unit")
        else:
            with OptipathError.collecting(faults):
                single_text(explored, opened[name], text.strip())
    if faults:
        raise ParameterError(*(Fault.of(each).but(subject="curve") for each in faults))
    text = f"{request.first}:{request.last}:{request.count}"
    unit = "" if unit_of(request.first) else opened[name].unit
    values = read_axis_text(text, opened[name], unit, explored.uses)
    assert values is not None  # noqa: S101 - which it is not for three parts
    fixed = {argument: value for argument, value in state.values.items() if argument != name}
    return SweepGrid((sweep_axis(explored.parameters, name, values),), fixed)


def _at(state: ReadState, axis: SweepAxis) -> float | None:
    """Return where the curve is now, in its unit; None where that is no number."""
    parameter = state.explored.parameters[axis.name]
    number = _number(parameter, state.values.get(axis.name, parameter.default))
    return None if number is None else in_unit(number, axis.unit)


def _lines(
    plan: Plan, grid: SweepGrid, names: Sequence[str], detector: str
) -> list[dict[str, Any]]:
    light = plan.run_all(**grid.given())[detector]
    lines = []
    for quantity in (_NAMES[name] for name in names):
        numbers = np.broadcast_to(np.asarray(quantity.shown_of(light), float), grid.shape)
        lines.append(quantity_as_json(quantity) | {"values": plain(numbers)})
    return lines
