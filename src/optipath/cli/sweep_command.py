"""``optipath sweep``: the light for every combination of values, printed or written to a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from optipath.cli.console import DIGITS, say, say_json
from optipath.cli.outcome import Outcome, outcome_as_json
from optipath.cli.preset_command import COMPOSING, PresetGroup
from optipath.cli.printed_sweep import print_sweep
from optipath.cli.sweep_files import NEW_FILE, write_csv, write_json
from optipath.composer.composer import Composer
from optipath.errors import ParameterError
from optipath.sweeps.read_axes import grid_of
from optipath.values.text_tables import columns_of

if TYPE_CHECKING:
    from optipath.cli.chosen import Chosen

ZIP = click.Option(
    ["--zip", "together"],
    metavar="NAME,NAME",
    multiple=True,
    help="Parameters whose values vary together, along one axis. May be repeated.",
)
COORDS = click.Option(
    ["--coords"],
    metavar="FILE.csv",
    help="Axes besides: a column for each parameter, its unit in the heading.",
)
CHUNKS = click.Option(
    ["--chunks"],
    metavar="N|auto",
    help="How many values along each axis a block has, of .zarr and .nc.",
)
SCHEDULER = click.Option(
    ["--scheduler"],
    metavar="WORD|ADDRESS",
    help="What computes the blocks: threads, processes, synchronous, or tcp://... of a cluster.",
)
OUT = click.Option(
    ["--out"],
    metavar="FILE",
    help="Write all into this file; its ending says in which form (csv, json, nc, zarr).",
)


def _sweep(
    chosen: Chosen,
    *,
    reads: str | None,
    as_json: bool,
    digits: int,
    out: str | None,
    together: tuple[str, ...],
    coords: str | None,
    chunks: str | None,
    scheduler: str | None,
    **options: Any,
) -> None:
    """Trace the light of a preset, or of a TOML file, for every combination of some values."""
    beside = [column.name for column in columns_of(coords)] if coords else []
    path = chosen.path(reads, beside)
    composer = Composer(**options)
    plan = composer.compose(path)
    zipped = [tuple(name.strip() for name in names.split(",")) for names in together]
    grid = grid_of(plan.inputs, chosen.axes, zipped, coords)
    if not grid.axes:
        raise ParameterError(NO_AXIS)
    file = None if out is None else Path(out)
    if file is None:
        outcome = outcome_of(chosen, path, plan, grid)
        if as_json:
            say_json(outcome_as_json(outcome))
        else:
            print_sweep(outcome, digits)
        return
    suffix = file.suffix.lower()
    if suffix == ".csv":
        write_csv(file, plan, grid)
    elif suffix == ".json":
        write_json(file, outcome_of(chosen, path, plan, grid))
    else:
        ...
    say(f"wrote {file}")
