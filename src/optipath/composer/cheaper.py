"""Cheaper kernels: what is known of arguments leaves less to compute."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from optipath.composer.builder import rebuilt
from optipath.composer.entries import vanishes
from optipath.elements.coupling import Operation, ResultOf

if TYPE_CHECKING:
    from optipath.engines.program.program import Program
    from optipath.values.operands import Operand


def cheaper_kernels(program: Program) -> tuple[Program, list[str]]:
    """Return a program with the cheapest kernel for what is known of its arguments.

    Parameters
    ----------
    program : Program
        The steps.

    Returns
    -------
    program : Program
        The same light.
    notes : list of str
        Where a kernel is cheaper.
    """
    cheaper: dict[int, Operation] = {}
    for place, operation in enumerate(program.operations):
        kernel, arguments = operation.kernel.specialised(operation.arguments, _vanishes)  # type: ignore[union-attr]
        kernel = kernel.never_less(arguments, _span)
        if kernel is not operation.kernel:
            cheaper[place] = Operation(kernel, arguments)
    if not cheaper:
        return program, []
    places = [step.evaluation for step in program.steps]
    notes = [
        f"cheaper at '{step.label}': {cheaper[place].kernel.name}"
        for step, place in zip(program.steps, places, strict=True)
        if place in cheaper
    ]
    found = [None if p is None else cheaper.get(p, program.operations[p]) for p in places]
    return rebuilt(program, found), notes


def _vanishes(argument: Operand | ResultOf) -> bool:
    return not isinstance(argument, ResultOf) and vanishes(argument)


def _span(argument: Operand | ResultOf) -> tuple[float, float]:
    return (-inf, inf) if isinstance(argument, ResultOf) else argument.span
