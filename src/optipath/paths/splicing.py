"""Splicing: elements put into the links of a graph, taken out of them, and exchanged."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.placement import azimuth_of, frame_at, goes_straight, is_zero
from optipath.composer.taps import taken_out
from optipath.composer.wiring import Wiring, link_text
from optipath.errors import PathError, listed, shown
from optipath.paths.editing import add, check_element
from optipath.paths.port_names import element_at, find_port, natural_port
from optipath.values.arrays.read_only import same
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterable

    import networkx as nx

    from optipath.composer.wiring import Link
    from optipath.elements.element import Element


def insert(graph: nx.MultiDiGraph, name: Any, element: Any, behind: Any) -> None:
    """Put an element into a link, as `PathGraph.insert` does.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        Elements and links, changed in place.
    name, element, behind
        As that takes them.
    """
    check_element(name, element)
    start, leaves = find_port(graph, behind, out=True)
    enters, passes = (natural_port(element, name, out=out) for out in (False, True))
    wiring = Wiring(graph)
    links = wiring.links_from.get((start, leaves), [])
    if len(links) != 1:
        cure = f"take all but one out first, by {taken_out(wiring, links)}"
        if not links:
            cure = f"write path.add('{name}', ...) and path.connect('{start}.{leaves}', '{name}')"
        raise PathError(
            f"'{start}.{leaves}' feeds {_listed(links)}, and not one link that '{name}' could be "
            f"put into; {cure}"
        )
    (link,) = links
    own, azimuth = getattr(element, "azimuth", 0.0), graph.edges[link]["azimuth"]
    if element.straight and not is_zero(own):
        # What stands behind it stays as it was turned.
        azimuth = _turned_more(wiring, link, -own, name)
    frame = frame_at(wiring, start, leaves) if element.straight else None
    add(graph, name, element, None if frame is None else {enters: frame})
    graph.remove_edge(*link)
    graph.add_edge(start, name, key=(leaves, enters), azimuth=None, tap=False)
    graph.add_edge(name, link[1], key=(passes, link[2][1]), azimuth=azimuth, tap=False)


def remove(graph: nx.MultiDiGraph, name: Any) -> None:
    """Take a node out, as `PathGraph.remove` does.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        Elements and links, changed in place.
    name
        As that takes them.
    """
    element_at(graph, name)
    before, behind = graph.in_edges(name, keys=True), graph.out_edges(name, keys=True)
    if before and behind:
        _close(graph, name, list(before), list(behind))
    graph.remove_node(name)


def replace(graph: nx.MultiDiGraph, name: Any, element: Any) -> None:
    """Put another element in the place of one, as `PathGraph.replace` does.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        Elements and links, changed in place.
    name, element
        As that takes them.
    """
    element_at(graph, name)
    check_element(name, element)
    entered = {enters for *_, (_, enters) in graph.in_edges(name, keys=True)}
    left = {leaves for *_, (leaves, _) in graph.out_edges(name, keys=True)}
    placed = {*graph.nodes[name]["frames"]} - {*element.inputs, *element.outputs}
    missing = (entered - {*element.inputs}) | (left - {*element.outputs}) | placed
    if missing:
        lost = listed([f"'{name}.{port}'" for port in sorted(missing)])
        ports = [f"'{name}.{port}'" for port in (*element.inputs, *element.outputs)]
        raise PathError(
            f"the new element of '{name}' has no {lost}, which links or frames use; it has "
            f"{listed(ports)}: disconnect the others first, or take '{name}' out and add it anew"
        )
    _check_turn(graph, name, element)
    graph.nodes[name]["element"] = element


def _check_turn(graph: nx.MultiDiGraph, name: str, element: Element) -> None:
    """Raise if a node was turned by its azimuth, and would not be by that of another element."""
    azimuth = getattr(graph.nodes[name]["element"], "azimuth", 0.0)
    links = [
        link for link in graph.in_edges(name, keys=True) if graph.edges[link]["azimuth"] is None
    ]
    if is_zero(azimuth) or not links or not is_zero(getattr(element, "azimuth", 0.0)):
        return
    turn = azimuth.formula if isinstance(azimuth, Parameter) else shown(azimuth)
    takes = f"give it azimuth=path.element('{name}').azimuth, or " * hasattr(element, "azimuth")
    ports = f"'{links[0][0]}.{links[0][2][0]}', '{name}.{links[0][2][1]}'"
    raise PathError(
        f"'{name}' is turned by its azimuth {turn}, and the new element is not; {takes}give an "
        f"azimuth, 0.0 for none, to the link: path.disconnect({ports}), then "
        f"path.connect({ports}, azimuth=...)"
    )


def _close(graph: nx.MultiDiGraph, name: str, before: list[Link], behind: list[Link]) -> None:
    """Link what stands before a node with what stands behind it."""
    if len(before) > 1 or len(behind) > 1 or before[0][1] == before[0][0]:
        raise PathError(
            f"several links meet at '{name}', {_listed([*before, *behind])}, so nothing tells "
            f"how to close the gap; disconnect those that are to go first"
        )
    wiring = Wiring(graph)
    ((start, _, (leaves, enters)),), ((_, end, (passes, arrives)),) = before, behind
    if not goes_straight(wiring.elements[name], enters, passes):
        raise PathError(
            f"light does not go straight through '{name}', so nothing tells how what stands "
            f"before and behind it would stand to each other; disconnect "
            f"{_listed([*before, *behind])} first"
        )
    azimuth, turn = graph.edges[behind[0]]["azimuth"], azimuth_of(wiring, before[0])
    if not is_zero(turn):
        azimuth = _turned_more(wiring, behind[0], turn, name)
    if graph.has_edge(start, end, key=(leaves, arrives)):
        raise PathError(
            f"without '{name}' there would be two links '{start}.{leaves} -> {end}.{arrives}'; "
            f"disconnect the one that there is first"
        )
    tap = graph.edges[before[0]]["tap"] or graph.edges[behind[0]]["tap"]
    graph.add_edge(start, end, key=(leaves, arrives), azimuth=azimuth, tap=tap)


def _turned_more(wiring: Wiring, link: Link, turn: Any, name: str) -> Any:
    """Return the azimuth of a link that turns what it leads to by more than it did."""
    own = wiring.graph.edges[link]["azimuth"]
    if own is None and is_zero(azimuth_of(wiring, link)):
        return turn
    if own is not None and same(own, -turn):
        return None
    if all(isinstance(part, (int, float, np.ndarray)) for part in (own, turn)):
        return own + turn
    raise PathError(
        f"'{name}' has an azimuth, and so has '{link[1]}' behind it, and no one azimuth does for "
        f"both; say how '{name}' is turned by its angle, and leave its azimuth out"
    )


def _listed(links: Iterable[Link]) -> str:
    return listed([f"'{link_text(link)}'" for link in links] or ["no link"])
