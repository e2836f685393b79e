"""The state of the page as a file: a table, a path as TOML, or lines of Python."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError
from optipath.explorer.curve_as_json import curve_grid
from optipath.explorer.python_lines import python_lines
from optipath.explorer.read_values import FieldFault, FieldFaults, read_state
from optipath.explorer.traced_state import curve_detector, traced
from optipath.sweeps.axes.sweep_grid import SweepGrid
from optipath.sweeps.labels.table_texts import regions, table_columns, table_heads

if TYPE_CHECKING:
    from optipath.explorer.asked_state import AskedCurve, AskedState
    from optipath.explorer.explored_presets import ExploredPresets
    from optipath.explorer.read_values import ReadState

_ENDINGS = {"csv": "csv", "toml": "toml", "python": "py"}
_ODD = re.compile(r"[^A-Za-z0-9_-]+")


def exported_as_json(presets: ExploredPresets, asked: AskedState) -> dict[str, Any]:
    """Return a state as a file."""
    state = read_state(presets, asked)
    traced(state)  # What cannot be traced is no file either.
    curve_detector(state)
    if asked.form == "toml":
        text = _toml(state)
    elif asked.form == "python":
        text = python_lines(state, presets.source(asked.preset))
    else:
        text = _table(state, asked.curve)
    name = "-".join([asked.preset.removesuffix(".toml"), *_case_words(asked)])
    return {"faults": [], "name": f"{_ODD.sub('-', name)}.{_ENDINGS[asked.form]}", "text": text}


def _case_words(asked: AskedState) -> list[str]:
    return [] if asked.case is None else ["case", asked.case]


def _table(state: ReadState, curve: AskedCurve | None) -> str:
    """Return what `optipath sweep --out` writes of the curve; without one, the light as a row."""
    plan = state.explored.plan
    try:
        grid = SweepGrid((), state.values) if curve is None else curve_grid(state, curve)
        rows = [",".join(table_heads(plan, grid))]
        for region in regions(grid.shape):
            rows += map(",".join, zip(*table_columns(plan, grid, region), strict=True))
    except OptipathError as error:
        raise FieldFaults(FieldFault("curve", each) for each in error.faults) from None
    return "".join(f"{row}\n" for row in rows)


def _toml(state: ReadState) -> str:
    return state.explored.path.with_defaults(**state.values).to_toml()
