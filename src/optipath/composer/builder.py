"""Builder: operands, evaluations and steps of a program, each entered once."""

from __future__ import annotations

from dataclasses import replace
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.engines.program import Evaluation, Loop, Program, Result, Step
from optipath.values.operands import ResultOf

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping, Sequence

    from optipath.values.operands import Operand, Operation


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

    def program(self, **ends: Any) -> Program:
        """Return what has been collected, with its sources, detectors, dumps and links."""
        collected = tuple(self.operands), tuple(self.evaluations), tuple(self.steps)
        return Program(*collected, loops=tuple(self.loops), **ends)

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
        """Add the sum of several lights; one alone is itself. Of a junction, `close` says which."""
        if len(lights) == 1:
            return lights[0]
        self.steps.append(Step(label, tuple(lights)))
        return len(self.steps) - 1

    def close(self, inputs: Mapping[int, Sequence[int]]) -> None:
        """Say what the junctions of a loop add up, now that all of its steps are there."""
        for junction, lights in inputs.items():
            self.steps[junction] = replace(self.steps[junction], inputs=tuple(lights))
        order = in_order_of_elimination(self.steps, min(inputs), tuple(inputs))
        layered = all(count <= 2 for count in order.values())
        self.loops.append(Loop(tuple(order), len(self.steps), layered))

    def _evaluation(self, operation: Operation, presence: Operand | None = None) -> int:
        key = id(operation), id(presence)
        if key not in self._place_of:
            arguments = [
                Result(self._evaluation(argument.operation), argument.place)
                if type(argument) is ResultOf
                else self._operand(argument)
                for argument in operation.arguments
            ]
            there = None if presence is None else self._operand(presence)
            kernel: Any = operation.kernel
            evaluation = Evaluation(kernel, tuple(arguments), there)
            index = self._evaluation_at.setdefault(evaluation, len(self.evaluations))
            if index == len(self.evaluations):
                self.evaluations.append(evaluation)
            # Kept with its place, so that no others get these numbers.
            self._place_of[key] = index, operation, presence
        return self._place_of[key][0]

    def _operand(self, operand: Operand) -> int:
        key = operand.key()
        index = new = len(self.operands)
        if key is not None:
            index = self._operand_at.setdefault(key, new)
        if index == new:
            self.operands.append(operand)
        return index


_WORDS = 60
"""How long the name of a step may become that is made of several."""


class Item(NamedTuple):
    """A step that does something to one light."""

    label: str
    operation: Operation
    presence: Operand | None
    light: int
    once: bool


def along_chains(program: Program, change: Callable[[list[Item]], list[Item]]) -> Program:
    """Return a program in which each chain of steps is replaced by another one."""
    return _Chains(program, change).program()


class _Chains:
    """Goes along a program; a light that is used once waits for what becomes of it."""

    def __init__(self, program: Program, change: Callable[[list[Item]], list[Item]]) -> None:
        self.old = program
        self.change = change
        self.builder = Builder()
        self._once = True
        self._waiting: dict[int, tuple[int, list[Item]]] = {}

    def program(self) -> Program:
        old, moved = self.old, self._resolved
        for lights, loop in old.stretches():
            # What enters a loop is there before, since its steps stand together.
            for light in lights if loop else ():
                for source in old.steps[light].inputs:
                    if source < lights.start:
                        moved(source)
            self._once = loop is None
            junctions = dict.fromkeys(sorted(loop.junctions) if loop else ())
            for junction in junctions:
                self._waiting[junction] = self.builder.sum(old.steps[junction].label, ()), []
            for light in lights:
                if light not in junctions:
                    self._waiting[light] = self._of(light, old.steps[light])
            if loop is not None:
                sums = {k: [moved(light) for light in old.steps[k].inputs] for k in loop.junctions}
                self.builder.close({moved(junction): lights for junction, lights in sums.items()})
        # In this order, since some lights are made when they are asked for.
        ends: dict[str, Any] = {
            end: {name: replace(r, light=moved(r.light)) for name, r in getattr(old, end).items()}
            for end in ("detectors", "dumps", "links")
        }
        ends["sources"] = {name: (moved(at), frame) for name, (at, frame) in old.sources.items()}
        return self.builder.program(**ends)

    def _of(self, light: int, step: Step) -> tuple[int, list[Item]]:
        if step.evaluation is None:
            return self.builder.sum(step.label, [self._resolved(i) for i in step.inputs]), []
        operation = self.old.operations[step.evaluation]
        if not step.inputs:
            return self.builder.step(step.label, (), operation), []
        there = self.old.presence(step.evaluation)
        item = Item(step.label, operation, there, light, self._once)
        (before,) = step.inputs
        base, items = self._waiting[before]
        if self.old.light_uses[before] > 1 or not items:
            return self._resolved(before), [item]
        del self._waiting[before]
        items.append(item)
        return base, items

    def _resolved(self, light: int) -> int:
        """Return the new light of an old one, its steps added."""
        base, items = self._waiting[light]
        if items:
            for item in self.change(items):
                base = self.builder.step(item.label, (base,), item.operation, item.presence)
            self._waiting[light] = base, []
        return base


def label_of(items: Sequence[Item]) -> str:
    """Return the names of steps as one, the first and the last where they would be too long."""
    names = [name for item in items for name in item.label.split(", ")]
    whole = ", ".join(dict.fromkeys(names))
    if len(whole) <= _WORDS:
        return whole
    return f"{names[0].split(' .. ')[0]} .. {names[-1].split(' .. ')[-1]}"


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
