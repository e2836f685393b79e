"""``optipath run``: the light at the detectors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.cli.arguments import grid_of_axes, refuse_arrays
from optipath.cli.chosen import of_each
from optipath.cli.console import DIGITS, say_json
from optipath.cli.outcome import outcome_as_json, outcome_of, print_cases, print_outcome
from optipath.cli.preset_command import COMPOSING, PresetGroup
from optipath.composer.composer import Composer

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.cli.chosen import Chosen
    from optipath.cli.outcome import Outcome


def _run(chosen: Chosen, *, reads: str | None, as_json: bool, digits: int, **options: Any) -> None:
    """Trace the light of a preset, or of a TOML file."""
    outcome = _outcome(chosen, reads, options)
    if as_json:
        say_json(outcome_as_json(outcome))
    else:
        print_outcome(outcome, digits)


def _run_several(
    several: Sequence[Chosen], *, reads: str | None, as_json: bool, digits: int, **options: Any
) -> None:
    outcomes = of_each(several, lambda one: _outcome(one, reads, options))
    if as_json:
        results = {case: outcome_as_json(outcome) for case, outcome in outcomes.items()}
        say_json({"preset": several[0].preset, "cases": results})
    else:
        print_cases(outcomes, digits)


def _outcome(chosen: Chosen, reads: str | None, options: Mapping[str, Any]) -> Outcome:
    path = chosen.path(reads)
    refuse_arrays(path, chosen.axes)
    plan = path.plan_by(Composer(**options))
    return outcome_of(chosen, path, plan, grid_of_axes(path, chosen.axes))


run = PresetGroup("run", _run, (*COMPOSING, DIGITS), several=_run_several, ranges=True)
