"""Light for many combinations of values, as it is printed: tables of points and of rows."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import cell, headed
from optipath.sweeps.labels.table_texts import heading

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from rich.table import Table

    from optipath.light.light import Light
    from optipath.light.printed_numbers import Numbers
    from optipath.sweeps.axes.sweep_axis import SweepAxis
    from optipath.sweeps.axes.sweep_grid import SweepGrid

MOST_ROWS = 200
"""How many rows a table has; more are for a file."""

_FEW = 5
_STOKES = ("S0", "S1", "S2", "S3")


def value_text(value: Any, digits: int) -> str:
    """Return a value of an axis as it is printed.

    Examples
    --------
    >>> value_text(400.0, 6), value_text("horizontal", 6)
    ('400', 'horizontal')
    """
    return value if isinstance(value, str) else f"{value + 0.0:.{digits}g}"


def span_text(axis: SweepAxis, digits: int) -> str:
    """Return which values an axis has, in a few words."""
    if len(axis) <= _FEW:
        texts = [value_text(value, digits) for value in axis.shown.tolist()]
        return f"{', '.join(texts)} {axis.unit}".rstrip()
    ends = [value_text(axis.shown[place].item(), digits) for place in (0, -1)]
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
    told: Mapping[str, tuple[str, str]] | None = None,
) -> Table:
    """Return a table with a row for each point of a grid."""
    told = told or {}
    columns = [heading(axis.name, axis.unit) for axis in grid.axes] + [*_STOKES]
    columns += [heading(word, unit) for word, unit in told.values()]
    table = headed(*columns, box=None, title=cell(title), title_justify="left", title_style="")
    for column in table.columns:
        column.justify = "right"
    more = [_degrees(getattr(light, key.lower()), unit) for key, (_, unit) in told.items()]
    for index in islice(np.ndindex(grid.shape), MOST_ROWS):
        values = _values_at(grid, index, numbers.digits)
        behind = (numbers.state(float(each[index])) for each in more)
        table.add_row(*map(cell, (*values, *numbers.stokes(light, index), *behind)))
    if (left := grid.points - MOST_ROWS) > 0:
        table.add_row(cell(f"{left:,} more"))
    return table


def plane_table(title: str, light: Light, grid: SweepGrid, numbers: Numbers) -> Table:
    """Return S0 for a grid of two axes: a row for each value of the first."""
    down, across = grid.axes
    heads = [value_text(value, numbers.digits) for value in across.shown.tolist()]
    corner = f"{heading(down.name, down.unit)} \\ {heading(across.name, across.unit)}"
    table = headed(
        corner, *heads, box=None, title=cell(title), title_justify="left", title_style=""
    )
    for column in table.columns:
        column.justify = "right"
    for row, value in enumerate(down.shown.tolist()):
        texts = [numbers.stokes(light, (row, place))[0] for place in range(len(across))]
        table.add_row(*map(cell, (value_text(value, numbers.digits), *texts)))
    return table


def _degrees(numbers: Any, unit: str) -> Any:
    return np.degrees(numbers) if unit == "deg" else numbers


def _values_at(grid: SweepGrid, index: Sequence[int], digits: int) -> list[str]:
    places = dict(zip(grid.sizes, index, strict=False))  # A batch without names has no sizes.
    return [value_text(axis.shown[places[axis.dimension]].item(), digits) for axis in grid.axes]
