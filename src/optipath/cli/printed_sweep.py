"""A sweep as it is printed: a row for each point, a plane of S0, or a summary."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed
from optipath.cli.outcome import TOLD
from optipath.cli.printed_grid import MOST_ROWS, plane_table, point_table
from optipath.cli.printed_light import print_given, ran
from optipath.light.printed_numbers import Numbers

if TYPE_CHECKING:
    from rich.table import Table

    from optipath.cli.outcome import Outcome
    from optipath.sweeps.axes.sweep_grid import SweepGrid

_MOST_COLUMNS = 12
_WIDEST = 1000


def print_sweep(outcome: Outcome, digits: int) -> None:
    """Print the light of a sweep, as far as it fits; the rest is for a file."""
    console, numbers = PlainConsole(), Numbers(digits)
    print_given(console, outcome, numbers)
    grid = outcome.grid
    is_line = len(grid.shape) == 1
    is_plane = len(grid.axes) == len(grid.shape) == 2
    if is_plane and grid.shape[0] <= MOST_ROWS and grid.shape[1] <= _MOST_COLUMNS:
        titles = {f"S0 at {name}": light for name, light in outcome.lights.items()}
        tables = [plane_table(title, light, grid, numbers) for title, light in titles.items()]
    elif is_line or grid.points <= MOST_ROWS:
        tables = [_point_table(console, outcome, name, numbers) for name in outcome.lights]
    else:
        tables = [_summary(outcome, numbers)]
    for table in tables:
        console.print(table)
    console.print(cell(ran([outcome])))
    if not is_line or grid.points > MOST_ROWS:
        console.print(cell("for all numbers add --out FILE (csv, json, nc, zarr), or --json"))


def sizes_text(grid: SweepGrid) -> str:
    """Return how many points a grid has, and how many along each dimension."""
    sizes = ", ".join(f"{name} {size:,}" for name, size in grid.sizes.items())
    return f"{grid.points:,} points ({sizes})"


def _point_table(console: PlainConsole, outcome: Outcome, name: str, numbers: Numbers) -> Table:
    """Return a row for each point, with as many quantities of light as the terminal is wide."""
    given = f"light at {name}", outcome.lights[name], outcome.grid, numbers
    for count in range(len(TOLD), 0, -1):
        table = point_table(*given, dict(islice(TOLD.items(), count)))
        if console.measure(table, options=console.options.update(width=_WIDEST)).maximum <= (
            console.width
        ):
            return table
    return point_table(*given)


def _summary(outcome: Outcome, numbers: Numbers) -> Table:
    """Return how many points there are, and between which values S0 lies."""
    about = cell(sizes_text(outcome.grid))
    table = headed("", "least S0", "largest S0", box=None, title=about, title_justify="left")
    for column in table.columns[1:]:
        column.justify = "right"
    for name, light in outcome.lights.items():
        known = light.intensity[np.isfinite(light.intensity)]
        ends = [float(find(known)) if known.size else np.nan for find in (np.min, np.max)]
        table.add_row(*map(cell, (f"light at {name}", *map(numbers.state, ends))))
    return table
