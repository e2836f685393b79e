"""Interpreter: a program run step by step, physical checks included."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial, reduce
from math import prod
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.formula import (
    DOUBLE,
    FROM_ANY,
    FROM_NEARER,
    LEFT,
    is_in_first_quadrant,
    of_angle,
)
from optipath.engines.path_formula import slack_of
from optipath.engines.program import carrying, evaluated, execute, whole_matrices
from optipath.errors import ParameterError
from optipath.kernels.carriers.carrier import (
    JonesCarrier,
    MatrixCarrier,
    ScaledCarrier,
    StokesCarrier,
)
from optipath.kernels.carriers.intensities import BoundsCarrier
from optipath.kernels.exponential import reproducible_numpy
from optipath.kernels.primitives import NUMPY
from optipath.kernels.trigonometry import DIGITS
from optipath.light.decompositions import lack, tolerance_for
from optipath.light.polarization_state import underflows, unscaled
from optipath.plan.loops import CloserLook, check_gains
from optipath.values.arrays import joint_shape
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.engines.program import LoopSolver, Program, Reading
    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.kernels.carriers.structures import Numbers
    from optipath.plan.reading import Batch
    from optipath.values.operands import Operand, Ranges
    from optipath.values.precision import Array


Shared: TypeAlias = "Mapping[int, tuple[Array, ...]]"

_LONG = 16


def carrier_of(program: Program, composing: str) -> type[Carrier]:
    """Return how light is carried along a program."""
    if composing == "jones":
        return JonesCarrier
    return ScaledCarrier if len(program.steps) > _LONG else StokesCarrier


@dataclass(eq=False, repr=False)
class Interpreter:
    """Runs a program without compiling anything.

    With limits, a path comes to the same bits alone and in any batch, and to those of formulas. A
    given number is an array then, since kernels choose the cheaper way where one is a plain 0.
    """

    def __init__(
        self,
        program: Program,
        carrier: type[Carrier],
        dtype: np.dtype[Any],
        limits: Ranges | None = None,
    ) -> None:
        self.program = program
        self.carrier = carrier
        self.dtype = dtype
        self.limits = limits
        self.xp = NUMPY if limits is None else reproducible_numpy(dtype.name)
        self._carriers = {k: k(self.xp) for k in (carrier, ScaledCarrier, MatrixCarrier)}
        self._carrying = program, self._carriers[carrier]
        if limits is not None:
            self._carrying = carrying(program, carrier, self.xp, dtype.name)
        self._known: list[Any] | None = None

    def lights(self, arguments: Batch, shared: Shared | None = None) -> list[Array]:
        """Return Stokes vectors (..., 4) at every end; for parts, see `shared`."""
        batch, arguments = arguments.shape, self._as_batch(arguments)
        own = {
            index: tuple(map(arguments.cut, numbers)) for index, numbers in (shared or {}).items()
        }
        program, carrier = self._carrying
        if program is self.program:
            result = self._read(arguments, self._execute(arguments, carrier, None, own))
        else:
            with np.errstate(all="ignore"):
                lights = execute(program, self.operands(arguments), carrier, number=self.number)
            result = self._read(arguments, lights)
        faint: Any = False
        if self.carrier is StokesCarrier:
            # What is so faint that numbers on the way underflow is carried scaled.
            faint = np.any([underflows(stokes[..., 0]) for stokes in result], axis=0)
        if np.any(faint):
            scaled = self._execute(arguments, self._carriers[ScaledCarrier], None, own)
            pairs = zip(self._read(arguments, scaled), result, strict=True)
            result = [np.where(faint[..., np.newaxis], one, other) for one, other in pairs]
        return [stokes.reshape(*batch, 4) for stokes in result]

    def _as_batch(self, arguments: Batch) -> Batch:
        """Return what is given, one path as a batch of one if it is to have the same bits."""
        alone = self.limits is not None and not arguments.shape
        return arguments._replace(shape=(1,)) if alone else arguments

    def shared(self, arguments: Batch) -> Shared:
        """Return evaluations along a few axes of a batch only, no larger than its light."""
        operands, carrier = self.operands(arguments), self._carriers[self.carrier]
        left, result = 4 * arguments.paths, {}
        with np.errstate(all="ignore"):
            for index, evaluation in enumerate(self.program.evaluations):
                places = [*self.program.passed_to[index]]
                if evaluation.presence is not None:
                    places.append(evaluation.presence)
                shapes = [operands[place].shape for place in places]
                size = 16 * prod(joint_shape(*shapes))
                needed = self.program.evaluation_uses[index]
                if needed and size <= min(left, arguments.paths):
                    result[index] = evaluated(self.program, index, operands, carrier, self.number)
                    left -= size
        return result

    def matrix(self, arguments: Batch, source: str, reading: Reading) -> Array:
        """Return Mueller matrices (..., 4, 4) from a source to a reading."""
        none, shape = self.dtype.type(0.0), (*arguments.shape, 4, 4)
        arguments = self._as_batch(arguments)
        begin, _ = self.program.sources[source]

        def emitted(part: Batch) -> dict[int, Components]:
            columns = np.eye(4, dtype=self.dtype).reshape(4, 4, *[1] * len(part.shape))
            dark = {step: (none,) * 4 for step, _ in self.program.sources.values()}
            return {**dark, begin: tuple(columns[:, row] for row in range(4))}

        lights = self._execute(arguments, self._carriers[MatrixCarrier], emitted)
        stokes = _stack(lights[reading.light][0], (4, *arguments.shape), reading, self.dtype)
        return np.ascontiguousarray(np.moveaxis(stokes, 0, -1)).reshape(shape)

    def bounds(self, arguments: Batch) -> list[Array]:
        """Return what `BoundsCarrier` reads at every end, shape (4, ...)."""
        batch, arguments = arguments.shape, self._as_batch(arguments)
        operands = self.operands(arguments)
        with np.errstate(all="ignore"):
            matrices = whole_matrices(
                self.program, operands, self._carriers[MatrixCarrier], self.number
            )
        lacking = what_matrices_lack(self.program, matrices)
        carrier = BoundsCarrier(NUMPY, slack_of(self.program, self.dtype.name) + lacking)
        with np.errstate(all="ignore"):
            result = execute(self.program, operands, carrier, None, self.number, matrices)
        read = []
        for reading in self.program.readings.values():
            rows = [np.broadcast_to(row, arguments.shape) for row in result[reading.light][0]]
            parts = np.array(rows, self.dtype)
            # What is too extreme for floats is bounded by nothing.
            message = np.all(np.isfinite(parts), axis=0)
            parts[1] = np.where(message, parts[1], 0.0)
            parts[2] = np.where(message, parts[2], np.inf)
            read.append(parts.reshape(4, *batch))
        if self.program.loops and np.any(np.isnan([parts[0] for parts in read])):
            self.lights(arguments)  # Light that does not fade is refused.
        return read

    def _read(self, arguments: Batch, lights: Mapping[int, Any]) -> list[Array]:
        """Return the light at every end as Stokes vectors."""
        results = []
        for reading in self.program.readings.values():
            components, exponent = lights[reading.light]
            stokes = _stack(components, arguments.shape, reading, self.dtype)
            results.append(stokes if isinstance(exponent, int) else unscaled(stokes, exponent))
        return results

    def _execute(
        self, arguments: Batch, carrier: Carrier, emitted: Any = None, shared: Shared | None = None
    ) -> dict[int, Any]:
        solvers: list[LoopSolver] = []
        begin = emitted and emitted(arguments)
        with np.errstate(all="ignore"):
            operands = self.operands(arguments)
            result = execute(self.program, operands, carrier, begin, self.number, shared, solvers)
            doubtful = _doubtful(solvers, arguments.shape)
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

    def number(self, number: Any) -> Array:
        """Return what a kernel gives in the precision of the plan."""
        # Plain numbers among what kernels give have no precision of their own.
        return np.asarray(number, self.dtype)

    def operands(self, arguments: Batch) -> list[Array]:
        """Return the numbers behind the operands of the program."""
        if self._known is None:
            self._known = [
                self._cast(operand.numbers(kind=wide(self.dtype))) if operand.known else None
                for operand in self.program.operands
            ]
        results = []
        for known, operand in zip(self._known, self.program.operands, strict=True):
            if known is None:
                results.append(self._operand_array(operand, arguments))
            else:
                cut = arguments.cut(known)
                # No array where it is one number, so that kernels see which are 0.
                results.append(cut if self.limits is None else cut[()])
        return results

    def _operand_array(self, operand: Operand, arguments: Batch) -> Array:
        key, numbers = operand.input_key, arguments.numbers
        if operand.part == "imag" and numbers[key] is False:
            # Not an array, so that kernels see an index that does not absorb.
            return self.dtype.type(0.0)  # type: ignore[no-any-return]
        circular = operand.part in ("cos", "sin")
        if self.limits is None or operand.part == "present":
            kind = wide(self.dtype) if circular else None
            raw = operand.number_in(numbers, partial(np.asarray, dtype=kind))
        elif circular and key in numbers:
            return self._circular(operand, np.atleast_1d(numbers[key]))
        else:
            raw = operand.number_in(numbers, lambda n: self._cast(np.atleast_1d(n)))
        return self._cast(operand.evaluated(self.xp, raw))

    def _circular(self, operand: Operand, angle: Array) -> Array:
        """Return the cosines or sines of angles, as formulas have them."""
        assert self.limits is not None  # noqa: S101 - for mypy
        digits, negative = DIGITS[self.dtype.name], operand.value.is_negative
        first = is_in_first_quadrant(operand, self.limits[operand.input_key.quantity])
        left: Any = None
        if self.dtype != np.float64:
            left = LEFT[FROM_NEARER if first else FROM_ANY](NUMPY, DOUBLE)(angle)
            left = self._cast(-left if negative else left)
        signed = self._cast(-angle if negative else angle)
        small = np.abs(signed) <= digits.most
        if first or np.all(small):
            return of_angle(self.xp, digits, operand.part, signed, left, first=first)  # type: ignore[no-any-return]
        left = None if left is None else np.where(small, left, 0.0).astype(self.dtype)
        near = np.where(small, signed, 0.0).astype(self.dtype)
        near = of_angle(self.xp, digits, operand.part, near, left, first=False)
        far = operand.evaluated(reproducible_numpy("float64"), angle)
        return np.where(small, near, self._cast(far))

    def _cast(self, numbers: Any) -> Array:
        array = np.asarray(numbers)
        with np.errstate(over="ignore", under="ignore"):  # What is not finite is told later.
            return array if array.dtype == bool else array.astype(self.dtype, copy=False)


def _doubtful(solvers: Sequence[LoopSolver], batch: tuple[int, ...]) -> Array:
    """Return for which paths of a batch a loop takes a closer look."""
    holds = [condition for solver in solvers for condition in solver.conditions]
    return np.broadcast_to(np.logical_not(reduce(np.logical_and, holds, np.True_)), batch)


def _instead(results: dict[int, Any], others: Mapping[int, Any], where: Array) -> dict[int, Any]:
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
) -> Array:
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


def _stacked(numbers: Sequence[Any]) -> Array:
    """Return matrices (..., 4, 4), in single precision where that holds all their digits."""
    flat = np.stack(np.broadcast_arrays(*numbers), axis=-1)
    with np.errstate(over="ignore"):
        single = flat.astype(np.float32)
    matrix = single if np.array_equal(single, flat) else flat
    return matrix.reshape(*flat.shape[:-1], 4, 4)
