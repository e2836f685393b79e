"""PhotonEnds: where photons have gone from a sample, each with its light."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.surfaces.ends.turned_ends import Numbers, turned_ends
from optipath.surfaces.walk.given_beam import UNPOLARISED, given_beam
from optipath.surfaces.walk.photon_beam import BLOCK
from optipath.surfaces.walk.walk_layout import CARRIED, ENDS, OUTCOME_NAMES
from optipath.values.arrays.memory import refuse_too_large
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.walk.photon_beam import PhotonBeam


@dataclass(frozen=True, eq=False)
class PhotonEnds:
    """Where photons have gone, one after the other.

    Their directions are as the sample lies; on an isotropic one, where each photon comes from an
    azimuth of its own, they are turned back so that all have come along x.

    Shapes: ends (photons,); events (photons,); directions (photons, 3); x (photons, 3); stokes
    (photons, ..., 4); scalar (photons, ...).
    """

    ends: npt.NDArray[np.str_]
    events: npt.NDArray[np.int64]
    directions: Numbers
    x: Numbers
    stokes: Numbers
    scalar: Numbers


def photon_ends(
    sample: Sample,
    incidence: Any,
    photons: int = 10_000,
    *,
    azimuth: Any = 0.0,
    wavelength: str | npt.ArrayLike | None = None,
    stokes: npt.ArrayLike = UNPOLARISED,
    seed: int = 0,
    most_events: int = 1000,
) -> PhotonEnds:
    """Return where photons go from a sample: the same photons that `energy` counts.

    Parameters
    ----------
    sample, incidence, azimuth, wavelength, stokes, seed, most_events
        As `energy` takes them.
    photons : int, optional
        How many are walked; all of them are kept, in some 130 bytes each.

    Returns
    -------
    PhotonEnds

    Raises
    ------
    SurfaceError
        With all faults at once.

    Examples
    --------
    >>> from optipath.surfaces.samples.sample import Sample
    >>> found = photon_ends(Sample([(1j, 0.3)]), "30 deg", photons=1000)
    >>> print(found.directions.shape, found.stokes.shape, np.unique(found.ends))
    (1000, 3) (1000, 4) ['up']
    """
    beam = given_beam(
        sample,
        incidence,
        azimuth,
        wavelength=wavelength,
        stokes=stokes,
        seed=seed,
        most_events=most_events,
        beside=whole_number("photons", photons),
    )
    refuse_too_large(
        (int(photons),),
        16 * (ENDS + CARRIED * beam.lights),
        cure="give fewer photons",
        error=SurfaceError,
        what="ends of {:.3g} photons",
    )
    blocks = range(-(-photons // BLOCK))
    return _ends_of(beam, np.concatenate([_block(beam, number, photons) for number in blocks]))


def _block(beam: PhotonBeam, number: int, photons: int) -> Numbers:
    return beam.block(number, min(BLOCK, photons - BLOCK * number), keeps=True).ends


def _ends_of(beam: PhotonBeam, found: Numbers) -> PhotonEnds:
    turned, shape = turned_ends(beam, found), (len(found), *beam.indices.n.shape)
    return PhotonEnds(
        ends=np.array(OUTCOME_NAMES)[turned.outcomes],
        events=turned.events,
        directions=turned.directions,
        x=turned.x,
        stokes=turned.stokes.reshape(*shape, 4),
        scalar=turned.scalar.reshape(shape),
    )
