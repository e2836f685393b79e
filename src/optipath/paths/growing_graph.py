"""GrowingGraph: the graph of a path, which may go on as that of a longer one."""

from __future__ import annotations

from contextlib import suppress
from itertools import islice
from threading import RLock
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

from optipath.errors import PathError
from optipath.paths.editing import join, open_port
from optipath.paths.element_graph import ElementGraph

if TYPE_CHECKING:
    from optipath.composer.wiring import Port

_LOCK = RLock()
"""Held while a graph grows, and while a beginning of it is copied."""


class GrowingGraph:
    """The graph of a path, which ``>>`` lets grow into that of a longer path.

    No copy is made, so that a chain takes no time that grows with its length. Of the longer graph,
    the path in front keeps the beginning, and copies that when it is read.
    """

    def __init__(self, graph: ElementGraph, *, may_grow: bool = False) -> None:
        self._graph = graph
        # Not where somebody may be reading it.
        self._may_grow = may_grow
        # How many nodes of the graph are its own, and what the whole was then; None if all are.
        self._beginning: tuple[int, dict[str, Any]] | None = None
        # All that have a beginning of the same graph, if there are any.
        self._sharers: WeakSet[GrowingGraph] | None = None
        self._open_end: Port | None = None

    def __len__(self) -> int:
        with _LOCK:
            return self._beginning[0] if self._beginning else len(self._graph)

    def read(self) -> ElementGraph:
        """Return the graph, to be read at any time and not to be changed."""
        with _LOCK:
            self._may_grow = False
            if self._beginning:
                self._graph, self._beginning, self._sharers = self._copy(), None, None
            return self._graph

    def change(self) -> ElementGraph:
        """Return the graph for a change in place, which no other path sees."""
        with _LOCK:
            graph, self._open_end = self.read(), None
            for sharer in self._sharers or ():
                sharer.read()
            self._sharers = None
            return graph

    def followed_by(self, behind: GrowingGraph) -> tuple[GrowingGraph, dict[str, str]]:
        """Return this graph with another behind it, and the names that nodes of that have there."""
        added = behind.read()
        with _LOCK:
            graph = self._graph if self._may_grow else self._copy()
            beginning = len(graph), dict(graph.graph)
            names = join(graph, added, self._open_end)
            result = GrowingGraph(graph, may_grow=True)
            if self._may_grow:
                self._beginning, self._may_grow = beginning, False
                result._sharers = WeakSet() if self._sharers is None else self._sharers
                result._sharers.add(self)
        if end := behind._only_end():
            result._open_end = names[end[0]], end[1]
        return result, names

    def _copy(self) -> ElementGraph:
        count, about = self._beginning or (None, self._graph.graph)
        first = dict(islice(self._graph.nodes.items(), count))
        result = ElementGraph()
        result.graph.update(about)
        result.add_nodes_from(first.items())
        links = self._graph.edges(first, keys=True, data=True)
        result.add_edges_from(link for link in links if link[1] in first)
        return result

    def _only_end(self) -> Port | None:
        """Return the only open way out, if there is one."""
        if self._open_end is None:
            with suppress(PathError):
                self._open_end = open_port(self.read(), out=True)
        return self._open_end

    def __reduce__(self) -> tuple[type[GrowingGraph], tuple[ElementGraph]]:
        return GrowingGraph, (self.read(),)
