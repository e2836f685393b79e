"""Photon ends: where photons leave a sample, each with its light."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.facets import plane_at_facet
from optipath.kernels.filters import align
from optipath.kernels.primitives import NUMPY
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.beam import BLOCK, MOST_PHOTONS, UNPOLARISED, beam_of
from optipath.values.arrays import refuse_too_large
from optipath.values.precision import Numbers, whole_number

if TYPE_CHECKING:
    from optipath.surfaces.sample import Sample
    from optipath.surfaces.walk.beam import PhotonBeam


@dataclass(frozen=True, eq=False)
class PhotonEnds:
    """Where photons have gone, one after the other.

    Directions are in the axes of the sample; on an isotropic one, each is turned back so that all
    photons have come along x. Shapes: ends, events (photons,); directions, x (photons, 3); stokes
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

    Examples
    --------
    >>> from optipath.surfaces.sample import Sample
    >>> found = photon_ends(Sample([(1j, 0.3)]), "30 deg", photons=1000)
    >>> print(found.directions.shape, found.stokes.shape, np.unique(found.ends))
    (1000, 3) (1000, 4) ['up']
    """
    faults = whole_number("photons", photons, 1, MOST_PHOTONS)
    light = {"azimuth": azimuth, "wavelength": wavelength, "stokes": stokes}
    beam = beam_of(sample, incidence, **light, seed=seed, most_events=most_events, others=faults)
    number = 16 * (layout.ENDS + layout.CARRIED * beam.lights)
    cure, what = "give fewer photons", "ends of {:.3g} photons"
    refuse_too_large((photons,), number, cure, SurfaceError, what)
    blocks = [
        beam.block(first // BLOCK, min(BLOCK, photons - first), keeps=True).ends
        for first in range(0, photons, BLOCK)
    ]
    return _ends_of(beam, np.concatenate(blocks))


def _ends_of(beam: PhotonBeam, results: Numbers) -> PhotonEnds:
    """Return the ends of photons in frames that belong to their directions."""
    k, x, turns = turned_directions(beam, results)
    shape = len(results), *beam.indices.n.shape
    lights = results[:, layout.END_LIGHTS :].reshape(len(results), -1, layout.CARRIED)
    carried = tuple(lights[..., place] for place in range(4))
    rotation = [each[:, np.newaxis] for each in turns.T]
    stokes = stokes_of(NUMPY, ROTATION.action(NUMPY, rotation, carried, 4))
    return PhotonEnds(
        ends=np.array(layout.OUTCOME_NAMES)[results[:, layout.OUTCOME].astype(int)],
        events=results[:, layout.EVENTS].astype(int),
        directions=k,
        x=x,
        stokes=np.stack(np.broadcast_arrays(*stokes), axis=-1).reshape(*shape, 4),
        scalar=lights[..., 4].reshape(shape),
    )


def turned_directions(beam: PhotonBeam, results: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Return directions and x (photons, 3) of found (photons, ENDS + CARRIED lights), and turns.

    On an isotropic sample as if all photons had come along x; turns (photons, 2) are those into
    the frames.
    """
    back = -results[:, layout.AZIMUTH] if beam.sample.isotropic else np.zeros(len(results))
    k, old_x = (
        _turned(results[:, place : place + 3], back) for place in (layout.END_K, layout.END_X)
    )
    _, _, x, *turn = plane_at_facet(NUMPY)(tuple(k.T), tuple(old_x.T), (0.0, 0.0, 1.0))
    x, turns = (np.stack(np.broadcast_arrays(*each), axis=-1) for each in (x, turn))
    along = (k[:, 0] == 0.0) & (k[:, 1] == 0.0)
    if np.any(along):
        # There is no meridional plane, and x is that of light beside it that goes on towards x.
        old, z = x[along], k[along, 2]
        turns[along] = np.stack(align(NUMPY)(old[:, 1], z * old[:, 0]), axis=-1)
        x[along] = 0.0, 1.0, 0.0
    return k, x, turns


def _turned(vectors: Numbers, angle: Numbers) -> Numbers:
    """Return vectors turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = vectors.T
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)
