"""Where the items of a graph in layers stand from left to right."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.cli.graph_layers import GraphLayers, Item
    from optipath.composer.wiring import Link

_SWEEPS = 12


class Extent(NamedTuple):
    """How far something reaches from its middle."""

    left: float
    right: float


def layer_places(
    layers: GraphLayers,
    extents: Mapping[Item, Extent],
    gap: float,
    ends: Mapping[Link, tuple[float, float]],
) -> dict[Item, float]:
    """Return the middle of each item: near those that it is linked with, and over none beside.

    Examples
    --------
    >>> from optipath.cli.graph_layers import graph_layers
    >>> links = [("a", "b", ("out", "in")), ("a", "c", ("left", "in"))]
    >>> extents = dict.fromkeys("abc", Extent(10, 10))
    >>> layer_places(graph_layers("abc", links), extents, 4, dict.fromkeys(links, (0, 0)))
    {'a': 22.0, 'b': 10.0, 'c': 34.0}
    """
    places: dict[Item, float] = {item: 0.0 for row in layers.rows for item in row}
    linked = {step: _linked(layers, ends, step) for step in (-1, 1)}
    for sweep in range(_SWEEPS):
        # At last downwards, so that a chain hangs straight from where it begins.
        step = -1 if sweep % 2 else 1
        for row in layers.rows if step < 0 else reversed(layers.rows):
            near = [
                [places[one] + shift for one, shift in linked[step].get(item, [(item, 0.0)])]
                for item in row
            ]
            wanted = [_mean(each) for each in near]
            places |= zip(row, _apart(wanted, [extents[item] for item in row], gap), strict=True)
    left = min((place - extents[item].left for item, place in places.items()), default=0.0)
    return {item: place - left for item, place in places.items()}


def _linked(
    layers: GraphLayers, ends: Mapping[Link, tuple[float, float]], step: int
) -> dict[Item, list[tuple[Item, float]]]:
    """Return what each item hangs on in the layer before (-1) or behind (1), and how far beside."""
    found: dict[Item, list[tuple[Item, float]]] = {}
    for link, way in layers.ways.items():
        leaves, enters = ends[link]
        offsets = [leaves, *[0.0] * (len(way) - 2), enters]
        for (above, left), (below, right) in pairwise(zip(way, offsets, strict=True)):
            if step < 0:
                found.setdefault(below, []).append((above, left - right))
            else:
                found.setdefault(above, []).append((below, right - left))
    return found


def _apart(wanted: Sequence[float], extents: Sequence[Extent], gap: float) -> list[float]:
    """Return the places nearest to those wanted (least squares) at which nothing overlaps.

    Of places less the room that all before them take, the order is all that is asked:
    isotonic regression by pooling adjacent violators.
    """
    room = [0.0]
    for before, after in pairwise(extents):
        room.append(room[-1] + before.right + gap + after.left)
    pools: list[list[float]] = []
    for place, taken in zip(wanted, room, strict=True):
        pools.append([place - taken])
        while len(pools) > 1 and _mean(pools[-2]) > _mean(pools[-1]):
            last = pools.pop()
            pools[-1] += last
    level = [_mean(pool) for pool in pools for _ in pool]
    return [one + taken for one, taken in zip(level, room, strict=True)]


def _mean(numbers: Sequence[float]) -> float:
    return sum(numbers) / len(numbers)
