"""``optipath sweep``: the light for every combination of values, printed or written to a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.cli.console import DIGITS, say, say_json
from optipath.cli.given_axes import refuse_arrays
from optipath.cli.outcome import outcome_as_json, outcome_of
from optipath.cli.preset_command import COMPOSING, PresetGroup
from optipath.cli.printed_sweep import print_sweep, sizes_text
from optipath.cli.sweep_files import write_csv, write_json
from optipath.cli.sweep_options import SWEEPING, chunks_of, is_of_blocks, option_faults
from optipath.composer.composer import Composer
from optipath.errors import ParameterError
from optipath.sweeps.read_axes import grid_of
from optipath.values.text_tables import columns_of

if TYPE_CHECKING:
    from optipath.cli.chosen import Chosen

_NO_AXIS = (
    "a sweep has no axis; give a parameter several values, such as --{name} {example}, or give "
    "--coords FILE.csv"
)


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
    beside = [column.name for column in columns_of(coords)] if coords else []
    path = chosen.path(reads, beside)
    refuse_arrays(path, [*chosen.axes, *beside])
    composer = Composer(**options)
    plan = composer.compose(path)
    together = [tuple(name.strip() for name in names.split(",")) for names in zip]
    grid = grid_of(plan.inputs, chosen.axes, together, coords)
    if not grid.axes:
        raise ParameterError(_NO_AXIS)
    if is_of_blocks(out):
        keywords = {"zip": together, "coords": coords, "composer": composer, "store": out}
        keywords |= {"chunks": chunks_of(chunks), "scheduler": scheduler}
        path.sweep(**chosen.axes, **keywords, progress=True)
    elif out is not None and out.lower().endswith(".csv"):
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


sweep = PresetGroup(
    "sweep", _sweep, (*COMPOSING, DIGITS, *SWEEPING), ranges=True, faults=option_faults
)
