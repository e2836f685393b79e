"""``optipath explain``: what the composer makes of a preset."""

from __future__ import annotations

import json
from typing import Any

import click

from optipath.cli.preset_command import PresetGroup
from optipath.composer import Composer
from optipath.presets import load_preset


def _explain(
    preset: str, case: str | None, values: dict[str, Any], *, method: str, as_json: bool
) -> None:
    text = Composer(method=method).compose(load_preset(preset, case=case, **values)).explain()
    click.echo(json.dumps({"preset": preset, "plan": text.splitlines()}) if as_json else text)


explain = PresetGroup("explain", action=_explain, help="Explain the plan of a preset.")
