"""Smooth samples: light on flat interfaces, known without photons."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.elements.ends import Detector, Source
from optipath.elements.interface import Interface
from optipath.elements.layer_stack import LayerStack
from optipath.errors import SurfaceError, shown
from optipath.materials.quantities import INCIDENCE
from optipath.paths.path_graph import PathGraph
from optipath.paths.polarization import polarization
from optipath.surfaces.hemisphere.beam import SIDES, PartSums
from optipath.values.angles import CosSin
from optipath.values.parameters import Parameter
from optipath.values.precision import Numbers, is_whole

if TYPE_CHECKING:
    from optipath.surfaces.hemisphere.beam import SensedBeam
    from optipath.surfaces.sample import Sample
    from optipath.surfaces.sample_layers import SampleIndices


def smooth_path(indices: SampleIndices, side: str) -> PathGraph:
    """Return the path of unpolarized light by way of smooth interfaces; parameter ``incidence``.

    >>> from optipath.surfaces.sample import Sample
    >>> path = smooth_path(Sample([(1.5, 0.1), (2.4, 0.1)]).indices(), "reflected")
    >>> print(path.trace(incidence="65 deg").intensity.round(5))
    [0.16024]
    """
    base = np.ravel(indices.base)
    media: list[Any] = [indices.outside, *indices.inner, base if indices.opaque else base.real]
    path = PathGraph()
    path.add("light", Source())
    path.add("sample", LayerStack(media, Parameter("incidence")))
    path.add("seen", Detector())
    path.connect("light", "sample.in")
    path.connect(f"sample.{side}", "seen.in")
    return path


def smooth_difference(indices: SampleIndices, incidence: Any, side: str) -> float:
    """Return (S0 - U) / U of unpolarized light that a smooth sample sends to one side.

    >>> from optipath.surfaces.sample import Sample
    >>> indices = Sample([(1.5, 0.1), (2.4, 0.1)]).indices()
    >>> print(round(100.0 * smooth_difference(indices, "60 deg", "reflected"), 3))
    -2.9
    """
    result = np.ravel(polarization(smooth_path(indices, side), incidence=incidence).difference)
    return float(result[np.argmax(np.abs(result))])


def smooth_exit(
    sample: Sample,
    incidence: Any,
    exit_angle: Any,
    depth: int = 1,
    wavelengths: str | npt.ArrayLike | None = None,
) -> Numbers:
    """Return what polarisation does to light that is reflected once below, and comes out forwards.

    The limit of nearly flat interfaces: light is refracted in, reflected by the facet halfway
    between the two directions, and refracted out, all in one plane. Angles in radians.

    >>> from optipath.surfaces.sample import Sample
    >>> sample = Sample([(1.5, 0.1), (2.4, 0.1)])
    >>> print((-100.0 * smooth_exit(sample, ["50 deg", "65 deg"], "80 deg")).round(1))
    [14.6 19.9]
    """
    if not is_whole(depth, 0, len(sample.layers) - 1):
        raise SurfaceError(
            f"there is no interface {shown(depth)}; give one from 0 to {len(sample.layers) - 1}"
        )
    angles = [
        np.asarray(INCIDENCE.check(name, value), float)
        for name, value in (("incidence", incidence), ("exit_angle", exit_angle))
    ]
    indices = sample.indices(wavelengths)
    media: list[Any] = [indices.outside, *indices.inner, indices.base][: depth + 2]
    return polarization(_path(media, *angles)).difference


def _path(media: list[Any], incidence: Numbers, exit_angle: Numbers) -> PathGraph:
    """Return the way down to the last interface between media, off a facet of it, and out."""
    there, back = (
        [np.arcsin(np.sin(angle) * media[0] / medium) for medium in media[:-1]]
        for angle in (incidence, exit_angle)
    )
    if np.isnan([there[-1].sum(), back[-1].sum()]).any():
        raise SurfaceError("no light gets down there: a medium above reflects it totally")
    path = PathGraph()
    path.add("source", Source())
    lit = "source"
    for place, angle in enumerate(there[:-1]):
        path.add(f"in {place}", Interface(media[place + 1], angle, media[place]))
        path.connect(lit, f"in {place}.in")
        lit = f"in {place}.transmitted"
    facet = Interface(media[-1], 0.5 * (there[-1] + back[-1]), media[-2], parallel=False)
    path.add("facet", facet)
    path.connect(lit, "facet.in")
    lit = "facet.reflected"
    for place in reversed(range(len(back) - 1)):
        face = Interface(media[place], back[place + 1], media[place + 1], parallel=False)
        path.add(f"out {place}", face)
        path.connect(lit, f"out {place}.in")
        lit = f"out {place}.transmitted"
    path.add("detector", Detector())
    path.connect(lit, "detector.in")
    return path


_MOST_EVENTS = 1000
"""From how many events on nothing is left of light between flat interfaces."""


def is_flat(seen: SensedBeam) -> bool:
    """Tell whether light is known without photons: it meets flat interfaces and no limit."""
    beam = seen.beam
    whole = seen.events is None and beam.most_events >= _MOST_EVENTS
    return whole and beam.sample.is_flat


def flat_light(seen: SensedBeam) -> PartSums:
    """Return the light of a flat sample, all of which goes into one pixel of each side.

    Multiple reflections are summed as by `LayerStack`; without polarization, with mean interfaces.
    """
    result = PartSums.none(seen.shape)
    for place, side in enumerate(seen.sides):
        matrices, scalar = _by_stack(seen, side)
        numbers = np.column_stack([matrices.reshape(len(scalar), 16), scalar])
        stored = {"both": slice(17), "polarized": slice(16), "scalar": slice(16, 17)}
        pixel = seen.sensor.place(_direction(seen, side))
        image = result.sums[0, place].reshape(-1, *seen.shape[-2:])
        image[pixel] = numbers[:, stored[seen.polarized]]
    return result


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
