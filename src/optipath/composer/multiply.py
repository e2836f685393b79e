"""Multiplying: steps whose numbers are all known are done once, or left out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.composer.chains import Item, along_chains, label_of
from optipath.composer.constants import Constant, multiplied
from optipath.composer.entries import known_numbers
from optipath.kernels.carriers.structures import FULL
from optipath.values.operands import Operand
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.program import Program

_MOST = 16
"""How many constants are multiplied, lest their roundings gather."""


def multiplied_constants(program: Program, *, matrices: bool) -> tuple[Program, list[str]]:
    """Return a program whose neighbouring constants are one, in float64."""
    known: dict[int | None, Constant] = {
        place: Constant(evaluation.kernel.structure, numbers)
        for place, numbers in enumerate(known_numbers(program)[1])
        if numbers is not None
        and (evaluation := program.evaluations[place]).presence is None
        and evaluation.kernel.structure is not None
    }
    if not known:
        return program, []
    multiplying = _Multiplying(
        [known.get(step.evaluation) for step in program.steps], matrices=matrices
    )
    return along_chains(program, multiplying.done_to), multiplying.notes


class _Multiplying:
    """Multiplies the constants of chains, and notes which."""

    def __init__(self, known: Sequence[Constant | None], *, matrices: bool) -> None:
        self.known = known
        self.matrices = matrices
        self.notes: list[str] = []

    def done_to(self, items: list[Item]) -> list[Item]:
        found: list[Item] = []
        run: list[tuple[Item, Constant]] = []
        for item in items:
            constant = self.known[item.light]
            if constant is None:
                found += self._as_one(run)
                run = []
                found.append(item)
            elif constant.is_identity:
                self.notes.append(f"{item.operation.kernel.name} at '{item.label}' changes nothing")
            elif run and (both := run[-1][1].then(constant)):
                run[-1] = self._joined([run[-1][0], item], both), both
            else:
                run.append((item, constant))
        return found + self._as_one(run)

    def _as_one(self, run: Sequence[tuple[Item, Constant]]) -> list[Item]:
        """Return neighbours as one matrix where that is less work and loses no digit."""
        items, constants = [item for item, _ in run], [constant for _, constant in run]
        if not (self.matrices and len(run) > 1):
            return items
        dear = sum(constant.cost for constant in constants) > Constant(FULL, ()).cost
        if not (dear and all(constant.lets_through for constant in constants)):
            return items
        found: list[tuple[Item, Constant]] = []
        for place, (item, constant) in enumerate(run):
            both = multiplied(found[-1][1], constant) if place % _MOST else None
            if both:
                found[-1] = self._joined([found[-1][0], item], both), both
            else:
                found.append((item, constant))
        return [item for item, _ in found]

    def _joined(self, items: Sequence[Item], constant: Constant) -> Item:
        names = [f"{item.operation.kernel.name} at '{item.label}'" for item in items]
        self.notes.append(f"constant, and multiplied: {' and '.join(names)}")
        operation = Operation(constant.kernel, tuple(map(Operand, constant.numbers)))
        return items[-1]._replace(label=label_of(items), operation=operation)
