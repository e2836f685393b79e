"""Editing: nodes and links added, inserted, removed and replaced."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from optipath.composer.placement import (
    azimuth_of,
    frame_at,
    goes_straight,
    is_zero,
    placement_faults,
    turn_text,
)
from optipath.composer.wiring import Wiring, link_text
from optipath.elements.element import Element
from optipath.elements.frame_checks import azimuth_at
from optipath.errors import PathError, collecting, did_you_mean, listed, shown, there_are
from optipath.light.frame import Frame
from optipath.materials.quantities import ANGLE
from optipath.paths.joining import (
    are_alike,
    check_port,
    element_at,
    find_port,
    natural_port,
    turn_more,
)
from optipath.values.use import stored_value

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

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
    if not isinstance(name, str) or not name or "." in name:
        raise PathError(
            f"node name {shown(name)} must be a text without a dot, as in "
            f"path.add('filter', Polarizer())"
        )
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
    turn = stored_value(f"link '{leaves} -> {enters}' azimuth", azimuth, ANGLE)
    graph.add_edge(*link, azimuth=turn, tap=tap)


def disconnect(graph: nx.MultiDiGraph, leaves: Any, enters: Any) -> None:
    """Take a link out, as `PathGraph.disconnect` does."""
    link = _only_link(graph, leaves) if enters is None else find_link(graph, leaves, enters)
    graph.remove_edge(*link)


def find_link(graph: nx.MultiDiGraph, leaves: Any, enters: Any) -> Link:
    """Return the link between two ports."""
    link = _link_of(graph, leaves, enters, [])
    if not graph.has_edge(*link):
        every = sorted(map(link_text, graph.edges(keys=True)))
        raise PathError(
            f"there is no link '{link_text(link)}'{did_you_mean(link_text(link), every)}"
        )
    return link


def _only_link(graph: nx.MultiDiGraph, leaves: Any) -> Link:
    """Return the link from a port that has no other, taps included."""
    port = find_port(graph, leaves, out=True)
    result = graph.out_edges(port[0], keys=True)
    links: list[Link] = [link for link in result if link[2][0] == port[1]]
    if len(links) != 1:
        every = sorted(map(link_text, links or graph.edges(keys=True)))
        raise PathError(
            f"'{'.'.join(port)}' feeds {_listed(links)}; name both ends of one{there_are(every)}"
        )
    return links[0]


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
        with collecting(faults, PathError):
            ends.append(find_port(graph, text, out=out))
    if faults:
        raise PathError(*faults)
    (start, out_port), (end, in_port) = ends
    return start, end, (out_port, in_port)


def insert(graph: nx.MultiDiGraph, name: Any, element: Any, behind: Any, before: Any) -> None:
    """Put an element into a link, as `PathGraph.insert` does."""
    check_element(name, element)
    enters, passes = (natural_port(element, name, out=out) for out in (False, True))
    link = _link_for(graph, name, behind, before)
    start, end, (leaves, arrives) = link
    frame = frame_at(Wiring(graph), start, leaves) if element.straight else None
    add(graph, name, element, None if frame is None else {enters: frame})
    if element.straight and frame is None:
        # What stands behind it stays as it was turned.
        turn_more(graph, link, -_own_turn(element))
    about = graph.edges[link]
    azimuth, tap = about["azimuth"], about["tap"]
    graph.remove_edge(*link)
    graph.add_edge(start, name, key=(leaves, enters), azimuth=None, tap=tap)
    graph.add_edge(name, end, key=(passes, arrives), azimuth=azimuth, tap=False)


def remove(graph: nx.MultiDiGraph, name: Any) -> None:
    """Take a node out, as `PathGraph.remove` does."""
    element_at(graph, name)
    before, behind = graph.in_edges(name, keys=True), graph.out_edges(name, keys=True)
    if before and behind:
        _close(graph, name, list(before), list(behind))
    graph.remove_node(name)


def replace(graph: nx.MultiDiGraph, name: Any, element: Any) -> None:
    """Put another element in the place of one, as `PathGraph.replace` does."""
    element_at(graph, name)
    check_element(name, element)
    entered = {enters for *_, (_, enters) in graph.in_edges(name, keys=True)}
    left = {leaves for *_, (leaves, _) in graph.out_edges(name, keys=True)}
    placed = {*graph.nodes[name]["frames"]} - {*element.inputs, *element.outputs}
    missing = (entered - {*element.inputs}) | (left - {*element.outputs}) | placed
    if missing:
        ports = ", ".join(f"'{name}.{port}'" for port in sorted(missing))
        raise PathError(
            f"the new element of '{name}' has no {ports}, which links or frames use; take "
            f"'{name}' out and add it anew"
        )
    if said := _turned_by_links(graph, name, element):
        for link in said:
            graph.edges[link]["azimuth"] = None
    elif graph.nodes[name]["element"].straight and element.straight:
        _turn_back(graph, name, element)
    else:
        _check_turn(graph, name, element)
    graph.nodes[name]["element"] = element


def _turned_by_links(graph: nx.MultiDiGraph, name: str, element: Element) -> list[Link]:
    """Return the links that turn a node if they say what another element says by itself."""
    links = [
        link
        for link in graph.in_edges(name, keys=True)
        if graph.edges[link]["azimuth"] is not None and not is_zero(azimuth_at(element, link[2][1]))
    ]
    for link in links:
        turn = graph.edges[link]["azimuth"]
        if not are_alike(turn, _own_turn(element)):
            raise PathError(
                f"link '{link_text(link)}' turns '{name}' by {turn_text(turn)}, and the new "
                f"element is turned by {turn_text(_own_turn(element))}; leave the azimuth of the "
                f"new element out to have it turned as the old one is"
            )
    return links


def _turn_back(graph: nx.MultiDiGraph, name: str, element: Element) -> None:
    """Turn what stands behind a node by as much as another element turns it less."""
    if graph.nodes[name]["frames"]:
        return  # World frames say how it stands.
    old = _own_turn(graph.nodes[name]["element"])
    for link in [link for link in graph.out_edges(name, keys=True) if link[1] != name]:
        turn_more(graph, link, old)
        turn_more(graph, link, -_own_turn(element))


def _link_for(graph: nx.MultiDiGraph, name: Any, behind: Any, before: Any) -> Link:
    """Return the one link behind a port, before another, or both."""
    if behind is None and before is None:
        raise PathError(
            f"path.insert('{name}', ...) names no link; give behind='node.port', where light "
            f"leaves, or before='node.port', where it arrives"
        )
    if behind is not None and before is not None:
        return find_link(graph, behind, before)
    wiring, is_behind = Wiring(graph), behind is not None
    port = find_port(graph, behind if is_behind else before, out=is_behind)
    links = (wiring.links_from if is_behind else wiring.links_to).get(port, [])
    if len(links) == 1:
        return links[0]
    feeds = "feeds" if is_behind else "is fed by"
    cure = "; name both ends, by behind and before" if links else ""
    raise PathError(
        f"'{name}' is put into one link, but '{'.'.join(port)}' {feeds} {_listed(links)}{cure}"
    )


def _own_turn(element: Element) -> Any:
    return getattr(element, "azimuth", 0.0)


def _check_turn(graph: nx.MultiDiGraph, name: str, element: Element) -> None:
    """Raise if a node was turned by its azimuth, and would not be by that of another element."""
    wiring, azimuth = Wiring(graph), _own_turn(graph.nodes[name]["element"])
    links = [
        link
        for link in graph.in_edges(name, keys=True)
        if graph.edges[link]["azimuth"] is None and not is_zero(azimuth_of(wiring, link))
    ]
    if not links or not is_zero(_own_turn(element)):
        return
    raise PathError(
        f"'{name}' is turned by its azimuth {turn_text(azimuth)}, and the new element is not; give "
        f"it that azimuth, or take the link out and connect it anew with azimuth=0.0"
    )


def _close(graph: nx.MultiDiGraph, name: str, before: list[Link], behind: list[Link]) -> None:
    """Link what stands before a node with what stands behind it."""
    if len(before) > 1 or len(behind) > 1 or before[0][1] == before[0][0]:
        raise PathError(
            f"several links meet at '{name}', {_listed([*before, *behind])}; disconnect those that "
            f"are to go first"
        )
    wiring = Wiring(graph)
    ((start, _, (leaves, enters)),), ((_, end, (passes, arrives)),) = before, behind
    if not goes_straight(wiring.elements[name], enters, passes):
        raise PathError(
            f"light does not go straight through '{name}'; disconnect "
            f"{_listed([*before, *behind])} first"
        )
    if graph.has_edge(start, end, key=(leaves, arrives)):
        raise PathError(
            f"link '{start}.{leaves} -> {end}.{arrives}' is there already; disconnect it first"
        )
    turn_more(graph, behind[0], azimuth_of(wiring, before[0]))
    about = graph.edges[behind[0]]
    tap = graph.edges[before[0]]["tap"] or about["tap"]
    graph.add_edge(start, end, key=(leaves, arrives), azimuth=about["azimuth"], tap=tap)


def _listed(links: Iterable[Link]) -> str:
    return listed([f"'{link_text(link)}'" for link in links] or ["no link"])
