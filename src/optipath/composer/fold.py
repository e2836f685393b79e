"""Folding: what is known is done once, what does nothing is left out, what is cheaper is taken."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from optipath.composer.builder import Builder
from optipath.composer.constants import Constant, multiplied
from optipath.composer.entries import number_of, vanishes
from optipath.kernels import FLOAT, FULL, TURN, TURN_BACK
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.program import Loop, Program, Step
    from optipath.kernels import Kernel


_MOST = 16
"""How many constants are multiplied, lest their roundings gather."""

_WORDS = 60
"""How long the name of a step may become that is made of several."""


@dataclass(frozen=True, eq=False)
class Item:
    """A step that does something to one light."""

    label: str
    kernel: Kernel
    operands: tuple[Operand, ...]
    presence: Operand | None

    def constant(self) -> Constant | None:
        """Return its numbers, if all are known."""
        numbers = tuple(map(number_of, self.operands))
        if self.presence is not None or None in numbers or self.kernel.structure is None:
            return None
        return _constant(self.kernel, numbers)


def fold(program: Program, *, constants: bool, matrices: bool) -> tuple[Program, list[str]]:
    """Return a program that gives the same light with less work, and what was folded.

    Parameters
    ----------
    program : Program
        The steps.
    constants : bool
        Whether constants may be multiplied, which is done in float64.
    matrices : bool
        Whether the product may be a whole matrix.
    """
    folding = _Folding(program, constants=constants, matrices=matrices)
    return folding.program(), folding.notes


class _Folding:
    """Goes along a program; a light that is used once waits for what becomes of it."""

    def __init__(self, program: Program, *, constants: bool, matrices: bool) -> None:
        self.old = program
        self.constants = constants
        self.matrices = matrices
        self.builder = Builder()
        self.notes: list[str] = []
        # What goes round keeps the digits that it is given, since its sum may need all of them.
        self._once = True
        self._waiting: dict[int, tuple[int, list[Item]]] = {}

    def program(self) -> Program:
        """Return the folded program."""
        for lights, loop in self.old.stretches():
            if loop is not None:
                self._settle_before(loop)
            self._once = loop is None
            junctions = self.builder.junctions_of(self.old, loop)
            self._waiting |= {junction: (light, []) for junction, light in junctions.items()}
            for light in lights:
                if light not in junctions:
                    self._waiting[light] = self._of(self.old.steps[light])
            self.builder.close_like(self.old, loop, self._settled)
        return self.builder.instead_of(self.old, self._settled)

    def _settle_before(self, loop: Loop) -> None:
        """Settle what enters a loop, since its steps stand together."""
        for light in range(loop.start, loop.stop):
            for source in self.old.steps[light].inputs:
                if source < loop.start:
                    self._settled(source)

    def _of(self, step: Step) -> tuple[int, list[Item]]:
        if step.evaluation is None:
            return self.builder.sum(step.label, [self._settled(i) for i in step.inputs]), []
        item = self._cheapest(Item(step.label, *self.old.parts(step.evaluation)))
        if not step.inputs:
            return self.builder.step(step.label, (), item.kernel, item.operands), []
        (light,) = step.inputs
        base, items = self._waiting[light]
        if self.old.light_uses[light] > 1 or not items:
            return self._settled(light), [item]
        del self._waiting[light]
        items.append(item)
        return base, items

    def _settled(self, light: int) -> int:
        """Return the new light of an old one, its steps added."""
        base, items = self._waiting[light]
        for item in self._folded(items):
            base = self.builder.step(item.label, (base,), item.kernel, item.operands, item.presence)
        self._waiting[light] = base, []
        return base

    def _cheapest(self, item: Item) -> Item:
        kernel, operands = item.kernel.specialised(item.operands, vanishes)
        kernel = kernel.never_less(operands, lambda operand: operand.span)
        if kernel is not item.kernel:
            self.notes.append(f"cheaper at '{item.label}': {kernel.name}")
        return replace(item, kernel=kernel, operands=operands)

    def _folded(self, items: list[Item]) -> list[Item]:
        found: list[Item] = []
        for item in items:
            turns = found and _is_turn(item) and _is_turn(found[-1])
            if turns and len(found[-1].operands) < _MOST:
                found[-1:] = self._turned(found[-1], item)
            else:
                found.append(item)
        return self._multiplied(found) if self.constants else found

    def _turned(self, first: Item, second: Item) -> list[Item]:
        """Return two turns as one, or as none if they undo each other."""
        self.notes.append(f"the turns at {_quoted([first, second])} are one")
        operands = [*_angles(first), *_angles(second)]
        # Sums are in float64.
        sums = self.constants and self._once
        numbers = [number_of(operand) if sums else None for operand in operands]
        known = sum(number for number in numbers if number is not None)
        left: list[Operand] = []
        for operand in (v for v, number in zip(operands, numbers, strict=True) if number is None):
            opposite = operand.negated().key()
            undone = [w for w in left if opposite is not None and w.key() == opposite]
            if undone:
                left.remove(undone[0])
            else:
                left.append(operand)
        if known:
            left.append(Operand(known))
        return [Item(_label([first, second]), TURN, tuple(left), None)] if left else []

    def _multiplied(self, items: list[Item]) -> list[Item]:
        found: list[Item] = []
        run: list[tuple[Item, Constant]] = []
        for item in items:
            constant = item.constant()
            if constant is None:
                found += self._as_one(run)
                run = []
                found.append(item)
            elif constant.is_identity:
                self.notes.append(f"{item.kernel.name} at '{item.label}' changes nothing")
            elif run and self._once and (both := run[-1][1].then(constant)):
                run[-1] = self._joined([run[-1][0], item], both), both
            else:
                run.append((item, constant))
        return found + self._as_one(run)

    def _as_one(self, run: Sequence[tuple[Item, Constant]]) -> list[Item]:
        """Return neighbours as one matrix where that is less work and loses no digit."""
        constants = [constant for _, constant in run]
        items = [item for item, _ in run]
        cost = sum(constant.cost for constant in constants)
        dear = self.matrices and self._once and len(run) > 1 and cost > Constant(FULL, ()).cost
        if not (dear and all(constant.lets_through for constant in constants)):
            return items
        found: list[Item] = []
        for start in range(0, len(run), _MOST):
            found += self._multiplied_out(run[start : start + _MOST])
        return found

    def _multiplied_out(self, run: Sequence[tuple[Item, Constant]]) -> list[Item]:
        found: list[tuple[Item, Constant]] = []
        for item, constant in run:
            both = multiplied(found[-1][1], constant) if found else None
            if both:
                found[-1] = self._joined([found[-1][0], item], both), both
            else:
                found.append((item, constant))
        return [item for item, _ in found]

    def _joined(self, items: Sequence[Item], constant: Constant) -> Item:
        label = _label(items)
        names = " and ".join(f"{item.kernel.name} at '{item.label}'" for item in items)
        self.notes.append(f"constant, and multiplied: {names}")
        return Item(label, constant.kernel, tuple(map(Operand, constant.numbers)), None)


@lru_cache(1024)
def _constant(kernel: Kernel, numbers: tuple[float, ...]) -> Constant | None:
    assert kernel.structure is not None  # noqa: S101 - only sources have none
    try:
        found = kernel.made_for(FLOAT)(*numbers)
        return Constant(kernel.structure, tuple(map(float, found)))
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return None


def _label(items: Sequence[Item]) -> str:
    """Return the names of steps as one, the first and the last where they would be too long."""
    names = [name for item in items for name in item.label.split(", ")]
    whole = ", ".join(dict.fromkeys(names))
    if len(whole) <= _WORDS:
        return whole
    return f"{names[0].split(' .. ')[0]} .. {names[-1].split(' .. ')[-1]}"


def _quoted(items: Sequence[Item]) -> str:
    return " and ".join(dict.fromkeys(f"'{item.label}'" for item in items))


def _is_turn(item: Item) -> bool:
    return item.presence is None and item.kernel in (TURN, TURN_BACK)


def _angles(item: Item) -> list[Operand]:
    return (
        [operand.negated() for operand in item.operands]
        if item.kernel is TURN_BACK
        else [*item.operands]
    )
