"""Entries: what is known of a step's Mueller matrix before any number comes."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.elements.coupling import ResultOf
from optipath.engines.formulas import Symbol
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbolic import SYMBOLIC
from optipath.engines.program.program import Result
from optipath.kernels import FLOAT, Kernel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.elements.coupling import Operation
    from optipath.engines.program.program import Program
    from optipath.kernels import Primitives
    from optipath.values.operands import Operand

Entry: TypeAlias = float | None
"""A number, or None for one that is not known."""

Entries: TypeAlias = tuple[tuple[Entry, ...], ...]
"""Four rows of a matrix, or one row of what a source emits."""

_Outline: TypeAlias = tuple[Kernel, tuple[Entry | Result, ...]]
"""A kernel, and what is known of its arguments; results are those of outlines before it."""

_UNKNOWN: Entries = ((None,) * 4,) * 4


def number_of(argument: Operand | ResultOf) -> float | None:
    """Return the one real number that an argument is known to be; None for all else."""
    if type(argument) is ResultOf:
        numbers = numbers_of(argument.operation)
        return None if numbers is None else float(numbers[argument.place])
    quickly = argument.known_float
    if quickly is not None:
        return quickly
    if not argument.known or argument.traced or argument.part == "present":
        return None
    array = argument.numbers({})
    return None if array.ndim or array.dtype.kind == "c" else float(array)


def numbers_of(operation: Operation) -> tuple[float, ...] | None:
    """Return what an operation comes to, if all that it is given are known numbers."""
    numbers: list[float] = []
    known: dict[int, tuple[float, ...] | None] = {}
    for argument in operation.arguments:
        if type(argument) is ResultOf:
            inner = argument.operation
            if id(inner) not in known:
                known[id(inner)] = numbers_of(inner)
            results = known[id(inner)]
            number = None if results is None else results[argument.place]
        else:
            number = number_of(argument)
        if number is None:
            return None
        numbers.append(number)
    return _evaluated(operation.kernel, tuple(numbers))


@lru_cache(1024)
def _evaluated(kernel: Kernel, numbers: tuple[float, ...]) -> tuple[float, ...] | None:
    try:
        return tuple(map(float, kernel.made_for(FLOAT)(*numbers)))
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return None


def entries_of(program: Program, evaluation: int) -> Entries:
    """Return what is known of the matrix of an evaluation, or of what it emits.

    Parameters
    ----------
    program : Program
        The steps.
    evaluation : int
        Which of its evaluations.

    Returns
    -------
    tuple of tuple
        Numbers, and None for each that is not known.
    """
    operation = program.operations[evaluation]
    kernel: Any = operation.kernel
    numbers = numbers_of(operation)
    try:
        found = (
            _symbolic(_outlined(operation)) if numbers is None else _rows(kernel, FLOAT, numbers)
        )
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return _UNKNOWN if kernel.structure is not None else _UNKNOWN[:1]
    if program.evaluations[evaluation].presence is None or kernel.structure is None:
        return found
    return tuple(
        tuple(entry if entry == float(r == c) else None for c, entry in enumerate(row))
        for r, row in enumerate(found)
    )


def _outlined(operation: Operation) -> tuple[_Outline, ...]:
    """Return what is known of an operation, behind that of those whose results it is given."""
    outlines: list[_Outline] = []
    places: dict[int, int] = {}

    def add(operation: Operation) -> int:
        if id(operation) not in places:
            given = [
                Result(add(argument.operation), argument.place)
                if type(argument) is ResultOf
                else _zero_or_one(argument)
                for argument in operation.arguments
            ]
            places[id(operation)] = len(outlines)
            outlines.append((operation.kernel, tuple(given)))
        return places[id(operation)]

    add(operation)
    return tuple(outlines)


def _zero_or_one(operand: Operand) -> Entry:
    """Return 0, 1 or None: which number it is seldom matters, but for these two."""
    quickly = operand.known_float
    if quickly is None and vanishes(operand):
        return 0.0
    number = quickly if quickly is not None else number_of(operand)
    return abs(number) if number in (0.0, 1.0) else None


def vanishes(operand: Operand) -> bool:
    """Tell whether an operand is known to be 0, for every path."""
    if not operand.known or operand.traced:
        return False
    numbers = operand.numbers({})
    # Of most arrays the first number tells.
    return not (numbers.size and numbers[(0,) * numbers.ndim]) and not np.any(numbers)


@lru_cache(1024)
def _symbolic(outlines: tuple[_Outline, ...]) -> Entries:
    recorder = Recorder(np.dtype(np.float64))
    results: list[Any] = []
    for index, (kernel, known) in enumerate(outlines):
        arguments = [
            results[number.evaluation][number.place]
            if isinstance(number, Result)
            else recorder.input(f"{index}.{place}")
            if number is None
            else np.float64(number)
            for place, number in enumerate(known)
        ]
        results.append(kernel.made_for(SYMBOLIC)(*arguments))
    return _rows(kernel, SYMBOLIC, results[-1])


def _rows(kernel: Kernel, xp: Primitives, numbers: Sequence[Any]) -> Entries:
    structure = kernel.structure
    rows = (numbers,) if structure is None else structure.rows(xp, numbers)
    return tuple([tuple(map(_known, row)) for row in rows])


def _known(number: Any) -> Entry:
    return None if isinstance(number, Symbol) or not np.isfinite(number) else float(number)
