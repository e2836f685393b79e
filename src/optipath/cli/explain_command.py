"""``optipath explain``: what the composer makes of a preset."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

from optipath.cli.console import say
from optipath.cli.preset_command import PresetGroup
from optipath.composer.composer import Composer

if TYPE_CHECKING:
    from optipath.cli.preset_command import Chosen


def _explain(chosen: Chosen, *, reads: str | None, as_json: bool, **options: Any) -> None:
    """Explain the plan of a preset."""
    found = Composer(**options).compose(chosen.path(reads)).explanation()
    if as_json:
        click.echo(json.dumps({"preset": chosen.preset, **found.as_dict()}, allow_nan=False))
    else:
        say(str(found))


explain = PresetGroup("explain", _explain)
