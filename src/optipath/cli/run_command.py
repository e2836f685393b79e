"""``optipath run`` and ``optipath explain``: the light at the detectors, and how it is computed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.cli.arguments import array_faults
from optipath.cli.console import DIGITS, say_json, say_wrapped
from optipath.cli.outcome import outcome_as_json, outcome_of, print_cases, print_outcome
from optipath.cli.preset_command import COMPOSING, PresetGroup
from optipath.composer.composer import Composer
from optipath.errors import ParameterError
from optipath.sweeps.grid import SweepGrid, sweep_axis

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.cli.outcome import Outcome
    from optipath.cli.preset_command import Cases, Chosen


def _run(cases: Cases, *, reads: str | None, as_json: bool, digits: int, **options: Any) -> None:
    """Trace the light of a preset, or of a TOML file."""
    outcomes = cases.each(lambda one: _outcome(one, reads, options))
    if as_json:
        cases.say_json(outcomes, outcome_as_json)
    elif cases.together:
        print_cases(outcomes, digits)
    else:
        print_outcome(next(iter(outcomes.values())), digits)


def _outcome(chosen: Chosen, reads: str | None, options: Mapping[str, Any]) -> Outcome:
    path = chosen.path(reads)
    plan = path.plan_by(Composer(**options))
    if chosen.axes and (faults := array_faults(plan.inputs, chosen.axes)):
        raise ParameterError(*faults)
    axes = [sweep_axis(path.parameters, name, values) for name, values in chosen.axes.items()]
    return outcome_of(chosen, path, plan, SweepGrid(tuple(axes)))


run = PresetGroup("run", _run, (*COMPOSING, DIGITS), several=True, ranges=True)


def _explain(chosen: Chosen, *, reads: str | None, as_json: bool, **options: Any) -> None:
    """Explain the plan of a preset."""
    result = chosen.path(reads).plan_by(Composer(**options)).explanation()
    if as_json:
        say_json({"preset": chosen.preset, **result.as_dict()})
    else:
        say_wrapped(str(result))


explain = PresetGroup("explain", _explain)
