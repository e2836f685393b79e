"""``optipath presets``: what there is."""

from __future__ import annotations

import click

from optipath.cli.console import JSON, say_descriptions
from optipath.cli.options import StrictCommand
from optipath.paths.files.presets import preset_descriptions


@click.command(cls=StrictCommand, params=[JSON])
def presets(*, as_json: bool) -> None:
    """List the presets."""
    say_descriptions("preset", preset_descriptions(), as_json=as_json)
