"""What a sample of flat interfaces does to light, which is known without photons."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from optipath.paths.polarization_matters import polarization
from optipath.surfaces.hemispheres.part_sums import PartSums
from optipath.surfaces.hemispheres.sensed_beam import SIDES
from optipath.surfaces.samples.smooth_path import smooth_path
from optipath.values.angles import CosSin

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.sensed_beam import SensedBeam

Numbers = npt.NDArray[np.float64]

_MOST_EVENTS = 1000
"""From how many events on nothing is left of light between flat interfaces."""


def is_flat(seen: SensedBeam) -> bool:
    """Tell whether light is known without photons: it meets flat interfaces and no limit."""
    beam = seen.beam
    whole = seen.events is None and beam.most_events >= _MOST_EVENTS
    return whole and beam.sample.is_flat


def flat_light(seen: SensedBeam) -> PartSums:
    """Return the light of a flat sample, all of which goes into one pixel of each side.

    Of light that goes to and fro between the interfaces, the sum over all rounds, as a
    `LayerStack` has it; without polarisation, the same with each interface by its mean.
    """
    found = PartSums.none(seen.shape)
    for place, side in enumerate(seen.sides):
        matrices, scalar = _by_stack(seen, side)
        numbers = np.column_stack([matrices.reshape(len(scalar), 16), scalar])
        kept = {"both": slice(17), "polarized": slice(16), "scalar": slice(16, 17)}
        pixel = seen.sensor.place(_direction(seen, side))
        image = found.sums[0, place].reshape(-1, *seen.shape[-2:])
        image[pixel] = numbers[:, kept[seen.polarized]]
    return found


def _direction(seen: SensedBeam, side: str) -> Numbers:
    """Return where light goes, by Snell's law; along the sample where none is let through."""
    beam = seen.beam
    azimuth, sin, cos = beam.plane_azimuth, beam.sin, beam.cos
    if side == "transmitted":
        sin = min(beam.smooth_sine(SIDES[side]), 1.0)
        cos = -np.sqrt((1.0 - sin) * (1.0 + sin))
    return np.array([sin * np.cos(azimuth), sin * np.sin(azimuth), cos])


def _by_stack(seen: SensedBeam, side: str) -> tuple[Numbers, Numbers]:
    """Return the Mueller matrix at each wavelength, and the share without polarisation."""
    beam = seen.beam
    path, angle = smooth_path(beam.indices, side), {"incidence": CosSin(beam.cos, beam.sin)}
    matrix, scalar = path.mueller(**angle).matrix, polarization(path, **angle).scalar
    lights = beam.indices.n.size
    return np.broadcast_to(matrix, (lights, 4, 4)), np.broadcast_to(scalar, (lights,))
