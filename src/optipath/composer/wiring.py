"""Wiring: the way of light from port to port, its order, loops and taps."""

from __future__ import annotations

from functools import cached_property
from heapq import heapify, heappop, heappush
from itertools import chain
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias, get_args

import networkx as nx

from optipath.elements.own_element import OwnWays, couplings_of, own_ways
from optipath.faults import Cure, Fault, listed

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from optipath.elements.coupling import Coupling
    from optipath.elements.element import Element


Link: TypeAlias = tuple[str, str, tuple[str, str]]
"""(start node, end node, (out-port, in-port)), as networkx keys the edges."""


Loops: TypeAlias = Literal["refuse", "sum"]
LOOPS: tuple[Loops, ...] = get_args(Loops)
"""What becomes of light that goes round: an error, or the sum over all rounds."""


Keep: TypeAlias = Literal["ends", "all"]
KEEPABLE: tuple[Keep, ...] = get_args(Keep)
"""Which light is kept: that at the ends of a path, or on every link as well."""


def link_text(link: Link) -> str:
    """Write a link as ``start.port -> end.port``."""
    start, end, (leaves, enters) = link
    return f"{start}.{leaves} -> {end}.{enters}"


class Wiring:
    """A graph of elements seen by its ports, each list of them gathered once.

    Ports rather than nodes tell light that passes an element twice from light in a loop.
    """

    def __init__(
        self, graph: nx.MultiDiGraph, loops: str | None = None, keep: str = KEEPABLE[0]
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
        # One element may stand in many places.
        each = {id(element): element for element in self.elements.values()}
        known = {key: couplings_of(element) for key, element in each.items()}
        return {name: known[id(element)] for name, element in self.elements.items()}

    def own_ways(self, method: str = "stable") -> list[OwnWays]:
        """Return the ways through elements of a user's own that are to be looked at."""
        ways = self.couplings.items()
        each = [own_ways(name, self.elements[name], several, method) for name, several in ways]
        return [*chain.from_iterable(each)]

    @cached_property
    def links_to(self) -> dict[Port, list[Link]]:
        """The links that arrive at each in-port, in order of their names."""
        results: dict[Port, list[Link]] = {}
        for link in sorted(self.graph.edges(keys=True)):
            results.setdefault((link[1], link[2][1]), []).append(link)
        return results

    @cached_property
    def links_from(self) -> dict[Port, list[Link]]:
        """The links that take the light of each out-port, in order of their names; no taps."""
        results: dict[Port, list[Link]] = {}
        for start, end, key, tap in sorted(self.graph.edges(keys=True, data="tap")):
            if not tap:
                results.setdefault((start, key[0]), []).append((start, end, key))
        return results

    @cached_property
    def taps(self) -> list[Link]:
        """The links that read the light of their port, and take nothing, in order of names."""
        links = self.graph.edges(keys=True, data="tap")
        return sorted((start, end, key) for start, end, key, tap in links if tap)

    @cached_property
    def ports(self) -> Ways:
        """The ways from port to port: links, and couplings inside of elements."""
        every = [(name, (*e.inputs, *e.outputs)) for name, e in self.elements.items()]
        ways: Ways = {(name, port): [] for name, ports in every for port in ports}
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
        pairs = [(name, way) for name, ways in self.couplings.items() for way in ways]
        return [(name, way.leaves) for name, way in pairs if way.enters is None]

    @cached_property
    def ends(self) -> list[Port]:
        """The ports where light ends: in-ports of elements with no way out."""
        ends = [(name, e.inputs) for name, e in self.elements.items() if not e.outputs]
        return [(name, port) for name, ports in ends for port in ports]

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
        """The ports that light passes (from a start to an end) in order; loops together."""
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
        ports = [(name, port) for name, e in self.elements.items() for port in e.outputs]
        return tuple(sorted(".".join(port) for port in ports if port not in self.links_from))


Port: TypeAlias = tuple[str, str]
"""(node, port)."""

Ways: TypeAlias = dict[Port, list[Port]]
"""To which ports light goes on from each."""


class Stretch(NamedTuple):
    """Ports that light passes one after the other: one port, or all those of a loop."""

    ports: tuple[Port, ...]
    junctions: tuple[Port, ...] = ()


def stretches(ways: Ways) -> list[Stretch]:
    """Return the ports in the order of travel, those of a loop together; ties by name."""
    order = _in_order(ways)
    if len(order) == len(ways):
        return [Stretch((port,)) for port in order]
    came_from = backwards(ways)
    loops = {min(ports): _loop(ways, ports, came_from) for ports in cycles(ways)}
    first_of = {port: first for first, loop in loops.items() for port in loop.ports}
    onwards: Ways = {}
    for port, later in ways.items():
        first = first_of.get(port, port)
        ends = [first_of.get(end, end) for end in later]
        onwards.setdefault(first, []).extend([end for end in ends if end != first])
    return [loops.get(port) or Stretch((port,)) for port in _in_order(onwards)]


def _in_order(ways: Ways) -> list[Port]:
    """Return ports behind those that lead to them, ties by name; none that a loop leads to."""
    before = dict.fromkeys(ways, 0)
    for onwards in ways.values():
        for later in onwards:
            before[later] += 1
    ready = [port for port, count in before.items() if not count]
    heapify(ready)
    order: list[Port] = []
    while ready:
        order.append(heappop(ready))
        for later in ways[order[-1]]:
            before[later] -= 1
            if not before[later]:
                heappush(ready, later)
    return order


def cycles(ways: Ways) -> list[set[Port]]:
    """Return the ports of each loop: those that light can reach from each other."""
    core = among(ways, ways.keys() - set(_in_order(ways)))
    if not core:
        return []
    return [ports for ports in nx.strongly_connected_components(nx.DiGraph(core)) if len(ports) > 1]


def backwards(ways: Ways) -> Ways:
    """Return from which ports light comes to each."""
    result: Ways = {port: [] for port in ways}
    for port, onwards in ways.items():
        for later in onwards:
            result[later].append(port)
    return result


def reached(ways: Ways, starts: Iterable[Port]) -> set[Port]:
    """Return the ports that light reaches."""
    results = set(starts)
    waiting = list(results)
    while waiting:
        for later in ways[waiting.pop()]:
            if later not in results:
                results.add(later)
                waiting.append(later)
    return results


def among(ways: Ways, stored: set[Port]) -> Ways:
    """Return the ways between some ports alone."""
    some = [port for port in ways if port in stored]
    return {port: [later for later in ways[port] if later in stored] for port in some}


def _loop(ways: Ways, together: set[Port], before: Ways) -> Stretch:
    """Return the ports of a loop; where several lights arrive is a junction."""
    junctions = {port for port in together if len(before[port]) > 1}
    order = sorted(junctions)
    # Between junctions, light has one way to come from.
    for port in order:
        order += sorted(p for p in ways[port] if p in together and p not in junctions)
    return Stretch(tuple(order), tuple(sorted(junctions)))


_OTHER = "other light"


def sharing_faults(wiring: Wiring) -> Iterator[str]:
    """Yield a sentence for each out-port whose whole light several links would take."""
    for (name, port), links in wiring.links_from.items():
        if len(links) > 1:
            ends = listed([f"'{link[1]}.{link[2][1]}'" for link in links])
            yield Fault(
                f"port '{name}.{port}' feeds {ends}, and each would get all of its light",
                Cure.of(
                    "put one behind the other, share it by a BeamSplitter, or tap it: {}".format,
                    "connect(..., tap=True)",
                    "tap = true below its [[links]]",
                ),
            )


def tap_faults(wiring: Wiring) -> Iterator[str]:
    """Yield a sentence for each tap whose light meets other light, and would count twice.

    Its light goes on elsewhere as well, so it may reach no loop, no Combiner, and no other end.
    """
    if not wiring.taps:
        return
    onwards = wiring.untapped
    light_of: dict[Port, str] = dict.fromkeys(reached(onwards, wiring.starts), _OTHER)
    for tap in wiring.taps:
        text = f"tap '{link_text(tap)}'"
        waiting = [(tap[1], tap[2][1])]
        while waiting:
            port = waiting.pop()
            met = light_of.setdefault(port, text)
            if met is not text:
                cure = "let it end in a Detector of its own, or share it by a BeamSplitter"
                twice = f"at '{'.'.join(port)}', where it would be counted twice"
                yield f"the light of {text} meets {met} {twice}; {cure}"
                break
            waiting += [later for later in onwards[port] if light_of.get(later) is not text]
