"""What users say of how many photons are walked, read and checked."""

from __future__ import annotations

import os
from numbers import Real
from typing import TYPE_CHECKING, Any

from optipath.errors import shown
from optipath.surfaces.energies.energy_run import EnergyRun
from optipath.surfaces.walk.given_beam import given_beam
from optipath.values.whole_numbers import is_whole, whole_number

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample import Sample

_USUAL = 1_000_000
"""How many photons are walked by default."""

_MOST_WITH_TOLERANCE, _MOST = 1_000_000_000, 1_000_000_000_000
"""How many at most where a tolerance is given, and how many anybody may ask for."""

_MOST_THREADS = 1024


def given_run(
    sample: Sample,
    incidence: Any,
    photons: int | None = None,
    *,
    tolerance: float | None = None,
    threads: int | None = None,
    **light: Any,
) -> tuple[EnergyRun, int]:
    """Return the run of photons that a user asks for, of which none is walked yet."""
    faults = _faults("photons", photons, _MOST) + _faults("threads", threads, _MOST_THREADS)
    if tolerance is not None and not _is_error(tolerance):
        faults.append(f"tolerance is {shown(tolerance)}; give a standard error within 0 .. 1")
    beam = given_beam(sample, incidence, **light, beside=faults)
    usual = _USUAL if tolerance is None else _MOST_WITH_TOLERANCE
    run = EnergyRun(beam, processors() if threads is None else int(threads))
    return run, usual if photons is None else int(photons)


def _faults(name: str, number: Any, most: int) -> list[str]:
    if number is None or is_whole(number, 1, most):
        return []
    return whole_number(name, number) or [f"{name} is {shown(number)}; give {most:,} at most"]


def _is_error(tolerance: Any) -> bool:
    is_number = isinstance(tolerance, Real) and not isinstance(tolerance, bool)
    return is_number and 0.0 < float(tolerance) < 1.0


def processors() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
