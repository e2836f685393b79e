"""Outcome of a run: as JSON, and printed as tables."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed, title
from optipath.faults import listed
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
        return {name: one for name, one in self.path.parameters.items() if name not in varied}

    @cached_property
    def case(self) -> Case:
        """The case, if these are the values it belongs to; else an empty one."""
        name, is_changed = self.chosen.case, self.chosen.values or self.grid.axes
        return Case({}) if name is None or is_changed else self.path.cases[name]

    @property
    def model(self) -> str:
        """The model that was run; both, where some paths took the exact one."""
        instead, exact = self.plan.instead, self.plan.reduction.model
        within = np.False_ if instead is None else self.errors <= instead.most
        if instead is None or not within.any():
            return exact
        return instead.model if within.all() else f"{instead.model}, {exact}"

    @cached_property
    def errors(self) -> Any:
        """The largest errors that the certificates leave, where some are allowed."""
        approximation = self.plan.answers.approximation
        assert approximation is not None  # noqa: S101 - asked for by who knows
        result = approximation.errors_for(self.grid.given())
        return result if self.grid.varied is self.grid else np.broadcast_to(result, self.grid.shape)

    @property
    def materials(self) -> dict[str, Any]:
        """The materials that were given, with n and k at each wavelength."""
        name, known = WAVELENGTH.name, self.path.parameters
        along = [axis.given for axis in self.grid.axes if axis.name == name]
        wavelength = along[0] if along else known[name].default if name in known else None
        given = materials_among(self.chosen.values)
        return {name: material_as_json(label, one, wavelength) for name, label, one in given}


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
    plan, chosen, parameters = outcome.plan, outcome.chosen, outcome.single
    parts = complex_parts_of(outcome.path.graph)
    axes: dict[str, dict[str, Any]] = {}
    for axis in outcome.grid.axes:
        # Those along one dimension vary together.
        along = {"dimension": axis.dimension} if axis.dimension != axis.name else {}
        axes[axis.name] = {**along, "unit": axis.unit, "values": axis.shown.tolist()}
    tolerance: dict[str, Any] = {}
    if (instead := plan.instead) is not None:
        tolerance = {"most": instead.most, "model": instead.model, "exact": plan.reduction.model}
        tolerance["error"] = plain(outcome.errors)
    results = {
        "preset": chosen.preset,
        "parameters": {
            name: plain(p.default, p.unit, parts.get(name, AMPLITUDE.complex_parts))
            for name, p in parameters.items()
        },
        "materials": outcome.materials,
        "choices": chosen.places,
        "axes": axes,
        "units": {name: p.unit for name, p in parameters.items() if p.unit},
        "model": outcome.model,
        "method": plan.method,
        "engine": outcome.engine,
        "tolerance": tolerance,
        "case": chosen.case,
        "note": outcome.case.note,
        "detectors": {name: _reading(outcome, name) for name in plan.program.detectors},
        "dumps": {name: _reading(outcome, name) for name in plan.program.dumps},
    }
    always = "parameters", "units", "detectors"
    return {name: value for name, value in results.items() if value or name in always}


def _reading(outcome: Outcome, name: str) -> dict[str, Any]:
    published, light = outcome.case.published.get(name), outcome.lights[name]
    messages = {key: plain(each.of(light), each.shown_unit) for key, each in FIGURES.items()}
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
    single = {name: one for name, one in outcome.single.items() if name not in labels}
    rows = [(name, numbers.value_of(one), one.help) for name, one in single.items()]
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
    texts = {name: numbers.value_of(one) for name, one in first.path.parameters.items()}
    texts |= {name: label for name, label, _ in materials_among(first.chosen.values)}
    for name, value in first.chosen.values.items():
        console.print(cell(f"{name} {texts.get(name, value)}"))
    for axis in first.grid.axes:
        console.print(cell(f"{axis.name} {span_text(axis, digits)}"))
    rows: list[list[str]] = []
    notes: dict[str, list[str]] = {}
    for case, outcome in outcomes.items():
        for name, light in outcome.lights.items():
            several = _rows(light, numbers, outcome.grid)
            rows += [[f"{case} {place}".rstrip(), name, *texts] for place, *texts in several]
            if published := outcome.case.published.get(name):
                rows.append([f"{case}, published", name, *(f"{n:g}" for n in published)])
        notes.setdefault(outcome.case.note, []).append(case)
    console.print(headed("case", "at", *_STOKES, rows=rows))
    for note, cases in notes.items():
        if note:
            console.print(cell(f"note on case{'s' * (len(cases) > 1)} {listed(cases)}: {note}"))
    console.print(cell(ran([*outcomes.values()])))


def _rows(light: Light, numbers: Numbers, grid: SweepGrid) -> Iterator[list[str]]:
    """Yield what is told of each light of a batch: which it is, and its components."""
    for index in islice(np.ndindex(light.intensity.shape), _ROWS):
        values = zip(grid.axes, _values_at(grid, index, numbers.digits), strict=True)
        place = ", ".join(f"{axis.name} {text} {axis.unit}".rstrip() for axis, text in values)
        yield [place or (str(list(index)) if index else ""), *numbers.stokes(light, index)]
    if (more := light.intensity.size - _ROWS) > 0:
        yield [f"{more} more", *[""] * 4]


def ran(outcomes: Sequence[Outcome]) -> str:
    """Say how some runs were computed."""
    ways = {
        "method": [outcome.plan.method for outcome in outcomes],
        "model": [outcome.model for outcome in outcomes],
        "engine": [outcome.engine for outcome in outcomes],
    }
    return ", ".join(f"{what} {' or '.join(dict.fromkeys(one))}" for what, one in ways.items())


def _light_table(outcome: Outcome, name: str, numbers: Numbers) -> Table:
    light, corner = outcome.lights[name], f"light at {name}"
    published = [f"{number:g}" for number in outcome.case.published.get(name) or ()]
    if outcome.grid.axes:
        return point_table(corner, light, outcome.grid, numbers)
    if light.stokes.ndim > 1:
        rows = [*_rows(light, numbers, outcome.grid)]
        rows += [["published", *published]] if published else []
        return headed(corner, *_STOKES, rows=rows)
    columns = [_STOKES, numbers.stokes(light), *[published] * bool(published)]
    rows = [*map(list, zip(*columns, strict=True)), *_state_rows(light, numbers)]
    return headed(corner, "computed", *["published"] * bool(published), rows=rows)


def _state_rows(light: Light, numbers: Numbers) -> Iterator[list[str]]:
    """Yield what is told of light besides its components."""
    is_read = not np.isnan(light.stokes).any()
    partly = " of the polarised part" if float(light.dop) < 1.0 - _SMALL else ""
    for each in PRINTED:
        number = plain(each.of(light), each.shown_unit)
        if number is not None:
            behind = partly if "ellipsometry" in each.printed else ""
            yield [each.printed, f"{numbers.text(number)} {each.shown_unit}".strip() + behind]
        elif is_read:
            yield [each.printed, "-"]


MOST_ROWS = 200
"""How many rows a table has; more are for a file."""

_FEW = 5


def _texts(values: Sequence[Any], digits: int) -> list[str]:
    """Return values of an axis as they are printed."""
    return [one if isinstance(one, str) else f"{one + 0.0:.{digits}g}" for one in values]


def span_text(axis: SweepAxis, digits: int) -> str:
    """Return which values an axis has, in a few words."""
    if len(axis) <= _FEW:
        return f"{', '.join(_texts(axis.shown.tolist(), digits))} {axis.unit}".rstrip()
    ends = " .. ".join(_texts(axis.shown[[0, -1]].tolist(), digits))
    return f"{ends} {axis.unit}".rstrip() + f", {len(axis):,} values"


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
    heads, labels = (_texts(axis.shown.tolist(), numbers.digits) for axis in (across, down))
    corner = f"{heading(down.name, down.unit)} \\ {heading(across.name, across.unit)}"
    rows = [
        [label, *(numbers.stokes(light, (row, place))[0] for place in range(len(across)))]
        for row, label in enumerate(labels)
    ]
    return headed(corner, *heads, rows=rows, right=0, box=None, title=cell(title))


def _values_at(grid: SweepGrid, index: Sequence[int], digits: int) -> list[str]:
    places = dict(zip(grid.sizes, index, strict=False))  # A batch without names has no sizes.
    return _texts([axis.shown[places[axis.dimension]].item() for axis in grid.axes], digits)
