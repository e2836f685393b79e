"""Energy: the shares of light that a sample reflects, transmits and absorbs."""

from __future__ import annotations

import os
from contextlib import closing
from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import PhotonWarning
from optipath.faults import shown
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.beam import (
    BLOCK,
    MOST_PHOTONS,
    MOST_THREADS,
    UNPOLARISED,
    beam_of,
    walked_in_order,
)
from optipath.values.angles import warn
from optipath.values.precision import Numbers, real_number, whole_number

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.surfaces.sample import Sample
    from optipath.surfaces.walk.beam import PhotonBeam


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

    Warns
    -----
    PhotonWarning
        If the tolerance is not reached, or so few photons carry so much of the light that the
        errors are not to be trusted.

    Examples
    --------
    A rough dielectric reflects less than half a percent of the light after several events, and
    what it does not reflect goes through:

    >>> from optipath.surfaces.sample import Sample
    >>> found = energy(Sample([(1.5, 0.5)]), "40 deg", photons=16_384)
    >>> bool(0.001 < found.R_m < 0.005), bool(abs(found.scalar.R + found.scalar.T - 1.0) < 1e-12)
    (True, True)
    """
    options: dict[str, Any] = {"azimuth": azimuth, "wavelength": wavelength, "stokes": stokes}
    options |= {"seed": seed, "most_events": most_events}
    options |= {"tolerance": tolerance, "threads": threads}
    run, most = run_arguments(sample, incidence, photons, **options)
    return walk_wanted(run, most, tolerance, progress)


def walk_wanted(
    run: EnergyRun,
    most: int,
    tolerance: float | None,
    progress: Callable[[int, int], None] | None = None,
) -> Energy:
    """Walk photons until there are as many, or the standard error of R is within a tolerance."""
    # A block on every surface at first, so that their differences are known.
    wanted = most if tolerance is None else min(2 * BLOCK * run.beam.surfaces, most)
    while True:
        run.walk(wanted, progress)
        result = checked_energy(run)
        error = float(np.max(result.R_se))
        if tolerance is None or error <= tolerance:
            return result
        if run.photons >= most:
            warn(
                f"the standard error of R is {error:.2g} after {run.photons} photons, more than "
                f"the tolerance of {tolerance:g}; allow more photons",
                PhotonWarning,
            )
            return result
        factor = min(_AIM * (error / tolerance) ** 2, _MOST_GROWN)
        wanted = min(BLOCK * ceil(factor * run.photons / BLOCK), most)


@dataclass(frozen=True, eq=False)
class EnergyShares:
    """Shares (events, ...) of the incident light by wavelength; ``_se``: their standard errors."""

    R_s: Numbers
    R_s_se: Numbers
    R_m: Numbers
    R_m_se: Numbers
    R: Numbers
    R_se: Numbers
    T_s: Numbers
    T_s_se: Numbers
    T_m: Numbers
    T_m_se: Numbers
    T: Numbers
    T_se: Numbers
    lost: Numbers
    lost_se: Numbers
    absorbed: Numbers
    absorbed_se: Numbers
    reflected: Numbers
    reflected_se: Numbers
    transmitted: Numbers
    transmitted_se: Numbers


_ONCE, _MORE, _ALL = slice(0, 1), slice(1, None), slice(None)
_PARTS: dict[str, tuple[list[int], slice, tuple[int, ...]]] = {
    "R_s": ([layout.UP], _ONCE, (1, 2)),
    "R_m": ([layout.UP], _MORE, (1, 2)),
    "R": ([layout.UP], _ALL, (1, 2)),
    "T_s": ([layout.DOWN], _ONCE, (1, 2)),
    "T_m": ([layout.DOWN], _MORE, (1, 2)),
    "T": ([layout.DOWN], _ALL, (1, 2)),
    "lost": ([layout.SIDEWAYS, layout.STUCK], _ALL, (1, 2)),
    "absorbed": ([*range(layout.OUTCOMES)], _ALL, (1, 2)),
    "reflected": ([layout.UP], _ALL, (1,)),
    "transmitted": ([layout.DOWN], _ALL, (1,)),
}
"""By what ends and events a share is, and over which of them it is the sum."""


def mean_and_error(photons: Numbers, total: Numbers, squares: Numbers) -> tuple[Numbers, Numbers]:
    """Return the mean over photons, and its standard error.

    Where photons fall on several surfaces, the error is that of the mean over surfaces: the larger
    mean square of a one-way analysis of variance (Scheffe, The Analysis of Variance, Wiley 1959,
    ch. 7). Shapes: photons (surfaces,); total, squares (surfaces, ...); returns mean, error (...).
    """
    lit = photons > 0.0
    photons, total, squares = photons[lit], total[lit], squares[lit]
    count, surfaces = photons.sum(), len(photons)
    each = photons.reshape(-1, *[1] * (total.ndim - 1))
    mean, means = total.sum(axis=0) / count, total / each
    # Of one photon, or one surface, nobody knows how it differs from others.
    within = (squares - total * means).sum(axis=0) / (count - surfaces or np.nan)
    between = (each * (means - mean) ** 2).sum(axis=0) / (surfaces - 1 or np.nan)
    return mean, np.sqrt(np.fmax(within, between).clip(min=0.0) / count)


@dataclass(frozen=True, eq=False)
class Energy(EnergyShares):
    """What becomes of the light that falls on a sample; the shares are those of `EnergyShares`.

    Standard errors are over photons and over realizations of random surfaces; of one photon NaN.
    """

    scalar: EnergyShares
    difference: EnergyShares
    photons: int
    surfaces: int
    sideways: int
    stuck: int

    @classmethod
    def of(cls, beam: PhotonBeam, sums: Numbers) -> Energy:
        """Return what sums over photons say. Shape: sums (surfaces, ends, events, lights, SUMS)."""
        source, shape = beam.states[0][0], beam.indices.n.shape
        counts = sums[..., 0, layout.COUNT]
        photons = counts.sum(axis=(1, 2))

        def shares(total: Numbers, squares: Numbers, whole: float) -> EnergyShares:
            wanted = (*sums.shape[:3], *shape)
            total, squares = (total / source).reshape(wanted), (squares / source**2).reshape(wanted)
            results: dict[str, Numbers] = {}
            for name, (ends, events, axes) in _PARTS.items():
                part = [each[:, ends, events].sum(axis=axes) for each in (total, squares)]
                results[name], results[f"{name}_se"] = mean_and_error(photons, *part)
            results["absorbed"] = whole - results["absorbed"]
            return EnergyShares(**results)

        polarised, scalar = sums[..., layout.INTENSITY], sums[..., layout.SCALAR]
        squares = sums[..., layout.INTENSITY_SQUARED]
        scalar_squares = sums[..., layout.SCALAR_SQUARED]
        apart = squares - 2.0 * sums[..., layout.PRODUCT] + scalar_squares
        return cls(
            **vars(shares(polarised, squares, 1.0)),
            scalar=shares(scalar, scalar_squares, 1.0),
            difference=shares(polarised - scalar, apart, 0.0),
            photons=int(photons.sum()),
            surfaces=int((photons > 0.0).sum()),
            sideways=int(counts[:, layout.SIDEWAYS].sum()),
            stuck=int(counts[:, layout.STUCK].sum()),
        )


class EnergyRun:
    """The sums over the photons that have been walked so far, in the order of their blocks."""

    def __init__(self, beam: PhotonBeam, threads: int) -> None:
        self.beam, self.threads = beam, threads
        self.blocks, self.photons = 0, 0
        self._sums: list[Numbers] = []

    def walk(self, photons: int, progress: Callable[[int, int], None] | None = None) -> None:
        """Walk on until there are as many photons in all; an interruption loses nothing."""
        todo = range(self.blocks, -(-photons // BLOCK))
        walked = walked_in_order(self.beam, todo, photons, self.threads, self.beam.block)
        with closing(walked):
            for block in walked:
                for surface, sums in block.sums.items():
                    missing = surface + 1 - len(self._sums)
                    self._sums += [np.zeros_like(sums) for _ in range(missing)]
                    self._sums[surface] += sums
                self.blocks, self.photons = self.blocks + 1, self.photons + block.photons
                if progress is not None:
                    progress(self.photons, photons)

    @property
    def energy(self) -> Energy:
        """What is known so far."""
        return Energy.of(self.beam, np.array(self._sums))


_USUAL, _MOST_WITH_TOLERANCE = 1_000_000, 1_000_000_000
"""How many photons are walked by default, and how many at most where a tolerance is given."""


def run_arguments(
    sample: Sample,
    incidence: Any,
    photons: int | None = None,
    *,
    tolerance: float | None = None,
    threads: int | None = None,
    **light: Any,
) -> tuple[EnergyRun, int]:
    """Return the run of photons that a user asks for, of which none is walked yet."""
    faults = [] if photons is None else whole_number("photons", photons, 1, MOST_PHOTONS)
    faults += [] if threads is None else whole_number("threads", threads, 1, MOST_THREADS)
    if tolerance is not None and not 0.0 < (real_number(tolerance) or 0.0) < 1.0:
        faults.append(f"tolerance is {shown(tolerance)}; give a standard error within 0 .. 1")
    beam = beam_of(sample, incidence, **light, others=faults)
    usual = _USUAL if tolerance is None else _MOST_WITH_TOLERANCE
    run = EnergyRun(beam, processors() if threads is None else int(threads))
    return run, usual if photons is None else int(photons)


def processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


_ERRORS, _ROUNDINGS = 6.0, 1e-9
"""By how many standard errors light may be missing, and by how much in any case."""


def checked_energy(run: EnergyRun) -> Energy:
    """Return what is known of a run; warn where light has come to nothing, or out of nothing.

    Few photons may carry most of the trapped light: until one of them is met, light is missing, and
    no standard error shows it.
    """
    result = run.energy
    if run.beam.indices.opaque:
        return result
    missing, error = float(result.absorbed), float(result.absorbed_se)
    if abs(missing) > _ERRORS * error + _ROUNDINGS:
        warn(
            f"R + T + lost is {1.0 - missing:.4f} where nothing absorbs, off by "
            f"{abs(missing) / error:.0f} standard errors: few photons carry light that is trapped; "
            f"walk more of them, or trust the shares without polarisation",
            PhotonWarning,
        )
    return result
