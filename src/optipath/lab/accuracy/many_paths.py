"""One path as a batch of many, for timing."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.path_values import Values
from optipath.elements.source import Source
from optipath.lab.accuracy.region_path import in_region
from optipath.lab.accuracy.regions import REGIONS

if TYPE_CHECKING:
    import networkx as nx

    from optipath.paths.path_graph import PathGraph


def many_paths(path: PathGraph, count: int) -> tuple[nx.MultiDiGraph, dict[str, Any]]:
    """Return a graph, and values of its parameters, that make a batch of a path.

    Interfaces are drawn from the generic region, each path its own; open parameters that
    are left are repeated, and so are the intensities of sources.

    Shape: returns (count,).

    Examples
    --------
    >>> import optipath as op
    >>> graph, values = many_paths(op.load_preset("malus"), 7)
    >>> values["angle"].shape
    (7,)
    """
    graph = in_region(path, REGIONS[0], count, "float64")
    for _, node in graph.nodes(data=True):
        element = node["element"]
        if isinstance(element, Source) and isinstance(element.intensity, (int, float)):
            node["element"] = replace(element, intensity=np.full(count, float(element.intensity)))
    values = {}
    for name, parameter in Values(graph).inputs().open.items():
        resolved = parameter.resolve(parameter.default)
        if np.all(resolved.present) and resolved.value.ndim == 0:
            values[name] = np.full(count, resolved.value)
    return graph, values
