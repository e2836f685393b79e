"""``optipath presets``: what there is."""

from __future__ import annotations

import click

from optipath.cli.console import PlainConsole, cell, headed, say_json
from optipath.cli.preset_command import JSON
from optipath.paths.presets.loader import load_preset, preset_names


@click.command(params=[JSON])
def presets(*, as_json: bool) -> None:
    """List the presets."""
    descriptions = {name: load_preset(name).description for name in preset_names()}
    if as_json:
        say_json(descriptions)
        return
    table = headed("preset", "what it is", box=None)
    for name, description in descriptions.items():
        table.add_row(cell(name), cell(description))
    PlainConsole().print(table)
