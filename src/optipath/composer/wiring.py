"""Wiring: the way of light from port to port, its order, loops and taps."""

from __future__ import annotations

from functools import cached_property
from heapq import heapify, heappop, heappush
from itertools import compress
from operator import and_
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, TypeVar, get_args

import networkx as nx

from optipath.elements.element import Alike
from optipath.elements.own_element import OwnWays, couplings_of, is_own, own_ways
from optipath.faults import Cure, Fault, listed

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Iterator

    from optipath.elements.coupling import Coupling
    from optipath.elements.element import Element
    from optipath.light.frame import Frame


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

    def changed(self, loops: str | None, keep: str) -> Wiring:
        """Return the same wiring for other loops, and for what is kept."""
        if loops is None and keep == self.keep:
            return self
        result = Wiring(self.graph, loops, keep)
        result.alike = self.alike
        return result

    @cached_property
    def _nodes(self) -> tuple[dict[str, Element], dict[str, dict[str, Frame]]]:
        elements, framed = {}, {}
        for name, about in self.graph.nodes(data=True):
            elements[name] = about["element"]
            if frames := about["frames"]:
                framed[name] = frames
        return elements, framed

    @property
    def elements(self) -> dict[str, Element]:
        """The element of each node."""
        return self._nodes[0]

    @cached_property
    def _links(self) -> tuple[list[Link], dict[Link, Any], list[Link]]:
        links, azimuths, taps = list[Link](), dict[Link, Any](), list[Link]()
        for start, ends in self.graph.adjacency():
            for end, keyed in ends.items():
                for key, about in keyed.items():
                    link = start, end, key
                    links.append(link)
                    if about["azimuth"] is not None:
                        azimuths[link] = about["azimuth"]
                    if about["tap"]:
                        taps.append(link)
        return links, azimuths, sorted(taps)

    @property
    def links(self) -> list[Link]:
        """The links, in the order of the graph."""
        return self._links[0]

    @property
    def azimuths(self) -> dict[Link, Any]:
        """The turns that links say themselves."""
        return self._links[1]

    @property
    def taps(self) -> list[Link]:
        """The links that read the light of their port, and take nothing, in order of names."""
        return self._links[2]

    @cached_property
    def turned(self) -> frozenset[str]:
        """The nodes whose elements turn the links to them."""
        turns = [(name, getattr(e, "azimuth", 0.0)) for name, e in self.elements.items()]
        return frozenset([name for name, turn in turns if type(turn) is not float or turn])

    @cached_property
    def framed_links(self) -> frozenset[Link]:
        """The links with an azimuth of their own, or frames in the world at an end."""
        azimuths, placed = self.azimuths, self.placed
        if not placed:
            return frozenset(azimuths)
        some = [link for link in self.links if not placed.isdisjoint(link[:2])]
        return frozenset(azimuths).union(some)

    def may_turn(self, link: Link) -> bool:
        """Tell whether a link may turn frames."""
        return link[1] in self.turned or link in self.framed_links

    @cached_property
    def placed(self) -> frozenset[str]:
        """The nodes with frames in the world, by their own values or given."""
        return self.self_placed.union(self.framed)

    @cached_property
    def self_placed(self) -> frozenset[str]:
        """The nodes whose elements have frames by their own values."""
        return frozenset([name for name, e in self.elements.items() if e.self_placed])

    @property
    def framed(self) -> dict[str, dict[str, Frame]]:
        """The frames in the world of the ports of each node that has some."""
        return self._nodes[1]

    @cached_property
    def couplings(self) -> dict[str, tuple[Coupling, ...]]:
        """The ways through the element of each node."""
        known: dict[int, tuple[Coupling, ...]] = {}
        results: dict[str, tuple[Coupling, ...]] = {}
        for name, element in self.alike.items():
            if (couplings := known.get(id(element))) is None:
                couplings = known[id(element)] = couplings_of(element)
            results[name] = couplings
        return results

    @cached_property
    def alike(self) -> Alike:
        """For each node, the first element that is equal to its own."""
        return Alike(self.elements)

    def own_ways(self, method: str = "stable") -> list[OwnWays]:
        """Return the ways through elements of a user's own that are to be looked at."""
        names = self.alike.where(lambda element: is_own(type(element)))
        each = [own_ways(name, self.elements[name], self.couplings[name], method) for name in names]
        return [way for ways in each for way in ways]

    @cached_property
    def links_to(self) -> dict[Port, list[Link]]:
        """The links that arrive at each in-port, in order of their names."""
        return _by_port([((link[1], link[2][1]), link) for link in self.links])

    @cached_property
    def links_from(self) -> dict[Port, list[Link]]:
        """The links that take the light of each out-port, in order of their names; no taps."""
        taps = {*self.taps}
        links = [link for link in self.links if link not in taps] if taps else self.links
        return _by_port([((link[0], link[2][0]), link) for link in links])

    @cached_property
    def _places(self) -> dict[str, tuple[int, dict[str, int]]]:
        """Of each node, the number of its first port, and the places of its ports from there."""
        known: dict[type, dict[str, int]] = {}
        results: dict[str, tuple[int, dict[str, int]]] = {}
        first, elements = 0, self.elements
        for name in sorted(elements):
            kind = type(elements[name])
            if (places := known.get(kind)) is None:
                ports = sorted((*kind.inputs, *kind.outputs))
                places = known[kind] = {port: at for at, port in enumerate(ports)}
            results[name] = first, places
            first += len(places)
        return results

    @cached_property
    def ports(self) -> list[Port]:
        """All ports, in order of their names; their places are their numbers."""
        return [(name, port) for name, (_, places) in self._places.items() for port in places]

    def number(self, name: str, port: str) -> int:
        """Return the number of a port."""
        first, places = self._places[name]
        return first + places[port]

    @cached_property
    def ways(self) -> list[list[int]]:
        """To which ports light goes on from each: by links, and by couplings inside of elements."""
        ways: list[list[int]] = [[] for _ in self.ports]
        places = self._places
        for name, couplings in self.couplings.items():
            first, at = places[name]
            for coupling in couplings:
                if coupling.enters is not None:
                    ways[first + at[coupling.enters]].append(first + at[coupling.leaves])
        for start, end, (leaves, enters) in self.links:
            (first, at), (later, there) = places[start], places[end]
            ways[first + at[leaves]].append(later + there[enters])
        # A link that carries no light is a fault of its own, and not one of reach as well.
        for start, _, (leaves, _) in self.dark_links:
            for enters in self.elements[start].inputs:
                ways[self.number(start, enters)].append(self.number(start, leaves))
        return ways

    def _named(self, *, taps: bool) -> Ways:
        """Return the ways from port to port by their names, with those of taps or without."""
        ports, left_out = self.ports, set[tuple[int, int]]()
        for start, end, (leaves, enters) in () if taps else self.taps:
            left_out.add((self.number(start, leaves), self.number(end, enters)))
        return {
            ports[at]: [ports[to] for to in sorted(onwards) if (at, to) not in left_out]
            for at, onwards in enumerate(self.ways)
        }

    @cached_property
    def untapped(self) -> Ways:
        """The ways from port to port, those of taps left out."""
        return self._named(taps=False)

    @cached_property
    def starts(self) -> list[Port]:
        """The ports where light begins."""
        ways = self.couplings.items()
        return [(name, c.leaves) for name, several in ways for c in several if c.enters is None]

    @cached_property
    def ends(self) -> list[Port]:
        """The ports where light ends: in-ports of elements with no way out."""
        ends = [(name, e.inputs) for name, e in self.elements.items() if not e.outputs]
        return [(name, port) for name, ports in ends for port in ports]

    def is_lit(self, name: str, port: str) -> bool:
        """Tell whether light reaches a port."""
        return bool(self._reach[0][self.number(name, port)])

    @property
    def lit_nodes(self) -> set[str]:
        """The nodes that light reaches."""
        return {name for name, _ in compress(self.ports, self._reach[0])}

    @property
    def useful_nodes(self) -> set[str]:
        """The nodes from which light reaches an end."""
        return {name for name, _ in compress(self.ports, self._reach[1])}

    @cached_property
    def _in_line(self) -> list[int]:
        """All ports in order, without those of cycles, and those that a cycle leads to."""
        return _in_order(self.ways)

    @cached_property
    def _reach(self) -> tuple[bytearray, bytearray]:
        """Of each port, whether light reaches it, and whether it reaches an end from there."""
        ways, order = self.ways, self._in_line
        lit, useful = bytearray(len(ways)), bytearray(len(ways))
        for ports, signs in ((self.starts, lit), (self.ends, useful)):
            for port in ports:
                signs[self.number(*port)] = True
        if len(order) < len(ways):
            there = dict(enumerate(ways))
            for onwards, signs in ((there, lit), (backwards(there), useful)):
                for at in reached(onwards, [*compress(there, signs)]):
                    signs[at] = True
            return lit, useful
        for at in order:
            if lit[at]:
                for later in ways[at]:
                    lit[later] = True
        for at in reversed(order):
            for later in ways[at]:
                if useful[later]:
                    useful[at] = True
        return lit, useful

    @cached_property
    def stretches(self) -> list[Stretch]:
        """The ports that light passes (from a start to an end) in order; loops together.

        Without loops, one stretch has them all.
        """
        lit, useful = self._reach
        passed = lit if self.keep == "all" else bytes(map(and_, lit, useful))
        if len(self._in_line) == len(self.ways):
            ports = self.ports
            return [Stretch(tuple([ports[at] for at in self._in_line if passed[at]]))]
        return stretches(among(self._named(taps=True), {*compress(self.ports, passed)}))

    @property
    def cycles(self) -> list[set[Port]]:
        """The ports of each cycle, those of taps left out, whether light gets there or not."""
        return [] if len(self._in_line) == len(self.ways) else cycles(self.untapped)

    @cached_property
    def order(self) -> dict[Port, int]:
        """The place of each port in the order of travel."""
        travelled = (port for stretch in self.stretches for port in stretch.ports)
        return {port: place for place, port in enumerate(travelled)}

    @cached_property
    def dark_links(self) -> list[Link]:
        """The links from out-ports that no coupling gives light to."""
        lit: dict[int, set[str]] = {}  # Equal elements share their couplings.
        for ways in self.couplings.values():
            if id(ways) not in lit:
                lit[id(ways)] = {coupling.leaves for coupling in ways}
        known = self.couplings
        return sorted([link for link in self.links if link[2][0] not in lit[id(known[link[0]])]])

    @cached_property
    def outlets(self) -> tuple[str, ...]:
        """The out-ports whose light no link takes: it leaves the path, read by taps or not."""
        taken = self.links_from
        ports = [(name, port) for name, e in self.elements.items() for port in e.outputs]
        return tuple(sorted([".".join(port) for port in ports if port not in taken]))


def _by_port(pairs: Iterable[tuple[Port, Link]]) -> dict[Port, list[Link]]:
    """Return the links of each port, in order of their names."""
    results: dict[Port, list[Link]] = {}
    for port, link in pairs:
        results.setdefault(port, []).append(link)
    for _, links in where_several(results):
        links.sort()
    return results


def where_several(links_at: dict[Port, list[Link]]) -> list[tuple[Port, list[Link]]]:
    """Return the ports at which several links are, in order, with these."""
    return sorted([(port, links) for port, links in links_at.items() if len(links) > 1])


Port: TypeAlias = tuple[str, str]
"""(node, port)."""

Ways: TypeAlias = dict[Port, list[Port]]
"""To which ports light goes on from each."""


P = TypeVar("P", bound="Hashable")
"""A port, or its number."""


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


def _in_order(ways: Any) -> list[Any]:
    """Return ports behind those that lead to them, ties by name; none that a loop leads to.

    They are keys, or numbers in order of their names.
    """
    numbered = isinstance(ways, list)
    before: Any = [0] * len(ways) if numbered else dict.fromkeys(ways, 0)
    for onwards in ways if numbered else ways.values():
        for later in onwards:
            before[later] += 1
    ready = [port for port in (range(len(ways)) if numbered else ways) if not before[port]]
    heapify(ready)
    order: list[Any] = []
    while ready:
        order.append(heappop(ready))
        for later in ways[order[-1]]:
            before[later] -= 1
            if not before[later]:
                heappush(ready, later)
    return order


def cycles(ways: Ways) -> list[set[Port]]:
    """Return the ports of each loop: those that light can reach from each other."""
    if not (core := among(ways, ways.keys() - set(_in_order(ways)))):
        return []
    return [ports for ports in nx.strongly_connected_components(nx.DiGraph(core)) if len(ports) > 1]


def backwards(ways: dict[P, list[P]]) -> dict[P, list[P]]:
    """Return from which ports light comes to each."""
    result: dict[P, list[P]] = {port: [] for port in ways}
    for port, onwards in ways.items():
        for later in onwards:
            result[later].append(port)
    return result


def reached(ways: dict[P, list[P]], starts: Iterable[P]) -> set[P]:
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
    for (name, port), links in where_several(wiring.links_from):
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
