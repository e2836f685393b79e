"""The ends of photons, each light in the frame of its meridional plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.filters.rotation import align
from optipath.kernels.geometry.facet import plane_at_facet
from optipath.kernels.numbers.primitives import NUMPY
from optipath.surfaces.walk.walk_layout import (
    AZIMUTH,
    CARRIED,
    END_K,
    END_LIGHTS,
    END_X,
    EVENTS,
    OUTCOME,
)

if TYPE_CHECKING:
    from optipath.surfaces.walk.photon_beam import PhotonBeam

Numbers = npt.NDArray[np.float64]

_ACROSS = 0.0, 1.0, 0.0


class TurnedDirections(NamedTuple):
    """Where photons go, as the sample lies; on an isotropic one as if all had come along x.

    Shapes: k, x (photons, 3); turns (photons, 2).
    """

    k: Numbers
    x: Numbers
    turns: Numbers


class TurnedEnds(NamedTuple):
    """Where photons end, with their lights; directions are those of `TurnedDirections`.

    Shapes: outcomes, events (photons,); directions, x (photons, 3); stokes (photons, lights, 4);
    scalar (photons, lights).
    """

    outcomes: npt.NDArray[np.int64]
    events: npt.NDArray[np.int64]
    directions: Numbers
    x: Numbers
    stokes: Numbers
    scalar: Numbers


def turned_directions(beam: PhotonBeam, found: Numbers) -> TurnedDirections:
    """Return where photons go, and the frames that belong to their directions.

    Shape: found (photons, ENDS + CARRIED lights).
    """
    back = -found[:, AZIMUTH] if beam.sample.isotropic else np.zeros(len(found))
    k, old_x = (_turned(found[:, place : place + 3], back) for place in (END_K, END_X))
    _, _, x, *turn = plane_at_facet(NUMPY)(tuple(k.T), tuple(old_x.T), (0.0, 0.0, 1.0))
    x, turns = (np.stack(np.broadcast_arrays(*each), axis=-1) for each in (x, turn))
    along = (k[:, 0] == 0.0) & (k[:, 1] == 0.0)
    if np.any(along):
        # There is no meridional plane, and x is that of light beside it that goes on towards x.
        old, z = x[along], k[along, 2]
        turns[along] = np.stack(align(NUMPY)(old[:, 1], z * old[:, 0]), axis=-1)
        x[along] = _ACROSS
    return TurnedDirections(k, x, turns)


def turned_ends(beam: PhotonBeam, found: Numbers) -> TurnedEnds:
    """Return the ends of photons in frames that belong to their directions."""
    directions = turned_directions(beam, found)
    lights = found[:, END_LIGHTS:].reshape(len(found), -1, CARRIED)
    carried = tuple(lights[..., place] for place in range(4))
    rotation = [each[:, np.newaxis] for each in directions.turns.T]
    stokes = stokes_of(NUMPY, ROTATION.made_for(NUMPY)(rotation, carried, 4))
    return TurnedEnds(
        outcomes=found[:, OUTCOME].astype(int),
        events=found[:, EVENTS].astype(int),
        directions=directions.k,
        x=directions.x,
        stokes=np.stack(np.broadcast_arrays(*stokes), axis=-1),
        scalar=lights[..., 4],
    )


def _turned(vectors: Numbers, angle: Numbers) -> Numbers:
    """Return vectors turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = vectors.T
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)
