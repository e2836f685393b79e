"""What users say of photons: directions, wavelengths and seeds, read and checked."""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError, shown
from optipath.paths.format.faults import Faults
from optipath.surfaces.samples.sample import Sample
from optipath.surfaces.walk.photon_beam import PhotonBeam
from optipath.values.domains.quantities import ANGLE, INCIDENCE
from optipath.values.domains.states import StokesDomain
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from optipath.values.domains.domain import Domain

UNPOLARISED = (1.0, 0.0, 0.0, 0.0)
_STOKES = StokesDomain("Stokes vector", tail=(4,))
_LEAST_COSINE = 1e-12
"""That of an angle that is 90 deg but for roundings."""


def given_beam(
    sample: Sample,
    incidence: Any,
    azimuth: Any = 0.0,
    *,
    wavelength: str | npt.ArrayLike | None = None,
    stokes: npt.ArrayLike = UNPOLARISED,
    seed: int = 0,
    most_events: int = 1000,
    beside: Sequence[str] = (),
) -> PhotonBeam:
    """Return the photons that a user asks for."""
    if not isinstance(sample, Sample):
        raise SurfaceError(
            *beside,
            f"sample is {shown(sample)}; give an op.Sample, such as op.Sample([(1.5, 0.1)]), or "
            f"op.load_sample(name)",
        )
    faults = Faults(beside)
    incidence = faults.attempt("", _one, "incidence", incidence, INCIDENCE)
    azimuth = faults.attempt("", _one, "azimuth", azimuth, ANGLE)
    if incidence is not None and cos(incidence) < _LEAST_COSINE:
        faults.append("incidence is 90 deg, along the sample, where no light gets to it; give less")
    faults += whole_number("seed", seed, 0) + whole_number("most_events", most_events)
    light = faults.attempt("", given_state, "stokes", stokes)
    indices = faults.attempt("", sample.indices, wavelength)
    if faults or indices is None or light is None:
        raise SurfaceError(*faults)
    return PhotonBeam(
        sample,
        cos(incidence),
        sin(incidence),
        azimuth,
        indices,
        (light,),
        int(seed),
        int(most_events),
    )


def given_state(name: str, stokes: npt.ArrayLike) -> tuple[float, float, float, float]:
    """Return the state of polarisation of the light that falls on a sample.

    Shape: stokes (4,).

    Examples
    --------
    >>> given_state("source", [2, 1, 0, 0])
    (2.0, 1.0, 0.0, 0.0)
    """
    faults = Faults()
    state: Any = faults.attempt("", _one, name, stokes, _STOKES.unphysical)
    if state is None:
        raise SurfaceError(*faults)
    if not state[0] > 0.0:
        raise SurfaceError(f"{name} has no intensity; give S0 > 0")
    if not _STOKES.allows(np.array(state)):
        raise SurfaceError(
            f"{name} is {[*state]}, polarised by more than 100 %; give S1^2 + S2^2 + S3^2 <= S0^2"
        )
    return state  # type: ignore[no-any-return]


def _one(name: str, value: Any, domain: Domain) -> Any:
    """Return one number of a domain, or one vector, as Python has it."""
    found = np.asarray(domain.check(name, value))
    if found.shape != domain.tail:
        raise SurfaceError(
            f"{name} has the shape {found.shape}; photons come one way at a time, so give one "
            f"{domain.name}"
        )
    return tuple(found.tolist()) if domain.tail else float(found)
