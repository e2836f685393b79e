"""What a run was given and has found, and the same as JSON."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.given_light import WAVELENGTH, material_as_json, materials_among
from optipath.cli.plain_json import plain
from optipath.paths.format.writer import complex_parts_of
from optipath.values.cases import Case
from optipath.values.domains.quantities import AMPLITUDE

if TYPE_CHECKING:
    from optipath.cli.chosen import Chosen
    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan

# What is told of light besides its Stokes vector, and in which unit.
TOLD = {
    "dop": ("DoP", ""),
    "dolp": ("DoLP", ""),
    "aop": ("AoP", "deg"),
    "ellipticity": ("ellipticity", ""),
    "ellipticity_angle": ("ellipticity angle", "deg"),
    "Psi": ("Psi (ellipsometry)", "deg"),
    "Delta": ("Delta (ellipsometry)", "deg"),
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
    engine : str
        What has run it.
    """

    chosen: Chosen
    path: PathGraph
    plan: Plan
    lights: dict[str, Light]
    engine: str

    @cached_property
    def case(self) -> Case:
        """The case, or an empty one."""
        name = self.chosen.case
        return Case({}) if name is None else self.path.cases[name]

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

    @property
    def materials(self) -> dict[str, Any]:
        """The materials that were given, with their n and k at the wavelength; {} without any."""
        if not (given := list(materials_among(self.chosen.values))):
            return {}
        known = self.path.parameters
        wavelength = known[WAVELENGTH.name].default if WAVELENGTH.name in known else None
        found = {name: material_as_json(label, one, wavelength) for name, label, one in given}
        return {"materials": found}

    @property
    def note(self) -> str:
        """The note of the case, if these are the values it belongs to."""
        return "" if self.chosen.values else self.case.note

    def published(self, detector: str) -> tuple[float, ...] | None:
        """Return the published Stokes vector, if these are the values it belongs to."""
        return None if self.chosen.values else self.case.published.get(detector)


def outcome_as_json(outcome: Outcome) -> dict[str, Any]:
    """Return what a run has found as JSON can hold it, with all digits."""
    plan, parameters = outcome.plan, outcome.path.parameters
    parts = complex_parts_of(outcome.path.graph)
    found: dict[str, Any] = {
        "preset": outcome.chosen.preset,
        "parameters": {
            name: plain(p.default, p.unit, parts.get(name, AMPLITUDE.complex_parts))
            for name, p in parameters.items()
        },
        **outcome.materials,
        **({"choices": outcome.chosen.places} if outcome.chosen.places else {}),
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
    if outcome.note:
        found["note"] = outcome.note
    found["detectors"] = {name: _reading(outcome, name) for name in plan.program.detectors}
    dumps = {name: _reading(outcome, name) for name in plan.program.dumps}
    return found | ({"dumps": dumps} if dumps else {})


def _reading(outcome: Outcome, name: str) -> dict[str, Any]:
    published, light = outcome.published(name), outcome.lights[name]
    told: dict[str, Any] = {
        key: plain(getattr(light, key.lower()), unit) for key, (_, unit) in TOLD.items()
    }
    told["units"] = {key: unit for key, (_, unit) in TOLD.items() if unit}
    found = {"stokes": plain(light.stokes), "polarization": told}
    if np.any(light.exponent):
        # Too faint for the numbers above: they are 0, and these are not.
        found["log10_intensity"] = plain(light.log10_intensity)
        found["normalized"] = plain(light.normalized)
    return found | ({"published": list(published)} if published else {})
