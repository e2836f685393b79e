"""The order in which the knots of a loop are eliminated."""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.program import Step


def in_order_of_elimination(
    steps: Sequence[Step], start: int, knots: tuple[int, ...]
) -> dict[int, int]:
    """Return the knots of a loop in order, each with how many neighbours it has left.

    A knot that is eliminated makes its neighbours neighbours of each other; taking the one
    with the fewest each time, as Markowitz does (Management Science 3, 1957), keeps them few.
    In a stack of parallel interfaces it adds layer after layer.

    Parameters
    ----------
    steps : sequence of Step
        All steps so far, those of the loop being the last.
    start : int
        The first step of the loop.
    knots : tuple of int
        Where lights meet in it.
    """
    near = neighbours(steps, start, knots)
    waiting = [(len(others), knot) for knot, others in near.items()]
    heapify(waiting)
    order: dict[int, int] = {}
    while waiting:
        count, knot = heappop(waiting)
        if knot not in near or count != len(near[knot]):
            continue
        order[knot] = count
        others = near.pop(knot)
        for other in others:
            near[other] = (near[other] | others) - {other, knot}
            heappush(waiting, (len(near[other]), other))
    return order


def neighbours(steps: Sequence[Step], start: int, knots: tuple[int, ...]) -> dict[int, set[int]]:
    """Return which knots of a loop light passes next to each other."""
    behind = {knot: knot for knot in knots}
    for light in range(start, len(steps)):
        if light not in behind:
            # Between knots, light has one way to come from.
            behind[light] = behind[steps[light].inputs[0]]
    found: dict[int, set[int]] = {knot: set() for knot in knots}
    for knot in knots:
        before = {behind[light] for light in steps[knot].inputs if light >= start}
        for other in before - {knot}:
            found[knot].add(other)
            found[other].add(knot)
    return found
