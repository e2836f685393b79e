"""``optipath run`` and ``optipath explain``: the light at the detectors, and how it is computed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.cli.arguments import array_faults
from optipath.cli.console import DIGITS, say_json, say_wrapped
from optipath.cli.outcome import outcome_as_json, outcome_of, print_cases, print_outcome
from optipath.cli.preset_command import COMPOSING, PresetGroup, of_each
from optipath.composer.composer import Composer
from optipath.errors import ParameterError
from optipath.sweeps.grid import SweepGrid, sweep_axis

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.cli.outcome import Outcome
    from optipath.cli.preset_command import Chosen


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
    plan = path.plan_by(Composer(**options))
    if chosen.axes and (faults := array_faults(plan.inputs, chosen.axes)):
        raise ParameterError(*faults)
    axes = [sweep_axis(path.parameters, name, values) for name, values in chosen.axes.items()]
    return outcome_of(chosen, path, plan, SweepGrid(tuple(axes)))


run = PresetGroup("run", _run, (*COMPOSING, DIGITS), several=_run_several, ranges=True)


def _explain(chosen: Chosen, *, reads: str | None, as_json: bool, **options: Any) -> None:
    """Explain the plan of a preset."""
    result = chosen.path(reads).plan_by(Composer(**options)).explanation()
    if as_json:
        say_json({"preset": chosen.preset, **result.as_dict()})
    else:
        say_wrapped(str(result))


explain = PresetGroup("explain", _explain)
