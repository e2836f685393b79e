"""Chains: steps that light takes one after the other, none of which anything else needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from optipath.composer.builder import Builder

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.engines.program.program import Loop, Program, Step
    from optipath.values.operands import Operand
    from optipath.values.operation import Operation

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
        for lights, loop in self.old.stretches():
            if loop is not None:
                self._settle_before(loop)
            self._once = loop is None
            junctions = self.builder.junctions_of(self.old, loop)
            self._waiting |= {junction: (light, []) for junction, light in junctions.items()}
            for light in lights:
                if light not in junctions:
                    self._waiting[light] = self._of(light, self.old.steps[light])
            self.builder.close_like(self.old, loop, self._settled)
        return self.builder.instead_of(self.old, self._settled)

    def _settle_before(self, loop: Loop) -> None:
        """Settle what enters a loop, since its steps stand together."""
        for light in range(loop.start, loop.stop):
            for source in self.old.steps[light].inputs:
                if source < loop.start:
                    self._settled(source)

    def _of(self, light: int, step: Step) -> tuple[int, list[Item]]:
        if step.evaluation is None:
            return self.builder.sum(step.label, [self._settled(i) for i in step.inputs]), []
        operation = self.old.operations[step.evaluation]
        if not step.inputs:
            return self.builder.step(step.label, (), operation), []
        there = self.old.presence(step.evaluation)
        item = Item(step.label, operation, there, light, self._once)
        (before,) = step.inputs
        base, items = self._waiting[before]
        if self.old.light_uses[before] > 1 or not items:
            return self._settled(before), [item]
        del self._waiting[before]
        items.append(item)
        return base, items

    def _settled(self, light: int) -> int:
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
