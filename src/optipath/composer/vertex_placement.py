"""Placement of vertices, whose frames come from the points of a chain."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.composer.wiring import link_text
from optipath.elements import SpecularVertex

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.composer.wiring import Link, Wiring


def is_vertex(wiring: Wiring, name: str) -> bool:
    """Tell whether a node is a vertex of a chain."""
    return name in wiring.vertices


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
