"""Validation: every fault of a path at once, each with its place and its cure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import networkx as nx

from optipath.composer.placement import placement_faults
from optipath.composer.values import Values
from optipath.composer.wiring import Wiring
from optipath.elements import Detector, Source
from optipath.errors import PathError

if TYPE_CHECKING:
    from collections.abc import Iterator


def validate(graph: nx.MultiDiGraph) -> None:
    """Raise unless a graph of elements can be composed.

    Raises
    ------
    PathError
        With all faults found: values, frames, ends, links and loops.
    """
    refuse_faults(Values(graph), Wiring(graph))


def refuse_faults(values: Values, wiring: Wiring) -> None:
    """Raise unless values and wiring can be composed.

    Raises
    ------
    PathError
        With all faults found.
    """
    faults = [*values.faults(), *placement_faults(wiring), *_wiring_faults(wiring)]
    if faults:
        raise PathError(*faults)


def structure_faults(graph: nx.MultiDiGraph) -> list[str]:
    """Return what is wrong with links, ends, reach and loops, a sentence each."""
    return list(_wiring_faults(Wiring(graph)))


def _wiring_faults(wiring: Wiring) -> Iterator[str]:
    yield from _feeding_faults(wiring)
    if not wiring.starts:
        yield f"the path has no source; add one, such as {Source()!r}"
    if not any(isinstance(element, Detector) for element in wiring.elements.values()):
        yield "the path has no detector; add one, such as Detector()"
    yield from _loop_faults(wiring.ports)
    if wiring.starts and wiring.ends:
        yield from _reach_faults(wiring)


def _feeding_faults(wiring: Wiring) -> Iterator[str]:
    for (name, port), links in wiring.links_to.items():
        element = wiring.elements[name]
        if len(links) > 1 and not element.merges:
            feeders = " and ".join(f"'{start}.{leaves}'" for start, _, (leaves, _) in links)
            kind = element.kind or type(element).__name__
            yield (
                f"port '{name}.{port}' is fed by {feeders}, but {kind} does not merge light; "
                f"put a Combiner before it"
            )


def _reach_faults(wiring: Wiring) -> Iterator[str]:
    for name, element in wiring.elements.items():
        ports = [(name, port) for port in (*element.inputs, *element.outputs)]
        if not any(port in wiring.lit for port in ports):
            yield _unlit(wiring, name)
        elif not any(port in wiring.useful for port in ports):
            exits = " or ".join(f"'{name}.{port}'" for port in element.outputs)
            yield f"node '{name}' reaches no detector; link {exits} towards one, or to a Dump"


def _unlit(wiring: Wiring, name: str) -> str:
    for port in wiring.elements[name].inputs:
        for start, _, (leaves, _) in wiring.links_to.get((name, port), []):
            if not any(coupling.leaves == leaves for coupling in wiring.couplings[start]):
                kind = wiring.elements[start].kind
                return (
                    f"node '{name}' gets no light: '{start}.{leaves}' is named, but {kind} gives "
                    f"no light there in this version"
                )
    entries = ", ".join(f"'{name}.{port}'" for port in wiring.elements[name].inputs)
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
