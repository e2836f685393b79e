"""``optipath presets``: what there is."""

from __future__ import annotations

import json

import click
from rich.table import Table

from optipath.cli.console import PlainConsole, cell
from optipath.paths.presets.loader import load_preset, preset_names


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def presets(*, as_json: bool) -> None:
    """List the presets."""
    descriptions = {name: load_preset(name).description for name in preset_names()}
    if as_json:
        click.echo(json.dumps(descriptions))
        return
    table = Table("preset", "what it is", box=None, header_style="bold")
    for name, description in descriptions.items():
        table.add_row(cell(name), cell(description))
    PlainConsole().print(table)
