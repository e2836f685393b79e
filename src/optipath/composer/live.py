"""Live components: which of (S0, S1, S2, S3) light may have and somebody needs, step by step."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.composer.builder import Builder
from optipath.composer.entries import entries_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.composer.entries import Entries
    from optipath.program import Program


class Live:
    """What of each light of a program is alive.

    Parameters
    ----------
    program : Program
        The steps.

    Attributes
    ----------
    reached : list of set of int
        For each light, the components that may differ from 0.
    needed : list of set of int
        For each light, the components on which something depends that is read.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        known = [entries_of(program, place) for place in range(len(program.evaluations))]
        self.entries: list[Entries | None] = [
            None if step.evaluation is None else known[step.evaluation] for step in program.steps
        ]
        self.reached = self._forward()
        self.needed = self._backward()

    @property
    def components(self) -> list[tuple[int, ...]]:
        """For each light, the components that are alive; an intensity always is."""
        pairs = zip(self.reached, self.needed, strict=True)
        return [tuple(sorted((reached & needed) | {0})) for reached, needed in pairs]

    @property
    def counts(self) -> tuple[int, ...]:
        """For each light, how many of the first components hold all that are alive."""
        return tuple(components[-1] + 1 for components in self.components)

    def does_nothing(self, light: int) -> bool:
        """Tell whether a step leaves everything as it is that is alive."""
        rows, step = self.entries[light], self.program.steps[light]
        if rows is None or not step.inputs:
            return False
        (before,) = step.inputs
        return all(
            rows[row][column] == float(row == column)
            for row in self.needed[light] | {0}
            for column in self.reached[before]
        )

    def _forward(self) -> list[set[int]]:
        reached: list[set[int]] = [set() for _ in self.program.steps]
        return self._settled(reached, lambda: self._send_forward(reached))

    def _backward(self) -> list[set[int]]:
        needed: list[set[int]] = [set() for _ in self.program.steps]
        for reading in self.program.readings.values():
            needed[reading.light] |= set(range(reading.components))
        return self._settled(needed, lambda: self._send_backward(needed))

    def _settled(self, found: list[set[int]], sent: Callable[[], None]) -> list[set[int]]:
        """Return what is found once nothing is added any more; loops take several rounds."""
        sent()
        before = -1
        while self.program.loops and (now := sum(map(len, found))) > before:
            before = now
            sent()
        return found

    def _send_forward(self, reached: list[set[int]]) -> None:
        for light, (step, rows) in enumerate(zip(self.program.steps, self.entries, strict=True)):
            arriving = set().union(*(reached[source] for source in step.inputs))
            if rows is None:
                reached[light] |= arriving
            elif not step.inputs:
                reached[light] |= {i for i, entry in enumerate(rows[0]) if entry != 0.0}
            else:
                reached[light] |= {i for i in range(4) if any(rows[i][j] != 0.0 for j in arriving)}

    def _send_backward(self, needed: list[set[int]]) -> None:
        for light in reversed(range(len(needed))):
            rows, asked = self.entries[light], needed[light]
            for before in self.program.steps[light].inputs:
                if rows is None:
                    needed[before] |= asked
                else:
                    needed[before] |= {j for j in range(4) if any(rows[i][j] != 0.0 for i in asked)}


def trim(live: Live) -> tuple[Program, list[str]]:
    """Return a program without the steps that do nothing to what is alive, and which they are."""
    old, builder = live.program, Builder()
    moved: dict[int, int] = {}
    left_out = []
    for lights, loop in old.stretches():
        moved |= builder.knots_of(old, loop)
        for light in lights:
            if light in moved:
                continue
            step = old.steps[light]
            inputs = tuple(moved[i] for i in step.inputs)
            if step.evaluation is not None and live.does_nothing(light):
                kernel = old.parts(step.evaluation)[0]
                left_out.append(f"{kernel.name} at '{step.label}'")
                moved[light] = inputs[0]
            elif step.evaluation is None:
                moved[light] = builder.sum(step.label, inputs)
            else:
                moved[light] = builder.step(step.label, inputs, *old.parts(step.evaluation))
        builder.close_like(old, loop, moved.__getitem__)
    return builder.instead_of(old, moved.__getitem__), left_out
