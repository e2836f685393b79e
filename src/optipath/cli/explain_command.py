"""``optipath explain``: what the composer makes of a preset."""

from __future__ import annotations

import json
from typing import Any

import click

from optipath.cli.console import say
from optipath.cli.preset_command import PresetGroup
from optipath.composer import Composer
from optipath.paths.presets.loader import load_preset


def _explain(
    preset: str,
    case: str | None,
    values: dict[str, Any],
    *,
    reads: str | None,
    as_json: bool,
    **options: Any,
) -> None:
    path = load_preset(preset, case=case, **values)
    path = path if reads is None else path.reading(reads)
    found = Composer(**options).compose(path).explanation()
    if as_json:
        click.echo(json.dumps({"preset": preset, **found.as_dict()}, allow_nan=False))
    else:
        say(str(found))


explain = PresetGroup("explain", action=_explain, help="Explain the plan of a preset.")
