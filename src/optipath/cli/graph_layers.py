"""A graph in layers: what stands in which, in which order, and which links pass through."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.composer.wiring import Link

Item: TypeAlias = "str | tuple[Link, int]"
"""What takes a place in a layer: a node by its name, or a link that passes, with the layer."""

_SWEEPS = 8


@dataclass(frozen=True)
class GraphLayers:
    """Layers of nodes, from the first that light passes to the last."""

    rows: list[list[Item]]
    ways: dict[Link, list[Item]]
    back: list[Link]

    @property
    def layer(self) -> dict[Item, int]:
        """The number of the layer of each item."""
        return {item: number for number, row in enumerate(self.rows) for item in row}


def graph_layers(order: Sequence[str], links: Sequence[Link]) -> GraphLayers:
    """Return the layers of a graph.

    A node stands behind all that send light to it, and the items of a layer in such an order
    that links cross seldom (barycentres: Sugiyama, Tagawa and Toda, IEEE Trans. SMC 11, 109, 1981).

    Examples
    --------
    >>> links = [("a", "b", ("out", "in")), ("b", "c", ("out", "in")), ("a", "c", ("left", "in"))]
    >>> graph_layers(["a", "b", "c"], links).rows
    [['a'], ['b', (('a', 'c', ('left', 'in')), 1)], ['c']]
    """
    place = {name: number for number, name in enumerate(order)}
    onwards = [link for link in links if place[link[0]] < place[link[1]]]
    layer = _layer_of(order, onwards)
    rows: list[list[Item]] = [[] for _ in range(1 + max(layer.values(), default=0))]
    for name in order:
        rows[layer[name]].append(name)
    ways: dict[Link, list[Item]] = {}
    for link in onwards:
        passed: list[Item] = [
            (link, number) for number in range(layer[link[0]] + 1, layer[link[1]])
        ]
        for number, item in enumerate(passed, layer[link[0]] + 1):
            rows[number].append(item)
        ways[link] = [link[0], *passed, link[1]]
    back = [link for link in links if place[link[0]] >= place[link[1]]]
    return GraphLayers(_in_order(rows, ways), ways, back)


def _layer_of(order: Sequence[str], onwards: Sequence[Link]) -> dict[str, int]:
    layer = dict.fromkeys(order, 0)
    ends: dict[str, list[str]] = {name: [] for name in order}
    for start, end, _ in onwards:
        ends[start].append(end)
    for name in order:
        for end in ends[name]:
            layer[end] = max(layer[end], layer[name] + 1)
    # Where nothing comes from above, a node stands next to what it sends light to.
    reached = {end for _, end, _ in onwards}
    for name in order:
        if name not in reached and ends[name]:
            layer[name] = min(layer[end] for end in ends[name]) - 1
    return layer


def _neighbours(ways: Mapping[Link, Sequence[Item]], step: int) -> dict[Item, list[Item]]:
    """Return what each item is linked with in the layer before (-1) or behind it (1)."""
    found: dict[Item, list[Item]] = {}
    for way in ways.values():
        for one, next_one in pairwise(way):
            here, there = (one, next_one) if step > 0 else (next_one, one)
            found.setdefault(here, []).append(there)
    return found


def _in_order(rows: list[list[Item]], ways: Mapping[Link, Sequence[Item]]) -> list[list[Item]]:
    for sweep in range(_SWEEPS):
        down = sweep % 2 == 0
        linked = _neighbours(ways, -1 if down else 1)
        place: dict[Item, float] = {}
        for row in rows if down else reversed(rows):
            near = {item: [place[one] for one in linked.get(item, ())] for item in row}
            here = {item: (number + 0.5) / len(row) for number, item in enumerate(row)}
            row.sort(key=lambda one: sum(near[one]) / len(near[one]) if near[one] else here[one])
            place |= {item: (number + 0.5) / len(row) for number, item in enumerate(row)}
    return rows
