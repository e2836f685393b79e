"""``optipath presets``: what there is."""

from __future__ import annotations

import click

from optipath.cli.console import JSON, PlainConsole, cell, headed, say_json
from optipath.cli.options import StrictCommand
from optipath.paths.files.presets import preset_descriptions


@click.command(cls=StrictCommand, params=[JSON])
def presets(*, as_json: bool) -> None:
    """List the presets."""
    descriptions = preset_descriptions()
    if as_json:
        say_json(descriptions)
        return
    table = headed("preset", "what it is", box=None)
    for name, description in descriptions.items():
        table.add_row(cell(name), cell(description))
    PlainConsole().print(table)
