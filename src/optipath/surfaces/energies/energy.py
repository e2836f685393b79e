"""What share of light a sample sends back and lets through, by photons that walk over it."""

from __future__ import annotations

import warnings
from math import ceil
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import PhotonWarning
from optipath.surfaces.energies.checked_energy import checked_energy
from optipath.surfaces.energies.given_run import given_run
from optipath.surfaces.walk.given_beam import UNPOLARISED
from optipath.surfaces.walk.photon_beam import BLOCK
from optipath.values.calls_up import calls_up
from optipath.values.cures import cure

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.surfaces.energies.energy_run import EnergyRun
    from optipath.surfaces.energies.energy_table import Energy
    from optipath.surfaces.samples.sample import Sample

_AIM = 1.1
"""How many times as many photons are walked as the error so far asks for."""

_MOST_GROWN = 8
"""How many times as many as so far are walked at once, since errors are estimates."""


def energy(
    sample: Sample,
    incidence: Any,
    photons: int | None = None,
    *,
    azimuth: Any = 0.0,
    wavelength: str | npt.ArrayLike | None = None,
    stokes: npt.ArrayLike = UNPOLARISED,
    seed: int = 0,
    tolerance: float | None = None,
    most_events: int = 1000,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Energy:
    """Return what share of light a sample sends back and lets through.

    Parameters
    ----------
    sample : Sample
        What the light falls on.
    incidence : float or str
        The angle of incidence in radians, 0 up to pi/2, or a text such as ``"60 deg"``.
    photons : int, optional
        How many photons are walked; a million by default. With a tolerance, how many at most.
    azimuth : float or str, optional
        Towards which side the light goes, from x towards y of the sample. On an isotropic sample
        it makes no difference.
    wavelength : float, str or array_like, optional
        In metres, or ``"550 nm"``, where an index depends on it. Several ride on the same photons
        where the base alone depends on them, and is opaque.
    stokes : array_like, optional
        The Stokes vector of the light, the x of its frame horizontal; unpolarised by default.
    seed : int, optional
        The same seed gives the same bits, with any number of threads.
    tolerance : float, optional
        Photons are walked until the standard error of R is no larger, at all wavelengths.
    most_events : int, optional
        After how many events a photon is given up, and counted as lost.
    threads : int, optional
        How many walk at a time; as many as there are processors by default.
    progress : callable, optional
        Told how many photons there are, and of how many.

    Returns
    -------
    Energy

    Raises
    ------
    SurfaceError
        With all faults at once.

    Warns
    -----
    PhotonWarning
        If the tolerance is not reached, or so few photons carry so much of the light that the
        errors are not to be trusted.

    Examples
    --------
    A rough dielectric reflects less than half a percent of the light after several events, and
    what it does not reflect goes through:

    >>> from optipath.surfaces.samples.sample import Sample
    >>> found = energy(Sample([(1.5, 0.5)]), "40 deg", photons=16_384)
    >>> bool(0.001 < found.R_m < 0.005), bool(abs(found.scalar.R + found.scalar.T - 1.0) < 1e-12)
    (True, True)
    """
    run, most = given_run(
        sample,
        incidence,
        photons,
        tolerance=tolerance,
        threads=threads,
        azimuth=azimuth,
        wavelength=wavelength,
        stokes=stokes,
        seed=seed,
        most_events=most_events,
    )
    return walk_wanted(run, most, tolerance, progress)


def walk_wanted(
    run: EnergyRun,
    most: int,
    tolerance: float | None,
    progress: Callable[[int, int], None] | None = None,
) -> Energy:
    """Walk as many photons as are wanted."""
    if tolerance is not None:
        return walk_until(run, tolerance, most, progress)
    run.walk(most, progress)
    return checked_energy(run)


def walk_until(
    run: EnergyRun, tolerance: float, most: int, progress: Callable[[int, int], None] | None
) -> Energy:
    """Walk photons until the standard error of R is within a tolerance."""
    # A block on every surface, so that their differences are known.
    wanted = min(2 * BLOCK * run.beam.surfaces, most)
    while True:
        run.walk(wanted, progress)
        found = checked_energy(run)
        error = float(np.max(found.R_se))
        if error <= tolerance:
            return found
        if run.photons >= most:
            warnings.warn(
                f"the standard error of R is {error:.2g} after {run.photons} photons, more than "
                f"the tolerance of {tolerance:g}; allow more {cure('photons', '--photons')}",
                PhotonWarning,
                calls_up(),
            )
            return found
        factor = min(_AIM * (error / tolerance) ** 2, _MOST_GROWN)
        wanted = min(BLOCK * ceil(factor * run.photons / BLOCK), most)
