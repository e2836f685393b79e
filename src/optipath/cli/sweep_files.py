"""Files that ``optipath sweep`` writes itself: JSON, and tables with a row for each point."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from optipath.cli.outcome import outcome_as_json
from optipath.cli.progress_bar import progress_bar
from optipath.cli.text_files import told_of, write
from optipath.sweeps.labels.table_texts import regions, table_columns, table_heads
from optipath.values.written_files import written_whole

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.cli.outcome import Outcome
    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_grid import SweepGrid


def write_json(file: Path, outcome: Outcome) -> None:
    """Write all that a run has found as one JSON object."""
    write(file, json.dumps(outcome_as_json(outcome), allow_nan=False).encode())


def write_csv(file: Path, plan: Plan, grid: SweepGrid) -> None:
    """Write a line for each point of a grid, a part of them after the other."""
    columns = table_heads(plan, grid)
    with told_of(file), written_whole(file) as stream, progress_bar(grid.points) as tell:
        stream.write(",".join(columns).encode() + b"\n")
        for region in regions(grid.shape):
            rows = list(zip(*table_columns(plan, grid, region), strict=True))
            stream.write("".join(f"{','.join(row)}\n" for row in rows).encode())
            tell(file.name, advance=len(rows))
