"""Wiring: the way light takes from port to port of a path."""

from __future__ import annotations

from collections import Counter
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import networkx as nx

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.elements import Coupling, Element

Port: TypeAlias = tuple[str, str]
Link: TypeAlias = tuple[str, str, tuple[str, str]]
"""(start node, end node, (out-port, in-port)), as networkx keys the edges."""


LOOPS = ("refuse", "sum")
"""What becomes of light that goes round: an error, or the sum over all rounds."""


KEPT = ("ends", "all")
"""Which light is kept: that at the ends of a path, or on every link as well."""


class Stretch(NamedTuple):
    """Ports that light passes one after the other: one port, or all those of a loop.

    Attributes
    ----------
    ports : tuple of Port
        In the order of travel, but for the knots.
    knots : tuple of Port
        Those of a loop where lights meet, one of which every way round passes.
    """

    ports: tuple[Port, ...]
    knots: tuple[Port, ...] = ()


def link_text(link: Link) -> str:
    """Write a link as ``start.port -> end.port``."""
    start, end, (leaves, enters) = link
    return f"{start}.{leaves} -> {end}.{enters}"


class Wiring:
    """A graph of elements seen by its ports, each view gathered once.

    Working on ports rather than nodes tells light that passes an element twice, by
    different ways, from light that goes round in a loop.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        Elements and links.
    loops : {"refuse", "sum"}, optional
        Whether light may go round; by default what the graph says, and else not.
    keep : {"ends", "all"}, optional
        Which light is wanted: that which reaches an end, or all.
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
    def couplings(self) -> dict[str, tuple[Coupling, ...]]:
        """The ways through the element of each node."""
        return {name: tuple(element.couplings()) for name, element in self.elements.items()}

    @cached_property
    def links_to(self) -> dict[Port, list[Link]]:
        """The links that arrive at each in-port, in order of their names."""
        found: dict[Port, list[Link]] = {}
        for link in sorted(self.graph.edges(keys=True)):
            found.setdefault((link[1], link[2][1]), []).append(link)
        return found

    @cached_property
    def ports(self) -> nx.DiGraph:
        """The graph whose nodes are ports, and whose edges are links and couplings."""
        ports = nx.DiGraph()
        for name, element in self.elements.items():
            ports.add_nodes_from((name, port) for port in (*element.inputs, *element.outputs))
            ports.add_edges_from(
                ((name, coupling.enters), (name, coupling.leaves))
                for coupling in self.couplings[name]
                if coupling.enters is not None
            )
        ports.add_edges_from(
            ((start, leaves), (end, enters))
            for start, end, (leaves, enters) in self.graph.edges(keys=True)
        )
        # A link that carries no light is a fault of its own, and not one of reach as well.
        ports.add_edges_from(
            ((start, enters), (start, leaves))
            for start, _, (leaves, _) in self.dark_links
            for enters in self.elements[start].inputs
        )
        return ports

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
        return _reached(self.ports, self.starts)

    @cached_property
    def useful(self) -> set[Port]:
        """The ports from which light reaches an end."""
        return _reached(self.ports.reverse(copy=False), self.ends)

    @cached_property
    def wanted(self) -> nx.DiGraph:
        """The ports that light passes on its way from a start to an end, or all of them."""
        kept = self.lit if self.keep == "all" else self.lit & self.useful
        found = nx.DiGraph()
        found.add_nodes_from(kept)
        found.add_edges_from(edge for edge in self.ports.edges if kept.issuperset(edge))
        return found

    @cached_property
    def stretches(self) -> list[Stretch]:
        """The ports that light passes, in the order of travel; those of a loop together."""
        wanted = self.wanted
        rounds = [c for c in nx.strongly_connected_components(wanted) if len(c) > 1]
        if not rounds:
            return [Stretch((port,)) for port in nx.lexicographical_topological_sort(wanted)]
        stands_for = {port: min(ports) for ports in rounds for port in ports}
        loops = {min(ports): _loop(wanted, ports) for ports in rounds}
        outer = nx.DiGraph()
        outer.add_nodes_from(stands_for.get(port, port) for port in wanted)
        ends = ((stands_for.get(a, a), stands_for.get(b, b)) for a, b in wanted.edges)
        outer.add_edges_from((a, b) for a, b in ends if a != b)
        order = nx.lexicographical_topological_sort(outer)
        return [loops.get(port) or Stretch((port,)) for port in order]

    @cached_property
    def dark_links(self) -> list[Link]:
        """The links from out-ports that no coupling gives light to."""
        lit = {(name, c.leaves) for name, ways in self.couplings.items() for c in ways}
        return [link for link in self.graph.edges(keys=True) if (link[0], link[2][0]) not in lit]

    @cached_property
    def outlets(self) -> tuple[str, ...]:
        """The out-ports that no link takes: their light leaves the path."""
        taken = {(start, leaves) for start, _, (leaves, _) in self.graph.edges(keys=True)}
        found = (
            f"{name}.{port}"
            for name, element in self.elements.items()
            for port in element.outputs
            if (name, port) not in taken
        )
        return tuple(sorted(found))

    @cached_property
    def copied(self) -> tuple[str, ...]:
        """The out-ports that several links take, each the whole light."""
        counts = Counter(f"{start}.{ways[0]}" for start, _, ways in self.graph.edges(keys=True))
        return tuple(sorted(port for port, count in counts.items() if count > 1))


def _loop(ports: nx.DiGraph, together: set[Port]) -> Stretch:
    """Return the ports of a loop; where several lights arrive is a knot."""
    knots = tuple(sorted(port for port in together if ports.in_degree(port) > 1))
    between = nx.DiGraph()
    between.add_nodes_from(together)
    between.add_edges_from(
        (start, end) for end in together.difference(knots) for start in ports.predecessors(end)
    )
    order = nx.lexicographical_topological_sort(between)
    return Stretch(tuple(order), knots)


def _reached(ports: nx.DiGraph, starts: Iterable[Port]) -> set[Port]:
    reached = set(starts)
    waiting = list(reached)
    while waiting:
        for successor in ports.successors(waiting.pop()):
            if successor not in reached:
                reached.add(successor)
                waiting.append(successor)
    return reached
