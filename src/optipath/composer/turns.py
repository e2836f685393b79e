"""Turns: neighbours become one, and vanish where they undo each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.composer.chains import Item, along_chains, label_of
from optipath.composer.entries import number_of
from optipath.kernels.catalogue import TURN, TURN_BACK
from optipath.values.operands import Operand
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from optipath.engines.program.program import Program

_MOST = 16
"""How many angles are added, lest their roundings gather."""


def joined_turns(program: Program, *, sums: bool) -> tuple[Program, list[str]]:
    """Return a program whose neighbouring turns are one."""
    notes: list[str] = []

    def joined(items: list[Item]) -> list[Item]:
        found: list[Item] = []
        for item in items:
            turns = found and _is_turn(item) and _is_turn(found[-1])
            if turns and len(found[-1].operation.arguments) < _MOST:
                names = dict.fromkeys(f"'{turn.label}'" for turn in (found[-1], item))
                notes.append(f"the turns at {' and '.join(names)} are one")
                found[-1:] = _as_one(found[-1], item, sums=sums and item.once)
            else:
                found.append(item)
        return found

    return (along_chains(program, joined) if _has_neighbours(program) else program), notes


def _has_neighbours(program: Program) -> bool:
    turns = {place for place, e in enumerate(program.evaluations) if e.kernel in _TURNS}
    steps = program.steps
    second = [step for step in steps if step.evaluation in turns]
    return not turns.isdisjoint([steps[step.inputs[0]].evaluation for step in second])


_TURNS = (TURN, TURN_BACK)


def _is_turn(item: Item) -> bool:
    known = item.presence is None and item.operation.kernel in _TURNS
    return known and {type(argument) for argument in item.operation.arguments} == {Operand}


def _as_one(first: Item, second: Item, *, sums: bool) -> list[Item]:
    """Return two turns as one, or as none if they undo each other."""
    angles = [*_angles(first), *_angles(second)]
    numbers = [number_of(angle) if sums else None for angle in angles]
    known = sum(number for number in numbers if number is not None)
    left: list[Operand] = []
    for angle in (a for a, number in zip(angles, numbers, strict=True) if number is None):
        opposite = angle.negated().key()
        undone = [other for other in left if opposite is not None and other.key() == opposite]
        if undone:
            left.remove(undone[0])
        else:
            left.append(angle)
    if known:
        left.append(Operand(known))
    whole = second._replace(label=label_of([first, second]), operation=Operation(TURN, tuple(left)))
    return [whole] if left else []


def _angles(item: Item) -> list[Operand]:
    angles = item.operation.arguments
    if item.operation.kernel is TURN_BACK:
        return [angle.negated() for angle in angles]
    return [*angles]
