"""What a run was given and has found, and the same as JSON."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.paths.format.writer import complex_parts_of
from optipath.sweeps.axes.sweep_grid import SweepGrid
from optipath.sweeps.whole.free_memory import refuse_more_than_free
from optipath.values.cases import Case
from optipath.values.domains.quantities import AMPLITUDE
from optipath.values.named_materials import WAVELENGTH, material_as_json, materials_among
from optipath.values.plain_json import plain

if TYPE_CHECKING:
    from optipath.cli.chosen import Chosen
    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.values.parameters import Parameter

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
    """What a run was given, and what it has found."""

    chosen: Chosen
    path: PathGraph
    plan: Plan
    lights: dict[str, Light]
    engine: str
    grid: SweepGrid = field(default_factory=lambda: SweepGrid(()))

    @property
    def single(self) -> dict[str, Parameter]:
        """The parameters that have one value, by name."""
        varied = {axis.name for axis in self.grid.axes}
        known = self.path.parameters
        return {name: parameter for name, parameter in known.items() if name not in varied}

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
        found = approximation.errors_for(self.grid.given())
        is_idle = self.grid.varied is not self.grid
        return np.broadcast_to(found, self.grid.shape) if is_idle else found

    @property
    def materials(self) -> dict[str, Any]:
        """The materials that were given, with n and k at each wavelength; {} without any."""
        if not (given := list(materials_among(self.chosen.values))):
            return {}
        known = self.path.parameters
        wavelength = known[WAVELENGTH.name].default if WAVELENGTH.name in known else None
        along = [axis.given for axis in self.grid.axes if axis.name == WAVELENGTH.name]
        wavelength = along[0] if along else wavelength
        found = {name: material_as_json(label, one, wavelength) for name, label, one in given}
        return {"materials": found}

    @property
    def note(self) -> str:
        """The note of the case, if these are the values it belongs to."""
        return "" if self._is_changed else self.case.note

    def published(self, detector: str) -> tuple[float, ...] | None:
        """Return the published Stokes vector, if these are the values it belongs to."""
        return None if self._is_changed else self.case.published.get(detector)

    @property
    def _is_changed(self) -> bool:
        return bool(self.chosen.values or self.grid.axes)


def outcome_of(chosen: Chosen, path: PathGraph, plan: Plan, grid: SweepGrid) -> Outcome:
    """Run a plan for all that was chosen."""
    if grid.axes:
        refuse_more_than_free(plan, grid)
    found = plan.run_all(**grid.given())
    lights = {name: _laid_out(light, grid) for name, light in found.items()}
    return Outcome(chosen, path, plan, lights, " and ".join(plan.answers.ran_by), grid)


def _laid_out(light: Light, grid: SweepGrid) -> Light:
    """Return the light of a run, repeated along dimensions on which nothing depends."""
    if (ran := grid.varied) is grid:
        return light
    each = zip(grid.shape, ran.shape, strict=True)
    return light.reshape(ran.shape)[np.ix_(*[np.arange(size) % own for size, own in each])]


def outcome_as_json(outcome: Outcome) -> dict[str, Any]:
    """Return what a run has found as JSON can hold it, with all digits."""
    plan, parameters = outcome.plan, outcome.single
    parts = complex_parts_of(outcome.path.graph)
    found: dict[str, Any] = {
        "preset": outcome.chosen.preset,
        "parameters": {
            name: plain(p.default, p.unit, parts.get(name, AMPLITUDE.complex_parts))
            for name, p in parameters.items()
        },
        **outcome.materials,
        **({"choices": outcome.chosen.places} if outcome.chosen.places else {}),
        **_axes_as_json(outcome.grid),
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


def _axes_as_json(grid: SweepGrid) -> dict[str, Any]:
    """Return the axes as they were given; those along one dimension vary together."""
    axes = {
        axis.name: {
            **({"dimension": axis.dimension} if axis.dimension != axis.name else {}),
            "unit": axis.unit,
            "values": axis.shown.tolist(),
        }
        for axis in grid.axes
    }
    return {"axes": axes} if axes else {}


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
