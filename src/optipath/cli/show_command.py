"""``optipath show``: what a preset is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from optipath.cli.arguments import NEW_FILE, check_place, write
from optipath.cli.console import PlainConsole, cell, headed, wrapped
from optipath.cli.options import StrictCommand
from optipath.cli.path_picture import headings, parameter_rows, path_picture
from optipath.cli.preset_command import no_preset, one_case
from optipath.paths.drawing import draw
from optipath.paths.files.presets import load_preset, preset_of_case

if TYPE_CHECKING:
    from pathlib import Path


CASE = click.Option(["--case", "cases"], metavar="NAME", multiple=True, help="Named set of values.")
SVG = click.Option(
    ["--svg"], type=NEW_FILE, help="Draw the graph into this file as well, which ends in .svg."
)


PRESET = click.Argument(["preset"], required=False, metavar="PRESET")


@click.command(cls=StrictCommand, params=[PRESET, CASE, SVG])
def show(preset: str | None, cases: tuple[str, ...], svg: Path | None) -> None:
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
