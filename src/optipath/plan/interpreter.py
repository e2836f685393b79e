"""Interpreter: a program run step by step, loops and physical checks included.

Where little light leaves a loop, 1 - gain loses digits, so elements of a loop are evaluated and
summed in twice the precision, by the same kernels.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from functools import partial, reduce
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.engines.execute import evaluated, execute, whole_matrices
from optipath.engines.path_formula import slack_of
from optipath.engines.program import LoopSolver
from optipath.errors import LoopWarning, ParameterError
from optipath.kernels.carriers.carrier import (
    JonesCarrier,
    MatrixCarrier,
    ScaledCarrier,
    StokesCarrier,
)
from optipath.kernels.carriers.intensities import BoundsCarrier
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.double_double import DoubleDouble, twice
from optipath.kernels.primitives import NUMPY
from optipath.light.decompositions import lack, tolerance_for
from optipath.light.underflow import underflows, unscaled
from optipath.values.angles import calls_up
from optipath.values.arrays import joint_shape
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from optipath.engines.program import Loop, Program, Reading
    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.kernels.carriers.structures import Numbers
    from optipath.plan.reading import ResolvedInputs
    from optipath.values.operands import Operand

    Array = np.ndarray[Any, Any]


Shared: TypeAlias = Mapping[int, tuple[np.ndarray[Any, Any], ...]]

_LONG = 16


def carrier_of(program: Program, composing: str) -> type[Carrier]:
    """Return how light is carried along a program."""
    if composing == "jones":
        return JonesCarrier
    return ScaledCarrier if len(program.steps) > _LONG else StokesCarrier


class Interpreter:
    """Runs a program without compiling anything."""

    def __init__(self, program: Program, carrier: type[Carrier], dtype: np.dtype[Any]) -> None:
        self.program = program
        self.carrier = carrier
        self.dtype = dtype
        self._carriers = {kind: kind(NUMPY) for kind in (carrier, ScaledCarrier, MatrixCarrier)}
        self._known: list[Any] | None = None

    def lights(
        self, arguments: ResolvedInputs, shared: Shared | None = None
    ) -> list[np.ndarray[Any, Any]]:
        """Return Stokes vectors (..., 4) at every end; for parts, see `shared`."""
        own = {
            index: tuple(map(arguments.cut, numbers)) for index, numbers in (shared or {}).items()
        }
        return self._results(arguments, own)

    def shared(self, arguments: ResolvedInputs) -> Shared:
        """Return evaluations along a few axes of a batch only, no larger than its light."""
        operands, carrier = self.operands(arguments), self._carriers[self.carrier]
        left, result = 4 * arguments.paths, {}
        with np.errstate(all="ignore"):
            for index, evaluation in enumerate(self.program.evaluations):
                shapes = [operands[operand].shape for operand in self.program.passed_to[index]]
                shapes += (
                    [] if evaluation.presence is None else [operands[evaluation.presence].shape]
                )
                size = 16 * prod(joint_shape(*shapes))
                needed = self.program.evaluation_uses[index]
                if needed and size <= min(left, arguments.paths):
                    result[index] = evaluated(self.program, index, operands, carrier, self.number)
                    left -= size
        return result

    def matrix(
        self, arguments: ResolvedInputs, source: str, reading: Reading
    ) -> np.ndarray[Any, Any]:
        """Return Mueller matrices (..., 4, 4) from a source to a reading."""
        none = self.dtype.type(0.0)
        begin, _ = self.program.sources[source]

        def emitted(part: ResolvedInputs) -> dict[int, Components]:
            columns = np.eye(4, dtype=self.dtype).reshape(4, 4, *[1] * len(part.batch))
            dark = {step: (none,) * 4 for step, _ in self.program.sources.values()}
            return {**dark, begin: tuple(columns[:, row] for row in range(4))}

        lights = self._execute(arguments, self._carriers[MatrixCarrier], emitted)
        stokes = _stack(lights[reading.light][0], (4, *arguments.batch), reading, self.dtype)
        return np.ascontiguousarray(np.moveaxis(stokes, 0, -1))

    def bounds(self, arguments: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        """Return what `BoundsCarrier` reads at every end, shape (4, ...)."""
        operands = self.operands(arguments)
        with np.errstate(all="ignore"):
            matrices = whole_matrices(
                self.program, operands, self._carriers[MatrixCarrier], self.number
            )
        lacking = what_matrices_lack(self.program, matrices)
        carrier = BoundsCarrier(NUMPY, slack_of(self.program, self.dtype.name) + lacking)
        result = self._execute(arguments, carrier, shared=matrices)
        read = []
        for reading in self.program.readings.values():
            parts = np.empty((4, *arguments.batch), self.dtype)
            for row, part in enumerate(result[reading.light][0]):
                parts[row] = part
            # What is too extreme for floats is bounded by nothing.
            message = np.all(np.isfinite(parts), axis=0)
            parts[1] = np.where(message, parts[1], 0.0)
            parts[2] = np.where(message, parts[2], np.inf)
            read.append(parts)
        return read

    def _results(self, arguments: ResolvedInputs, shared: Shared) -> list[Array]:
        """Return light; what is so faint that numbers on the way underflow is carried scaled."""
        result = self._stacked(arguments, self._carriers[self.carrier], shared)
        if self.carrier is StokesCarrier and any(np.any(underflows(s[..., 0])) for s in result):
            result = self._stacked(arguments, self._carriers[ScaledCarrier], shared)
        return result

    def _stacked(self, arguments: ResolvedInputs, carrier: Carrier, shared: Shared) -> list[Array]:
        return self._read(arguments, self._execute(arguments, carrier, None, shared))

    def _read(self, arguments: ResolvedInputs, lights: Mapping[int, Any]) -> list[Array]:
        """Return the light at every end as Stokes vectors."""
        results = []
        for reading in self.program.readings.values():
            components, exponent = lights[reading.light]
            stokes = _stack(components, arguments.batch, reading, self.dtype)
            results.append(stokes if isinstance(exponent, int) else unscaled(stokes, exponent))
        return results

    def _execute(
        self,
        arguments: ResolvedInputs,
        carrier: Carrier,
        emitted: Any = None,
        shared: Shared | None = None,
    ) -> dict[int, Any]:
        solvers: list[LoopSolver] = []
        begin = emitted and emitted(arguments)
        with np.errstate(all="ignore"):
            operands = self.operands(arguments)
            result = execute(self.program, operands, carrier, begin, self.number, shared, solvers)
            doubtful = _doubtful(solvers, arguments.batch)
            if not np.any(doubtful):
                return result
            part = arguments if np.all(doubtful) else arguments.part((doubtful,))
            operands, solvers = self.operands(part), []
            begin = emitted and emitted(part)
            closer = CloserLook(self.program, part, operands, self.dtype)
            longer = closer.evaluations()
            again = execute(
                self.program, operands, carrier, begin, self.number, longer, solvers, closer.meet
            )
            check_gains(solvers)
        return again if part is arguments else _instead(result, again, doubtful)

    def number(self, number: Any) -> np.ndarray[Any, Any]:
        """Return what a kernel gives in the precision of the plan."""
        # Plain numbers among what kernels give have no precision of their own.
        return np.asarray(number, self.dtype)

    def operands(self, arguments: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        """Return the numbers behind the operands of the program."""
        if self._known is None:
            self._known = [
                self._cast(operand.numbers(kind=wide(self.dtype))) if operand.known else None
                for operand in self.program.operands
            ]
        return [
            self._operand_array(operand, arguments) if fixed is None else arguments.cut(fixed)
            for fixed, operand in zip(self._known, self.program.operands, strict=True)
        ]

    def _operand_array(self, operand: Operand, arguments: ResolvedInputs) -> np.ndarray[Any, Any]:
        if operand.part == "imag" and arguments.numbers[operand.input_key] is False:
            # Not an array, so that kernels see an index that does not absorb.
            return self.dtype.type(0.0)  # type: ignore[no-any-return]
        kind = wide(self.dtype) if operand.part in ("cos", "sin") else None
        raw = operand.number_in(arguments.numbers, partial(np.asarray, dtype=kind))
        return self._cast(operand.evaluated(NUMPY, raw))

    def _cast(self, numbers: Any) -> np.ndarray[Any, Any]:
        array = np.asarray(numbers)
        with np.errstate(over="ignore", under="ignore"):  # What is not finite is told later.
            return array if array.dtype == bool else array.astype(self.dtype, copy=False)


def _doubtful(solvers: Sequence[LoopSolver], batch: tuple[int, ...]) -> np.ndarray[Any, Any]:
    """Return for which paths of a batch a loop takes a closer look."""
    holds = [condition for solver in solvers for condition in solver.conditions]
    return np.broadcast_to(np.logical_not(reduce(np.logical_and, holds, np.True_)), batch)


def _instead(
    results: dict[int, Any], others: Mapping[int, Any], where: np.ndarray[Any, Any]
) -> dict[int, Any]:
    """Return lights, those of some paths replaced by others."""

    def put(number: Any, other: Any) -> Any:
        number = np.asarray(number)
        several = number.shape[: max(0, number.ndim - where.ndim)]
        whole = np.array(np.broadcast_to(number, (*several, *where.shape)))
        whole[..., where] = other
        return whole

    return {
        light: (tuple(map(put, components, others[light][0])), put(exponent, others[light][1]))
        for light, (components, exponent) in results.items()
    }


def _stack(
    components: Any, batch: tuple[int, ...], reading: Reading, dtype: np.dtype[Any]
) -> np.ndarray[Any, Any]:
    stokes = np.full((*batch, 4), np.nan, dtype=dtype)
    for component in range(reading.components):
        stokes[..., component] = components[component]
    return stokes


_ALLOWANCE = 10.0
"""By how much bounds may be wrong, per unit share by which an eigenvalue is below 0: M + 4 l
diag(1, 0, 0, 0) is physical where M has the eigenvalue -l, once for each of two intensities."""


def what_matrices_lack(program: Program, matrices: Mapping[int, Numbers]) -> Any:
    """Return what bounds must give away, since some matrices have been rounded."""
    total: Any = 0.0
    for index, numbers in matrices.items():
        elements = program.matrices[index]
        matrix = _stacked(numbers)
        share = lack(matrix)
        if np.any(share > tolerance_for(matrix)):
            raise ParameterError(
                f"the Mueller matrix of '{elements[0]}' is unphysical, having a coherency "
                f"eigenvalue of {-np.nanmax(share):.3g} times the largest, so nothing bounds its "
                f"light; give it Mueller(matrix).nearest_physical().matrix"
            )
        total = total + _ALLOWANCE * len(elements) * share
    return total


def _stacked(numbers: Sequence[Any]) -> np.ndarray[Any, Any]:
    """Return matrices (..., 4, 4), in single precision where that holds all their digits."""
    flat = np.stack(np.broadcast_arrays(*numbers), axis=-1)
    with np.errstate(over="ignore"):
        single = flat.astype(np.float32)
    matrix = single if np.array_equal(single, flat) else flat
    return matrix.reshape(*flat.shape[:-1], 4, 4)


_MOST = 1 << 22
"""How many entries of matrices are looked at together; larger systems are judged by sums."""

_WARNED = 1e-4
"""What leaves a loop each time round below which it is told, as a share."""

_FEW_DIGITS, _NEAR = 1e-9, 1e-3
"""How near to 1 a gain has lost its digits, and how near it may have, where light gains."""

_ROUNDING = 1e-15


class LargestGain(NamedTuple):
    """That path of a batch of which most stays in a loop."""

    closed: bool
    leaves: float
    condition: float


def check_gains(solvers: Sequence[LoopSolver]) -> None:
    """Refuse light that gains going round; warn where nearly all of it comes back.

    Without amplifiers, some light stays where a pivot is 0. Else the spectral radius of the round
    trip tells; next to 1, whether unpolarized light given to every junction adds up to physical
    light, which it does just where the radius is below 1 (Krein & Rutman, Uspekhi Mat. Nauk 3,
    1948).
    """
    faults = []
    for solver in solvers:
        if np.all(reduce(np.logical_and, solver.conditions, np.True_)):
            continue
        place = solver.program.steps[solver.loop.start].label
        worst = _Judged(solver).worst()
        if worst is None:
            faults.append(
                f"what comes back of the light that goes round at '{place}' is no finite number: "
                f"a value is too extreme; give values nearer to 1, or compose with "
                f"method='stable' and dtype='float64'"
            )
        elif worst.closed:
            faults.append(
                f"light that goes round at '{place}' never fades: {1.0 - worst.leaves:.9g} of it "
                f"comes back each time; let some of it leave, or absorb some"
            )
        elif worst.leaves < _WARNED:
            warnings.warn(
                f"of the light that goes round at '{place}', all but {worst.leaves:.2g} comes back "
                f"each time; the condition number of the sum is {worst.condition:.2g}, by which "
                f"errors of the values that are given may be enlarged",
                LoopWarning,
                stacklevel=calls_up(),
            )
    if faults:
        raise ParameterError(*faults)


class _Judged:
    """The doubtful paths of a batch, by what the unknowns of a loop are to each other."""

    def __init__(self, solver: LoopSolver) -> None:
        self.solver = solver
        self.columns = [solver.scattered(column.back) for column in solver.columns]
        numbers = [*solver.pivots, *(n for column in self.columns for n in column.values())]
        self.shape = np.broadcast_shapes((1,), *(np.shape(_high(number)) for number in numbers))
        holds = reduce(np.logical_and, solver.conditions, np.True_)
        self.where = tuple(np.argwhere(~np.broadcast_to(holds, self.shape)).T)
        # What no light ever gets to may keep all of it.
        self.lit = self._stacked(_lit(number, self.shape) for number in solver.found) > 0.0
        self.pivots = np.where(self.lit, self._stacked(solver.pivots), 1.0)
        self.fades = self._picked(reduce(np.logical_and, solver.fading(), np.True_)) > 0.0

    def worst(self) -> LargestGain | None:
        """Return the worst of them; None where one is no finite number."""
        if not np.all(np.isfinite(self.pivots)):
            return None
        least = self.pivots.min(axis=-1)
        closed = self.fades & (least <= 0.0)
        first = self._doubtful(least)
        if len(self.solver.unknowns) ** 2 > _MOST:
            closed = np.where(self.fades, closed, ~self._adds_up())
            left = float(least.min(initial=1.0))
            return LargestGain(bool(closed.any()), left, 2.0 / max(left, np.finfo(float).tiny))
        if not first.size:
            return _HARMLESS
        matrices = self._matrices(first)
        if not np.all(np.isfinite(matrices)):
            return None
        leaves, least, fades = 1.0 - _radius(matrices), least[first], self.fades[first]
        # Next to 1, a gain has lost the digits that the pivots still have.
        leaves = np.where(fades & (leaves < _FEW_DIGITS), np.maximum(leaves, least), leaves)
        near = np.abs(leaves) < _NEAR
        gains = np.where(near, ~self._adds_up()[first], leaves <= 0.0) & ~fades
        closed = closed[first] | gains
        leaves = np.where(gains, np.minimum(leaves, 0.0), leaves)
        worst = np.lexsort((leaves, ~closed))[0]
        return LargestGain(bool(closed[worst]), float(leaves[worst]), _condition(matrices[worst]))

    def _doubtful(self, least: Array) -> Array:
        """Return the paths that must be looked at: all that may gain, and the most closed."""
        order = np.argsort(least)
        order = order[self.fades[order] & (least[order] < _WARNED)]
        most = max(1, _MOST // len(self.solver.unknowns) ** 2)
        return np.concatenate([np.flatnonzero(~self.fades), order[:most]])

    def _matrices(self, paths: Array) -> Array:
        """Return what of each unknown comes back as which, for some paths."""
        count = len(self.solver.unknowns)
        matrices = np.zeros((len(paths), count, count))
        for place, column in enumerate(self.columns):
            for row, number in column.items():
                matrices[:, row, place] = self._picked(number)[paths]
        lit = self.lit[paths]
        return np.where(lit[:, :, np.newaxis] & lit[:, np.newaxis, :], matrices, 0.0)

    def _adds_up(self) -> Array:
        """Return where unpolarised light at every junction adds up to light that can be."""
        unpolarised = {
            junction: ((1.0,), (0.5, 0.5), (0.5, 0.5, 0.0), (0.5, 0.5, 0.0, 0.0))[count - 1]
            for junction in self.solver.loop.junctions
            if (count := self.solver.count(junction))
        }
        with np.errstate(all="ignore"):
            self.solver.lights(unpolarised)
            return self._picked(self.solver.adds_up(_ROUNDING)) > 0.0

    def _picked(self, number: Any) -> Array:
        return np.broadcast_to(np.asarray(_high(number), float), self.shape)[self.where]

    def _stacked(self, numbers: Iterable[Any]) -> Array:
        return np.stack([self._picked(number) for number in numbers], axis=-1)


_HARMLESS = LargestGain(closed=False, leaves=1.0, condition=1.0)


def _radius(matrices: Array) -> Array:
    """Return the spectral radius of each of several matrices."""
    return np.asarray(np.abs(np.linalg.eigvals(matrices)).max(axis=-1))


def _condition(matrix: Array) -> float:
    """Return the condition number of (I - M)^-1 with respect to I and M, not to I - M."""
    with np.errstate(all="ignore"):
        sums = np.linalg.pinv(np.eye(len(matrix)) - matrix, rcond=0.0)
    return float((1.0 + np.linalg.norm(matrix, 2)) * np.linalg.norm(sums, 2))


def _high(number: Any) -> Any:
    return number.high if isinstance(number, DoubleDouble) else number


def _lit(number: Any, shape: tuple[int, ...]) -> Array:
    """Return where an unknown is not 0, for any of the paths that share a loop."""
    lit = np.asarray(np.asarray(number) != 0.0)
    while lit.ndim > len(shape):
        lit = np.asarray(lit.any(axis=0))
    own = shape[len(shape) - lit.ndim :]
    shared = tuple(axis for axis, length in enumerate(own) if length == 1)
    return np.asarray(lit.any(axis=shared, keepdims=True))


_TWICE = twice(NUMPY)


class CloserLook:
    """Solves the loops of a program for what is given."""

    def __init__(
        self,
        program: Program,
        arguments: ResolvedInputs,
        plain: list[np.ndarray[Any, Any]],
        dtype: np.dtype[Any],
    ) -> None:
        self.program = program
        self.given = arguments
        self.plain = plain
        self.dtype = dtype
        self._operands: dict[int, Any] = {}
        self._numbers: dict[int, Numbers] = {}

    def meet(self, loop: Loop) -> LoopSolver:
        """Return the lights at the junctions of a loop."""
        return LoopSolver(self.program, loop, self.numbers, _TWICE, _longer, self._rounded)

    def evaluations(self) -> dict[int, tuple[np.ndarray[Any, Any], ...]]:
        """Return what every evaluation comes to, rounded, as `execute` may be given it.

        Reflection, entry and return at a boundary then share each digit of its angle.
        """
        used = (index for index, uses in enumerate(self.program.evaluation_uses) if uses)
        return {index: tuple(map(self._rounded, self.numbers(index))) for index in used}

    def numbers(self, index: int) -> Numbers:
        """Return what an evaluation comes to."""
        if index not in self._numbers:
            self._numbers[index] = self._evaluated(index)
        return self._numbers[index]

    def _evaluated(self, index: int) -> Numbers:
        evaluation = self.program.evaluations[index]
        operands = list(self.plain)
        for place in self.program.passed_to[index]:
            operands[place] = self._operand(place)
        try:
            numbers = evaluated(self.program, index, operands, StokesCarrier(_TWICE), _longer)
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            numbers = evaluated(self.program, index, self.plain, StokesCarrier(NUMPY), _longer)
        if evaluation.kernel.structure is ROTATION:
            # A cosine and a sine that are rounded belong to no angle; their ratio does.
            numbers = _of_an_angle(*numbers)
        return numbers

    def _operand(self, place: int) -> Any:
        if place not in self._operands:
            operand, kind = self.program.operands[place], wide(self.dtype)
            if operand.known:
                raw = _longer(self.given.cut(np.asarray(operand.raw(), kind)))
            else:
                raw = operand.number_in(self.given.numbers, lambda n: _longer(np.asarray(n, kind)))
            raw = _of_an_angle(*raw) if isinstance(raw, tuple) else raw
            self._operands[place] = operand.evaluated(_TWICE, raw)
        return self._operands[place]

    def _rounded(self, number: Any) -> Any:
        high = number.high if isinstance(number, DoubleDouble) else number
        return np.asarray(high, self.dtype)


def _longer(number: Any) -> DoubleDouble:
    if isinstance(number, DoubleDouble):
        return number
    array = np.asarray(number)
    # Not a plain 0: the rest has the precision of the number.
    kind = np.result_type(array, np.float64)
    array = array.astype(kind, copy=False)
    return DoubleDouble(NUMPY, array, 0.0 * array)


def _of_an_angle(c: DoubleDouble, s: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    length = (c * c + s * s).sqrt()
    return c / length, s / length
