"""``optipath sweep``: the light for every combination of values, printed or written to a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.cli.block_bar import block_bar
from optipath.cli.console import DIGITS, say, say_json
from optipath.cli.given_axes import refuse_arrays
from optipath.cli.outcome import outcome_as_json, outcome_of
from optipath.cli.preset_command import COMPOSING, PresetGroup
from optipath.cli.printed_sweep import print_sweep, sizes_text
from optipath.cli.sweep_files import write_csv, write_json
from optipath.cli.sweep_options import (
    SWEEPING,
    chunks_of,
    coords_names,
    ending_of,
    is_of_blocks,
    option_faults,
    zip_groups,
)
from optipath.composer.composer import Composer
from optipath.errors import ParameterError, listed
from optipath.sweeps.axes.read_axes import grid_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.cli.chosen import Chosen


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
    beside = coords_names(coords)
    if twice := [name for name in beside if name in chosen.values]:
        flags = listed([f"--{name.replace('_', '-')}" for name in twice])
        raise ParameterError(f"{flags} and --coords both give values; leave one of them out")
    path = chosen.path(reads, beside)
    refuse_arrays(path, [*chosen.axes, *beside])
    composer = Composer(**options)
    plan = composer.compose(path)
    together = [*zip_groups(zip).values()]
    grid = grid_of(plan.inputs, chosen.axes, together, coords)
    if not grid.axes:
        raise ParameterError(_no_axis(plan.inputs.open))
    if out is not None and is_of_blocks(out):
        with block_bar(out) as progress:
            path.sweep(
                zip=together,
                coords=coords,
                chunks=chunks_of(chunks),
                store=out,
                scheduler=scheduler,
                progress=progress,
                composer=composer,
                **chosen.axes,
            )
    elif out is not None and ending_of(out) == ".csv":
        write_csv(Path(out), plan, grid)
    else:
        outcome = outcome_of(chosen, path, plan, grid)
        if out is not None:
            write_json(Path(out), outcome)
        elif as_json:
            say_json(outcome_as_json(outcome))
        else:
            print_sweep(outcome, digits)
    if out is not None:
        say(f"wrote {out}: {sizes_text(grid)}")


def _no_axis(known: Iterable[str]) -> str:
    flags = [f"--{name.replace('_', '-')} START:STOP:COUNT" for name in known][:1]
    given = " or ".join([*flags, "--coords FILE.csv"])
    return f"a sweep has an axis at least; give {given}, or write 'optipath run' for single values"


sweep = PresetGroup(
    "sweep", _sweep, (*COMPOSING, DIGITS, *SWEEPING), ranges=True, faults=option_faults
)
