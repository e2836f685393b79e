"""``optipath run``: the light at the detectors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from optipath.cli.console import PlainConsole, cell, headed, say_json
from optipath.cli.plain_json import plain
from optipath.cli.preset_command import PresetGroup
from optipath.composer.composer import Composer
from optipath.paths.format.writer import complex_parts_of
from optipath.values.cases import Case
from optipath.values.domains.quantities import AMPLITUDE

if TYPE_CHECKING:
    from optipath.cli.preset_command import Chosen
    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan


_ROWS = 20

# What is told of light besides its Stokes vector, and in which unit.
_TOLD = {
    "dop": ("DoP", ""),
    "dolp": ("DoLP", ""),
    "aop": ("AoP", "deg"),
    "ellipticity": ("ellipticity", ""),
    "psi": ("psi", "deg"),
    "delta": ("delta", "deg"),
}


@dataclass(frozen=True)
class Outcome:
    """What a run was given, and what it has found.

    Attributes
    ----------
    chosen : Chosen
        The preset, and what is given for it.
    path : PathGraph
        What was run.
    plan : Plan
        By which it was run.
    lights : dict of str to Light
        The light at every end.
    """

    chosen: Chosen
    path: PathGraph
    plan: Plan
    lights: dict[str, Light]

    @cached_property
    def case(self) -> Case:
        """The case, or an empty one."""
        name = self.chosen.case
        return Case({}) if name is None else self.path.cases[name]

    @property
    def engine(self) -> str:
        """What runs so many paths: plain floats where there is one."""
        batch = np.broadcast_shapes(*(light.intensity.shape for light in self.lights.values()))
        return self.plan.engine_for(math.prod(batch))

    @property
    def model(self) -> str:
        """The model that was run; both, where some paths took the exact one."""
        instead, exact = self.plan.instead, self.plan.reduction.model
        if instead is None:
            return exact
        within = self.errors <= instead.most
        if not within.any():
            return exact
        return instead.model if within.all() else f"{instead.model}, {exact}"

    @cached_property
    def errors(self) -> Any:
        """The largest errors that the certificates leave, where some are allowed."""
        approximation = self.plan.answers.approximation
        assert approximation is not None  # noqa: S101 - asked for by who knows
        return approximation.errors_for({})

    def published(self, detector: str) -> tuple[float, ...] | None:
        """Return the published Stokes vector, if these are the values it belongs to."""
        return None if self.chosen.values else self.case.published.get(detector)


def _run(chosen: Chosen, *, reads: str | None, as_json: bool, **options: Any) -> None:
    """Trace the light of a preset, or of a TOML file."""
    path = chosen.path(reads)
    plan = Composer(**options).compose(path)
    outcome = Outcome(chosen, path, plan, plan.run_all())
    if as_json:
        say_json(_as_json(outcome))
    else:
        _print(outcome)


run = PresetGroup("run", _run)


def _as_json(outcome: Outcome) -> dict[str, Any]:
    plan, parameters = outcome.plan, outcome.path.parameters
    parts = complex_parts_of(outcome.path.graph)
    found: dict[str, Any] = {
        "preset": outcome.chosen.preset,
        "parameters": {
            name: plain(p.default, p.unit, parts.get(name, AMPLITUDE.complex_parts))
            for name, p in parameters.items()
        },
        "units": {name: p.unit for name, p in parameters.items() if p.unit},
        "model": outcome.model,
        "method": plan.method,
        "engine": outcome.engine,
    }
    if (instead := plan.instead) is not None:
        allowed = {"most": instead.most, "model": instead.model, "exact": plan.reduction.model}
        found["tolerance"] = {**allowed, "error": plain(outcome.errors)}
    if outcome.chosen.case:
        found["case"] = outcome.chosen.case
    if outcome.case.note:
        found["note"] = outcome.case.note
    found["detectors"] = {name: _reading(outcome, name) for name in plan.program.detectors}
    dumps = {name: _reading(outcome, name) for name in plan.program.dumps}
    return found | ({"dumps": dumps} if dumps else {})


def _reading(outcome: Outcome, name: str) -> dict[str, Any]:
    published, light = outcome.published(name), outcome.lights[name]
    told = {word: plain(getattr(light, word), unit) for word, (_, unit) in _TOLD.items()}
    found = {"stokes": plain(light.stokes), "polarization": told}
    if np.any(light.exponent):
        # Too faint for the numbers above: they are 0, and these are not.
        found["log10_intensity"] = plain(light.log10_intensity)
        found["normalized"] = plain(light.normalized)
    return found | ({"published": list(published)} if published else {})


def _print(outcome: Outcome) -> None:
    console = PlainConsole()
    console.print(cell(outcome.chosen.title, style="bold"), cell(outcome.path.description))
    table = Table(box=None, show_header=False)
    for name, parameter in outcome.path.parameters.items():
        table.add_row(*map(cell, (name, parameter.text(parameter.default), parameter.help)))
    console.print(table)
    for name in outcome.lights:
        console.print(_light_table(outcome, name))
    if outcome.case.note:
        console.print(cell(f"note: {outcome.case.note}"))
    ran = f"method {outcome.plan.method}, model {outcome.model}, engine {outcome.engine}"
    console.print(cell(ran))


def _light_table(outcome: Outcome, name: str) -> Table:
    stokes, published = outcome.lights[name].stokes, outcome.published(name)
    if stokes.ndim > 1:
        return _batch_table(name, stokes)
    table = headed(f"light at {name}", "computed")
    if published:
        table.add_column("published")
    for position, component in enumerate(stokes.tolist()):
        row = [f"S{position}", _shown(component)]
        table.add_row(*map(cell, [*row, *([f"{published[position]:g}"] if published else [])]))
    light = outcome.lights[name]
    for key, (word, unit) in _TOLD.items():
        number = plain(getattr(light, key), unit)
        if number is not None:
            table.add_row(word, f"{_shown(number)} {unit}".strip())
    if light.exponent:
        table.add_row("log10 S0", f"{light.log10_intensity:.12g}")
        table.add_row("over S0", ", ".join(_shown(part) for part in light.normalized.tolist()))
    return table


def _batch_table(name: str, stokes: np.ndarray[Any, Any]) -> Table:
    table = headed(f"light at {name}", "S0", "S1", "S2", "S3")
    indices = list(np.ndindex(stokes.shape[:-1]))
    for index in indices[:_ROWS]:
        table.add_row(cell(str(list(index))), *(cell(_shown(c)) for c in stokes[index].tolist()))
    if len(indices) > _ROWS:
        table.add_row(f"{len(indices) - _ROWS} more")
    return table


def _shown(component: float) -> str:
    return "not read" if math.isnan(component) else f"{component + 0.0:.12g}"
