"""Validation: every fault of a path at once, each with its place and its cure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import networkx as nx

from optipath.composer.path_values import Values
from optipath.composer.placement import placement_faults
from optipath.composer.travel import among, cycles
from optipath.composer.wiring import Wiring, link_text
from optipath.elements.source import Source
from optipath.errors import PathError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.composer.travel import Ways


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

    Parameters
    ----------
    values, wiring
        What is known of a path.

    Raises
    ------
    PathError
        With all faults found.
    """
    faults = _faults(values, wiring, set(), whole=True)
    if faults:
        raise PathError(*faults)


def partial_faults(graph: nx.MultiDiGraph, suspects: set[str], *, whole: bool) -> list[str]:
    """Return the faults of a graph of elements of which some may be missing.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        The elements and links that there are.
    suspects : set of str
        The nodes whose links may not all be there; what hangs together with them is not
        called unreached.
    whole : bool
        Whether all nodes are there, so that a missing source or detector says something.

    Returns
    -------
    list of str
        A sentence for each.
    """
    unsure: set[str] = set()
    for together in nx.weakly_connected_components(graph):
        if together & suspects:
            unsure |= together
    return _faults(Values(graph), Wiring(graph), unsure, whole=whole)


def _faults(values: Values, wiring: Wiring, unsure: set[str], *, whole: bool) -> list[str]:
    found = [*values.faults(), *placement_faults(wiring)]
    found += [*_feeding_faults(wiring), *_dark_link_faults(wiring)]
    if wiring.loops != "sum":
        found += _loop_faults(wiring.ports)
    if whole:
        found += _missing_end_faults(wiring)
    if wiring.starts and wiring.ends:
        found += _reach_faults(wiring, unsure)
    return found


def _missing_end_faults(wiring: Wiring) -> Iterator[str]:
    if not wiring.starts:
        yield f"the path has no source; add one, such as {Source()!r}"
    if not any(element.detects for element in wiring.elements.values()):
        yield "the path has no detector; add one, such as Detector()"


def _dark_link_faults(wiring: Wiring) -> Iterator[str]:
    for link in wiring.dark_links:
        kind, leaves = wiring.elements[link[0]].kind, link[2][0]
        yield (
            f"link '{link_text(link)}' carries no light: {kind} names '{leaves}', but gives no "
            f"light there; remove the link"
        )


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


def _reach_faults(wiring: Wiring, unsure: set[str]) -> Iterator[str]:
    for name, element in wiring.elements.items():
        ports = [(name, port) for port in (*element.inputs, *element.outputs)]
        if name in unsure:
            continue
        if not any(port in wiring.lit for port in ports):
            entries = ", ".join(f"'{name}.{port}'" for port in element.inputs)
            yield f"node '{name}' is reached by no source; link one to {entries}"
        elif not any(port in wiring.useful for port in ports):
            exits = " or ".join(f"'{name}.{port}'" for port in element.outputs)
            yield f"node '{name}' reaches no detector; link {exits} towards one, or to a Dump"


def _loop_faults(ports: Ways) -> Iterator[str]:
    for together in cycles(ports):
        start = min(together)
        inside = nx.DiGraph(among(ports, together))
        back = min(inside.predecessors(start))
        route = [name for name, _ in nx.shortest_path(inside, start, back)]
        names = [name for i, name in enumerate(route) if i == 0 or route[i - 1] != name]
        closed = names if len(names) > 1 and names[0] == names[-1] else [*names, names[0]]
        yield (
            f"light goes round in a cycle: {' -> '.join(closed)}; open it by removing a link, "
            f"or sum over all rounds with loops='sum'"
        )
