"""``optipath explain``: what the composer makes of a preset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.cli.console import say_json, say_wrapped
from optipath.cli.preset_command import PresetGroup
from optipath.composer.composer import Composer

if TYPE_CHECKING:
    from optipath.cli.chosen import Chosen


def _explain(chosen: Chosen, *, reads: str | None, as_json: bool, **options: Any) -> None:
    """Explain the plan of a preset."""
    result = chosen.path(reads).plan_by(Composer(**options)).explanation()
    if as_json:
        say_json({"preset": chosen.preset, **result.as_dict()})
    else:
        say_wrapped(str(result))


explain = PresetGroup("explain", _explain)
