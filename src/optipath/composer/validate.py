"""Validation: every fault of a path at once, each with its place and its cure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import networkx as nx

from optipath.composer.placement import placement_faults
from optipath.composer.ports import (
    element_of,
    emitting,
    ending,
    port_graph,
    reached_from,
)
from optipath.composer.values import value_faults
from optipath.elements import Detector, Source
from optipath.errors import PathError

if TYPE_CHECKING:
    from collections.abc import Iterator


def validate(graph: nx.MultiDiGraph) -> None:
    """Raise unless the path can be composed.

    Raises
    ------
    PathError
        With all faults found: values, frames, ends, links and loops.
    """
    faults = [
        *value_faults(graph),
        *placement_faults(graph),
        *feeding_faults(graph),
        *structure_faults(graph),
    ]
    if faults:
        raise PathError(*faults)


def feeding_faults(graph: nx.MultiDiGraph) -> list[str]:
    """Return a sentence for each in-port that is fed twice and does not merge."""
    found = []
    for name, element in graph.nodes(data="element"):
        if element.merges:
            continue
        for port in element.inputs:
            feeders = [
                f"'{start}.{leaves}'"
                for start, _, (leaves, enters) in graph.in_edges(name, keys=True)
                if enters == port
            ]
            if len(feeders) > 1:
                found.append(
                    f"port '{name}.{port}' is fed by {' and '.join(feeders)}, but {element.kind} "
                    f"does not merge light; put a Combiner before it"
                )
    return found


def structure_faults(graph: nx.MultiDiGraph) -> list[str]:
    """Return what is wrong with ends, reach and loops, a sentence each."""
    kinds = [element_of(graph, name) for name in graph]
    found = []
    if not emitting(graph):
        found.append(f"the path has no source; add one, such as {Source()!r}")
    if not any(isinstance(element, Detector) for element in kinds):
        found.append("the path has no detector; add one, such as Detector()")
    ports = port_graph(graph)
    found += _loop_faults(ports)
    if emitting(graph) and ending(graph):
        found += _reach_faults(graph, ports)
    return found


def _reach_faults(graph: nx.MultiDiGraph, ports: nx.DiGraph) -> Iterator[str]:
    lit = reached_from(ports, emitting(graph))
    useful = reached_from(ports.reverse(copy=False), ending(graph))
    for name, element in graph.nodes(data="element"):
        all_ports = [(name, port) for port in (*element.inputs, *element.outputs)]
        entries = ", ".join(f"'{name}.{port}'" for port in element.inputs)
        if not any(port in lit for port in all_ports):
            yield _unlit(graph, name, entries)
        elif not any(port in useful for port in all_ports):
            exits = " or ".join(f"'{name}.{port}'" for port in element.outputs)
            yield f"node '{name}' reaches no detector; link {exits} towards one, or to a Dump"


def _unlit(graph: nx.MultiDiGraph, name: str, entries: str) -> str:
    for start, _, (leaves, _) in graph.in_edges(name, keys=True):
        if not any(c.leaves == leaves for c in element_of(graph, start).couplings()):
            return (
                f"node '{name}' gets no light: '{start}.{leaves}' is named, but "
                f"{element_of(graph, start).kind} gives no light there in this version"
            )
    return f"node '{name}' is reached by no source; link one to {entries}"


def _loop_faults(ports: nx.DiGraph) -> Iterator[str]:
    for component in nx.strongly_connected_components(ports):
        if len(component) > 1:
            start = min(component)
            inside = ports.subgraph(component)
            back = min(inside.predecessors(start))
            route = [name for name, _ in nx.shortest_path(inside, start, back)]
            names = [name for i, name in enumerate(route) if i == 0 or route[i - 1] != name]
            closed = names if len(names) > 1 and names[0] == names[-1] else [*names, names[0]]
            yield f"light goes round in a cycle: {' -> '.join(closed)}; open it by removing a link"
