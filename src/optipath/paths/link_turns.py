"""Turns of links: what stands behind a link, turned by more than it was."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.placement import azimuth_of, goes_straight, is_zero, turn_text
from optipath.composer.wiring import Wiring
from optipath.errors import OptipathError, PathError
from optipath.values.arrays.read_only import read_only, same
from optipath.values.arrays.shapes import joint_shape
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    import networkx as nx

    from optipath.composer.wiring import Link


def turn_more(graph: nx.MultiDiGraph, link: Link, turn: Any, cure: str = "") -> None:
    """Turn what a link leads to by more than it is, in place.

    An azimuth of the element there goes over to its links, since one place has to say it.

    Units: turn in radians.
    """
    if is_zero(turn):
        return
    before = azimuth_of(Wiring(graph), link)
    try:
        total = _sum(before, turn)
    except OptipathError:
        start, end, (leaves, arrives) = link
        apart = (
            f"put an element that does nothing between them first, path.insert('between', "
            f"Attenuator(1.0), behind='{start}.{leaves}', before='{end}.{arrives}')"
        )
        raise PathError(
            f"'{end}' would be turned by {turn_text(before)} and by {turn_text(turn)}, and no "
            f"one azimuth does for both; {cure or apart}"
        ) from None
    _give_azimuth_to_links(graph, link)
    graph.edges[link]["azimuth"] = None if is_zero(total) else total


def turns_to(graph: nx.MultiDiGraph, name: str) -> list[Any]:
    """Return the turns of a node against the port that light comes from straight on.

    Units: the result in radians.
    """
    wiring, found, leaves, seen = Wiring(graph), [], "", set()
    while len(links := graph.in_edges(name, keys=True)) == 1:
        (link,) = links
        start, end, (port, enters) = link
        bends = leaves and not goes_straight(wiring.elements[end], enters, leaves)
        if bends or link in seen:  # A ring has no port to begin at.
            break
        found.append(azimuth_of(wiring, link))
        seen.add(link)
        name, leaves = start, port
    return [turn for turn in found if not is_zero(turn)]


def turn_to(graph: nx.MultiDiGraph, name: str, turns: list[Any]) -> None:
    """Turn a node, and nothing behind it, until it stands as `turns_to` told elsewhere.

    Units: turns in radians.
    """
    (enters,), (passes,) = graph.in_edges(name, keys=True), graph.out_edges(name, keys=True)
    missing = [*turns]
    for turn in turns_to(graph, name):
        alike = next((at for at, one in enumerate(missing) if same(one, turn)), None)
        if alike is None:
            missing.append(-turn)
        else:
            del missing[alike]
    cure = f"take it out by path.remove('{name}'), and put it in by path.insert with one"
    for turn in missing:
        turn_more(graph, enters, turn, cure)
        turn_more(graph, passes, -turn, cure)


def are_alike(first: Any, second: Any) -> bool:
    """Tell whether two turns are the same, but for what turns there and back have rounded off.

    Units: first, second in radians.

    Examples
    --------
    >>> are_alike(0.7, 0.7 - 0.9 + 0.9), are_alike(0.7, 0.8)
    (True, False)
    """
    if isinstance(first, Parameter) and isinstance(second, Parameter):
        of_one = first.alone() == second.alone() and first.scale == second.scale
        return of_one and are_alike(first.offset, second.offset)
    if isinstance(first, Parameter) or isinstance(second, Parameter):
        return False
    return np.shape(first) == np.shape(second) and np.allclose(first, second, 1e-15, 1e-15)


def _give_azimuth_to_links(graph: nx.MultiDiGraph, link: Link) -> None:
    """Let the links that an element's azimuth turns say it, if it turns this one."""
    wiring, node = Wiring(graph), graph.nodes[link[1]]
    links = [
        one
        for one in wiring.links_to[link[1], link[2][1]]
        if graph.edges[one]["azimuth"] is None and not is_zero(azimuth_of(wiring, one))
    ]
    if link in links:
        for one in links:
            graph.edges[one]["azimuth"] = azimuth_of(wiring, one)
        node["element"] = replace(node["element"], azimuth=0.0)


def _sum(first: Any, second: Any) -> Any:
    """Return the sum of two turns."""
    if is_zero(first):
        return second
    if same(first, -second):
        return 0.0
    if not isinstance(first, Parameter) and not isinstance(second, Parameter):
        joint_shape(np.shape(first), np.shape(second))
        return read_only(first + second)
    if (
        isinstance(first, Parameter)
        and isinstance(second, Parameter)
        and (first.alone() == second.alone())
    ):
        scale, offset = first.scale + second.scale, first.offset + second.offset
        dimension = first.offset_dimension or second.offset_dimension
        return first.shaped(scale, offset, dimension) if scale else offset
    return first + second
