"""``optipath show``: what a preset is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click
import numpy as np

from optipath.cli.arguments import NEW_FILE, check_place, write
from optipath.cli.console import PlainConsole, cell, headed, wrapped
from optipath.cli.options import StrictCommand
from optipath.cli.path_picture import headings, parameter_rows, path_picture
from optipath.cli.preset_command import no_preset, one_case
from optipath.composer.wiring import Wiring, link_text
from optipath.errors import ParameterError
from optipath.paths.drawing import draw
from optipath.paths.files.presets import load_preset, preset_of_case

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.paths.path_graph import PathGraph


CASE = click.Option(["--case", "cases"], metavar="NAME", multiple=True, help="Named set of values.")
SVG = click.Option(
    ["--svg"], type=NEW_FILE, help="Draw the graph into this file as well, which ends in .svg."
)
FRAMES = click.Option(
    ["--frames"], is_flag=True, help="Show the frame of each port, and the turn on each link."
)


PRESET = click.Argument(["preset"], required=False, metavar="PRESET")


@click.command(cls=StrictCommand, params=[PRESET, CASE, SVG, FRAMES])
def show(preset: str | None, cases: tuple[str, ...], svg: Path | None, *, frames: bool) -> None:
    """Show the parameters, elements and links of a preset, or of a TOML file."""
    if preset is None:
        raise no_preset()
    if svg is not None and svg.suffix.lower() != ".svg":
        raise click.UsageError(f"--svg draws SVG, and '{svg}' ends otherwise; add the ending .svg")
    if svg is not None:
        check_place(svg)
    path = load_preset(preset)
    case = one_case("show", path, cases)
    path = preset_of_case(path, preset, case)
    if svg is not None:
        write(svg, path_picture(path, preset, case).encode())
    rows = _frame_rows(path) if frames else []
    console = PlainConsole()
    console.print(cell(path.description, style="bold"), end="\n\n")
    if path.parameters or path.choices:
        console.print(headed(*headings(case), rows=parameter_rows(path), box=None))
        console.print()
    text = [draw(path)]
    if path.cases:
        text += ["", f"cases: {', '.join(path.cases)}"]
    text += [f"  {name}: {result.note}" for name, result in path.cases.items() if result.note]
    lines = wrapped("\n".join(text), console.width, whole_words=True)
    console.print(cell(lines), soft_wrap=True)
    if rows:
        console.print()
        console.print(headed("port", "x", "y", "z", "turn", rows=rows, box=None, right=4))


def _frame_rows(path: PathGraph) -> list[tuple[str, ...]]:
    """Return the frame of each port that light passes, and the turns of the links to it."""
    try:
        frames = path.frames()
    except ParameterError as error:
        raise ParameterError(*[f.but(cure="give it a default") for f in error.faults]) from None
    wiring, rows = Wiring(path.graph), []
    for name, ports in frames.items():
        for port, frame in ports.items():
            links = wiring.links_to.get((name, port), [])
            if not links and port in wiring.elements[name].inputs:
                continue
            axes = [_numbers(axis) for axis in (frame.x, frame.y, frame.z)]
            if f"{name}.{port}" in frames.relative:
                axes[2] = "the light"
            turns = [f"{_numbers(np.degrees(frames.turns[link_text(link)]))} deg" for link in links]
            rows.append((f"{name}.{port}", *axes, ", ".join(turns)))
    return rows


def _numbers(values: np.ndarray[Any, Any]) -> str:
    """Return a number or a vector as a table has it; how many there are of a batch."""
    several = values.shape[:-1] if values.ndim and values.shape[-1] == 3 else values.shape
    if several:
        return f"{np.prod(several)} values"
    return " ".join(f"{one + 0.0:.3g}" for one in np.atleast_1d(values).round(9))
