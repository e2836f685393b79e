"""Entries: what is known of a step's Mueller matrix before any number comes."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.formulas import Symbol
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbolic import SYMBOLIC
from optipath.engines.program.program import Result
from optipath.kernels import FLOAT, Kernel

if TYPE_CHECKING:
    from collections.abc import Sequence

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


def number_of(operand: Operand) -> float | None:
    """Return the one real number that an operand is known to be; None for all else."""
    quickly = operand.known_float
    if quickly is not None:
        return quickly
    if not operand.known or operand.traced or operand.part == "present":
        return None
    numbers = operand.numbers({})
    return None if numbers.ndim or numbers.dtype.kind == "c" else float(numbers)


def vanishes(operand: Operand) -> bool:
    """Tell whether an operand is known to be 0, for every path."""
    if not operand.known or operand.traced:
        return False
    numbers = operand.numbers({})
    # Of most arrays the first number tells.
    return not (numbers.size and numbers[(0,) * numbers.ndim]) and not np.any(numbers)


def known_numbers(
    program: Program,
) -> tuple[list[float | None], list[tuple[float, ...] | None]]:
    """Return the number of each operand, and those of each evaluation, as far as known."""
    operands = [number_of(operand) for operand in program.operands]
    found: list[tuple[float, ...] | None] = []
    for evaluation in program.evaluations:
        given: list[float | None] = []
        for argument in evaluation.arguments:
            if isinstance(argument, Result):
                results = found[argument.evaluation]
                given.append(None if results is None else results[argument.place])
            else:
                given.append(operands[argument])
        found.append(None if None in given else _evaluated(evaluation.kernel, tuple(given)))
    return operands, found


def entries_of(program: Program) -> list[Entries]:
    """Return what is known of the matrix of each evaluation, or of what it emits."""
    numbers, evaluated = known_numbers(program)
    # Which number it is seldom matters, but for 0 and 1.
    known = [
        (abs(number) if number in (0.0, 1.0) else None)
        if number is not None
        else (0.0 if operand.known and vanishes(operand) else None)
        for operand, number in zip(program.operands, numbers, strict=True)
    ]
    found = []
    for place, evaluation in enumerate(program.evaluations):
        kernel, result = evaluation.kernel, evaluated[place]
        try:
            outlines = _outlines(program, place, known) if result is None else ()
            rows = _rows(kernel, FLOAT, result) if result else _symbolic(outlines)
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            rows = _UNKNOWN if kernel.structure is not None else _UNKNOWN[:1]
        if evaluation.presence is not None and kernel.structure is not None:
            rows = _as_it_may_be_absent(rows)
        found.append(rows)
    return found


@lru_cache(1024)
def _evaluated(kernel: Kernel, numbers: tuple[float, ...]) -> tuple[float, ...] | None:
    try:
        return tuple(map(float, kernel.made_for(FLOAT)(*numbers)))
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return None


def _outlines(program: Program, place: int, known: Sequence[Entry]) -> tuple[_Outline, ...]:
    """Return what is known of an evaluation, behind that of those whose results it is given."""
    wanted = [place]
    for index in wanted:
        wanted += program.takes[index]
    at = {index: order for order, index in enumerate(sorted(set(wanted)))}
    found = []
    for index in at:
        evaluation = program.evaluations[index]
        arguments = [
            Result(at[argument.evaluation], argument.place)
            if isinstance(argument, Result)
            else known[argument]
            for argument in evaluation.arguments
        ]
        found.append((evaluation.kernel, tuple(arguments)))
    return tuple(found)


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


@lru_cache(1024)
def _as_it_may_be_absent(rows: Entries) -> Entries:
    return tuple(
        tuple(entry if entry == float(r == c) else None for c, entry in enumerate(row))
        for r, row in enumerate(rows)
    )


def _rows(kernel: Kernel, xp: Primitives, numbers: Sequence[Any]) -> Entries:
    structure = kernel.structure
    rows = (numbers,) if structure is None else structure.rows(xp, numbers)
    return tuple([tuple(map(_known, row)) for row in rows])


def _known(number: Any) -> Entry:
    return None if isinstance(number, Symbol) or not np.isfinite(number) else float(number)
