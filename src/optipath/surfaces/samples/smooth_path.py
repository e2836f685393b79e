"""The path of light on a sample whose interfaces are flat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.layer_stack import LayerStack
from optipath.elements.source import Source
from optipath.elements.terminal import Detector
from optipath.paths.path_graph import PathGraph
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample_indices import SampleIndices


def smooth_path(indices: SampleIndices, side: str) -> PathGraph:
    """Return the path of unpolarised light by way of smooth interfaces, to one side of them.

    Its parameter is the angle of ``incidence``.

    Examples
    --------
    >>> from optipath.surfaces.samples.sample import Sample
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
