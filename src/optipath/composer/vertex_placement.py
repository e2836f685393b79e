"""Placement of vertices, whose frames come from the points of a chain."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.composer.wiring import link_text
from optipath.elements import SpecularVertex

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.composer.wiring import Link, Wiring
    from optipath.vertices import VertexFrame


def is_vertex(wiring: Wiring, name: str) -> bool:
    """Tell whether a node is a vertex of a chain."""
    return isinstance(wiring.elements[name], SpecularVertex)


def vertex_frame(wiring: Wiring, name: str, port: str) -> VertexFrame | None:
    """Return the frame of the vertex that light at an end comes from, or a source's goes to.

    Directly, or through elements that let it go straight on and are not turned.
    """
    backward = port in wiring.elements[name].inputs
    passed: set[str] = set()
    while name not in passed:
        passed.add(name)
        links = _links(wiring, name, port, backward=backward)
        if len(links) != 1 or _is_turned(wiring, links[0]):
            return None
        start, end, (leaves, enters) = links[0]
        name, port = (start, leaves) if backward else (end, enters)
        element = wiring.elements[name]
        if isinstance(element, SpecularVertex):
            return element.own_frame(port)
        ways = element.inputs if backward else element.outputs
        if not element.straight or len(ways) != 1:
            return None
        port = ways[0]
    return None


def vertex_link_faults(wiring: Wiring, link: Link) -> list[str]:
    """Return what is wrong with a link between vertices, or from one to a world frame."""
    start, end, _ = link
    vertices = [is_vertex(wiring, start), is_vertex(wiring, end)]
    text = f"link '{link_text(link)}'"
    if all(vertices):
        before, behind = wiring.elements[start], wiring.elements[end]
        assert isinstance(behind, SpecularVertex)  # noqa: S101 - asked above
        if wiring.graph.edges[link]["azimuth"] is not None:
            return [f"{text} is turned by its vertices and by an azimuth; leave the azimuth out"]
        if not behind.follows(before):
            return [f"{text} must lead from a vertex to the next of one chain: {_next(behind)}"]
    elif any(vertices) and wiring.graph.nodes[end if vertices[0] else start]["frames"]:
        placed, vertex = (end, start) if vertices[0] else (start, end)
        problem = f"'{placed}' has world frames of its own, and '{vertex}' those of its vertices"
        return [f"{text}: {problem}; place '{placed}' relatively"]
    return []


def vertex_faults(wiring: Wiring) -> Iterator[str]:
    """Yield what is wrong with elements that stand relatively between two vertices."""
    for name in wiring.elements:
        if not is_vertex(wiring, name):
            continue
        waiting = [p for p in wiring.graph.predecessors(name) if not is_vertex(wiring, p)]
        seen = set(waiting)
        while waiting:
            between = waiting.pop()
            for before in wiring.graph.predecessors(between):
                if is_vertex(wiring, before):
                    yield (
                        f"'{between}' stands relatively between the vertices '{before}' and "
                        f"'{name}', whose frames differ; put it before the first vertex or "
                        f"behind the last"
                    )
                elif before not in seen:
                    seen.add(before)
                    waiting.append(before)


def _next(vertex: SpecularVertex) -> str:
    place: Any = vertex.place
    before = place - 1 if isinstance(place, int) else "the one"
    return f"the same vertices, and place {before} before place {place}"


def _links(wiring: Wiring, name: str, port: str, *, backward: bool) -> list[Link]:
    if backward:
        return wiring.links_to.get((name, port), [])
    edges = wiring.graph.out_edges(name, keys=True)
    return [link for link in edges if link[2][0] == port]


def _is_turned(wiring: Wiring, link: Link) -> bool:
    own = wiring.graph.edges[link]["azimuth"]
    turn = getattr(wiring.elements[link[1]], "azimuth", 0.0) if own is None else own
    return not (isinstance(turn, (int, float)) and turn == 0.0)
