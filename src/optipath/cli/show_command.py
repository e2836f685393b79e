"""``optipath show``: what a preset is made of."""

from __future__ import annotations

import re
from io import StringIO
from typing import TYPE_CHECKING

import click
from rich.cells import cell_len

from optipath.cli.chosen import one_case
from optipath.cli.console import PlainConsole, cell, headed, wrapped
from optipath.cli.misplaced import StrictCommand
from optipath.cli.preset_command import no_preset
from optipath.cli.text_files import NewFile, write
from optipath.errors import printable
from optipath.paths.drawing import draw
from optipath.paths.presets.loader import load_preset, preset_of_case

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter
CASE = click.Option(["--case", "cases"], metavar="NAME", multiple=True, help="Named set of values.")
SVG = click.Option(["--svg"], type=NewFile(), help="Draw into this file as well.")

# What rich would load from the net: a typeface, in place of which one that is there will do.
_FROM_THE_NET = re.compile(r"@font-face \{.*?\}\s*|<!--.*?-->\s*", re.DOTALL)


def _show(preset: str | None, cases: tuple[str, ...], svg: Path | None) -> None:
    """Show the parameters, elements and links of a preset, or of a TOML file."""
    if preset is None:
        raise no_preset()
    path = load_preset(preset)
    case = one_case("show", path, cases)
    path = path if case is None else preset_of_case(path, preset, case)
    if svg is not None:
        write(svg, _picture(path, f"optipath show {preset}").encode())
    _print(PlainConsole(), path)


PRESET = click.Argument(["preset"], required=False, metavar="PRESET")
show = click.command("show", cls=StrictCommand, params=[PRESET, CASE, SVG])(_show)


def _picture(path: PathGraph, title: str) -> str:
    # A picture has a width of its own; what is printed has the terminal's.
    text = StringIO()
    _print(PlainConsole(width=100, file=text), path)
    width = max(100, *map(cell_len, text.getvalue().splitlines()))
    recorder = PlainConsole(record=True, width=width, file=StringIO())
    _print(recorder, path)
    return _FROM_THE_NET.sub("", recorder.export_svg(title=printable(title)))


def _print(console: PlainConsole, path: PathGraph) -> None:
    console.print(cell(path.description, style="bold"), end="\n\n")
    if path.parameters or path.choices:
        table = headed("parameter", "default", "range", "what it is", box=None)
        for parameter in path.parameters.values():
            table.add_row(*map(cell, _row(parameter)))
        for name, choice in path.choices.items():
            described = "; ".join(filter(None, [choice.help, ", ".join(choice.behind)]))
            table.add_row(*map(cell, (name, choice.place(path.graph), "", described)))
        console.print(table)
        console.print()
    text = [draw(path)]
    if path.cases:
        text += ["", f"cases: {', '.join(path.cases)}"]
    text += [f"  {name}: {found.note}" for name, found in path.cases.items() if found.note]
    shown = wrapped("\n".join(text), console.width, whole_words=True)
    console.print(cell(shown), soft_wrap=True)


def _row(parameter: Parameter) -> tuple[str, str, str, str]:
    described = "; ".join(filter(None, [parameter.help, ", ".join(parameter.all_words)]))
    default = ("bound to " if parameter.bound else "") + parameter.default_text()
    return parameter.name, default, parameter.range_text(), described
