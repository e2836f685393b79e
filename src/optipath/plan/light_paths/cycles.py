"""Ways that have no end: loops that light may go round as often as it likes."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from optipath.engines.program.program import Program


def endless(program: Program, bounces: int | None) -> str:
    """Return a place where light goes round without end; nothing where it does not."""
    for loop in program.loops:
        if bounces is None or _goes_round_unbounced(program, range(loop.start, loop.stop)):
            return program.steps[loop.start].label
    return ""


def _goes_round_unbounced(program: Program, members: range) -> bool:
    """Tell whether there is a way round a loop that has no reflection."""
    inputs = {
        light: {i for i in program.steps[light].inputs if i in members}
        for light in members
        if not program.steps[light].bounces
    }
    waiting = True
    while waiting:
        # What waits for nothing any more is on no way round.
        done = [light for light, before in inputs.items() if not before & inputs.keys()]
        for light in done:
            del inputs[light]
        waiting = bool(done)
    return bool(inputs)
