"""``optipath sweep``: the light for every combination of values, printed or written to a file."""

from __future__ import annotations

import json
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from optipath.cli.arguments import check_place, write
from optipath.cli.console import DIGITS, PlainConsole, cell, headed, progress_bar, say, say_json
from optipath.cli.options import flag, parameter_name
from optipath.cli.outcome import (
    MOST_ROWS,
    outcome_as_json,
    outcome_of,
    plane_table,
    point_table,
    print_arguments,
    ran,
)
from optipath.cli.preset_command import COMPOSING, PresetGroup
from optipath.composer.composer import Composer
from optipath.errors import OptipathError, ParameterError
from optipath.faults import listed, shown
from optipath.light.quantities import PRINTED, Numbers
from optipath.sweeps.axes import grid_of
from optipath.sweeps.datasets import csv_parts
from optipath.values.columns import columns_of
from optipath.values.files import message_of, written_whole

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from rich.table import Table

    from optipath.cli.outcome import Outcome
    from optipath.cli.preset_command import Chosen
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepGrid


SWEEPING = (
    click.Option(
        ["--zip"],
        metavar="NAME,NAME",
        multiple=True,
        help="Parameters whose values vary together, along one axis. May be repeated.",
    ),
    click.Option(
        ["--coords"],
        metavar="FILE.csv",
        help="Axes besides: a column for each parameter, its unit in the heading.",
    ),
    click.Option(
        ["--chunks"], metavar="N|auto", help="How many values along each axis are computed at once."
    ),
    click.Option(
        ["--scheduler"],
        metavar="WORD|ADDRESS",
        help="What computes .zarr and .nc: threads, processes, synchronous, or tcp://... of a "
        "cluster.",
    ),
    click.Option(["--out"], metavar="FILE", help="Write all into this file (csv, json, nc, zarr)."),
)

_TEXTS, _BLOCKS = (".csv", ".json"), (".nc", ".zarr")
"""Endings of what the command writes itself, and of what is computed and written by blocks."""


def zip_groups(groups: Sequence[str]) -> list[tuple[str, ...]]:
    """Return the parameters of each group that varies together, by what was written.

    >>> zip_groups(["sky-angle, --theta"])
    [('sky_angle', 'theta')]
    """
    return [tuple(filter(None, map(parameter_name, names.split(",")))) for names in groups]


def _faults(*, out: str | None, **options: Any) -> list[str]:
    """Return what is wrong with the options of a sweep, a sentence each."""
    faults = [] if out is None else out_faults(out)
    if options["as_json"] and out is not None:
        faults.append("--json prints what --out writes into a file; give one of them")
    faults += [
        f"--zip {shown(names)} names fewer than two parameters; write --zip NAME,NAME"
        for names in options["zip"]
        if len(zip_groups([names])[0]) < 2
    ]
    idle = [f"--{name}" for name in ("chunks", "scheduler") if options[name]]
    if idle and (out is None or Path(out).suffix not in _BLOCKS):
        faults.append(
            f"{listed(idle)} belong{'s' * (len(idle) == 1)} to a sweep that is written by "
            f"blocks; add --out FILE.zarr or FILE.nc, or leave it out"
        )
    return faults


def out_faults(out: str) -> list[str]:
    """Return what is wrong with a file that a sweep is to be written to, a sentence each."""
    file, name = Path(out), f"--out {shown(out)}"
    if "\0" in out or file.suffix not in (*_TEXTS, *_BLOCKS):
        meant = shown(str(file.with_suffix(".csv"))) if file.name else "'result.csv'"
        return [f"{name} has no ending of a sweep; write {meant}, .json, .nc or .zarr"]
    if file.suffix in _TEXTS and (file.exists() or file.is_symlink()):
        return [f"{name} is there already, and stays; name another file, or remove it"]
    faults: list[str] = []
    with OptipathError.collecting(faults, about="--out"):
        check_place(file)
    return faults


def _sweep(
    chosen: Chosen,
    *,
    reads: str | None,
    as_json: bool,
    digits: int,
    out: str | None,
    zip: tuple[str, ...],  # noqa: A002 - as `path.sweep` has it
    coords: str | None,
    chunks: str | None,
    scheduler: str | None,
    **options: Any,
) -> None:
    """Trace the light of a preset, or of a TOML file, for every combination of some values."""
    other = [] if coords is None else [column.name for column in columns_of(coords)]
    if twice := [name for name in other if name in chosen.values]:
        flags = listed([flag(name) for name in twice])
        raise ParameterError(f"{flags} and --coords both give values; leave one of them out")
    path, composer = chosen.path(reads, other), Composer(**options)
    plan = path.plan_by(composer)
    together = zip_groups(zip)
    grid = grid_of(plan.inputs, chosen.axes, together, coords)
    if not grid.axes:
        ways = [f"{flag(name)} START:STOP:COUNT" for name in plan.inputs.open][:1]
        raise ParameterError(
            f"a sweep has an axis at least; give {' or '.join([*ways, '--coords FILE.csv'])}, or "
            f"write 'optipath run' for single values"
        )
    form = Path(out or "").suffix
    if out and form in _BLOCKS:
        with block_bar(out) as progress:
            path.sweep(
                zip=together,
                coords=coords,
                chunks=int(chunks) if chunks and chunks.isdecimal() else chunks,
                store=out,
                scheduler=scheduler,
                progress=progress,
                composer=composer,
                **chosen.axes,
            )
    elif out and form == ".csv":
        _write_csv(Path(out), plan, grid)
    else:
        outcome = outcome_of(chosen, path, plan, grid)
        if out:
            write(Path(out), json.dumps(outcome_as_json(outcome), allow_nan=False).encode())
        elif as_json:
            say_json(outcome_as_json(outcome))
        else:
            print_sweep(outcome, digits)
    if out:
        say(f"wrote {out}: {_sizes_text(grid)}")


sweep = PresetGroup("sweep", _sweep, (*COMPOSING, DIGITS, *SWEEPING), ranges=True, faults=_faults)


def _write_csv(file: Path, plan: Plan, grid: SweepGrid) -> None:
    """Write a line for each point of a grid, a part of them after the other."""
    parts = csv_parts(plan, grid)
    heads = next(parts)  # Before there is a file: names may clash.
    unwritten = message_of(file, click.ClickException, "")
    with unwritten, written_whole(file) as stream, progress_bar(grid.points) as tell:
        stream.write(heads.encode())
        for part in parts:
            stream.write(part.encode())
            tell(file.name, advance=part.count("\n"))


_MOST_COLUMNS = 12
_WIDEST = 1000


def print_sweep(outcome: Outcome, digits: int) -> None:
    """Print the light of a sweep, as far as it fits; the rest is for a file."""
    console, numbers, grid = PlainConsole(), Numbers(digits), outcome.grid
    print_arguments(console, outcome, numbers)
    is_line, is_short = len(grid.shape) == 1, grid.points <= MOST_ROWS
    is_plane = len(grid.axes) == len(grid.shape) == 2
    if is_plane and grid.shape[0] <= MOST_ROWS and grid.shape[1] <= _MOST_COLUMNS:
        for name, light in outcome.lights.items():
            console.print(plane_table(f"S0 at {name}", light, grid, numbers))
    elif is_line or is_short:
        for name in outcome.lights:
            console.print(_point_table(console, outcome, name, numbers))
    else:
        console.print(_summary(outcome, numbers))
    console.print(cell(ran([outcome])))
    if not (is_line and is_short):
        console.print(cell("for all numbers add --out FILE (csv, json, nc, zarr), or --json"))


def _sizes_text(grid: SweepGrid) -> str:
    """Return how many points a grid has, and how many along each dimension."""
    sizes = ", ".join(f"{name} {size:,}" for name, size in grid.sizes.items())
    return f"{grid.points:,} points ({sizes})"


def _point_table(console: PlainConsole, outcome: Outcome, name: str, numbers: Numbers) -> Table:
    """Return a row for each point, with as many quantities of light as the terminal is wide."""
    for count in range(len(PRINTED), 0, -1):
        light, told = outcome.lights[name], PRINTED[:count]
        table = point_table(f"light at {name}", light, outcome.grid, numbers, told)
        needed = console.measure(table, options=console.options.update(width=_WIDEST)).maximum
        if needed <= console.width:
            return table
    return point_table(f"light at {name}", outcome.lights[name], outcome.grid, numbers)


def _summary(outcome: Outcome, numbers: Numbers) -> Table:
    """Return how many points there are, and between which values S0 lies."""
    rows = []
    for name, light in outcome.lights.items():
        known = light.intensity[np.isfinite(light.intensity)]
        ends = (known.min(), known.max()) if known.size else (np.nan, np.nan)
        rows.append([f"light at {name}", *(numbers.state(float(end)) for end in ends)])
    about = cell(_sizes_text(outcome.grid))
    return headed("", "least S0", "largest S0", rows=rows, box=None, title=about, right=1)


@contextmanager
def block_bar(store: str) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on a terminal; say how many blocks were there, and are where Ctrl-C comes."""
    from optipath.sweeps.stored import place_of_blocks  # noqa: PLC0415 - Zarr takes its time

    counts: list[tuple[int, int]] = []
    # A file is written once all are there.
    stored = place_of_blocks(store)
    try:
        with progress_bar(1.0) as show:

            def tell(done: int, total: int) -> None:
                if not counts and done:
                    say(f"optipath: {_counted(done, total)} in {stored} already", err=True)
                counts.append((done, total))
                show(f"{done} of {total} blocks", completed=done / total)

            yield tell
    except KeyboardInterrupt:
        if counts and counts[-1][0]:
            there = f"{_counted(*counts[-1])} in {stored}"
            say(f"optipath: {there}; the same command goes on from there", err=True)
        raise


def _counted(done: int, total: int) -> str:
    return f"{done:,} of {total:,} block{'s' * (total != 1)} {'is' if done == 1 else 'are'}"
