"""Editing: nodes and links put into a graph of elements, and taken out of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from optipath.composer.placement import placement_faults
from optipath.composer.wiring import Wiring, link_text
from optipath.elements.chaining import NamedElement
from optipath.elements.element import Element
from optipath.errors import PathError, did_you_mean, listed, shown, there_are
from optipath.light.frames import Frame
from optipath.paths.joining import name_by_kind
from optipath.paths.port_names import check_port, find_port
from optipath.values.domains.quantities import ANGLE
from optipath.values.made import kept_value

if TYPE_CHECKING:
    from collections.abc import Callable

    import networkx as nx

    from optipath.composer.wiring import Link


def edit(graph: nx.MultiDiGraph, change: Callable[[nx.MultiDiGraph], None]) -> None:
    """Change a graph in place, or raise and leave it as it was."""
    trial = graph.copy()
    change(trial)
    known = placement_faults(Wiring(graph))
    if faults := [fault for fault in placement_faults(Wiring(trial)) if fault not in known]:
        raise PathError(*faults)
    change(graph)


def add(graph: nx.MultiDiGraph, name: Any, element: Any, frames: Any) -> None:
    """Add a node, as `PathGraph.add` does."""
    if isinstance(name, (Element, NamedElement)):
        meant = name.named(name_by_kind(name)) if isinstance(name, Element) else name
        raise PathError(
            f"an element is added by a name: path.add('{meant.name}', {shown(meant.element)})"
        )
    if not isinstance(name, str) or not name or "." in name:
        raise PathError(f"node name {shown(name)} must be a text without a dot; choose another")
    if name in graph:
        raise PathError(f"node '{name}' is there already; choose another name")
    check_element(name, element)
    frames = {} if frames is None else frames
    if not isinstance(frames, Mapping) or not all(
        isinstance(frame, Frame) for frame in frames.values()
    ):
        raise PathError(
            f"frames of '{name}' must be a Frame for each port, such as "
            f"{{'in': Frame()}}, not {shown(frames)}"
        )
    frames = dict(frames)
    for port in frames:
        check_port(element, name, port, (*element.inputs, *element.outputs))
    graph.add_node(name, element=element, frames=frames)


def connect(graph: nx.MultiDiGraph, leaves: Any, enters: Any, azimuth: Any, tap: Any) -> None:
    """Add a link, as `PathGraph.connect` does."""
    faults = [] if isinstance(tap, bool) else [f"tap must be True or False, not {shown(tap)}"]
    link = _link_of(graph, leaves, enters, faults)
    if graph.has_edge(*link):
        raise PathError(f"link '{link_text(link)}' is there already; remove the second one")
    turn = kept_value(f"link '{leaves} -> {enters}' azimuth", azimuth, ANGLE)
    graph.add_edge(*link, azimuth=turn, tap=tap)


def disconnect(graph: nx.MultiDiGraph, leaves: Any, enters: Any) -> None:
    """Take a link out, as `PathGraph.disconnect` does."""
    link = _only_link(graph, leaves) if enters is None else find_link(graph, leaves, enters)
    graph.remove_edge(*link)


def find_link(graph: nx.MultiDiGraph, leaves: Any, enters: Any) -> Link:
    """Return the link between two ports."""
    link = _link_of(graph, leaves, enters, [])
    if not graph.has_edge(*link):
        near = {*graph.out_edges(link[0], keys=True), *graph.in_edges(link[1], keys=True)}
        cure = did_you_mean(link_text(link), sorted(map(link_text, near)))
        cure = cure if near else there_are(sorted(map(link_text, graph.edges(keys=True))))
        raise PathError(f"there is no link '{link_text(link)}'{cure}")
    return link


def _only_link(graph: nx.MultiDiGraph, leaves: Any) -> Link:
    """Return the link from a port that has no other, taps included."""
    port = find_port(graph, leaves, out=True)
    found = graph.out_edges(port[0], keys=True)
    links: list[Link] = [link for link in found if link[2][0] == port[1]]
    if len(links) == 1:
        return links[0]
    text = ".".join(port)
    if not links:
        every = sorted(map(link_text, graph.edges(keys=True)))
        raise PathError(f"'{text}' feeds no link{there_are(every)}")
    ends = [f"'{end}.{enters}'" for _, end, (_, enters) in sorted(links)]
    raise PathError(
        f"'{text}' feeds {listed(ends)}; say which is taken out, such as "
        f"path.disconnect('{text}', {ends[0]})"
    )


def check_element(name: Any, element: Any) -> None:
    """Raise unless what is given for a node is an element."""
    if not isinstance(element, Element):
        raise PathError(
            f"node '{name}' must be an element such as Polarizer(), not {shown(element)}"
        )


def _link_of(graph: nx.MultiDiGraph, leaves: Any, enters: Any, faults: list[str]) -> Link:
    """Return the link between two ports, or raise with these faults and those of the ports."""
    ends = []
    for text, out in ((leaves, True), (enters, False)):
        try:
            ends.append(find_port(graph, text, out=out))
        except PathError as fault:
            faults += fault.faults
    if faults:
        raise PathError(*faults)
    (start, out_port), (end, in_port) = ends
    return start, end, (out_port, in_port)
