"""ElementGraph: a networkx graph of elements whose attributes only a path changes."""

from __future__ import annotations

from typing import Any, NoReturn

import networkx as nx

from optipath.errors import PathError


class Attributes(dict[str, Any]):
    """What is said of a node or a link, filled once; a path changes it by `dict.update`."""

    __slots__ = ()

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        cure = "use its methods, as path.replace(...), or change a copy, path.to_networkx()"
        raise PathError(f"attributes in the graph of a path are read-only; {cure}")

    __setitem__ = __delitem__ = __ior__ = setdefault = pop = popitem = clear = _refuse

    def update(self, *others: Any, **more: Any) -> None:
        """Fill what is empty, as networkx does."""
        if self:
            self._refuse()
        super().update(*others, **more)

    def __reduce__(self) -> tuple[type[Attributes], tuple[dict[str, Any]]]:
        return Attributes, ({**self},)


class ElementGraph(nx.MultiDiGraph):  # type: ignore[misc] # networkx has no types
    """The graph of a path."""

    node_attr_dict_factory = edge_attr_dict_factory = Attributes

    def view(self) -> nx.MultiDiGraph[str]:
        """Return a view as networkx makes them, copies of which are plain."""
        result = nx.graphviews.generic_graph_view(self, nx.MultiDiGraph)
        result.graph = Attributes(self.graph)
        return result
