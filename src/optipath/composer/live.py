"""Live components: which of (S0, S1, S2, S3) light may have and somebody needs, step by step."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from typing import TYPE_CHECKING

from optipath.composer.builder import rebuilt
from optipath.composer.entries import entries_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from optipath.composer.entries import Entries
    from optipath.elements.coupling import Operation
    from optipath.engines.program.program import Program


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
    def components(self) -> tuple[tuple[int, ...], ...]:
        """For each light, the components that are alive; an intensity always is."""
        pairs = zip(self.reached, self.needed, strict=True)
        return tuple([tuple(sorted((reached & needed) | {0})) for reached, needed in pairs])

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
        steps, used_by = self.program.steps, self.program.used_by
        reached: list[set[int]] = [set() for _ in steps]
        waiting = _Waiting(range(len(steps)))
        for light in waiting:
            arriving = set().union(*(reached[source] for source in steps[light].inputs))
            found = _sent(self.entries[light], arriving, emits=not steps[light].inputs)
            if not found <= reached[light]:
                reached[light] |= found
                waiting.add(used_by[light])
        return reached

    def _backward(self) -> list[set[int]]:
        steps = self.program.steps
        needed: list[set[int]] = [set() for _ in steps]
        for reading in self.program.readings.values():
            needed[reading.light] |= set(range(reading.components))
        waiting = _Waiting(reversed(range(len(steps))))
        for light in waiting:
            rows, asked = self.entries[light], needed[light]
            found = asked
            if rows is not None and steps[light].inputs:
                found = {j for j in range(4) if any(rows[i][j] != 0.0 for i in asked)}
            for before in steps[light].inputs:
                if not found <= needed[before]:
                    needed[before] |= found
                    waiting.add((before,))
        return needed


def _sent(rows: Entries | None, arriving: set[int], *, emits: bool) -> set[int]:
    """Return the components that a step makes of those that arrive."""
    if rows is None:
        return arriving
    if emits:
        return {i for i, entry in enumerate(rows[0]) if entry != 0.0}
    return {i for i in range(4) if any(rows[i][j] != 0.0 for j in arriving)}


class _Waiting:
    """Lights to be looked at, once each, and again where others that they hang on have changed."""

    def __init__(self, lights: Iterable[int]) -> None:
        self._lights = deque(lights)
        self._there = set(self._lights)

    def add(self, lights: Iterable[int]) -> None:
        """Let some wait that do not yet."""
        for light in lights:
            if light not in self._there:
                self._there.add(light)
                self._lights.append(light)

    def __iter__(self) -> Iterator[int]:
        while self._lights:
            light = self._lights.popleft()
            self._there.discard(light)
            yield light


def left_out(program: Program) -> tuple[Program, list[str]]:
    """Return a program without the steps that do nothing to what is alive.

    Parameters
    ----------
    program : Program
        The steps.

    Returns
    -------
    program : Program
        The same light, and what of it is alive.
    notes : list of str
        Which steps were left out.
    """
    live, notes = Live(program), []
    operations: list[Operation | None] = []
    for light, step in enumerate(program.steps):
        operation = None if step.evaluation is None else program.operations[step.evaluation]
        if operation is not None and live.does_nothing(light):
            notes.append(
                f"left out, since it changes nothing alive: {operation.kernel.name} at "
                f"'{step.label}'"
            )
            operation = None
        operations.append(operation)
    if notes:
        return rebuilt(program, operations), notes
    return replace(program, live=live.components), []


def fewest_components(program: Program) -> tuple[Program, list[str]]:
    """Return a program that carries the first components of each light that hold all alive."""
    live = program.live or Live(program).components
    return replace(program, live=live, counts=tuple([alive[-1] + 1 for alive in live])), []
