"""The way light takes from port to port, as a directed graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import networkx as nx

if TYPE_CHECKING:
    from optipath.elements import Element

Port: TypeAlias = tuple[str, str]


def element_of(graph: nx.MultiDiGraph, name: str) -> Element:
    """Return the element of a node."""
    return graph.nodes[name]["element"]  # type: ignore[no-any-return]


def port_graph(graph: nx.MultiDiGraph) -> nx.DiGraph:
    """Return the graph whose nodes are ports, and whose edges are links and couplings.

    Working on ports rather than nodes tells light that passes an element twice,
    by different ways, from light that goes round in a loop.
    """
    ports = nx.DiGraph()
    for name, element in graph.nodes(data="element"):
        ports.add_nodes_from((name, port) for port in (*element.inputs, *element.outputs))
        for coupling in element.couplings():
            if coupling.enters is not None:
                ports.add_edge((name, coupling.enters), (name, coupling.leaves))
    for start, end, (leaves, enters) in graph.edges(keys=True):
        ports.add_edge((start, leaves), (end, enters))
    return ports


def emitting(graph: nx.MultiDiGraph) -> list[Port]:
    """Return the ports where light begins."""
    return [
        (name, coupling.leaves)
        for name, element in graph.nodes(data="element")
        for coupling in element.couplings()
        if coupling.enters is None
    ]


def ending(graph: nx.MultiDiGraph) -> list[Port]:
    """Return the ports where light ends: in-ports of elements with no way out."""
    return [
        (name, port)
        for name, element in graph.nodes(data="element")
        if not element.outputs
        for port in element.inputs
    ]


def reached_from(ports: nx.DiGraph, starts: list[Port]) -> set[Port]:
    """Return the ports that light from any of the starts can reach, these included."""
    reached = set(starts)
    waiting = list(starts)
    while waiting:
        for successor in ports.successors(waiting.pop()):
            if successor not in reached:
                reached.add(successor)
                waiting.append(successor)
    return reached


def outlets(graph: nx.MultiDiGraph) -> list[str]:
    """Return the out-ports that no link takes: their light leaves the path."""
    taken = {(start, leaves) for start, _, (leaves, _) in graph.edges(keys=True)}
    return [
        f"{name}.{port}"
        for name, element in graph.nodes(data="element")
        for port in element.outputs
        if (name, port) not in taken
    ]
