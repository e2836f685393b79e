"""The order in which the junctions of a loop are eliminated."""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.program import Step


def in_order_of_elimination(
    steps: Sequence[Step], start: int, junctions: tuple[int, ...]
) -> dict[int, int]:
    """Return the junctions of a loop in the order of their elimination.

    A junction that is eliminated makes its neighbours neighbours of each other; taking the one
    with the fewest each time, as Markowitz does (Management Science 3, 1957), keeps them few.
    In a stack of parallel interfaces it adds layer after layer.
    """
    near = neighbours(steps, start, junctions)
    waiting = [(len(others), junction) for junction, others in near.items()]
    heapify(waiting)
    order: dict[int, int] = {}
    while waiting:
        count, junction = heappop(waiting)
        if junction not in near or count != len(near[junction]):
            continue
        order[junction] = count
        others = near.pop(junction)
        for other in others:
            near[other] = (near[other] | others) - {other, junction}
            heappush(waiting, (len(near[other]), other))
    return order


def neighbours(
    steps: Sequence[Step], start: int, junctions: tuple[int, ...]
) -> dict[int, set[int]]:
    """Return which junctions of a loop light passes next to each other."""
    behind = {junction: junction for junction in junctions}
    for light in range(start, len(steps)):
        if light not in behind:
            # Between junctions, light has one way to come from.
            behind[light] = behind[steps[light].inputs[0]]
    found: dict[int, set[int]] = {junction: set() for junction in junctions}
    for junction in junctions:
        before = {behind[light] for light in steps[junction].inputs if light >= start}
        for other in before - {junction}:
            found[junction].add(other)
            found[other].add(junction)
    return found
