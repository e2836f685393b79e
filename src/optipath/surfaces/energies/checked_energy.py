"""Whether the light of a sample that absorbs nothing is all there."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from optipath.errors import PhotonWarning
from optipath.values.calls_up import calls_up

if TYPE_CHECKING:
    from optipath.surfaces.energies.energy_run import EnergyRun
    from optipath.surfaces.energies.energy_table import Energy

_ERRORS, _ROUNDINGS = 6.0, 1e-9
"""By how many standard errors light may be missing, and by how much in any case."""


def checked_energy(run: EnergyRun) -> Energy:
    """Return what is known of a run; warn where light has come to nothing, or out of nothing.

    Light that is trapped goes through many events, and at each its weight is changed by how it is
    polarised. The few photons that then carry most of it are seldom met: until they are, light is
    missing, and no standard error knows of it.
    """
    found = run.energy
    if run.beam.indices.opaque:
        return found
    missing, error = float(found.absorbed), float(found.absorbed_se)
    if abs(missing) > _ERRORS * error + _ROUNDINGS:
        warnings.warn(
            f"R + T + lost is {1.0 - missing:.4f} where nothing absorbs, off by "
            f"{abs(missing) / error:.0f} standard errors: light that is trapped is carried by few "
            f"photons, which these have not met often enough; trust the shares without "
            f"polarisation",
            PhotonWarning,
            calls_up(),
        )
    return found
