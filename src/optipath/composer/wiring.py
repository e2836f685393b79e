"""Wiring: the way light takes from port to port of a path."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

from optipath.composer.travel import Port, Ways, among, backwards, reached, stretches
from optipath.elements.own_couplings import couplings_of
from optipath.elements.own_ways import OwnWays, own_ways

if TYPE_CHECKING:
    import networkx as nx

    from optipath.composer.travel import Stretch
    from optipath.elements.coupling import Coupling
    from optipath.elements.element import Element

Link: TypeAlias = tuple[str, str, tuple[str, str]]
"""(start node, end node, (out-port, in-port)), as networkx keys the edges."""


LOOPS = ("refuse", "sum")
"""What becomes of light that goes round: an error, or the sum over all rounds."""


KEPT = ("ends", "all")
"""Which light is kept: that at the ends of a path, or on every link as well."""


def link_text(link: Link) -> str:
    """Write a link as ``start.port -> end.port``."""
    start, end, (leaves, enters) = link
    return f"{start}.{leaves} -> {end}.{enters}"


class Wiring:
    """A graph of elements seen by its ports, each list of them gathered once.

    Working on ports rather than nodes tells light that passes an element twice, by
    different ways, from light that goes round in a loop.
    """

    def __init__(
        self, graph: nx.MultiDiGraph, loops: str | None = None, keep: str = KEPT[0]
    ) -> None:
        self.graph = graph
        self.keep = keep
        self.loops = graph.graph.get("loops", LOOPS[0]) if loops is None else loops

    @cached_property
    def elements(self) -> dict[str, Element]:
        """The element of each node."""
        return dict(self.graph.nodes(data="element"))

    @cached_property
    def self_placed(self) -> frozenset[str]:
        """The nodes whose elements have frames by their own values."""
        return frozenset([name for name, e in self.elements.items() if e.self_placed])

    @cached_property
    def couplings(self) -> dict[str, tuple[Coupling, ...]]:
        """The ways through the element of each node."""
        known: dict[int, tuple[Coupling, ...]] = {}
        # One element may stand in many places.
        for element in self.elements.values():
            if id(element) not in known:
                known[id(element)] = couplings_of(element)
        return {name: known[id(element)] for name, element in self.elements.items()}

    def own_ways(self, method: str = "stable") -> list[OwnWays]:
        """Return the ways through elements of a user's own that are to be looked at."""
        return [
            ways
            for name, couplings in self.couplings.items()
            for ways in own_ways(name, self.elements[name], couplings, method)
        ]

    @cached_property
    def links_to(self) -> dict[Port, list[Link]]:
        """The links that arrive at each in-port, in order of their names."""
        found: dict[Port, list[Link]] = {}
        for link in sorted(self.graph.edges(keys=True)):
            found.setdefault((link[1], link[2][1]), []).append(link)
        return found

    @cached_property
    def links_from(self) -> dict[Port, list[Link]]:
        """The links that take the light of each out-port, in order of their names; no taps."""
        found: dict[Port, list[Link]] = {}
        for start, end, key, tap in sorted(self.graph.edges(keys=True, data="tap")):
            if not tap:
                found.setdefault((start, key[0]), []).append((start, end, key))
        return found

    @cached_property
    def taps(self) -> list[Link]:
        """The links that read the light of their port, and take nothing, in order of names."""
        links = self.graph.edges(keys=True, data="tap")
        return sorted((start, end, key) for start, end, key, tap in links if tap)

    @cached_property
    def ports(self) -> Ways:
        """The ways from port to port: links, and couplings inside of elements."""
        ways: Ways = {
            (name, port): []
            for name, element in self.elements.items()
            for port in (*element.inputs, *element.outputs)
        }
        for name, couplings in self.couplings.items():
            for coupling in couplings:
                if coupling.enters is not None:
                    ways[name, coupling.enters].append((name, coupling.leaves))
        for start, end, (leaves, enters) in self.graph.edges(keys=True):
            ways[start, leaves].append((end, enters))
        # A link that carries no light is a fault of its own, and not one of reach as well.
        for start, _, (leaves, _) in self.dark_links:
            for enters in self.elements[start].inputs:
                ways[start, enters].append((start, leaves))
        return ways

    @cached_property
    def untapped(self) -> Ways:
        """The ways from port to port, those of taps left out."""
        ways = dict(self.ports)
        for start, end, (leaves, enters) in self.taps:
            ways[start, leaves] = [port for port in ways[start, leaves] if port != (end, enters)]
        return ways

    @cached_property
    def starts(self) -> list[Port]:
        """The ports where light begins."""
        return [
            (name, coupling.leaves)
            for name, couplings in self.couplings.items()
            for coupling in couplings
            if coupling.enters is None
        ]

    @cached_property
    def ends(self) -> list[Port]:
        """The ports where light ends: in-ports of elements with no way out."""
        return [
            (name, port)
            for name, element in self.elements.items()
            if not element.outputs
            for port in element.inputs
        ]

    @cached_property
    def lit(self) -> set[Port]:
        """The ports that light reaches."""
        return reached(self.ports, self.starts)

    @cached_property
    def useful(self) -> set[Port]:
        """The ports from which light reaches an end."""
        return reached(backwards(self.ports), self.ends)

    @cached_property
    def stretches(self) -> list[Stretch]:
        """The ports that light passes, in the order of travel; those of a loop together.

        Those on a way from a start to an end, or all that are lit.
        """
        wanted = self.lit if self.keep == "all" else self.lit & self.useful
        return stretches(among(self.ports, wanted))

    @cached_property
    def order(self) -> dict[Port, int]:
        """The place of each port in the order of travel."""
        travelled = (port for stretch in self.stretches for port in stretch.ports)
        return {port: place for place, port in enumerate(travelled)}

    @cached_property
    def dark_links(self) -> list[Link]:
        """The links from out-ports that no coupling gives light to."""
        lit = {(name, c.leaves) for name, ways in self.couplings.items() for c in ways}
        return [link for link in self.graph.edges(keys=True) if (link[0], link[2][0]) not in lit]

    @cached_property
    def outlets(self) -> tuple[str, ...]:
        """The out-ports whose light no link takes: it leaves the path, read by taps or not."""
        taken = self.links_from
        found = (
            f"{name}.{port}"
            for name, element in self.elements.items()
            for port in element.outputs
            if (name, port) not in taken
        )
        return tuple(sorted(found))
