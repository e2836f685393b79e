"""The order in which light passes the ports of a path, and where it goes round."""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import networkx as nx

if TYPE_CHECKING:
    from collections.abc import Iterable

Port: TypeAlias = tuple[str, str]
"""(node, port)."""

Ways: TypeAlias = dict[Port, list[Port]]
"""To which ports light goes on from each."""


class Stretch(NamedTuple):
    """Ports that light passes one after the other: one port, or all those of a loop."""

    ports: tuple[Port, ...]
    junctions: tuple[Port, ...] = ()


def stretches(ways: Ways) -> list[Stretch]:
    """Return the ports in the order of travel, those of a loop together.

    Where nothing else tells, ports come in the order of their names.
    """
    together = cycles(ways)
    came_from = backwards(ways) if together else {}
    loops = {min(ports): _loop(ways, ports, came_from) for ports in together}
    stands_for = {port: first for first, loop in loops.items() for port in loop.ports}
    before = dict.fromkeys(ways, 0)
    for port, onwards in ways.items():
        start = stands_for.get(port, port)
        for later in onwards:
            end = stands_for.get(later, later)
            before[end] += end != start
    ready = [p for p, count in before.items() if not count and stands_for.get(p, p) == p]
    heapify(ready)
    order: list[Stretch] = []
    while ready:
        port = heappop(ready)
        stretch = loops.get(port) or Stretch((port,))
        order.append(stretch)
        for member in stretch.ports:
            for later in ways[member]:
                end = stands_for.get(later, later)
                if end != port:
                    before[end] -= 1
                    if not before[end]:
                        heappush(ready, end)
    return order


def cycles(ways: Ways) -> list[set[Port]]:
    """Return the ports of each loop: those that light can reach from each other."""
    core = among(ways, _going_round(ways))
    core = among(core, _going_round(backwards(core)))
    if not core:
        return []
    return [ports for ports in nx.strongly_connected_components(nx.DiGraph(core)) if len(ports) > 1]


def backwards(ways: Ways) -> Ways:
    """Return from which ports light comes to each."""
    found: Ways = {port: [] for port in ways}
    for port, onwards in ways.items():
        for later in onwards:
            found[later].append(port)
    return found


def reached(ways: Ways, starts: Iterable[Port]) -> set[Port]:
    """Return the ports that light reaches."""
    found = set(starts)
    waiting = list(found)
    while waiting:
        for later in ways[waiting.pop()]:
            if later not in found:
                found.add(later)
                waiting.append(later)
    return found


def among(ways: Ways, kept: set[Port]) -> Ways:
    """Return the ways between some ports alone."""
    return {
        port: [later for later in onwards if later in kept]
        for port, onwards in ways.items()
        if port in kept
    }


def _going_round(ways: Ways) -> set[Port]:
    """Return the ports that are left when those to which no other leads are taken away."""
    before = dict.fromkeys(ways, 0)
    for onwards in ways.values():
        for later in onwards:
            before[later] += 1
    gone = [port for port, count in before.items() if not count]
    for port in gone:
        for later in ways[port]:
            before[later] -= 1
            if not before[later]:
                gone.append(later)
    return ways.keys() - set(gone)


def _loop(ways: Ways, together: set[Port], before: Ways) -> Stretch:
    """Return the ports of a loop; where several lights arrive is a junction."""
    junctions = {port for port in together if len(before[port]) > 1}
    order = sorted(junctions)
    # Between junctions, light has one way to come from.
    for port in order:
        order += sorted(p for p in ways[port] if p in together and p not in junctions)
    return Stretch(tuple(order), tuple(sorted(junctions)))
