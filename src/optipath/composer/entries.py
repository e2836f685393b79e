"""Entries: what is known of a step's Mueller matrix before any number comes."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbol import Symbol
from optipath.engines.formulas.symbolic import SYMBOLIC
from optipath.engines.program.program import Result
from optipath.kernels.numbers.primitives import FLOAT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.program import Program
    from optipath.kernels.carriers.kernel import Kernel
    from optipath.values.operands import Operand

Entry: TypeAlias = float | None
"""A number, or None for one that is not known."""

Entries: TypeAlias = tuple[tuple[Entry, ...], ...]
"""Four rows of a matrix, or one row of what a source emits."""

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
    """Return the number of each operand, and those of each evaluation, as far as known.

    Where light goes round, evaluations may be done in twice the digits, in which what floats
    give as 0 or 1 may be neither: none is known.
    """
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
        unknown = None in given or program.loops
        found.append(None if unknown else _evaluated(evaluation.kernel, tuple(given)))
    return operands, found


def entries_of(program: Program) -> list[Entries]:
    """Return what is known of the matrix of each evaluation, or of what it emits."""
    numbers, evaluated = known_numbers(program)
    pairs = zip(program.operands, numbers, strict=True)
    known = [0.0 if n is None and vanishes(o) else _zero_or_one(n) for o, n in pairs]
    found: list[Entries] = []
    for evaluation, result in zip(program.evaluations, evaluated, strict=True):
        given = [
            _zero_or_one(_result(program, found, argument))
            if isinstance(argument, Result)
            else known[argument]
            for argument in evaluation.arguments
        ]
        found.append(_entries(evaluation.kernel, result, tuple(given)))
        if evaluation.presence is not None and evaluation.kernel.structure is not None:
            found[-1] = _as_it_may_be_absent(found[-1])
    return found


@lru_cache(1024)
def _evaluated(kernel: Kernel, numbers: tuple[float, ...]) -> tuple[float, ...] | None:
    try:
        return tuple(map(float, kernel.made_for(FLOAT)(*numbers)))
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return None


def _result(program: Program, found: Sequence[Entries], result: Result) -> Entry:
    """Return what is known of a result: that of a kernel without structure has one row."""
    structure = program.evaluations[result.evaluation].kernel.structure
    row = found[result.evaluation][0]
    return row[result.place] if structure is None and result.place < len(row) else None


def _zero_or_one(number: Entry) -> Entry:
    """Return 0, 1 or None: which number it is seldom matters, but for these two."""
    return abs(number) if number in (0.0, 1.0) else None


@lru_cache(1024)
def _entries(kernel: Kernel, result: tuple[float, ...] | None, known: tuple[Entry, ...]) -> Entries:
    structure, xp = kernel.structure, SYMBOLIC if result is None else FLOAT
    recorder = Recorder(np.dtype(np.float64))
    given = [
        recorder.input(str(place)) if number is None else np.float64(number)
        for place, number in enumerate(known)
    ]
    try:
        with np.errstate(all="ignore"):  # Of no paths at all, every number is 0.
            numbers: Any = kernel.made_for(SYMBOLIC)(*given) if result is None else result
        rows = (numbers,) if structure is None else structure.rows(xp, numbers)
        return tuple([tuple(map(_known, row)) for row in rows])
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return _UNKNOWN if structure is not None else _UNKNOWN[:1]


@lru_cache(1024)
def _as_it_may_be_absent(rows: Entries) -> Entries:
    return tuple(
        tuple(entry if entry == float(r == c) else None for c, entry in enumerate(row))
        for r, row in enumerate(rows)
    )


def _known(number: Any) -> Entry:
    return None if isinstance(number, Symbol) or not np.isfinite(number) else float(number)
