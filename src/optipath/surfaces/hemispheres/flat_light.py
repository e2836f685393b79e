"""What a sample of flat interfaces does to light, which is known without photons."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.elements.layer_stack import LayerStack
from optipath.elements.source import Source
from optipath.elements.terminal import Detector
from optipath.paths.path_graph import PathGraph
from optipath.paths.polarization_matters import polarization
from optipath.surfaces.hemispheres.part_sums import PartSums
from optipath.values.angles import CosSin
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.sensed_beam import SensedBeam

Numbers = npt.NDArray[np.float64]

_MOST_EVENTS = 1000
"""From how many events on nothing is left of light between flat interfaces."""


def is_flat(seen: SensedBeam) -> bool:
    """Tell whether light is known without photons: it meets flat interfaces, and is not cut short.

    Parameters
    ----------
    seen : SensedBeam
        What is measured.

    Returns
    -------
    bool
    """
    beam = seen.beam
    whole = seen.events is None and beam.most_events >= _MOST_EVENTS
    return whole and all(layer.is_flat for layer in beam.sample.layers)


def flat_light(seen: SensedBeam) -> PartSums:
    """Return the light of a flat sample, all of which goes into one pixel of each side.

    Of light that goes to and fro between the interfaces, the sum over all rounds, as a
    `LayerStack` has it; without polarisation, the same with each interface by its mean.

    Parameters
    ----------
    seen : SensedBeam
        What is measured, and of which `is_flat` holds.

    Returns
    -------
    PartSums
        Of no photons.
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
    azimuth = 0.0 if beam.sample.isotropic else beam.azimuth
    sin, cos = beam.sin, beam.cos
    if side == "transmitted":
        sin = min(sin * beam.indices.outside / float(beam.indices.n.flat[0]), 1.0)
        cos = -np.sqrt((1.0 - sin) * (1.0 + sin))
    return np.array([sin * np.cos(azimuth), sin * np.sin(azimuth), cos])


def _by_stack(seen: SensedBeam, side: str) -> tuple[Numbers, Numbers]:
    """Return the Mueller matrix at each wavelength, and the share without polarisation."""
    beam = seen.beam
    indices, angle = beam.indices, {"incidence": CosSin(beam.cos, beam.sin)}
    base = np.atleast_1d(np.ravel(indices.base))
    media: list[Any] = [indices.outside, *indices.inner, base if indices.opaque else base.real]
    path = PathGraph()
    path.add("light", Source()) >> path.add("stack", LayerStack(media, Parameter("incidence")))
    path.add("eye", Detector())
    path.connect(f"stack.{side}", "eye.in")
    matrix, scalar = path.mueller(**angle).matrix, polarization(path, **angle).scalar
    return np.broadcast_to(matrix, (len(base), 4, 4)), np.broadcast_to(scalar, (len(base),))
