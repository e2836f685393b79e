"""Turns of links: what stands behind a link, turned by more than it was."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.placement import azimuth_of, is_zero, turn_text
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

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        Elements and links.
    link : tuple
        One of the links.
    turn : float, ndarray or Parameter
        By how much more, in radians.
    cure : str, optional
        What to do where both turns do not make one azimuth; by default to put an element
        between them.

    Raises
    ------
    PathError
        If they do not: two parameters, or one and an array.
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
    """Return the sum of two turns.

    Raises
    ------
    OptipathError
        If it has no form: of two parameters, of one and an array, of arrays that do not fit.
    """
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
