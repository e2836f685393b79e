"""The formula of a path: from what is given to the light at every end."""

from __future__ import annotations

from functools import reduce
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.formula import Formula
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbolic_inputs import Limits, SymbolicInputs
from optipath.engines.program.carrying import carrying
from optipath.engines.program.execute import execute, itself, whole_matrices
from optipath.kernels.carriers.bounds_carrier import BoundsCarrier, largest_error
from optipath.kernels.carriers.coherency import is_physical
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.light.underflow import UNDERFLOW

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence

    from optipath.engines.program.loops import LoopSolver
    from optipath.engines.program.program import Program, Reading
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.kernels.numbers.primitives import Primitives
    from optipath.values.input_key import InputKey


NO_AXES: Mapping[str, frozenset[int]] = MappingProxyType({})
"""Nothing is said of the axes of arrays: all differ from path to path."""


def lights_formula(
    program: Program,
    carrier: type[Carrier],
    dtype: str,
    forms: Mapping[InputKey, str],
    limits: Mapping[Hashable, Limits],
    *,
    axes: Mapping[str, frozenset[int]] = NO_AXES,
    unreduced: bool = False,
    masks: bool = False,
    single: bool = False,
    counted: bool = False,
) -> Formula:
    """Return the formula of the light at every end.

    With `unreduced`, numbers that are known are taken like those that are given, and all
    four components are computed, read or not. The results are the four components of each
    reading in turn, else NaN where they are not read, and then the exponents. It holds for values
    within their limits whose light is finite and not too faint.
    """
    recorder = Recorder(np.dtype(dtype))
    known = recorder.opaque if unreduced else None
    operands = SymbolicInputs(
        recorder, forms, limits, axes=axes, known=known, single=single, counted=counted
    )
    xp, tiny = operands.primitives, recorder.dtype.type(np.finfo(recorder.dtype).tiny)
    program, carried = carrying(program, carrier, xp, dtype)
    solvers: list[LoopSolver] = []
    symbols = operands.of(program)
    with np.errstate(all="ignore"):
        found = execute(program, symbols, carried, number=known or itself, solvers=solvers)
    outputs: list[Any] = []
    exponents: list[Any] = []
    holds = [condition for solver in solvers for condition in solver.conditions]
    for reading in program.readings.values():
        components, exponent = found[reading.light]
        read: Any = components[: 4 if unreduced else reading.components]
        sound = _finite(read, recorder.dtype)
        if carrier is StokesCarrier:
            sound = sound & (components[0] >= tiny * UNDERFLOW)
        read, sound = _masked(xp, read, sound) if masks else (read, sound)
        outputs += [*read, *[np.nan] * (4 - len(read))]
        exponents.append(exponent)
        holds.append(sound)
    return _formula(recorder, [*outputs, *exponents], holds)


def bounds_formula(
    program: Program,
    dtype: str,
    forms: Mapping[InputKey, str],
    limits: Mapping[Hashable, Limits],
    axes: Mapping[str, frozenset[int]] = NO_AXES,
    model: str | None = None,
) -> Formula:
    """Return the formula of what `BoundsCarrier` reads at every end, four numbers in turn.

    With the name of a model, that of the intensities without polarisation at every end, and
    of the largest error that the model has at any of them.
    """
    recorder = Recorder(np.dtype(dtype))
    operands = SymbolicInputs(recorder, forms, limits, axes=axes)
    xp = operands.primitives
    symbols, carrier = operands.of(program), BoundsCarrier(xp, slack_of(program, dtype))
    matrices = whole_matrices(program, symbols, carrier)
    found = execute(program, symbols, carrier, shared=matrices)
    read = [found[reading.light][0] for reading in program.readings.values()]
    totals = [total for total, *_ in read]
    holds = [is_physical(xp, matrix, _spare(dtype)) for matrix in matrices.values()]
    holds += [_finite([n for numbers in read for n in numbers], recorder.dtype)]
    holds += [total >= np.finfo(recorder.dtype).tiny * UNDERFLOW for total in totals]
    if model is None:
        return _formula(recorder, [n for numbers in read for n in numbers], holds)
    errors = [largest_error(xp, lower, upper, model) for _, lower, upper, _ in read]
    return _formula(recorder, [*totals, reduce(xp.maximum, errors)], holds)


def slack_of(program: Program, dtype: str) -> float:
    """Return what bounds give away for roundings, those of whole Mueller matrices included."""
    matrices = sum(map(len, program.matrices.values()))
    return 256.0 * float(np.finfo(dtype).eps) + 16.0 * _spare(dtype) * matrices


def _spare(dtype: str) -> float:
    """Return how far an eigenvalue of a matrix may be below 0 by rounding, as a share of M00."""
    return 32.0 * float(np.finfo(dtype).eps)


def matrix_formula(
    program: Program,
    source: str,
    reading: Reading,
    dtype: str,
    forms: Mapping[InputKey, str],
    limits: Mapping[Hashable, Limits],
    axes: Mapping[str, frozenset[int]] = NO_AXES,
    *,
    masks: bool = False,
) -> Formula:
    """Return the formula of the Mueller matrix from a source to a reading, row by row."""
    recorder = Recorder(np.dtype(dtype))
    operands = SymbolicInputs(recorder, forms, limits, axes=axes)
    symbols, carrier = operands.of(program), MatrixCarrier(operands.primitives)
    none, one = recorder.dtype.type(0.0), recorder.dtype.type(1.0)
    columns = []
    solvers: list[LoopSolver] = []
    for place in range(4):
        emitted = {step: (none,) * 4 for step, _ in program.sources.values()}
        begin, _ = program.sources[source]
        emitted[begin] = tuple(one if row == place else none for row in range(4))
        with np.errstate(all="ignore"):
            components, _ = execute(program, symbols, carrier, emitted, solvers=solvers)[
                reading.light
            ]
        columns.append(components)
    rows = range(reading.components)
    outputs = [column[row] for row in rows for column in columns]
    sound = _finite(outputs, recorder.dtype)
    if masks:
        outputs, sound = _masked(operands.primitives, outputs, sound)
    unread = [np.nan] * (16 - len(outputs))
    holds = [condition for solver in solvers[:1] for condition in solver.conditions]
    return _formula(recorder, [*outputs, *unread], [*holds, sound])


def _masked(xp: Primitives, numbers: Sequence[Any], sound: Any) -> tuple[list[Any], Any]:
    """Return numbers that are all NaN where the first is, and whether they are sound or so."""
    there = numbers[0] == numbers[0]  # Of all numbers, NaN alone differs from itself.
    return [xp.where(there, number, np.nan) for number in numbers], sound | ~there


def _finite(numbers: Any, dtype: np.dtype[Any]) -> Any:
    """Return whether numbers are finite: their sum, and so each."""
    total: Any = reduce(lambda one, other: one + other, map(abs, numbers))
    return total <= np.finfo(dtype).max


def _formula(recorder: Recorder, results: list[Any], holds: list[Any]) -> Formula:
    conditions = (*recorder.requirements, *holds)
    return Formula(recorder.dtype, tuple(results), conditions, recorder.wide, recorder.constants)
