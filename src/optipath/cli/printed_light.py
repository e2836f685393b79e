"""Light as it is printed: the state at each end, and a table of cases."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

import numpy as np
from rich.table import Table

from optipath.cli.console import PlainConsole, cell, headed, title
from optipath.cli.outcome import TOLD
from optipath.cli.printed_grid import point_table, point_texts, span_text
from optipath.errors import listed
from optipath.light.printed_numbers import Numbers
from optipath.sweeps.axes.sweep_grid import SweepGrid
from optipath.values.named_materials import materials_among
from optipath.values.plain_json import plain

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from optipath.cli.outcome import Outcome
    from optipath.light.light import Light

_ROWS = 20
_UNDEFINED = "-"
_SMALL = 1e-9
"""How far from 1 a degree of polarisation may be by rounding alone."""


def print_outcome(outcome: Outcome, digits: int) -> None:
    """Print what a run was given and has found."""
    console, numbers = PlainConsole(), Numbers(digits)
    print_given(console, outcome, numbers)
    for name in outcome.lights:
        console.print(_light_table(outcome, name, numbers))
    if outcome.note:
        console.print(cell(f"note: {outcome.note}"))
    console.print(cell(ran([outcome])))


def print_given(console: PlainConsole, outcome: Outcome, numbers: Numbers) -> None:
    """Print what a run was given."""
    console.print(title(outcome.chosen.title, outcome.path.description))
    table = Table(box=None, show_header=False)
    given = {name: label for name, label, _ in materials_among(outcome.chosen.values)}
    for name, parameter in outcome.single.items():
        if name in given:
            continue
        table.add_row(*map(cell, (name, numbers.value_of(parameter), parameter.help)))
    for name, label in given.items():
        table.add_row(*map(cell, (name, label, outcome.chosen.opened.parameters[name].help)))
    for name, word in outcome.chosen.places.items():
        table.add_row(*map(cell, (name, word, outcome.path.choices[name].help)))
    for axis in outcome.grid.axes:
        table.add_row(*map(cell, (axis.name, span_text(axis, numbers.digits), axis.help)))
    console.print(table)


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
    table = headed("case", "at", "S0", "S1", "S2", "S3")
    for case, outcome in outcomes.items():
        for name, light in outcome.lights.items():
            for row in _case_rows(light, numbers, outcome.grid):
                table.add_row(*map(cell, [f"{case}{row[0]}", name, *row[1:]]))
            if published := outcome.published(name):
                texts = [f"{number:g}" for number in published]
                table.add_row(*map(cell, [f"{case}, published", name, *texts]))
    console.print(table)
    notes: dict[str, list[str]] = {}
    for case, outcome in outcomes.items():
        if outcome.note:
            notes.setdefault(outcome.note, []).append(case)
    for note, cases in notes.items():
        console.print(
            cell(f"note on {'case' if len(cases) == 1 else 'cases'} {listed(cases)}: {note}")
        )
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
    return ", ".join(f"{what} {' or '.join(dict.fromkeys(found))}" for what, found in ways.items())


def _light_table(outcome: Outcome, name: str, numbers: Numbers) -> Table:
    light, published = outcome.lights[name], outcome.published(name)
    if outcome.grid.axes:
        return point_table(f"light at {name}", light, outcome.grid, numbers)
    if light.stokes.ndim > 1:
        return _batch_table(name, light, numbers, published)
    table = headed(f"light at {name}", "computed")
    if published:
        table.add_column("published")
    for position, component in enumerate(numbers.stokes(light)):
        row = [f"S{position}", component]
        table.add_row(*map(cell, [*row, *([f"{published[position]:g}"] if published else [])]))
    for word, text in _state_rows(light, numbers):
        table.add_row(cell(word), cell(text))
    return table


def _state_rows(light: Light, numbers: Numbers) -> Iterator[tuple[str, str]]:
    """Yield what is told of light besides its components."""
    unread = bool(np.isnan(light.stokes).any())
    partly = " of the polarised part" if float(light.dop) < 1.0 - _SMALL else ""
    for key, (word, unit) in TOLD.items():
        number = plain(getattr(light, key.lower()), unit)
        if number is not None:
            behind = partly if "ellipsometry" in word else ""
            yield word, f"{numbers.text(number)} {unit}".strip() + behind
        elif not unread:
            yield word, _UNDEFINED
    if light.exponent:
        yield "log10 S0", numbers.text(float(light.log10_intensity))
        yield "over S0", ", ".join(map(numbers.text, light.normalized.tolist()))


def _batch_table(
    name: str, light: Light, numbers: Numbers, published: Sequence[float] | None
) -> Table:
    table = headed(f"light at {name}", "S0", "S1", "S2", "S3")
    for row in _case_rows(light, numbers, SweepGrid(())):
        table.add_row(*(cell(text.strip()) for text in row))
    if published:
        table.add_row("published", *(f"{number:g}" for number in published))
    return table
