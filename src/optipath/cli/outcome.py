"""Outcome of a run: as JSON, and printed as tables."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed, title
from optipath.errors import listed
from optipath.light.quantities import PRINTED, Numbers
from optipath.materials.named_materials import WAVELENGTH, material_as_json, materials_among
from optipath.materials.quantities import AMPLITUDE, plain
from optipath.paths.files.writer import complex_parts_of
from optipath.sweeps.datasets import CAPITALIZED, heading
from optipath.sweeps.grid import SweepGrid, refuse_more_than_free
from optipath.values.cases import Case

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from rich.table import Table

    from optipath.cli.preset_command import Chosen
    from optipath.light.light import Light
    from optipath.light.quantities import LightQuantity
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepAxis
    from optipath.values.parameters import Parameter


FIGURES = {CAPITALIZED.get(each.attribute, each.attribute): each for each in PRINTED}
"""What is told of light besides its Stokes vector, by its key in JSON."""


@dataclass(frozen=True)
class Outcome:
    """What a run was given, and what it has found."""

    chosen: Chosen
    path: PathGraph
    plan: Plan
    lights: dict[str, Light]
    engine: str
    grid: SweepGrid = field(default_factory=lambda: SweepGrid(()))

    @property
    def single(self) -> dict[str, Parameter]:
        """The parameters that have one value, by name."""
        varied = {axis.name for axis in self.grid.axes}
        known = self.path.parameters
        return {name: parameter for name, parameter in known.items() if name not in varied}

    @cached_property
    def case(self) -> Case:
        """The case, if these are the values it belongs to; else an empty one."""
        name = self.chosen.case
        is_changed = bool(self.chosen.values or self.grid.axes)
        return Case({}) if name is None or is_changed else self.path.cases[name]

    @property
    def model(self) -> str:
        """The model that was run; both, where some paths took the exact one."""
        instead, exact = self.plan.instead, self.plan.reduction.model
        if instead is None:
            return exact
        within = self.errors <= instead.most
        if not within.any():
            return exact
        return instead.model if within.all() else f"{instead.model}, {exact}"

    @cached_property
    def errors(self) -> Any:
        """The largest errors that the certificates leave, where some are allowed."""
        approximation = self.plan.answers.approximation
        assert approximation is not None  # noqa: S101 - asked for by who knows
        result = approximation.errors_for(self.grid.given())
        is_idle = self.grid.varied is not self.grid
        return np.broadcast_to(result, self.grid.shape) if is_idle else result

    @property
    def materials(self) -> dict[str, Any]:
        """The materials that were given, with n and k at each wavelength; {} without any."""
        if not (argument := list(materials_among(self.chosen.values))):
            return {}
        known = self.path.parameters
        wavelength = known[WAVELENGTH.name].default if WAVELENGTH.name in known else None
        along = [axis.given for axis in self.grid.axes if axis.name == WAVELENGTH.name]
        wavelength = along[0] if along else wavelength
        results = {name: material_as_json(label, one, wavelength) for name, label, one in argument}
        return {"materials": results}


def outcome_of(chosen: Chosen, path: PathGraph, plan: Plan, grid: SweepGrid) -> Outcome:
    """Run a plan for all that was chosen."""
    if grid.axes:
        refuse_more_than_free(plan, grid)
    result = plan.run_all(**grid.given())
    lights = {name: _laid_out(light, grid) for name, light in result.items()}
    return Outcome(chosen, path, plan, lights, " and ".join(plan.answers.ran_by), grid)


def _laid_out(light: Light, grid: SweepGrid) -> Light:
    """Return the light of a run, repeated along dimensions on which nothing depends."""
    if (ran := grid.varied) is grid:
        return light
    each = zip(grid.shape, ran.shape, strict=True)
    return light.reshape(ran.shape)[np.ix_(*[np.arange(size) % own for size, own in each])]


def outcome_as_json(outcome: Outcome) -> dict[str, Any]:
    """Return what a run has found as JSON can hold it, with all digits."""
    plan, parameters = outcome.plan, outcome.single
    parts = complex_parts_of(outcome.path.graph)
    axes: dict[str, dict[str, Any]] = {}
    for axis in outcome.grid.axes:
        # Those along one dimension vary together.
        along = {"dimension": axis.dimension} if axis.dimension != axis.name else {}
        axes[axis.name] = {**along, "unit": axis.unit, "values": axis.shown.tolist()}
    results: dict[str, Any] = {
        "preset": outcome.chosen.preset,
        "parameters": {
            name: plain(p.default, p.unit, parts.get(name, AMPLITUDE.complex_parts))
            for name, p in parameters.items()
        },
        **outcome.materials,
        **({"choices": outcome.chosen.places} if outcome.chosen.places else {}),
        **({"axes": axes} if axes else {}),
        "units": {name: p.unit for name, p in parameters.items() if p.unit},
        "model": outcome.model,
        "method": plan.method,
        "engine": outcome.engine,
    }
    if (instead := plan.instead) is not None:
        allowed = {"most": instead.most, "model": instead.model, "exact": plan.reduction.model}
        results["tolerance"] = {**allowed, "error": plain(outcome.errors)}
    if outcome.chosen.case:
        results["case"] = outcome.chosen.case
    if outcome.case.note:
        results["note"] = outcome.case.note
    results["detectors"] = {name: _reading(outcome, name) for name in plan.program.detectors}
    dumps = {name: _reading(outcome, name) for name in plan.program.dumps}
    return results | ({"dumps": dumps} if dumps else {})


def _reading(outcome: Outcome, name: str) -> dict[str, Any]:
    published, light = outcome.case.published.get(name), outcome.lights[name]
    messages: dict[str, Any] = {
        key: plain(each.of(light), each.shown_unit) for key, each in FIGURES.items()
    }
    messages["units"] = {key: each.shown_unit for key, each in FIGURES.items() if each.shown_unit}
    results = {"stokes": plain(light.stokes), "polarization": messages}
    return results | ({"published": list(published)} if published else {})


_ROWS = 20
_STOKES = ("S0", "S1", "S2", "S3")
_SMALL = 1e-9
"""How far from 1 a degree of polarisation may be by rounding alone."""


def print_outcome(outcome: Outcome, digits: int) -> None:
    """Print what a run was given and has found."""
    console, numbers = PlainConsole(), Numbers(digits)
    print_arguments(console, outcome, numbers)
    for name in outcome.lights:
        console.print(_light_table(outcome, name, numbers))
    if outcome.case.note:
        console.print(cell(f"note: {outcome.case.note}"))
    console.print(cell(ran([outcome])))


def print_arguments(console: PlainConsole, outcome: Outcome, numbers: Numbers) -> None:
    """Print what a run was given."""
    console.print(title(outcome.chosen.title, outcome.path.description))
    labels = {name: label for name, label, _ in materials_among(outcome.chosen.values)}
    opened, choices = outcome.chosen.opened.parameters, outcome.path.choices
    rows = [
        (name, numbers.value_of(parameter), parameter.help)
        for name, parameter in outcome.single.items()
        if name not in labels
    ]
    rows += [(name, label, opened[name].help) for name, label in labels.items()]
    rows += [(name, word, choices[name].help) for name, word in outcome.chosen.places.items()]
    rows += [(a.name, span_text(a, numbers.digits), a.help) for a in outcome.grid.axes]
    console.print(headed("", "", "", rows=rows, box=None, show_header=False))


def print_cases(outcomes: Mapping[str, Outcome], digits: int) -> None:
    """Print a table of cases, with what was published under what is computed."""
    console, numbers = PlainConsole(), Numbers(digits)
    first = next(iter(outcomes.values()))
    counted = f"{len(outcomes)} case{'s' * (len(outcomes) != 1)}"
    console.print(title(f"{first.chosen.preset}, {counted}", first.path.description))
    labels = {name: label for name, label, _ in materials_among(first.chosen.values)}
    for name, value in {**first.chosen.values, **labels}.items():
        parameter = None if name in labels else first.path.parameters.get(name)
        text = value if parameter is None else numbers.value_of(parameter)
        console.print(cell(f"{name} {text}"))
    for axis in first.grid.axes:
        console.print(cell(f"{axis.name} {span_text(axis, digits)}"))
    rows: list[list[str]] = []
    for case, outcome in outcomes.items():
        for name, light in outcome.lights.items():
            several = _case_rows(light, numbers, outcome.grid)
            rows += [[f"{case}{place}", name, *texts] for place, *texts in several]
            if published := outcome.case.published.get(name):
                rows.append([f"{case}, published", name, *(f"{n:g}" for n in published)])
    console.print(headed("case", "at", *_STOKES, rows=rows))
    notes: dict[str, list[str]] = {}
    for case, outcome in outcomes.items():
        if outcome.case.note:
            notes.setdefault(outcome.case.note, []).append(case)
    for note, cases in notes.items():
        console.print(cell(f"note on case{'s' * (len(cases) > 1)} {listed(cases)}: {note}"))
    console.print(cell(ran([*outcomes.values()])))


def _case_rows(light: Light, numbers: Numbers, grid: SweepGrid) -> Iterator[list[str]]:
    """Yield what is told of each light of a batch: which it is, and its components."""
    for index in islice(np.ndindex(light.intensity.shape), _ROWS):
        values = ", ".join(point_texts(grid, index, numbers.digits))
        place = values or (str(list(index)) if index else "")
        yield [f" {place}".rstrip(), *numbers.stokes(light, index)]
    if (more := light.intensity.size - _ROWS) > 0:
        yield [f" {more} more", *[""] * 4]


def ran(outcomes: Sequence[Outcome]) -> str:
    """Say how some runs were computed."""
    ways = {
        "method": [outcome.plan.method for outcome in outcomes],
        "model": [outcome.model for outcome in outcomes],
        "engine": [outcome.engine for outcome in outcomes],
    }
    return ", ".join(f"{what} {' or '.join(dict.fromkeys(one))}" for what, one in ways.items())


def _light_table(outcome: Outcome, name: str, numbers: Numbers) -> Table:
    light, published = outcome.lights[name], outcome.case.published.get(name)
    if outcome.grid.axes:
        return point_table(f"light at {name}", light, outcome.grid, numbers)
    if light.stokes.ndim > 1:
        rows = [[text.strip() for text in row] for row in _case_rows(light, numbers, SweepGrid(()))]
        rows += [["published", *(f"{number:g}" for number in published)]] if published else []
        return headed(f"light at {name}", *_STOKES, rows=rows)
    rows = [[word, text] for word, text in zip(_STOKES, numbers.stokes(light), strict=True)]
    if published:
        rows = [[*row, f"{number:g}"] for row, number in zip(rows, published, strict=True)]
    rows += _state_rows(light, numbers)
    return headed(f"light at {name}", "computed", *["published"] * bool(published), rows=rows)


def _state_rows(light: Light, numbers: Numbers) -> Iterator[list[str]]:
    """Yield what is told of light besides its components."""
    unread = bool(np.isnan(light.stokes).any())
    partly = " of the polarised part" if float(light.dop) < 1.0 - _SMALL else ""
    for each in PRINTED:
        word, unit = each.printed, each.shown_unit
        number = plain(each.of(light), unit)
        if number is not None:
            behind = partly if "ellipsometry" in word else ""
            yield [word, f"{numbers.text(number)} {unit}".strip() + behind]
        elif not unread:
            yield [word, "-"]


MOST_ROWS = 200
"""How many rows a table has; more are for a file."""

_FEW = 5


def printed_value(value: Any, digits: int) -> str:
    """Return a value of an axis as it is printed."""
    return value if isinstance(value, str) else f"{value + 0.0:.{digits}g}"


def span_text(axis: SweepAxis, digits: int) -> str:
    """Return which values an axis has, in a few words."""
    if len(axis) <= _FEW:
        texts = [printed_value(value, digits) for value in axis.shown.tolist()]
        return f"{', '.join(texts)} {axis.unit}".rstrip()
    ends = [printed_value(axis.shown[place].item(), digits) for place in (0, -1)]
    return f"{' .. '.join(ends)} {axis.unit}".rstrip() + f", {len(axis):,} values"


def point_texts(grid: SweepGrid, index: Sequence[int], digits: int) -> Iterator[str]:
    """Yield the value of each axis at a point of a grid, with its name and unit."""
    for axis, text in zip(grid.axes, _values_at(grid, index, digits), strict=True):
        yield f"{axis.name} {text} {axis.unit}".rstrip()


def point_table(
    title: str,
    light: Light,
    grid: SweepGrid,
    numbers: Numbers,
    quantities: Sequence[LightQuantity] = (),
) -> Table:
    """Return a table with a row for each point of a grid."""
    columns = [heading(axis.name, axis.unit) for axis in grid.axes] + [*_STOKES]
    columns += [heading(each.printed, each.shown_unit) for each in quantities]
    more = [each.shown_of(light) for each in quantities]
    rows = [
        [
            *_values_at(grid, index, numbers.digits),
            *numbers.stokes(light, index),
            *(numbers.state(float(each[index])) for each in more),
        ]
        for index in islice(np.ndindex(grid.shape), MOST_ROWS)
    ]
    if (left := grid.points - MOST_ROWS) > 0:
        rows.append([f"{left:,} more"])
    return headed(*columns, rows=rows, right=0, box=None, title=cell(title))


def plane_table(title: str, light: Light, grid: SweepGrid, numbers: Numbers) -> Table:
    """Return S0 for a grid of two axes: a row for each value of the first."""
    down, across = grid.axes
    heads, labels = (
        [printed_value(value, numbers.digits) for value in axis.shown.tolist()]
        for axis in (across, down)
    )
    corner = f"{heading(down.name, down.unit)} \\ {heading(across.name, across.unit)}"
    rows = [
        [label, *(numbers.stokes(light, (row, place))[0] for place in range(len(across)))]
        for row, label in enumerate(labels)
    ]
    return headed(corner, *heads, rows=rows, right=0, box=None, title=cell(title))


def _values_at(grid: SweepGrid, index: Sequence[int], digits: int) -> list[str]:
    places = dict(zip(grid.sizes, index, strict=False))  # A batch without names has no sizes.
    return [printed_value(axis.shown[places[axis.dimension]].item(), digits) for axis in grid.axes]
