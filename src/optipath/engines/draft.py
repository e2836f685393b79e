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

    __slots__ = ("action", "bounces", "fact", "inputs", "label", "operation", "presence")

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
        # What is known of its operation, and what it makes of components; once looked up.
        self.fact: Any = None
        self.action: Any = None


class Steps:
    """Steps in the making, in order; the place of each is the number of the light it makes."""

    of_sum: type[Any]

    def __init__(self) -> None:
        self.steps: list[Any] = []
        self.loops: list[tuple[tuple[int, ...], int]] = []

    def add(self, step: Any) -> int:
        """Add a step, and return its place."""
        self.steps.append(step)
        return len(self.steps) - 1

    def sum(self, label: str, lights: Sequence[int]) -> int:
        """Add the sum of several lights; one alone is itself. Of a junction, `close` says which."""
        return lights[0] if len(lights) == 1 else self.add(self.of_sum(label, tuple(lights)))

    def close(self, inputs: Mapping[int, Sequence[int]]) -> None:
        """Say what the junctions of a loop add up, now that all of its steps are there."""
        for junction, lights in inputs.items():
            self.steps[junction] = self.of_sum(self.steps[junction].label, tuple(lights))
        self.loops.append((tuple(inputs), len(self.steps)))


class Draft(Steps):
    """Steps as they were lowered; where their light begins, ends and is kept, as in `Program`."""

    of_sum = DraftStep

    def __init__(self) -> None:
        super().__init__()
        self.ends: dict[str, Any] = {}

    @cached_property
    def program(self) -> Program:
        """The program, made when it is first needed."""
        shared = SharedSteps()
        for step in self.steps:
            shared.share(step, step.inputs)
        shared.loops = self.loops
        return shared.program(self.ends)

    def __eq__(self, other: object) -> bool:
        return self.program == other.program if isinstance(other, Draft) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    @classmethod
    def of(cls, program: Program) -> Draft:
        """Return what stands for a program that is there."""
        result = cls()
        vars(result)["program"] = program
        return result


class SharedSteps(Steps):
    """Steps of a program: operands and evaluations that are equal are entered once."""

    of_sum = Step

    def __init__(self) -> None:
        super().__init__()
        self.operands: list[Operand] = []
        self.evaluations: list[Evaluation] = []
        self._operand_at: dict[Hashable, int] = {}
        self._number_at: dict[Hashable, int] = {}
        self._evaluation_at: dict[Evaluation, int] = {}
        # By the numbers of operations, kept with these, lest others get them.
        self._place_of: dict[Any, tuple[int, Operation]] = {}

    def share(self, step: DraftStep, inputs: tuple[int, ...]) -> int:
        """Add a step of a draft, which does to other lights what it does to its own."""
        if step.operation is None:
            return self.add(Step(step.label, inputs))
        place, bounces = self._place(step.operation, step.presence), step.bounces
        return self.add(Step(step.label, inputs, place, bounces is not None, bounces or 0))

    def program(self, ends: Mapping[str, Any]) -> Program:
        """Return the program."""
        loops = tuple([_loop(self.steps, *loop) for loop in self.loops])
        operands, evaluations = tuple(self.operands), tuple(self.evaluations)
        return Program(operands, evaluations, tuple(self.steps), loops=loops, **ends)

    def _place(self, operation: Operation, presence: Operand | None = None) -> int:
        """Return the place of an evaluation."""
        of_operation = id(operation) if presence is None else (id(operation), id(presence))
        if (known := self._place_of.get(of_operation)) is not None:
            return known[0]
        arguments: list[int | Result] = []
        numbers = self._number_at
        for argument in operation.arguments:
            if type(argument) is ResultOf:
                arguments.append(Result(self._place(argument.operation), argument.place))
                continue
            number = argument
            if type(argument) is Operand and argument.part == "value":
                number = argument.value
            if type(number) is float:
                key: Hashable = number or str(number)  # 0 is not -0.
                if (place := numbers.get(key)) is None:
                    place = numbers[key] = len(self.operands)
                    self.operands.append(operand_of(argument))
            else:
                place = self._entered(argument, argument.key())
            arguments.append(place)
        there = None if presence is None else self._entered(presence, presence.key())
        kernel: Any = operation.kernel
        evaluation = Evaluation(kernel, tuple(arguments), there)
        index = self._evaluation_at.setdefault(evaluation, len(self.evaluations))
        if index == len(self.evaluations):
            self.evaluations.append(evaluation)
        self._place_of[of_operation] = index, operation
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
