"""The formula of a path: from what is given to the light at every end."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, field
from functools import reduce
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.float_engine import CallingCarrier, call
from optipath.engines.formula import FROM_ANY, FROM_NEARER, Formula, is_in_first_quadrant, of_angle
from optipath.engines.program import carrying, execute, itself, whole_matrices
from optipath.engines.symbols import ONE_AXIS, SYMBOLIC, Recorder, reproducible_symbolic
from optipath.kernels.carriers.carrier import MatrixCarrier, StokesCarrier
from optipath.kernels.carriers.intensities import BoundsCarrier, largest_error
from optipath.kernels.carriers.structures import FULL, is_physical
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


Limits: TypeAlias = tuple[float, float]

_APART = 1e-6
"""How far the squares of a cosine and a sine may be from 1 together."""


@dataclass(eq=False, repr=False)
class PathFormula:
    """Records what a program does with what is given, for values within their limits.

    With `unreduced`, known numbers are taken as inputs, and all components are computed; `single`
    is for one path of floats, by functions that paths share; `counted` counts operations alone.
    Arrays of which `axes` says nothing differ from path to path.
    """

    program: Program
    precision: str
    forms: Mapping[InputKey, str]
    limits: Mapping[Hashable, Limits]
    axes: Mapping[Any, frozenset[int]] = field(default_factory=dict)
    _: KW_ONLY
    masks: bool = False
    unreduced: bool = False
    single: bool = False
    counted: bool = False
    holds: list[Any] = field(default_factory=list, init=False)

    def __post_init__(self) -> None:
        self.recorder = Recorder(np.dtype(self.precision))
        self.dtype = self.recorder.dtype
        self.xp = SYMBOLIC if self.counted else reproducible_symbolic(self.precision)

    def lights(self, carrier: type[Carrier]) -> Formula:
        """Return the formula of the light at every end, if it is finite and not too faint.

        The four components of each reading in turn, NaN where not read.
        """
        xp, tiny = self.xp, self.dtype.type(np.finfo(self.dtype).tiny)
        program, carried = carrying(self.program, carrier, xp, self.precision)
        solvers: list[LoopSolver] = []
        symbols = self._operands()
        shows_dark = self.axes and type(carried) is StokesCarrier and self._only_loses
        if self.single:
            carried = CallingCarrier(self.recorder, carried)
        number = self.recorder.opaque if self.unreduced else itself
        with np.errstate(all="ignore"):
            result = execute(program, symbols, carried, number=number, solvers=solvers)
        outputs: list[Any] = []
        self.holds += [condition for solver in solvers for condition in solver.conditions]
        for reading in program.readings.values():
            components, exponent = result[reading.light]
            read: Any = components[: 4 if self.unreduced else reading.components]
            sound = self._finite(read)
            if carrier is StokesCarrier:
                bright = components[0] >= tiny * UNDERFLOW
                dark = sum(map(abs, read)) == 0.0
                sound = sound & (bright | dark if shows_dark else bright)
            read, sound = self._masked(read, sound)
            if not isinstance(exponent, int):
                read = [xp.ldexp(component, exponent) for component in read]
                # NaN is not dark.
                dark = reduce(xp.maximum, map(xp.absolute, read)) < tiny
                read = [xp.where(dark, tiny.dtype.type(0.0), component) for component in read]
            outputs += [*read, *[np.nan] * (4 - len(read))]
            self.holds.append(sound)
        return self._formula(outputs)

    @property
    def _only_loses(self) -> bool:
        """Whether nothing amplifies, so that what is 0 on the way is 0 at the end."""
        kernels = [evaluation.kernel for evaluation in self.program.evaluations]
        return not self.program.loops and all(
            kernel.structure is not FULL and kernel.is_built_in for kernel in kernels
        )

    def matrix(self, source: str, reading: Reading) -> Formula:
        """Return the formula of the Mueller matrix from a source to a reading, row by row."""
        symbols, carrier = self._operands(), MatrixCarrier(self.xp)
        none, one = self.dtype.type(0.0), self.dtype.type(1.0)
        begin, _ = self.program.sources[source]
        columns = []
        solvers: list[LoopSolver] = []
        for place in range(4):
            emitted = {step: (none,) * 4 for step, _ in self.program.sources.values()}
            emitted[begin] = tuple(one if row == place else none for row in range(4))
            with np.errstate(all="ignore"):
                lights = execute(self.program, symbols, carrier, emitted, solvers=solvers)
            columns.append(lights[reading.light][0])
        rows = [column[row] for row in range(reading.components) for column in columns]
        outputs, sound = self._masked(rows, self._finite(rows))
        self.holds += [condition for solver in solvers[:1] for condition in solver.conditions]
        self.holds.append(sound)
        return self._formula([*outputs, *[np.nan] * (16 - len(outputs))])

    def bounds(self, model: str | None = None) -> Formula:
        """Return the formula of what `BoundsCarrier` reads at every end, four numbers in turn.

        With a model, that of the unpolarized intensities at every end, and of its largest error.
        """
        xp, kind, symbols = self.xp, self.precision, self._operands()
        carrier = BoundsCarrier(xp, slack_of(self.program, kind))
        matrices = whole_matrices(self.program, symbols, carrier)
        result = execute(self.program, symbols, carrier, shared=matrices)
        read = [result[reading.light][0] for reading in self.program.readings.values()]
        numbers, totals = [n for several in read for n in several], [total for total, *_ in read]
        self.holds += [is_physical(xp, matrix, _spare(kind)) for matrix in matrices.values()]
        self.holds += [self._finite(numbers)]
        self.holds += [total >= np.finfo(self.dtype).tiny * UNDERFLOW for total in totals]
        if model is None:
            return self._formula(numbers)
        errors = [largest_error(xp, lower, upper, model) for _, lower, upper, _ in read]
        return self._formula([*totals, reduce(xp.maximum, errors)])

    def _masked(self, numbers: Sequence[Any], sound: Any) -> tuple[Sequence[Any], Any]:
        """Return numbers that are all NaN where the first may be, and whether they are sound."""
        if not self.masks:
            return numbers, sound
        there = numbers[0] == numbers[0]  # Of all numbers, NaN alone differs from itself.
        return [self.xp.where(there, number, np.nan) for number in numbers], sound | ~there

    def _finite(self, numbers: Any) -> Any:
        """Return whether numbers are finite: their sum, and so each."""
        total: Any = reduce(lambda one, other: one + other, map(abs, numbers))
        return total <= np.finfo(self.dtype).max

    def _formula(self, results: Sequence[Any]) -> Formula:
        made = self.recorder
        conditions = (*made.requirements, *self.holds)
        about = tuple(results), conditions, made.wide, made.constants
        return Formula(made.dtype, *about, apart=self.single)

    def _operands(self) -> list[Any]:
        """Return a symbol, or a number that is known, for each operand."""
        operands = enumerate(self.program.operands)
        results = [self._operand(operand, f".{place}") for place, operand in operands]
        if not self.unreduced:
            return results
        return [o if isinstance(o, bool) else self.recorder.opaque(o) for o in results]

    def _operand(self, operand: Operand, name: str) -> Any:
        if operand.known:
            numbers = operand.numbers(kind=wide(self.dtype))
            if operand.part == "present":
                return self._input(name, MANY, "bool") if numbers.ndim else True
            if numbers.ndim:
                return self._input(name, MANY)
            with np.errstate(over="ignore", under="ignore"):
                return self.dtype.type(numbers[()])
        key = operand.input_key
        if key not in self.forms:
            return self._of_pair(operand)
        form = self.forms[key]
        if key.part == "present":
            return form == ONE if form in (ONE, ABSENT) else self._input(key, form, "bool")
        if form == ABSENT:
            return self.dtype.type(0.0)
        argument = self._within(key, *key.limits_in(self.limits))
        if operand.part in ("cos", "sin") and not self.counted:
            return self._circular(operand, form, argument)
        return operand.evaluated(self.xp, argument)

    def _input(self, name: Any, form: str, kind: str = "float", left: str = "") -> Any:
        axes = frozenset[int]() if form == ONE else self.axes.get(name, ONE_AXIS)
        return self.recorder.input(name, kind, axes=axes, left=left)

    def _within(self, key: InputKey, low: float, high: float, *, always: bool = False) -> Any:
        """Return a number that is given, whose range is required where nobody else looks at it."""
        form, kind = self.forms[key], self.dtype.type
        argument = self._input(key, form)
        if form == WIDE:
            # What is looked at is the number that is given, not what is left of it.
            most = float(np.finfo(np.float64).max)
            self.recorder.wide[key] = float(max(low, -most)), float(min(high, most))
        if always or self.single or form == MANY:
            most = float(np.finfo(self.dtype).max)
            ends = kind(max(low, -most)), kind(min(high, most))
            if self.single:
                self.recorder.require(self.recorder.record("within", argument, *ends))
            else:
                self.recorder.require(ends[0] <= argument)
                self.recorder.require(argument <= ends[1])
        # From here on it is known, and no longer asked.
        argument.positive = low >= 0.0
        return argument

    def _of_pair(self, operand: Operand) -> Any:
        """Return what an operand sees of an angle that is given by its cosine and sine."""
        key = operand.input_key
        low, high = self.limits[key.quantity]
        least = 0.0 if low >= 0.0 and high <= np.pi / 2 else -1.0
        pair = [key._replace(part=part) for part in ("cos", "sin")]
        cos, sin = [self._within(each, least, 1.0, always=True) for each in pair]
        self.recorder.require(abs(cos * cos + sin * sin - 1.0) <= _APART)
        return operand.evaluated(self.xp, (cos, sin))

    def _circular(self, operand: Operand, form: str, angle: Any) -> Any:
        kind, negative = self.dtype, operand.value.is_negative
        if negative:
            angle = -angle
        digits = DIGITS[self.precision]
        first = is_in_first_quadrant(operand, self.limits[operand.input_key.quantity])
        if self.single:
            return self._called_circular(operand, angle, first=first)
        left = None
        if form in (ONE, WIDE) and kind != wide(kind):
            # Next to a right angle it is all that there is, and has more digits than the angle.
            nearer = FROM_NEARER if first else FROM_ANY
            left = self._input(operand.input_key, form, left=nearer)
            left = -left if negative else left
        if not first:
            self.recorder.require(abs(angle) <= digits.most)
        return of_angle(self.xp, digits, operand.part, angle, left, first=first)

    def _called_circular(self, operand: Operand, angle: Any, *, first: bool) -> Any:
        digits = DIGITS[self.precision]

        def factory(xp: Primitives) -> Callable[[Any], tuple[Any, Any]]:
            return lambda angle: (
                of_angle(xp, digits, "sin", angle, None, first=first),
                of_angle(xp, digits, "cos", angle, None, first=first),
            )

        return call(self.recorder, ("angle", first), factory, (angle,))[operand.part == "cos"]


def slack_of(program: Program, dtype: str) -> float:
    """Return what bounds give away for roundings, those of whole Mueller matrices included."""
    matrices = sum(map(len, program.matrices.values()))
    return 256.0 * float(np.finfo(dtype).eps) + 16.0 * _spare(dtype) * matrices


def _spare(dtype: str) -> float:
    """Return how far an eigenvalue of a matrix may be below 0 by rounding, as a share of M00."""
    return 32.0 * float(np.finfo(dtype).eps)
