"""Validation: every fault of a path at once, each with its place and its cure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import networkx as nx

from optipath.composer.followed_values import with_followed
from optipath.composer.media import Media
from optipath.composer.path_values import Values
from optipath.composer.placement import placement_faults
from optipath.composer.wiring import (
    LOOPS,
    Wiring,
    among,
    cycles,
    link_text,
    sharing_faults,
    tap_faults,
)
from optipath.errors import Cure, Fault, PathError
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.composer.wiring import Ways


def validate(graph: nx.MultiDiGraph, values: Values | None = None) -> None:
    """Raise unless a graph of elements can be composed."""
    whole, unfollowed = with_followed(graph)
    wiring = Wiring(whole)
    if values is None or whole is not values.graph:
        values = Values(whole)
    refuse_faults(values, wiring, Media(wiring), unfollowed)


def refuse_faults(values: Values, wiring: Wiring, media: Media, unfollowed: list[str]) -> None:
    """Raise unless values, wiring and media can be composed."""
    faults = unfollowed + _faults(values, wiring, media)
    if faults:
        raise PathError(*faults)
    for _, element in values.graph.nodes(data="element"):
        vars(element)["_is_sound"] = True


def _faults(values: Values, wiring: Wiring, media: Media) -> list[str]:
    # In a cycle by mistake, light meets media and misses ends in consequence.
    cyclic = [] if wiring.loops == LOOPS[1] else list(_loop_faults(wiring.untapped))
    results = [*values.faults, *placement_faults(wiring), *([] if cyclic else media.faults())]
    results += [*_feeding_faults(wiring), *sharing_faults(wiring), *tap_faults(wiring)]
    results += [*_dark_link_faults(wiring), *cyclic, *_missing_end_faults(wiring)]
    results += [] if results else _own_faults(wiring)
    if wiring.starts and wiring.ends and not cyclic:
        results += _reach_faults(wiring)
    return results


def _own_faults(wiring: Wiring) -> Iterator[str]:
    for each in wiring.own_ways():
        if each.are_known():
            yield from (fault for _, fault in each.faults(Operand.numbers))


def _missing_end_faults(wiring: Wiring) -> Iterator[str]:
    if not wiring.starts:
        yield _missing("source", "Source()")
    if not any(element.detects for element in wiring.elements.values()):
        yield _missing("detector", "Detector()")


def _missing(kind: str, made: str) -> Fault:
    table = f'[elements.{kind}] with kind = "{kind}"'
    return Fault(f"the path has no {kind}", Cure.of("add one, such as {}".format, made, table))


def _dark_link_faults(wiring: Wiring) -> Iterator[str]:
    for link in wiring.dark_links:
        element, leaves = wiring.elements[link[0]], link[2][0]
        kind = element.kind or type(element).__name__
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


def _reach_faults(wiring: Wiring) -> Iterator[str]:
    """Yield where a link is missing, and not what is cut off in consequence."""
    ports = {
        name: [(name, port) for port in (*element.inputs, *element.outputs)]
        for name, element in wiring.elements.items()
    }
    dark = {name for name, each in ports.items() if wiring.lit.isdisjoint(each)}
    missing = {name for name, each in ports.items() if wiring.useful.isdisjoint(each)}
    for name in _firsts(wiring.graph.subgraph(dark)):
        entries = ", ".join(f"'{name}.{port}'" for port in wiring.elements[name].inputs)
        yield f"node '{name}' is reached by no source; link one to {entries}"
    for name in _firsts(wiring.graph.subgraph(missing - dark), backwards=True):
        exits = " or ".join(f"'{name}.{port}'" for port in wiring.elements[name].outputs)
        yield f"node '{name}' reaches no detector; link {exits} towards one, or to a Dump"


def _firsts(graph: nx.MultiDiGraph, *, backwards: bool = False) -> list[str]:
    """Return the nodes that no other leads to; of nodes in a circle, one."""
    if not graph:
        return []
    parts = nx.condensation(graph.reverse() if backwards else graph)
    return [min(parts.nodes[n]["members"]) for n, degree in parts.in_degree if not degree]


def _loop_faults(ports: Ways) -> Iterator[str]:
    for together in cycles(ports):
        start = min(together)
        inside = nx.DiGraph(among(ports, together))
        back = min(inside.predecessors(start))
        route = [name for name, _ in nx.shortest_path(inside, start, back)]
        names = [name for i, name in enumerate(route) if i == 0 or route[i - 1] != name]
        closed = names if len(names) > 1 and names[0] == names[-1] else [*names, names[0]]
        yield Fault(
            f"light goes round in a cycle: {' -> '.join(closed)}",
            Cure.of(
                "open it by removing a link, or sum over all rounds with {}".format,
                "loops='sum'",
                'loops = "sum" above all tables',
            ),
        )
