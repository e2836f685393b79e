"""Cheaper kernels: what is known of arguments leaves less to compute."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from optipath.composer.chains import Item, along_chains
from optipath.composer.entries import vanishes
from optipath.values.operation import Operation, ResultOf

if TYPE_CHECKING:
    from optipath.engines.program.program import Program
    from optipath.values.operands import Operand


def cheaper_kernels(program: Program) -> tuple[Program, list[str]]:
    """Return a program with the cheapest kernel for what is known of its arguments."""
    cheaper: dict[int | None, Operation] = {}
    for place, evaluation in enumerate(program.evaluations):
        given = program.operations[place].arguments
        kernel, arguments = evaluation.kernel.specialised(given, _vanishes)
        kernel = kernel.never_less(arguments, _span)
        if kernel is not evaluation.kernel:
            cheaper[place] = Operation(kernel, arguments)
    if not cheaper:
        return program, []

    def cheapest(item: Item) -> Item:
        place = program.steps[item.light].evaluation
        return item._replace(operation=cheaper.get(place, item.operation))

    notes = [
        f"cheaper at '{step.label}': {cheaper[step.evaluation].kernel.name}"
        for step in program.steps
        if step.evaluation in cheaper
    ]
    return along_chains(program, lambda items: list(map(cheapest, items))), notes


def _vanishes(argument: Operand | ResultOf) -> bool:
    return not isinstance(argument, ResultOf) and vanishes(argument)


def _span(argument: Operand | ResultOf) -> tuple[float, float]:
    return (-inf, inf) if isinstance(argument, ResultOf) else argument.span
