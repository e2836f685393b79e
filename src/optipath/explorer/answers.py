"""Answers to the page: presets, paths, traces and exports."""

from __future__ import annotations

import re
import warnings
from importlib.metadata import version
from keyword import iskeyword
from threading import Lock
from typing import TYPE_CHECKING, Any

from optipath.errors import AngleWarning, LoopWarning, OptipathError, ParameterError
from optipath.explorer.as_json import path_as_json
from optipath.explorer.state import faults_as_json, read_path, read_state, requested_state
from optipath.explorer.traced import curve_detector, curve_grid, traced, traced_as_json
from optipath.materials.material import Material
from optipath.materials.named_materials import extinction_with
from optipath.sweeps.datasets import csv_parts
from optipath.sweeps.grid import SweepGrid
from optipath.values.units import UNITS, parse_quantity

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.explorer.paths import ExploredPresets
    from optipath.explorer.state import ReadState, RequestedCurve, RequestedState


_WARNINGS = (AngleWarning, LoopWarning)
_STATE = ("case", "places", "values", "detector", "curve", "want")
_ENDINGS = {"csv": "csv", "toml": "toml", "python": "py"}
_ODD = re.compile(r"[^A-Za-z0-9_-]+")


class PageAnswers:
    """What answers the page; one request after the other, since plans are shared."""

    def __init__(self, presets: ExploredPresets) -> None:
        self._presets = presets
        self._lock = Lock()

    def presets(self) -> dict[str, Any]:
        """Return what may be opened, what is opened first, and units with their sizes."""
        units = {
            name: {"dimension": unit.dimension, "size": parse_quantity(f"1 {name}", unit.dimension)}
            for name, unit in UNITS.items()
        }
        opened = {"presets": self._presets.as_json(), "opened": self._presets.opened}
        return {**opened, "version": version("optipath"), "units": units}

    def open(self, argument: Any) -> dict[str, Any]:
        """Return what the page is told of a path."""
        return self._answer(
            argument, ("places",), lambda request: path_as_json(read_path(self._presets, request))
        )

    def trace(self, argument: Any) -> dict[str, Any]:
        """Return what the page shows of a state, warnings among its notes."""
        return self._answer(
            argument, _STATE, lambda request: traced_as_json(read_state(self._presets, request))
        )

    def export(self, argument: Any) -> dict[str, Any]:
        """Return a state as a file, and what it is called."""
        return self._answer(argument, (*_STATE, "form"), self._exported, ("form",))

    def _answer(
        self,
        argument: Any,
        allowed: Sequence[str],
        answer: Callable[[RequestedState], dict[str, Any]],
        needed: Sequence[str] = (),
    ) -> dict[str, Any]:
        """Answer one request at a time; what is wrong with its fields is an answer, too."""
        with self._lock, warnings.catch_warnings(record=True) as heard:
            for kind in _WARNINGS:
                warnings.simplefilter("always", kind)
            request = requested_state(argument, allowed, needed)
            try:
                result = answer(request)
            except OptipathError as error:
                return {"faults": faults_as_json(error)}
        if "notes" in result:
            told = [str(each.message) for each in heard if issubclass(each.category, _WARNINGS)]
            result["notes"] += dict.fromkeys(told)
        return {"faults": [], **result}

    def _exported(self, request: RequestedState) -> dict[str, Any]:
        state = read_state(self._presets, request)
        traced(state)  # What cannot be traced is no file either.
        curve_detector(state)
        if request.form == "toml":
            text = state.explored.path.with_defaults(**state.values).to_toml()
        elif request.form == "python":
            text = python_lines(state, self._presets.source(request.preset))
        else:
            text = _table(state, request.curve)
        case = [] if request.case is None else ["case", request.case]
        name = "-".join([request.preset.removesuffix(".toml"), *case])
        return {"name": f"{_ODD.sub('-', name)}.{_ENDINGS[request.form]}", "text": text}


def _table(state: ReadState, curve: RequestedCurve | None) -> str:
    """Return what `optipath sweep --out` writes of the curve; without one, the light as a row."""
    plan = state.explored.plan
    with ParameterError.wrapping(subject="curve"):
        grid = SweepGrid((), state.values) if curve is None else curve_grid(state, curve)
        return "".join(csv_parts(plan, grid))


_PRINTED = """\
lights = path.trace_all()
for name in {ends}:
    light = lights[name]
    print(name, *["0" if abs(each) < light.noise else f"{{each:.6g}}" for each in light.stokes])
"""


def python_lines(state: ReadState, source: str) -> str:
    """Return lines of Python for a state."""
    values = {name: repr(word) for name, word in state.asked.places.items()}
    values |= {name: _value(state, name, value) for name, value in state.given.items()}
    arguments = [f"{name}={text}" for name, text in values.items() if not iskeyword(name)]
    # Names that Python keeps for itself are in a mapping.
    if stored := [f"{name!r}: {text}" for name, text in values.items() if iskeyword(name)]:
        arguments.append(f"**{{{', '.join(stored)}}}")
    case = "" if state.asked.case is None else f", case={state.asked.case!r}"
    loaded = f"path = op.load_preset({source!r}{case})"
    if arguments and len(bound := f"{loaded}.bind({', '.join(arguments)})") <= 88:
        loaded = bound
    elif arguments:
        loaded += ".bind(\n" + "".join(f"    {each},\n" for each in arguments) + ")"
    ends = repr([*state.explored.detectors])
    return f"import optipath as op\n\n{loaded}\n{_PRINTED.format(ends=ends)}"


def _value(state: ReadState, name: str, value: Any) -> str:
    if isinstance(value, Material):
        return _material(state, name)
    parameter = state.explored.parameters[name]
    if isinstance(value, float) and not parameter.unit:
        return repr(value)
    return repr(parameter.text(value) if isinstance(value, float | complex | str) else value)


def _material(state: ReadState, name: str) -> str:
    """Return a material by its name, with the k that is given beside it."""
    texts = state.asked.values
    own = extinction_with(state.base.uses, name)
    known = state.base.parameters
    k = f", k={float(known[own].resolve(texts[own]).value)!r}" if own in texts else ""
    return f"op.Material.named({texts[name].strip()!r}{k})"
