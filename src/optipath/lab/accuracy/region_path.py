"""A path as it is, but with its interfaces in a region where methods fail."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from optipath.elements.interface import Interface
from optipath.values.follows import FOLLOWS

if TYPE_CHECKING:
    import networkx as nx

    from optipath.lab.accuracy.regions import Region
    from optipath.paths.path_graph import PathGraph


def in_region(path: PathGraph, region: Region, count: int, dtype: str) -> nx.MultiDiGraph:
    """Return the graph of a path whose interfaces are drawn from a region, each anew.

    Everything else stays. The incidence of an interface that has world frames stays too:
    they fix it.

    Examples
    --------
    >>> import optipath as op
    >>> from optipath.lab.accuracy.regions import REGIONS
    >>> graph = in_region(op.load_preset("npgr026"), REGIONS[0], 5, "float64")
    >>> graph.nodes["X1"]["element"].incidence.shape
    (5,)
    """
    graph = path.graph.copy()
    for number, name in enumerate(interfaces(path)):
        node = graph.nodes[name]
        drawn = region.samples(count, dtype, seed=number)
        changes: dict[str, Any] = {"index": drawn.n + 1j * drawn.k, "outside": 1.0}
        if not node["frames"]:
            changes["incidence"] = drawn.incidence
        node["element"] = replace(node["element"], **changes)
    return graph


def interfaces(path: PathGraph) -> list[str]:
    """Return the names of the interfaces of a path whose values nothing ties to those of others.

    Those of stacks are left alone: light from behind needs a medium that does not absorb, and
    one angle fixes all others, and a medium has two boundaries.
    """
    lit_behind = {end for _, end, (_, enters) in path.graph.edges(keys=True) if enters == "back"}
    return [
        name
        for name, element in path.graph.nodes(data="element")
        if isinstance(element, Interface)
        and name not in lit_behind
        and element.incidence_in is None
        and FOLLOWS not in (element.outside, element.incidence)
    ]
