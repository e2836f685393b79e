"""One photon walked again, with all that happens to it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.frames import Frame
from optipath.surfaces.replay.photon import Photon
from optipath.surfaces.replay.photon_event import event_of
from optipath.surfaces.walk.given_beam import UNPOLARISED, given_beam
from optipath.surfaces.walk.photon_beam import BLOCK
from optipath.surfaces.walk.walk_layout import (
    DIRECTION,
    EVENTS,
    FIRST_K,
    FIRST_X,
    LAST_K,
    LAST_X,
    OUTCOME,
    OUTCOME_NAMES,
    RECORD,
)
from optipath.values.arrays.memory import refuse_too_large
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.walk.photon_beam import PhotonBeam
    from optipath.surfaces.walk.walked_block import WalkedBlock


def replayed_photon(
    sample: Sample,
    number: int,
    incidence: Any = 0.0,
    *,
    seed: int = 0,
    azimuth: Any = 0.0,
    wavelength: str | npt.ArrayLike | None = None,
    stokes: npt.ArrayLike = UNPOLARISED,
    most_events: int = 1000,
) -> Photon:
    """Return one of the photons that `energy` counts, with all that happens to it."""
    beam = given_beam(
        sample,
        incidence,
        azimuth,
        wavelength=wavelength,
        stokes=stokes,
        seed=seed,
        most_events=most_events,
        beside=whole_number("number", number, 0),
    )
    refuse_too_large(
        (beam.most_events + 1,),
        8 * RECORD,
        cure="give fewer most_events",
        error=SurfaceError,
        what="record of {:.3g} events",
    )
    block, place = divmod(int(number), BLOCK)
    walked = beam.block(block, wanted=place)
    return _photon_of(beam, int(number), walked)


def _photon_of(beam: PhotonBeam, number: int, walked: WalkedBlock) -> Photon:
    surface = beam.surface(number)
    ends = walked.record[0]
    first, start_x, last, x = (
        ends[place : place + 3].copy() for place in (FIRST_K, FIRST_X, LAST_K, LAST_X)
    )
    count = int(ends[EVENTS])
    directions = [*walked.record[2 : count + 1, DIRECTION : DIRECTION + 3].copy(), last][:count]
    shape = beam.indices.n.shape
    carried = walked.lights.T[:4]
    return Photon(
        beam=beam,
        number=number,
        surface=surface,
        events=tuple(
            event_of(beam, surface, walked, place, onwards)
            for place, onwards in enumerate(directions, 1)
        ),
        end=OUTCOME_NAMES[int(ends[OUTCOME])],
        start=Frame.from_direction(first, start_x),
        frame=Frame.from_direction(last, x),
        stokes=np.stack(stokes_of(NUMPY, tuple(carried)), axis=-1).reshape(*shape, 4),
        scalar=walked.lights[:, 4].reshape(shape),
    )
