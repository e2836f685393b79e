"""What a walk of photons was given and has found, and the same as JSON."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.surfaces.energies.energy import walk_wanted
from optipath.values.plain_json import plain

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.cli.given_walk import GivenWalk
    from optipath.surfaces.energies.energy_table import Energy


@dataclass(frozen=True)
class EnergyOutcome:
    """What photons have told that fell on a sample from one direction."""

    given: GivenWalk
    energy: Energy
    seconds: float
    interrupted: bool


def walked(given: GivenWalk, progress: Callable[[int, int], None]) -> EnergyOutcome:
    """Return what photons tell; where Ctrl-C comes, what those tell that have been walked."""
    begin, interrupted = perf_counter(), False
    try:
        walk_wanted(given.run, given.wanted, given.tolerance, progress)
    except KeyboardInterrupt:
        if not given.run.photons:
            raise
        interrupted = True
    return EnergyOutcome(given, given.run.energy, perf_counter() - begin, interrupted)


def energy_as_json(outcome: EnergyOutcome) -> dict[str, Any]:
    """Return an outcome as JSON can hold it, with all digits."""
    given, beam = outcome.given, outcome.given.run.beam
    units = {"incidence": given.incidence.unit, "azimuth": "deg"}
    found: dict[str, Any] = {
        "incidence": plain(given.incidence.shown),
        "azimuth": plain(beam.azimuth, "deg"),
        "stokes": [*beam.states[0]],
    }
    if given.wavelengths is not None:
        found["wavelength"] = plain(given.wavelengths.shown)
        units["wavelength"] = given.wavelengths.unit
    found |= {"units": units, "seed": beam.seed}
    if given.tolerance is not None:
        found["tolerance"] = given.tolerance
    found |= {"interrupted": outcome.interrupted, "seconds": outcome.seconds}
    return {**found, **_plain(asdict(outcome.energy))}


def _plain(found: dict[str, Any]) -> dict[str, Any]:
    """Return numbers and arrays as JSON can hold them; counts stay whole."""
    return {
        name: _plain(value)
        if isinstance(value, dict)
        else value
        if isinstance(value, int)
        else plain(np.asarray(value))
        for name, value in found.items()
    }
