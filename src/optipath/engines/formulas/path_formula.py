"""The formula of a path: from what is given to the light at every end."""

from __future__ import annotations

from functools import reduce
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.formula import Formula
from optipath.engines.formulas.recorder import Recorder
from optipath.engines.formulas.symbolic_inputs import Leaves, Limits
from optipath.engines.program.execute import itself, walk, whole_matrices
from optipath.kernels import Bounds, Linear, Plain, Powers, is_physical, largest_error
from optipath.light.underflow import FAINT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines.program.loops import Meeting
    from optipath.engines.program.program import Program, Reading
    from optipath.kernels import Way
    from optipath.values.operands import Raw


NO_AXES: Mapping[str, frozenset[int]] = MappingProxyType({})
"""Nothing is said of the axes of arrays: all differ from path to path."""

_SPARE = 2.0**60
"""How far the numbers of a quotient keep from where they lose digits."""


def lights_formula(
    program: Program,
    way: type[Way],
    dtype: str,
    forms: Mapping[Raw, str],
    limits: Mapping[str, Limits],
    *,
    polynomials: bool,
    axes: Mapping[str, frozenset[int]] = NO_AXES,
    as_it_stands: bool = False,
) -> Formula:
    """Return the formula of the light at every end.

    With `as_it_stands`, numbers that are known are taken like those that are given, and all
    four components are computed, read or not. The results are the four components of each
    reading in turn, else NaN where they are not read, and then the exponents. It holds for values
    within their limits whose light is finite and not too faint.
    """
    recorder = Recorder(np.dtype(dtype))
    known = recorder.hidden if as_it_stands else None
    leaves = Leaves(recorder, forms, limits, polynomials=polynomials, axes=axes, known=known)
    xp, tiny = leaves.primitives, recorder.dtype.type(np.finfo(recorder.dtype).tiny)
    carried: Way = way(xp)
    if way is Plain and program.for_powers is not None:
        program, carried = program.for_powers, Powers(xp, tiny * _SPARE)
    meetings: list[Meeting] = []
    symbols = leaves.of(program)
    with np.errstate(all="ignore"):
        found = walk(program, symbols, carried, number=known or itself, meetings=meetings)
    outputs: list[Any] = []
    exponents: list[Any] = []
    holds = [condition for meeting in meetings for condition in meeting.conditions]
    for reading in program.readings.values():
        components, exponent = found[reading.light]
        read = components[: 4 if as_it_stands else reading.components]
        outputs += [*read, *[np.nan] * (4 - len(read))]
        exponents.append(exponent)
        holds.append(_finite(read, recorder.dtype))
        if way is Plain:
            holds.append(components[0] >= tiny * FAINT)
    return _formula(recorder, [*outputs, *exponents], holds)


def bounds_formula(
    program: Program,
    dtype: str,
    forms: Mapping[Raw, str],
    limits: Mapping[str, Limits],
    axes: Mapping[str, frozenset[int]] = NO_AXES,
    model: str | None = None,
) -> Formula:
    """Return the formula of what `Bounds` reads at every end, four numbers in turn.

    With the name of a model, that of the intensities without polarisation at every end, and
    of the largest error that the model has at any of them.
    """
    recorder = Recorder(np.dtype(dtype))
    leaves = Leaves(recorder, forms, limits, polynomials=True, axes=axes)
    xp = leaves.primitives
    symbols, way = leaves.of(program), Bounds(xp, slack_of(program, dtype))
    matrices = whole_matrices(program, symbols, way)
    found = walk(program, symbols, way, shared=matrices)
    read = [found[reading.light][0] for reading in program.readings.values()]
    totals = [total for total, *_ in read]
    holds = [is_physical(xp, matrix, _spare(dtype)) for matrix in matrices.values()]
    holds += [_finite([n for numbers in read for n in numbers], recorder.dtype)]
    holds += [total >= np.finfo(recorder.dtype).tiny * FAINT for total in totals]
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
    forms: Mapping[Raw, str],
    limits: Mapping[str, Limits],
    axes: Mapping[str, frozenset[int]] = NO_AXES,
) -> Formula:
    """Return the formula of the Mueller matrix from a source to a reading, row by row."""
    recorder = Recorder(np.dtype(dtype))
    leaves = Leaves(recorder, forms, limits, polynomials=True, axes=axes)
    symbols, way = leaves.of(program), Linear(leaves.primitives)
    none, one = recorder.dtype.type(0.0), recorder.dtype.type(1.0)
    columns = []
    meetings: list[Meeting] = []
    for place in range(4):
        emitted = {step: (none,) * 4 for step, _ in program.sources.values()}
        begin, _ = program.sources[source]
        emitted[begin] = tuple(one if row == place else none for row in range(4))
        with np.errstate(all="ignore"):
            components, _ = walk(program, symbols, way, emitted, meetings=meetings)[reading.light]
        columns.append(components)
    rows = range(reading.components)
    outputs = [column[row] for row in rows for column in columns]
    unread = [np.nan] * (16 - len(outputs))
    holds = [condition for meeting in meetings[:1] for condition in meeting.conditions]
    return _formula(recorder, [*outputs, *unread], [*holds, _finite(outputs, recorder.dtype)])


def _finite(numbers: Any, dtype: np.dtype[Any]) -> Any:
    """Return whether numbers are finite: their sum, and so each."""
    total: Any = reduce(lambda one, other: one + other, map(abs, numbers))
    return total <= np.finfo(dtype).max


def _formula(recorder: Recorder, results: list[Any], holds: list[Any]) -> Formula:
    conditions = (*recorder.requirements, *holds)
    return Formula(recorder.dtype, tuple(results), conditions, recorder.wide, recorder.constants)
