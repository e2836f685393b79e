"""Reversal: a graph of elements run the other way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.media import with_followed
from optipath.composer.meetings import Meetings
from optipath.composer.placement import azimuth_of, frame_at, is_zero
from optipath.composer.wiring import Wiring, link_text, where_several
from optipath.elements.boundary import BoundaryElement
from optipath.elements.coupling import vanishes
from optipath.elements.element import Element
from optipath.elements.ends import Detector, Dump, Source
from optipath.errors import OptipathError, PathError
from optipath.faults import did_you_mean, listed, shown, there_are
from optipath.kernels.kernel import called
from optipath.paths.editing import find_port
from optipath.paths.element_graph import Attributes, ElementGraph
from optipath.values.arrays import changed, same

if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterable, Iterator

    import networkx as nx

    from optipath.composer.wiring import Link, Port
    from optipath.light.frame import Frame
    from optipath.paths.binding import PlaceChoice
    from optipath.values.cases import Case


_SAME = 1e-9
"""Up to what angle two frames of a vertex are one."""


def reversed_graph(graph: nx.MultiDiGraph, source: Any = None) -> ElementGraph:
    """Return a graph of elements in which light goes the other way."""
    filled, faults = with_followed(graph)
    PathError.raise_for(faults)
    turning = _Turning(Wiring(filled))
    sources, faults = sources_by_name(source, turning.before)
    turning.reverse_elements(sources)
    PathError.raise_for([*faults, *turning.faults, *turning.link_faults()])
    choices = reversed_choices(turning.wiring, turning.port)
    result = ElementGraph()
    result.graph.update(graph.graph, choices=choices)
    for name in [*graph][::-1]:
        frames = Attributes(turning.frames(name))
        result.add_node(name, element=turning.elements[name], frames=frames)
    for link in [*graph.edges(keys=True)][::-1]:
        start, end, (leaves, enters) = link
        key = turning.port(end, enters), turning.port(start, leaves)
        about = {**graph.edges[link], "azimuth": turning.azimuth(link), "tap": False}
        result.add_edges_from([(end, start, key, about)])
    return result


def reversed_cases(
    cases: Mapping[str, Case], choices: Iterable[str], known: Container[str]
) -> dict[str, Case]:
    """Return the cases that are left where light goes the other way, and these names are known."""
    gone = [name for name in choices if name not in known]
    results = {name: one for name, one in cases.items() if one.values.keys().isdisjoint(gone)}
    for name, one in results.items():
        left = {argument: value for argument, value in one.values.items() if argument in known}
        results[name] = replace(one, values=left, published={})
    return results


class _Turning:
    """Turns round what stands at the nodes of a graph, and the links between them."""

    def __init__(self, wiring: Wiring) -> None:
        self.wiring = wiring
        self.before = wiring.elements
        self.elements: dict[str, Element] = {}
        self.faults: list[str] = []

    def reverse_elements(self, sources: dict[str, Element]) -> None:
        """Reverse the element of each node; light begins at the ends as it is told."""
        meetings = Meetings(self.wiring)
        wedges = {n for n, e in self.before.items() if getattr(e, "parallel", True) is False}
        tilted = [m for m in meetings.all if m.enters[0] in wedges and meetings.may_be_shown(m)]
        at_angle = {meeting.leaves[0] for meeting in tilted}
        known: dict[int, Element] = {}
        for name, element in self.before.items():
            if not element.inputs or not element.outputs:
                self.elements[name] = reversed_end(element, sources.get(name))
                continue
            try:
                if id(element) not in known:
                    known[id(element)] = _reversed(element)
            except OptipathError as fault:
                self.faults += [each.under(f"'{name}'") for each in fault.faults]
                continue
            back, is_parallel = known[id(element)], name not in at_angle
            if isinstance(back, BoundaryElement) and vars(back)["parallel"] is not is_parallel:
                back = changed(back, parallel=is_parallel)
            self.elements[name] = back
        self._share_arrays()

    def _share_arrays(self) -> None:
        """Let elements that share an array share its reverse: the vertices of one chain do."""
        made: dict[tuple[int, str], Any] = {}
        for name, back in self.elements.items():
            for field in back.domains():
                value, there = getattr(back, field), getattr(self.before[name], field, None)
                if isinstance(there, np.ndarray) and value is not there:
                    shared = made.setdefault((id(there), field), value)
                    if shared is not value and same(shared, value):
                        self.elements[name] = changed(self.elements[name], **{field: shared})

    def port(self, name: str, port: str) -> str:
        """Return the port where reversed light leaves that came in at another; empty if unknown."""
        element = self.before[name]
        if not element.inputs:
            return "in"
        if not element.outputs:
            return self.elements[name].outputs[0]
        return str(called(f"port_back of element class {_named(element)}", element.port_back, port))

    def link_faults(self) -> Iterator[str]:
        """Yield what has no way back of the links, a sentence each."""
        for tap in self.wiring.taps:
            yield f"link '{link_text(tap)}' is a tap, which has no way back; take it out"
        for (name, port), several in where_several(self.wiring.links_to):
            links = [link for link in several if link not in self.wiring.taps]
            # What adds up inside of an element has been told.
            if len(links) > 1 and not (self.before[name].merges and self.before[name].outputs):
                feeders = listed([f"'{start}.{leaves}'" for start, _, (leaves, _) in links])
                cure = "which has no way back; give each a detector of its own"
                yield f"light of {feeders} adds up at '{name}.{port}', {cure}"
        used = {end for link in self.wiring.graph.edges(keys=True) for end in _ends(link)}
        for name in sorted({name for name, port in used if not self._has_back(name, port)}):
            cure = "by which port light goes back; give it a class method port_back(port)"
            yield f"'{name}': element class {_named(self.before[name])} does not say {cure}"

    def _has_back(self, name: str, port: str) -> bool:
        """Tell whether light may go back by a port of a node."""
        element = self.before[name]
        if not element.inputs or not element.outputs:
            return True
        back = self.elements.get(name, element)
        return self.port(name, port) in (back.outputs if port in element.inputs else back.inputs)

    def frames(self, name: str) -> dict[str, Frame]:
        """Return the world frames of a node: those of light that goes back."""
        argument = self.wiring.graph.nodes[name]["frames"]
        results = {self.port(name, port): frame.reversed() for port, frame in argument.items()}
        if results or self.before[name].outputs:
            return results
        # A detector reads light in the frame that it arrives in; a source has one of its own.
        for start, _, (leaves, enters) in self.wiring.graph.in_edges(name, keys=True):
            if (frame := frame_at(self.wiring, start, leaves)) is not None:
                results[self.port(name, enters)] = frame.reversed()
        return results

    def azimuth(self, link: Link) -> Any:
        """Return the azimuth of a link on the way back, which is that on the way there."""
        azimuth = azimuth_of(self.wiring, link)
        own = self.wiring.graph.edges[link]["azimuth"]
        twist = self._twist(link)
        if np.any(twist):
            return azimuth + twist
        return None if own is None and is_zero(azimuth) else azimuth

    def _twist(self, link: Link) -> Any:
        """Return the turn by a link at a vertex without plane, whose x is that of arrival."""
        ends = _ends(link)
        placed = [name in self.wiring.self_placed for name, _ in ends]
        others = [self.before[name] for name, _ in ends if name not in self.wiring.self_placed]
        if placed[0] == placed[1] or not (others[0].inputs and others[0].outputs):
            return 0.0
        name, port = ends[placed.index(True)]
        there = self.before[name].own_frame(port)
        back = self.elements[name].own_frame(self.port(name, port))
        if there is None or back is None or there.names:
            return 0.0  # What is open are angles, which tell the plane.
        c, s = there.frame({}).reversed().turn_to(back.frame({}))
        turn = 0.5 * np.arctan2(s, c)
        turn = np.where(np.abs(turn) > _SAME, turn, 0.0)[()]
        return turn if placed[0] else -turn


def _ends(link: Link) -> tuple[Port, Port]:
    start, end, (leaves, enters) = link
    return (start, leaves), (end, enters)


def _named(element: Element) -> str:
    return type(element).__name__


def _reversed(element: Element) -> Element:
    """Return an element on the way back, which links turn in place of its azimuth."""
    if not is_zero(getattr(element, "azimuth", 0.0)):
        element = changed(element, azimuth=0.0)
    what = f"reversed() of element class {_named(element)}"
    back = called(what, element.reversed)
    if not isinstance(back, Element):
        raise PathError(f"{what} gives {shown(back)}; return an element")
    return back


def reversed_choices(
    wiring: Wiring, port_back: Callable[[str, str], str]
) -> dict[str, PlaceChoice]:
    """Return the choices of a path that stay the same choices on the way back.

    They do if nothing turns between the ports beside a place: a node has the frame of its arrival.
    """
    choices: dict[str, PlaceChoice] = wiring.graph.graph["choices"]
    movable = {choice.node for choice in choices.values()}
    results = {}
    for name, choice in choices.items():
        ports = [_next_port(wiring, choice.node, port) for port in choice.behind.values()]
        behind = {
            word: f"{port[0]}.{port_back(*port)}"
            for word, port in zip(choice.behind, ports, strict=True)
            if port is not None and port[0] not in movable
        }
        if len(behind) == len(ports):
            results[name] = replace(choice, behind=behind)
    return results


def _next_port(wiring: Wiring, node: str, behind: str) -> Port | None:
    """Return the port that comes behind a place of a node; None where something is turned."""
    try:
        port = find_port(wiring.graph, behind, out=True)
    except PathError:
        return None
    if frame_at(wiring, *port) is not None:
        return None
    while len(links := wiring.links_from.get(port, [])) == 1:
        (link,) = links
        if not is_zero(azimuth_of(wiring, link)):
            return None
        _, end, (_, enters) = link
        if end != node:
            return end, enters
        port = node, wiring.elements[node].natural
    return None


def reversed_end(element: Element, source: Element | None = None) -> Element:
    """Return what stands on the way back where light began or ended."""
    if not element.inputs:
        return Dump() if vanishes(getattr(element, "intensity", 1.0)) else Detector()
    return source or Source(1.0 if element.detects else 0.0)


def sources_by_name(
    arguments: Any, elements: Mapping[str, Element]
) -> tuple[dict[str, Element], list[str]]:
    """Return the light that begins at each node, and what is wrong with it, a sentence each."""
    ends = [name for name, element in elements.items() if not element.outputs]
    if arguments is None:
        return {}, []
    if not isinstance(arguments, Mapping):
        detectors = [name for name in ends if elements[name].detects]
        if len(detectors) != 1:
            fault = f"source is of one of {len(detectors)} detectors; give it by name"
            return {}, [fault + there_are(ends)]
        arguments = {detectors[0]: arguments}
    sources, faults = {}, []
    for name, one in arguments.items():
        if name not in ends:
            near = did_you_mean(name, ends)
            faults.append(f"source[{shown(name)}]: no light ends there{near}")
        elif not isinstance(one, Element) or one.inputs or len(one.outputs) != 1:
            faults.append(f"source[{shown(name)}] must be a Source, not {shown(one)}")
        else:
            sources[name] = one
    return sources, faults
