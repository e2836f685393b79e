"""The photons that ``optipath surface`` is asked to walk, read of its options."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from optipath.cli.surface_values import (
    azimuth_of,
    incidences_of,
    numbers_of,
    wavelengths_of,
)
from optipath.errors import SurfaceError
from optipath.paths.format.faults import Faults
from optipath.surfaces.energies.given_run import given_run

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.surfaces.energies.energy_run import EnergyRun
    from optipath.surfaces.samples.sample import Sample
    from optipath.values.axis_texts import AxisValues


@dataclass(frozen=True)
class GivenWalk:
    """Photons that fall on a sample from one direction, to be walked."""

    incidence: AxisValues
    wavelengths: AxisValues | None
    run: EnergyRun
    wanted: int
    tolerance: float | None

    @property
    def direction(self) -> str:
        """The angle of incidence, as it was given, with its unit."""
        return f"incidence {self.incidence.shown.item():g} {self.incidence.unit}"


def given_walks(
    sample: Sample,
    *,
    incidences: Sequence[str],
    wavelength: str | None,
    azimuth: str,
    stokes: str,
    surfaces: int | None,
    cells: str | None,
    sample_seed: int | None,
    **options: Any,
) -> list[GivenWalk]:
    """Return the walks that options ask for, one for each angle of incidence."""
    faults = Faults()
    angles = faults.attempt("", incidences_of, incidences) or incidences_of(["0"])
    lights = faults.attempt("", wavelengths_of, wavelength)
    light: dict[str, Any] = {
        "azimuth": faults.attempt("", azimuth_of, azimuth) or 0.0,
        "stokes": faults.attempt("", numbers_of, "--stokes", stokes, float, (4,)) or (1, 0, 0, 0),
        "wavelength": None if lights is None else lights.given,
    }
    mesh = faults.attempt("", numbers_of, "--cells", cells, int, (1, 2)) if cells else None
    drawn = {"surfaces": surfaces, "cells": mesh and (*mesh, mesh[0])[:2], "seed": sample_seed}
    changes = {name: value for name, value in drawn.items() if value is not None}
    sample = faults.attempt("the sample", dataclasses.replace, sample, **changes) or sample
    runs = [
        faults.attempt("", partial(given_run, sample, angle.given, **light, **options))
        for angle in angles
    ]
    if faults:
        raise SurfaceError(*dict.fromkeys(faults))
    return [
        GivenWalk(angle, lights, *run, options["tolerance"])
        for angle, run in zip(angles, filter(None, runs), strict=True)
    ]
