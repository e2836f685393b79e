"""Smooth samples: light on flat interfaces, known without photons."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.elements.ends import Detector, Source
from optipath.elements.interface import Interface
from optipath.elements.layer_stack import LayerStack
from optipath.errors import SurfaceError
from optipath.paths.path_graph import PathGraph
from optipath.paths.polarization import polarization
from optipath.surfaces.hemisphere.beam import SIDES, PartSums
from optipath.values.angles import CosSin
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.elements.element import Element
    from optipath.surfaces.hemisphere.beam import SensedBeam
    from optipath.surfaces.sample import Sample, SampleIndices
    from optipath.values.precision import Numbers


def smooth_path(indices: SampleIndices, side: str) -> PathGraph:
    """Return the path of unpolarized light by way of smooth interfaces; parameter ``incidence``."""
    base = np.ravel(indices.base)
    media: list[Any] = [indices.outside, *indices.inner, base if indices.opaque else base.real]
    return path_of_steps(Source(), [("sample", LayerStack(media, Parameter("incidence")), side)])


def path_of_steps(
    source: Source, steps: Iterable[tuple[str, Element, str]], description: str = ""
) -> PathGraph:
    """Return the path through elements by their names, of which light leaves each by a port."""
    path = PathGraph(description=description)
    path.add("source", source)
    last = "source"
    for name, element, port in steps:
        path.add(name, element)
        path.connect(last, f"{name}.in")
        last = f"{name}.{port}"
    path.add("detector", Detector())
    path.connect(last, "detector.in")
    return path


def smooth_difference(indices: SampleIndices, incidence: Any, side: str) -> float:
    """Return (S0 - U) / U of unpolarized light that a smooth sample sends to one side."""
    result = np.ravel(polarization(smooth_path(indices, side), incidence=incidence).difference)
    return float(result[np.argmax(np.abs(result))])


def smooth_exit(
    sample: Sample,
    incidence: npt.ArrayLike,
    exit_angle: npt.ArrayLike,
    depth: int = 1,
    wavelengths: str | npt.ArrayLike | None = None,
) -> Numbers:
    """Return what polarisation does to light that is reflected once below, and comes out forwards.

    The limit of nearly flat interfaces: light is refracted in, reflected by the facet halfway
    between the two directions, and refracted out, all in one plane. Angles in radians.
    """
    indices = sample.indices(wavelengths)
    media: list[Any] = [indices.outside, *indices.inner, indices.base][: depth + 2]
    there, back = (
        [np.arcsin(np.sin(angle) * media[0] / medium) for medium in media[:-1]]
        for angle in (incidence, exit_angle)
    )
    if np.isnan([np.sum(there[-1]), np.sum(back[-1])]).any():
        raise SurfaceError("no light gets down there: a medium above reflects it totally")
    steps = [
        (f"in {place}", Interface(media[place + 1], angle, media[place]), "transmitted")
        for place, angle in enumerate(there[:-1])
    ]
    facet = Interface(media[-1], 0.5 * (there[-1] + back[-1]), media[-2], parallel=False)
    steps.append(("facet", facet, "reflected"))
    for place in reversed(range(len(back) - 1)):
        face = Interface(media[place], back[place + 1], media[place + 1], parallel=False)
        steps.append((f"out {place}", face, "transmitted"))
    return polarization(path_of_steps(Source(), steps)).difference


def flat_light(seen: SensedBeam) -> PartSums:
    """Return the light of a flat sample, all of which goes into one pixel of each side.

    Multiple reflections are summed as by `LayerStack`; without polarization, with mean interfaces.
    """
    result, beam, lights = PartSums.none(seen.shape), seen.beam, seen.beam.indices.n.size
    stored = {"both": slice(17), "polarized": slice(16), "scalar": slice(16, 17)}
    for place, side in enumerate(seen.sides):
        path, angle = smooth_path(beam.indices, side), {"incidence": CosSin(beam.cos, beam.sin)}
        matrices = np.broadcast_to(path.mueller(**angle).matrix, (lights, 4, 4))
        scalar = np.broadcast_to(polarization(path, **angle).scalar, (lights,))
        numbers = np.column_stack([matrices.reshape(lights, 16), scalar])
        image = result.sums[0, place].reshape(-1, *seen.shape[-2:])
        azimuth, sin, cos = beam.plane_azimuth, beam.sin, beam.cos
        if side == "transmitted":  # Along the sample where none is let through.
            sin = min(beam.smooth_sine(SIDES[side]), 1.0)
            cos = -np.sqrt((1.0 - sin) * (1.0 + sin))
        direction = sin * np.cos(azimuth), sin * np.sin(azimuth), cos
        image[seen.sensor.place(direction)] = numbers[:, stored[seen.polarized]]
    return result
