"""Files that ``optipath sweep`` writes itself: JSON, and tables with a row for each point."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.outcome import outcome_as_json
from optipath.cli.printed_grid import heading
from optipath.cli.progress_bar import progress_bar
from optipath.cli.text_files import told_of, write
from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.sweeps.labels.variable_names import detectors_of, variable_names
from optipath.values.written_files import written_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from optipath.cli.outcome import Outcome
    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_grid import SweepGrid

_ROWS = 1 << 16
"""How many rows are computed and written at once."""


def write_json(file: Path, outcome: Outcome) -> None:
    """Write all that a run has found as one JSON object.

    Parameters
    ----------
    file : Path
        Where it is to be, whole or not at all.
    outcome : Outcome
        The run.

    Raises
    ------
    click.ClickException
        If it cannot be written.
    """
    write(file, json.dumps(outcome_as_json(outcome), allow_nan=False).encode())


def write_csv(file: Path, plan: Plan, grid: SweepGrid) -> None:
    """Write a line for each point of a grid, a part of them after the other.

    Parameters
    ----------
    file : Path
        Where it is to be, whole or not at all.
    plan : Plan
        By which the light is computed.
    grid : SweepGrid
        The values of its parameters, which are as many columns.

    Raises
    ------
    click.ClickException
        If it cannot be written.
    """
    columns = _columns(plan, grid)
    with told_of(file), written_whole(file) as stream, progress_bar(grid.points) as tell:
        stream.write(",".join(columns).encode() + b"\n")
        for region in regions(grid.shape):
            rows = list(zip(*_texts(plan, grid, region), strict=True))
            stream.write("".join(f"{','.join(row)}\n" for row in rows).encode())
            tell(file.name, advance=len(rows))


def regions(shape: Sequence[int], most: int = _ROWS) -> Iterator[tuple[slice, ...]]:
    """Yield parts of a grid in the order of its points.

    Parameters
    ----------
    shape : sequence of int
        Of the grid.
    most : int, optional
        How many points a part has at most.

    Yields
    ------
    tuple of slice
        One for each dimension.

    Examples
    --------
    >>> [[(cut.start, cut.stop) for cut in region] for region in regions((2, 3), 2)]
    [[(0, 1), (0, 2)], [(0, 1), (2, 3)], [(1, 2), (0, 2)], [(1, 2), (2, 3)]]
    """
    whole, points = len(shape), 1
    while whole and points * shape[whole - 1] <= most:
        whole -= 1
        points *= shape[whole]
    behind = [slice(0, size) for size in shape[whole:]]
    if not whole:
        yield tuple(behind)
        return
    size, step = shape[whole - 1], max(most // points, 1)
    for index in np.ndindex(*shape[: whole - 1]):
        before = [slice(place, place + 1) for place in index]
        for start in range(0, size, step):
            yield (*before, slice(start, min(start + step, size)), *behind)


def _columns(plan: Plan, grid: SweepGrid) -> list[str]:
    names = variable_names(grid, plan)
    ends = detectors_of(plan)
    at = [f" at {end}" for end in ends] if len(ends) > 1 else [""]
    told = [
        heading(names[quantity.variable] + place, _unit(quantity.unit))
        for place in at
        for quantity in QUANTITIES
    ]
    return [_quoted(name) for name in (*[heading(a.name, a.unit) for a in grid.axes], *told)]


def _texts(plan: Plan, grid: SweepGrid, region: Sequence[slice]) -> Iterator[Sequence[str]]:
    """Yield the texts of each column for a part of a grid."""
    shape = tuple(cut.stop - cut.start for cut in region)
    places = dict(zip(grid.sizes, range(len(shape)), strict=True))
    for axis in grid.axes:
        place = places[axis.dimension]
        texts = np.array([_text(value) for value in axis.shown[region[place]].tolist()], object)
        along = texts.reshape(-1, *(1,) * (len(shape) - 1 - place))
        yield np.broadcast_to(along, shape).ravel().tolist()
    lights = plan.run_all(**grid.given(region))
    for end in detectors_of(plan):
        for quantity in QUANTITIES:
            numbers = quantity.of(lights[end])
            numbers = np.degrees(numbers) if quantity.unit == "rad" else numbers
            each = np.broadcast_to(numbers + 0.0, shape)  # It may be the same along an axis.
            yield [repr(number) for number in each.ravel().tolist()]


def _text(value: Any) -> str:
    return _quoted(value) if isinstance(value, str) else repr(value)


def _quoted(text: str) -> str:
    """Return a cell of a table, in quotation marks where it needs them."""
    return '"' + text.replace('"', '""') + '"' if any(each in text for each in ',"\n') else text


def _unit(unit: str) -> str:
    """Return the unit in which the command line has a quantity of light."""
    return {"rad": "deg", "1": ""}.get(unit, unit)
