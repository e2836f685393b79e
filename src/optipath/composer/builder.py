"""Builder: collects operands, evaluations and steps of a program; equal ones are entered once."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from optipath.composer.junctions import in_order_of_elimination
from optipath.engines.program.program import Evaluation, Loop, Program, Reading, Result, Step
from optipath.values.operation import ResultOf

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping, Sequence

    from optipath.elements.vertices.frame import VertexFrame
    from optipath.light.frames import Frame
    from optipath.values.operands import Operand
    from optipath.values.operation import Operation


class Builder:
    """A program in the making."""

    def __init__(self) -> None:
        self.operands: list[Operand] = []
        self.evaluations: list[Evaluation] = []
        self.steps: list[Step] = []
        self.loops: list[Loop] = []
        self._operand_at: dict[Hashable, int] = {}
        self._evaluation_at: dict[Evaluation, int] = {}
        self._place_of: dict[tuple[int, int], tuple[int, Operation, Operand | None]] = {}

    def program(
        self,
        sources: Mapping[str, tuple[int, Frame | VertexFrame]],
        detectors: Mapping[str, Reading],
        dumps: Mapping[str, Reading],
        links: Mapping[str, Reading],
    ) -> Program:
        """Return what has been collected."""
        collected = tuple(self.operands), tuple(self.evaluations), tuple(self.steps)
        ends = sources, detectors, dumps
        return Program(*collected, *ends, loops=tuple(self.loops), links=links)

    def instead_of(self, old: Program, moved: Callable[[int], int]) -> Program:
        """Return what has been collected, with the ends of another program."""

        def ends(readings: Mapping[str, Reading]) -> dict[str, Reading]:
            return {name: replace(r, light=moved(r.light)) for name, r in readings.items()}

        # In this order, since some lights are made when they are asked for.
        read = ends(old.detectors), ends(old.dumps), ends(old.links)
        sources = {name: (moved(at), frame) for name, (at, frame) in old.sources.items()}
        return self.program(sources, *read)

    def step(
        self,
        label: str,
        inputs: tuple[int, ...],
        operation: Operation,
        presence: Operand | None = None,
        **about: Any,
    ) -> int:
        """Add a step that does something to light."""
        self.steps.append(Step(label, inputs, self._evaluation(operation, presence), **about))
        return len(self.steps) - 1

    def sum(self, label: str, lights: Sequence[int]) -> int:
        """Add the sum of several lights; one alone is itself."""
        if len(lights) == 1:
            return lights[0]
        self.steps.append(Step(label, tuple(lights)))
        return len(self.steps) - 1

    def junction(self, label: str) -> int:
        """Add a sum whose lights are not all there yet; `close` says which they are."""
        self.steps.append(Step(label, ()))
        return len(self.steps) - 1

    def close(self, inputs: Mapping[int, Sequence[int]]) -> None:
        """Say what the junctions of a loop add up, now that all of its steps are there."""
        for junction, lights in inputs.items():
            self.steps[junction] = replace(self.steps[junction], inputs=tuple(lights))
        start = min(inputs)
        order = in_order_of_elimination(self.steps, start, tuple(inputs))
        layered = all(count <= 2 for count in order.values())
        self.loops.append(Loop(tuple(order), len(self.steps), layered))

    def junctions_of(self, old: Program, loop: Loop | None) -> dict[int, int]:
        """Add the junctions of another program's loop; return the new light of each."""
        junctions = () if loop is None else sorted(loop.junctions)
        return {junction: self.junction(old.steps[junction].label) for junction in junctions}

    def close_like(self, old: Program, loop: Loop | None, moved: Callable[[int], int]) -> None:
        """Close a loop as another program has it, when its steps are there."""
        if loop is not None:
            sums = {k: [moved(light) for light in old.steps[k].inputs] for k in loop.junctions}
            self.close({moved(junction): lights for junction, lights in sums.items()})

    def _evaluation(self, operation: Operation, presence: Operand | None = None) -> int:
        key = id(operation), id(presence)
        if key not in self._place_of:
            given = [
                Result(self._evaluation(argument.operation), argument.place)
                if type(argument) is ResultOf
                else self._operand(argument)
                for argument in operation.arguments
            ]
            there = None if presence is None else self._operand(presence)
            kernel: Any = operation.kernel
            evaluation = Evaluation(kernel, tuple(given), there)
            index = self._evaluation_at.setdefault(evaluation, len(self.evaluations))
            if index == len(self.evaluations):
                self.evaluations.append(evaluation)
            # Kept with its place, so that no others get these numbers.
            self._place_of[key] = index, operation, presence
        return self._place_of[key][0]

    def _operand(self, operand: Operand) -> int:
        key = operand.key()
        index = (
            len(self.operands)
            if key is None
            else self._operand_at.setdefault(key, len(self.operands))
        )
        if index == len(self.operands):
            self.operands.append(operand)
        return index
