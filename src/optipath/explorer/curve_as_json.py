"""A curve of some quantities of light over a parameter, by one run of a batch."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, listed, shown, unknown
from optipath.explorer.read_values import FieldFault, FieldFaults, single_text
from optipath.sweeps.axes.sweep_axis import sweep_axis
from optipath.sweeps.axes.sweep_grid import SweepGrid
from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.sweeps.labels.table_texts import heading
from optipath.values.axis_texts import read_axis_text
from optipath.values.plain_json import plain
from optipath.values.units import in_unit, unit_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.explorer.asked_state import AskedCurve
    from optipath.explorer.read_values import ReadState
    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_axis import SweepAxis
    from optipath.values.parameters import Parameter

_NAMES = {quantity.variable: quantity for quantity in QUANTITIES}
_PLACE = re.compile(r"\(at (\d+), of \d+ paths\)")
_SEVERAL = ":,@"
"""What stands in a text of several values, or names a file, of which none is ever read."""


def curve_as_json(state: ReadState, asked: AskedCurve, detector: str) -> dict[str, Any]:
    """Return a curve for the page."""
    explored = state.explored
    axes: tuple[SweepAxis, ...] = ()
    try:
        grid = curve_grid(state, asked)
        axes = grid.axes
        key = detector, asked, *sorted(grid.fixed.items())
        lines = explored.kept_curve(key, lambda: _lines(explored.plan, grid, asked.y, detector))
    except OptipathError as error:
        told = [_by_value(sentence, axes) for sentence in error.faults]
        raise FieldFaults(FieldFault("curve", each) for each in told) from None
    (axis,) = axes
    return {
        "x": axis.shown.tolist(),
        "x_label": heading(axis.name, axis.unit),
        "unit": axis.unit,
        "at": _at(state, axis),
        "lines": lines,
    }


def curve_grid(state: ReadState, asked: AskedCurve) -> SweepGrid:
    """Return the grid of a curve, beside which everything has one value."""
    explored, name = state.explored, asked.x
    opened = explored.plan.inputs.open
    faults = [s for y in asked.y for s in unknown("quantity", y, _NAMES)]
    faults += unknown("parameter of the curve", name, opened)
    if not faults:
        faults += _end_faults(state, opened[name], asked)
    if faults:
        raise FieldFaults(FieldFault("curve", each) for each in faults)
    text = f"{asked.first}:{asked.last}:{asked.count}"
    unit = "" if unit_of(asked.first) else opened[name].unit
    values = read_axis_text(text, opened[name], unit, explored.uses)
    assert values is not None  # noqa: S101 - which it is not for three parts
    fixed = {given: value for given, value in state.values.items() if given != name}
    return SweepGrid((sweep_axis(explored.parameters, name, values),), fixed)


def _end_faults(state: ReadState, parameter: Parameter, asked: AskedCurve) -> list[str]:
    faults: list[str] = []
    for text in (asked.first, asked.last):
        if any(sign in text for sign in _SEVERAL) or text in parameter.all_words:
            faults.append(f"{shown(text)} is no end of a curve; give one number, with a unit")
            continue
        try:
            single_text(state.explored, parameter, text.strip())
        except OptipathError as error:
            faults += error.faults
    return faults


def _by_value(sentence: str, axes: Sequence[SweepAxis]) -> str:
    """Return a sentence that tells the place on a curve by the value there, not by its number."""

    def value(found: re.Match[str]) -> str:
        places = (f"{each.name} is {each.shown[int(found[1])]:g} {each.unit}" for each in axes)
        return f"(where {listed([place.strip() for place in places])})"

    return _PLACE.sub(value, sentence)


def _at(state: ReadState, axis: SweepAxis) -> float | None:
    """Return where the curve is now, in its unit; None where that is no number."""
    parameter = state.explored.parameters[axis.name]
    value = state.values.get(axis.name, parameter.default)
    value = parameter.words.get(value, value) if isinstance(value, str) else value
    number = np.asarray(value)
    if number.dtype.kind not in "iuf" or number.ndim:
        return None
    return in_unit(float(number), axis.unit)


def _lines(
    plan: Plan, grid: SweepGrid, names: Sequence[str], detector: str
) -> list[dict[str, Any]]:
    light = plan.run_all(**grid.given())[detector]
    lines = []
    for quantity in (_NAMES[name] for name in names):
        numbers = np.broadcast_to(np.asarray(quantity.shown_of(light), float), grid.shape)
        told = {"name": quantity.variable, "label": quantity.name, "unit": quantity.shown_unit}
        lines.append({**told, "values": plain(numbers)})
    return lines
