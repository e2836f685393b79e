"""The formula of a path: from what is given to the light at every end."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from functools import reduce
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.execute import execute, itself, whole_matrices
from optipath.engines.float_engine import CallingCarrier, call
from optipath.engines.formula import FROM_ANY, FROM_NEARER, Formula, is_in_first_quadrant, of_angle
from optipath.engines.program import carrying
from optipath.engines.symbols import ONE_AXIS, SYMBOLIC, Recorder, reproducible_symbolic
from optipath.kernels.carriers.carrier import MatrixCarrier, StokesCarrier
from optipath.kernels.carriers.intensities import BoundsCarrier, largest_error
from optipath.kernels.carriers.structures import is_physical
from optipath.kernels.trigonometry import DIGITS
from optipath.light.polarization_state import UNDERFLOW
from optipath.values.operands import ABSENT, MANY, ONE, WIDE
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping, Sequence

    from optipath.engines.program import LoopSolver, Program, Reading
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.kernels.primitives import Primitives
    from optipath.values.operands import InputKey, Operand


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

    The four components of each reading in turn, NaN where not read; with
    `unreduced`, known numbers are taken as inputs, and all components are computed. It holds for
    values within their limits whose light is finite and not too faint.
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
    if single:
        carried = CallingCarrier(recorder, carried)
    with np.errstate(all="ignore"):
        result = execute(program, symbols, carried, number=known or itself, solvers=solvers)
    outputs: list[Any] = []
    holds = [condition for solver in solvers for condition in solver.conditions]
    for reading in program.readings.values():
        components, exponent = result[reading.light]
        read: Any = components[: 4 if unreduced else reading.components]
        sound = _finite(read, recorder.dtype)
        if carrier is StokesCarrier:
            sound = sound & (components[0] >= tiny * UNDERFLOW)
        read, sound = _masked(xp, read, sound) if masks else (read, sound)
        if not isinstance(exponent, int):
            read = [xp.ldexp(component, exponent) for component in read]
            # NaN is not dark.
            dark = reduce(xp.maximum, map(xp.absolute, read)) < tiny
            read = [xp.where(dark, tiny.dtype.type(0.0), component) for component in read]
        outputs += [*read, *[np.nan] * (4 - len(read))]
        holds.append(sound)
    return _formula(recorder, outputs, holds)


def bounds_formula(
    program: Program,
    dtype: str,
    forms: Mapping[InputKey, str],
    limits: Mapping[Hashable, Limits],
    axes: Mapping[str, frozenset[int]] = NO_AXES,
    model: str | None = None,
) -> Formula:
    """Return the formula of what `BoundsCarrier` reads at every end, four numbers in turn.

    With a model, that of the unpolarized intensities at every end, and of its largest error.
    """
    recorder = Recorder(np.dtype(dtype))
    operands = SymbolicInputs(recorder, forms, limits, axes=axes)
    xp = operands.primitives
    symbols, carrier = operands.of(program), BoundsCarrier(xp, slack_of(program, dtype))
    matrices = whole_matrices(program, symbols, carrier)
    result = execute(program, symbols, carrier, shared=matrices)
    read = [result[reading.light][0] for reading in program.readings.values()]
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


Limits = tuple[float, float]

_APART = 1e-6
"""How far the squares of a cosine and a sine may be from 1 together."""


@dataclass(eq=False, repr=False)
class SymbolicInputs:
    """Makes the symbols of a program's operands."""

    recorder: Recorder
    forms: Mapping[InputKey, str]
    limits: Mapping[Hashable, Limits]
    _: KW_ONLY
    axes: Mapping[str, frozenset[int]]
    known: Callable[[Any], Any] | None = None
    single: bool = False
    counted: bool = False

    @property
    def primitives(self) -> Primitives:
        """What kernels are to be made of."""
        return SYMBOLIC if self.counted else reproducible_symbolic(self.recorder.precision)

    def of(self, program: Program) -> list[Any]:
        """Return a symbol, or a number that is known, for each operand."""
        results = [
            self._operand(operand, f".{place}") for place, operand in enumerate(program.operands)
        ]
        if self.known is None:
            return results
        return [
            operand if isinstance(operand, bool) else self.known(operand) for operand in results
        ]

    def _operand(self, operand: Operand, name: str) -> Any:
        if operand.known:
            numbers = operand.numbers(kind=wide(self.recorder.dtype))
            if operand.part == "present":
                return self._input(name, MANY, "bool") if numbers.ndim else True
            if numbers.ndim:
                return self._input(name, MANY)
            with np.errstate(over="ignore", under="ignore"):
                return self.recorder.dtype.type(numbers[()])
        key = operand.input_key
        if key not in self.forms:
            return self._of_pair(operand)
        form = self.forms[key]
        if key.part == "present":
            return form == ONE if form in (ONE, ABSENT) else self._input(str(key), form, "bool")
        if form == ABSENT:
            return self.recorder.dtype.type(0.0)
        argument = self._input_of(key, form)
        if operand.part in ("cos", "sin") and not self.counted:
            return self._circular(operand, form, argument)
        return operand.evaluated(self.primitives, argument)

    def _input(self, name: str, form: str, kind: str = "float", left: str = "") -> Any:
        axes = frozenset[int]() if form == ONE else self.axes.get(name, ONE_AXIS)
        return self.recorder.input(name, kind, axes=axes, left=left)

    def _input_of(self, key: InputKey, form: str) -> Any:
        low, high = key.limits_in(self.limits)
        argument = self._input(str(key), form)
        if form == WIDE:
            # What is looked at is the number that is given, not what is left of it.
            most = float(np.finfo(np.float64).max)
            self.recorder.wide[str(key)] = float(max(low, -most)), float(min(high, most))
        elif form != ONE or self.single:
            most = float(np.finfo(self.recorder.dtype).max)
            kind = self.recorder.dtype.type
            self.recorder.require(kind(max(low, -most)) <= argument)
            self.recorder.require(argument <= kind(min(high, most)))
        # From here on it is known, and no longer asked.
        argument.positive = low >= 0.0
        return argument

    def _of_pair(self, operand: Operand) -> Any:
        """Return what an operand sees of an angle that is given by its cosine and sine."""
        low, high = self.limits[operand.input_key.quantity]
        least = 0.0 if low >= 0.0 and high <= np.pi / 2 else -1.0
        cos, sin = (
            self._part(operand.input_key._replace(part=part), least) for part in ("cos", "sin")
        )
        self.recorder.require(abs(cos * cos + sin * sin - 1.0) <= _APART)
        return operand.evaluated(self.primitives, (cos, sin))

    def _part(self, key: InputKey, least: float) -> Any:
        kind = self.recorder.dtype.type
        if self.forms[key] == WIDE:
            self.recorder.wide[str(key)] = least, 1.0
        argument = self._input(str(key), self.forms[key])
        self.recorder.require(kind(least) <= argument)
        self.recorder.require(argument <= kind(1.0))
        argument.positive = least == 0.0
        return argument

    def _circular(self, operand: Operand, form: str, angle: Any) -> Any:
        kind, negative = self.recorder.dtype, operand.value.is_negative
        if negative:
            angle = -angle
        digits = DIGITS[kind.name]
        first = is_in_first_quadrant(operand, self.limits[operand.input_key.quantity])
        if self.single:
            return self._called_circular(operand, angle, first=first)
        left = None
        if form in (ONE, WIDE) and kind != wide(kind):
            # Next to a right angle it is all that there is, and has more digits than the angle.
            name = str(operand.input_key)
            left = self._input(name, form, left=FROM_NEARER if first else FROM_ANY)
            left = -left if negative else left
        if not first:
            self.recorder.require(abs(angle) <= digits.most)
        return of_angle(self.primitives, digits, operand.part, angle, left, first=first)

    def _called_circular(self, operand: Operand, angle: Any, *, first: bool) -> Any:
        digits = DIGITS[self.recorder.precision]

        def factory(xp: Primitives) -> Callable[[Any], tuple[Any, Any]]:
            return lambda angle: (
                of_angle(xp, digits, "sin", angle, None, first=first),
                of_angle(xp, digits, "cos", angle, None, first=first),
            )

        return call(self.recorder, ("angle", first), factory, (angle,))[operand.part == "cos"]
