"""Light that goes into a smooth sample, is reflected by one facet, and comes out, in one plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.elements.interface import Interface
from optipath.elements.source import Source
from optipath.elements.terminal import Detector
from optipath.errors import SurfaceError, shown
from optipath.paths.path_graph import PathGraph
from optipath.paths.polarization_matters import polarization
from optipath.values.domains.quantities import INCIDENCE
from optipath.values.whole_numbers import is_whole

Numbers = npt.NDArray[np.float64]

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample import Sample


def smooth_exit(
    sample: Sample,
    incidence: Any,
    exit_angle: Any,
    depth: int = 1,
    wavelengths: str | npt.ArrayLike | None = None,
) -> Numbers:
    """Return what polarisation does to light that is reflected once below, and comes out forwards.

    The limit of interfaces that are nearly flat: light is refracted in, reflected by the facet
    that stands halfway between the ways there and back, and refracted out, all in one plane.
    Pixels whose light comes so, and not from the topmost interface, tend to it.

    Units: incidence, exit_angle in radians.

    Examples
    --------
    Off n = 2.4 under a layer of 1.5, at 50 and 65 deg of incidence:

    >>> from optipath.surfaces.samples.sample import Sample
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
