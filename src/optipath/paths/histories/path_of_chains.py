"""The path of chains whose media and events are known: one element for each vertex."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.refracting_vertex import RefractingVertex
from optipath.elements.source import Source
from optipath.elements.specular_vertex import SpecularVertex
from optipath.elements.terminal import Detector
from optipath.elements.vertex import Vertex
from optipath.paths.histories.media_along import media_along
from optipath.paths.histories.vertex_events import REFLECTS, media_in_front
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays.read_only import locked

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.elements.chain_vertex import ChainVertex
    from optipath.paths.histories.chain_histories import Histories


def path_of_chains(
    points: Any, chains: Histories, intensity: Any, outside: Any, bad: str
) -> PathGraph:
    """Return the path of light from point to point."""
    path = PathGraph()
    node = path.add("light", Source(intensity))
    each = _alike if not isinstance(chains.events, np.ndarray) else _differing
    for place, vertex in enumerate(each(points, chains, outside, bad), 1):
        node = node >> path.add(f"vertex{place}", vertex)
    node >> path.add("eye", Detector())
    return path


def _alike(points: Any, chains: Histories, outside: Any, bad: str) -> Iterator[ChainVertex]:
    media, count = chains.materials, chains.count
    events: Any = chains.events or REFLECTS * count
    each = zip(events, media, media_in_front(events, media, outside), strict=True)
    for place, (event, material, front) in enumerate(each, 1):
        kind = SpecularVertex if event == REFLECTS else RefractingVertex
        yield kind(material, points, place, front, count, bad)


def _differing(points: Any, chains: Histories, outside: Any, bad: str) -> Iterator[ChainVertex]:
    events: Any = locked(chains.events)
    for place, sides in enumerate(media_along(events, chains.materials, outside), 1):
        yield Vertex(sides.behind, points, place, sides.front, events=events, bad=bad)
