"""GraphFace: a path as networkx users see it: nodes, links, and a plain graph of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.composer.plain_graph import plain
from optipath.elements.element import Chainable
from optipath.paths import editing
from optipath.paths.drawing import with_texts

if TYPE_CHECKING:
    from collections.abc import Iterator

    import networkx as nx
    from networkx.classes.reportviews import NodeView, OutMultiEdgeView

    from optipath.elements.element import Element
    from optipath.values.cases import Case


class GraphFace(Chainable):
    """What can be asked of the graph of a path."""

    description: str
    cases: dict[str, Case]
    _graph: nx.MultiDiGraph[str]

    @property
    def graph(self) -> nx.MultiDiGraph[str]:
        """The networkx graph, to query and not to change.

        Nodes carry ``element`` and ``frames``; links are keyed by (out-port, in-port)
        and carry ``azimuth`` and ``tap``.
        """
        return self._graph.copy(as_view=True)

    @property
    def nodes(self) -> NodeView[str]:
        """The nodes as networkx has them, ``path.nodes["X1"]["element"]``; not to be changed."""
        return self.graph.nodes

    @property
    def edges(self) -> OutMultiEdgeView[str]:
        """The links as networkx has them, keyed as in `graph`; not to be changed."""
        return self.graph.edges

    def to_networkx(self, *, text: bool = False) -> nx.MultiDiGraph[str]:
        """Return a plain networkx graph of the path, which is a copy and anybody's to change.

        Parameters
        ----------
        text : bool, optional
            Whether values are texts, for files such as GraphML and JSON: ``element`` is the kind,
            and its fields follow by name. It is not read back; `to_toml` is.

        Returns
        -------
        networkx.MultiDiGraph
            With the attributes that `from_networkx` takes, where there is something to say.

        Examples
        --------
        >>> import networkx as nx
        >>> import optipath as op
        >>> graph = (op.Source() >> op.Polarizer("30 deg") >> op.Detector()).to_networkx()
        >>> print(*nx.topological_sort(graph))
        source polarizer detector
        >>> graph.edges["source", "polarizer", 0]
        {'out_port': 'out', 'in_port': 'in'}
        """
        graph = plain(self._graph, description=self.description, cases=dict(self.cases))
        return with_texts(graph) if text else graph

    def element(self, name: str) -> Element:
        """Return the element of a node.

        Raises a `PathError` if there is no such node.
        """
        return editing.element_at(self._graph, name)

    def __contains__(self, name: object) -> bool:
        return name in self._graph

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the nodes, in the order in which they were added."""
        return iter(self._graph)

    def __len__(self) -> int:
        return len(self._graph)
