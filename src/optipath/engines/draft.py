"""Draft: steps in order, each with its own numbers, and the program that shares what is equal."""

from __future__ import annotations

from functools import cached_property
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, Any

from optipath.engines.program import Evaluation, Loop, Program, Result, Step
from optipath.values.operands import Operand, ResultOf, operand_of

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence

    from optipath.values.operands import Operation


class DraftStep:
    """Makes one light: the sum of its inputs, changed by an operation where that is present.

    Light at a port has taken so many bounces on the way there; any other, None.
    """

    __slots__ = ("action", "bounces", "inputs", "label", "operation", "presence")

    def __init__(
        self,
        label: str,
        inputs: tuple[int, ...],
        operation: Operation | None = None,
        presence: Operand | None = None,
        bounces: int | None = None,
    ) -> None:
        self.label = label
        self.inputs = inputs
        self.operation: Any = operation
        self.presence = presence
        self.bounces = bounces
        self.action: Any = None  # What it makes of components, once that was looked up.


class Draft:
    """Steps in the making; where their light begins, ends and is kept, as `Program` has it."""

    def __init__(self) -> None:
        self.steps: list[DraftStep] = []
        self.loops: list[tuple[tuple[int, ...], int]] = []
        self.ends: dict[str, Any] = {}

    def step(
        self,
        label: str,
        inputs: tuple[int, ...],
        operation: Operation,
        presence: Operand | None = None,
        bounces: int | None = None,
    ) -> int:
        """Add a step that does something to light."""
        self.steps.append(DraftStep(label, inputs, operation, presence, bounces))
        return len(self.steps) - 1

    def sum(self, label: str, lights: Sequence[int]) -> int:
        """Add the sum of several lights; one alone is itself. Of a junction, `close` says which."""
        if len(lights) == 1:
            return lights[0]
        self.steps.append(DraftStep(label, tuple(lights)))
        return len(self.steps) - 1

    def close(self, inputs: Mapping[int, Sequence[int]]) -> None:
        """Say what the junctions of a loop add up, now that all of its steps are there."""
        for junction, lights in inputs.items():
            self.steps[junction].inputs = tuple(lights)
        self.loops.append((tuple(inputs), len(self.steps)))

    @cached_property
    def program(self) -> Program:
        """The program: operands and evaluations that are equal are one, made when first needed."""
        return _Sharing(self).program

    def __eq__(self, other: object) -> bool:
        return self.program == other.program if isinstance(other, Draft) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    @classmethod
    def of(cls, program: Program) -> Draft:
        """Return what stands for a program that is there."""
        result = cls()
        vars(result)["program"] = program
        return result


class _Sharing:
    """Gathers the operands and evaluations of a draft, each entered once."""

    def __init__(self, draft: Draft) -> None:
        self.operands: list[Operand] = []
        self.evaluations: list[Evaluation] = []
        self.operations: list[Operation] = []
        self._operand_at: dict[Hashable, int] = {}
        self._number_at: dict[Hashable, int] = {}
        self._evaluation_at: dict[Evaluation, int] = {}
        # By their numbers, which are theirs as long as the draft is there.
        known = self._place_of = dict[Any, int]()
        steps = []
        for step in draft.steps:
            if (operation := step.operation) is None:
                steps.append(Step(step.label, step.inputs))
                continue
            presence = step.presence
            key = id(operation) if presence is None else (id(operation), id(presence))
            if (place := known.get(key)) is None:
                place = self._evaluation(operation, presence)
            bounces = step.bounces
            steps.append(Step(step.label, step.inputs, place, bounces is not None, bounces or 0))
        loops = tuple([_loop(steps, *loop) for loop in draft.loops])
        self.program = Program(
            tuple(self.operands), tuple(self.evaluations), tuple(steps), loops=loops, **draft.ends
        )
        vars(self.program)["operations"] = tuple(self.operations)

    def _evaluation(self, operation: Operation, presence: Operand | None = None) -> int:
        arguments: list[int | Result] = []
        known, numbers = self._operand_at, self._number_at
        for argument in operation.arguments:
            if type(argument) is ResultOf:
                inner = argument.operation
                if (place := self._place_of.get(id(inner))) is None:
                    place = self._evaluation(inner)
                arguments.append(Result(place, argument.place))
                continue
            number = argument
            if type(argument) is Operand and argument.part == "value":
                number = argument.value
            if type(number) is float:
                key: Hashable = number or str(number)  # 0 is not -0.
                if (place := numbers.get(key)) is None:
                    place = numbers[key] = len(self.operands)
                    self.operands.append(operand_of(argument))
            elif (place := known.get(key := argument.key())) is None:
                place = self._entered(argument, key)
            arguments.append(place)
        there = None if presence is None else self._entered(presence, presence.key())
        kernel: Any = operation.kernel
        evaluation = Evaluation(kernel, tuple(arguments), there)
        index = self._evaluation_at.setdefault(evaluation, len(self.evaluations))
        if index == len(self.evaluations):
            self.evaluations.append(evaluation)
            self.operations.append(operation)
        key = id(operation) if presence is None else (id(operation), id(presence))
        self._place_of[key] = index
        return index

    def _entered(self, operand: Operand, key: Hashable) -> int:
        """Return the place of an operand; those without a key are equal to none."""
        index = new = len(self.operands)
        if key is not None:
            index = self._operand_at.setdefault(key, new)
        if index == new:
            self.operands.append(operand)
        return index


def _loop(steps: Sequence[Step], junctions: tuple[int, ...], stop: int) -> Loop:
    order = in_order_of_elimination(steps[:stop], min(junctions), junctions)
    return Loop(tuple(order), stop, layered=all(count <= 2 for count in order.values()))


def in_order_of_elimination(
    steps: Sequence[Step], start: int, junctions: tuple[int, ...]
) -> dict[int, int]:
    """Return the junctions of a loop in the order of their elimination.

    Markowitz (Management Science 3, 1957): the junction with the fewest neighbors first, which
    keeps the fill-in low.
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
    results: dict[int, set[int]] = {junction: set() for junction in junctions}
    for junction in junctions:
        before = {behind[light] for light in steps[junction].inputs if light >= start}
        for other in before - {junction}:
            results[junction].add(other)
            results[other].add(junction)
    return results
