"""Entries: what is known of a step's Mueller matrix before any number comes."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.formulas import Symbol
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbolic import SYMBOLIC
from optipath.kernels import FLOAT, Kernel, Primitives

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.program import Program
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


def entries(
    kernel: Kernel, operands: Sequence[Operand], presence: Operand | None = None
) -> Entries:
    """Return what is known of the matrix of a step, or of what it emits."""
    numbers = tuple(number_of(operand) for operand in operands)
    if any(number is None for number in numbers):
        # Which numbers they are seldom matters, but for these two and arrays of zeros.
        known = tuple(n if n in (0.0, 1.0) else None for n in numbers)
        zeros = map(vanishes, operands)
        known = tuple(0.0 if zero else n for n, zero in zip(known, zeros, strict=True))
        found = _symbolic(kernel, known)
    else:
        found = _rows(kernel, FLOAT, numbers)
    if presence is None or kernel.structure is None:
        return found
    return tuple(
        tuple(entry if entry == float(r == c) else None for c, entry in enumerate(row))
        for r, row in enumerate(found)
    )


def entries_of(program: Program, evaluation: int) -> Entries:
    """Return what is known of the matrix of an evaluation."""
    return entries(*program.parts(evaluation))


def vanishes(operand: Operand) -> bool:
    """Tell whether an operand is known to be 0, for every path."""
    if not operand.known or operand.traced:
        return False
    numbers = operand.numbers({})
    # Of most arrays the first number tells.
    return not (numbers.size and numbers[(0,) * numbers.ndim]) and not np.any(numbers)


@lru_cache(1024)
def _symbolic(kernel: Kernel, known: tuple[Entry, ...]) -> Entries:
    recorder = Recorder(np.dtype(np.float64))
    arguments = [
        recorder.input(str(place)) if number is None else np.float64(number)
        for place, number in enumerate(known)
    ]
    return _rows(kernel, SYMBOLIC, arguments)


def _rows(kernel: Kernel, xp: Primitives, arguments: Sequence[Any]) -> Entries:
    try:
        numbers = kernel.made_for(xp)(*arguments)
        structure = kernel.structure
        rows = (numbers,) if structure is None else structure.rows(xp, numbers)
        return tuple(tuple(map(_known, row)) for row in rows)
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return _UNKNOWN if kernel.structure is not None else _UNKNOWN[:1]


def _known(number: Any) -> Entry:
    return None if isinstance(number, Symbol) or not np.isfinite(number) else float(number)
