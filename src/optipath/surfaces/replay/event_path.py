"""Events of a photon as a path: a source, an interface for each event, and a detector."""

from __future__ import annotations

from math import atan2
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from optipath.elements.interface import Interface
from optipath.elements.terminal import Detector
from optipath.kernels.fresnel.boundary import lossless_boundary
from optipath.kernels.numbers.primitives import FLOAT
from optipath.paths.path_graph import PathGraph

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.elements.source import Source
    from optipath.surfaces.replay.photon_event import PhotonEvent

Place: TypeAlias = int | tuple[int, ...]


def event_path(
    source: Source, events: Iterable[PhotonEvent], which: Place | None, description: str
) -> PathGraph:
    """Return the path of a photon through its events."""
    path = PathGraph(description=description)
    path.add("source", source)
    last = "source"
    for number, event in enumerate(events, 1):
        name = f"facet-{number}"
        path.add(name, _interface(event, which))
        path.connect(last, name)
        last = f"{name}.{'reflected' if event.reflected else 'transmitted'}"
    path.add("detector", Detector())
    path.connect(last, "detector")
    return path


def _interface(event: PhotonEvent, which: Place | None) -> Interface:
    index = event.n2 if which is None or not np.ndim(event.n2) else event.n2[which]
    angle, measured_in = event.incidence, None
    if not event.reflected and event.n1 > index:
        # Next to the critical angle, that of refraction has digits which that of incidence lacks.
        wave = lossless_boundary(FLOAT)(event.n1, index, event.cos, event.sin)
        angle, measured_in = atan2(wave.n1 * wave.s, wave.a), index
    # Facets stand at any angle to each other, for which no law of parallel faces holds.
    return Interface(index, angle, event.n1, event.turn, measured_in, parallel=False)
