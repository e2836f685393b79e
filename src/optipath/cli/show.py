"""``optipath show``: what a preset is made of."""

from __future__ import annotations

from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from optipath.drawing import draw
from optipath.presets import load_preset

if TYPE_CHECKING:
    from optipath.parameters import Parameter
    from optipath.path_graph import PathGraph


@click.command()
@click.argument("preset")
@click.option("--case", metavar="NAME", help="Named set of values.")
@click.option("--svg", type=click.Path(dir_okay=False), help="Draw into this file as well.")
def show(preset: str, case: str | None, svg: str | None) -> None:
    """Show the parameters, elements and links of a preset, or of a TOML file."""
    path = load_preset(preset, case=case)
    if svg:
        # A picture has a width of its own; what is printed has the terminal's.
        recorder = Console(record=True, width=100, file=StringIO(), highlight=False)
        _print(recorder, path)
        try:
            Path(svg).write_text(recorder.export_svg(title=f"optipath show {preset}"), "utf-8")
        except OSError as error:
            raise click.ClickException(f"'{svg}' cannot be written: {error.strerror}") from None
    _print(Console(highlight=False), path)


def _print(console: Console, path: PathGraph) -> None:
    console.print(Text(path.description, style="bold"), end="\n\n")
    if path.parameters:
        table = Table("parameter", "default", "range", "what it is", box=None, header_style="bold")
        for parameter in path.parameters.values():
            table.add_row(*map(Text, _row(parameter)))
        console.print(table)
        console.print()
    console.print(Text(draw(path)), soft_wrap=True)
    if path.cases:
        console.print(Text(f"\ncases: {', '.join(path.cases)}"))
    for name, found in path.cases.items():
        if found.note:
            console.print(Text(f"  {name}: {found.note}"))


def _row(parameter: Parameter) -> tuple[str, str, str, str]:
    described = [parameter.help, ", ".join(parameter.all_words)]
    state = "bound to " if parameter.bound else ""
    return (
        parameter.name,
        state + parameter.default_text(),
        parameter.range_text(),
        "; ".join(part for part in described if part),
    )
