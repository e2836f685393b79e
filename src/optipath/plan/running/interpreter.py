"""A program done step after step, with the kernels as they are: one path, or whole arrays."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial, reduce
from math import prod
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.formulas.path_formula import slack_of
from optipath.engines.program.execute import evaluated, execute, whole_matrices
from optipath.kernels.carriers.bounds_carrier import BoundsCarrier
from optipath.kernels.carriers.jones_carrier import JonesCarrier
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.underflow import folded, underflows
from optipath.plan.running.closer import CloserLook
from optipath.plan.running.gains import check_gains
from optipath.plan.running.physical import what_matrices_lack
from optipath.plan.running.reading import ResolvedInputs
from optipath.values.arrays.shapes import joint_shape
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.loops import LoopSolver
    from optipath.engines.program.program import Program, Reading
    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.values.input_key import InputKey
    from optipath.values.operands import Operand

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

    def single(self, numbers: Mapping[InputKey, Any]) -> list[tuple[Any, ...]] | None:
        """Return (S0, S1, S2, S3, exponent) at every end, all numbers being floats.

        None where that takes more care than floats allow.
        """
        found = self._found(ResolvedInputs(numbers, (1,)), {})
        if not all(np.all(np.isfinite(stokes[..., 0])) for stokes, _ in found):
            return None
        return [(*stokes[0].tolist(), exponent.item()) for stokes, exponent in found]

    def lights(
        self, given: ResolvedInputs, shared: Shared | None = None
    ) -> list[tuple[np.ndarray[Any, Any], Any]]:
        """Return Stokes vectors (..., 4) and exponents at every end.

        What several parts of a batch have in common may be given, see `shared`.
        """
        own = {index: tuple(map(given.cut, numbers)) for index, numbers in (shared or {}).items()}
        return [folded(*light) for light in self._found(given, own)]

    def shared(self, given: ResolvedInputs) -> Shared:
        """Return the numbers of evaluations that differ along a few axes of a batch only.

        Together they are no more than the light that the batch gives.
        """
        operands, carrier = self.operands(given), self._carriers[self.carrier]
        left, found = 4 * given.paths, {}
        with np.errstate(all="ignore"):
            for index, evaluation in enumerate(self.program.evaluations):
                shapes = [operands[operand].shape for operand in self.program.given_to[index]]
                shapes += (
                    [] if evaluation.presence is None else [operands[evaluation.presence].shape]
                )
                size = 16 * prod(joint_shape(*shapes))
                needed = self.program.evaluation_uses[index]
                if needed and size <= min(left, given.paths):
                    found[index] = evaluated(self.program, index, operands, carrier, self.number)
                    left -= size
        return found

    def matrix(self, given: ResolvedInputs, source: str, reading: Reading) -> np.ndarray[Any, Any]:
        """Return Mueller matrices (..., 4, 4) from a source to a reading."""
        none = self.dtype.type(0.0)
        begin, _ = self.program.sources[source]

        def emitted(part: ResolvedInputs) -> dict[int, Components]:
            columns = np.eye(4, dtype=self.dtype).reshape(4, 4, *[1] * len(part.batch))
            dark = {step: (none,) * 4 for step, _ in self.program.sources.values()}
            return {**dark, begin: tuple(columns[:, row] for row in range(4))}

        lights = self._execute(given, self._carriers[MatrixCarrier], emitted)
        stokes = _stack(lights[reading.light][0], (4, *given.batch), reading, self.dtype)
        return np.ascontiguousarray(np.moveaxis(stokes, 0, -1))

    def bounds(self, given: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        """Return what `BoundsCarrier` reads at every end, shape (4, ...)."""
        operands = self.operands(given)
        with np.errstate(all="ignore"):
            matrices = whole_matrices(
                self.program, operands, self._carriers[MatrixCarrier], self.number
            )
        lacking = what_matrices_lack(self.program, matrices)
        carrier = BoundsCarrier(NUMPY, slack_of(self.program, self.dtype.name) + lacking)
        found = self._execute(given, carrier, shared=matrices)
        read = []
        for reading in self.program.readings.values():
            parts = np.empty((4, *given.batch), self.dtype)
            for row, part in enumerate(found[reading.light][0]):
                parts[row] = part
            # What is too extreme for floats is bounded by nothing.
            told = np.all(np.isfinite(parts), axis=0)
            parts[1] = np.where(told, parts[1], 0.0)
            parts[2] = np.where(told, parts[2], np.inf)
            read.append(parts)
        return read

    def _found(self, given: ResolvedInputs, shared: Shared) -> list[tuple[Any, Any]]:
        """Return light and exponents; what is too faint for floats is carried with an exponent."""
        found = self._stacked(given, self._carriers[self.carrier], shared)
        if self.carrier is StokesCarrier and any(np.any(underflows(s[..., 0])) for s, _ in found):
            found = self._stacked(given, self._carriers[ScaledCarrier], shared)
        return found

    def _stacked(self, given: ResolvedInputs, carrier: Carrier, shared: Shared) -> list[Any]:
        return self._read(given, self._execute(given, carrier, None, shared))

    def _read(self, given: ResolvedInputs, lights: Mapping[int, Any]) -> list[Any]:
        """Return the light at every end as Stokes vectors, with exponents."""
        return [
            (
                _stack(lights[reading.light][0], given.batch, reading, self.dtype),
                np.broadcast_to(lights[reading.light][1], given.batch),
            )
            for reading in self.program.readings.values()
        ]

    def _execute(
        self,
        given: ResolvedInputs,
        carrier: Carrier,
        emitted: Any = None,
        shared: Shared | None = None,
    ) -> dict[int, Any]:
        solvers: list[LoopSolver] = []
        begin = emitted and emitted(given)
        with np.errstate(all="ignore"):
            operands = self.operands(given)
            found = execute(self.program, operands, carrier, begin, self.number, shared, solvers)
            doubtful = _doubtful(solvers, given.batch)
            if not np.any(doubtful):
                return found
            part = given if np.all(doubtful) else given.part((doubtful,))
            operands, solvers = self.operands(part), []
            begin = emitted and emitted(part)
            closer = CloserLook(self.program, part, operands, self.dtype)
            longer = closer.evaluations()
            again = execute(
                self.program, operands, carrier, begin, self.number, longer, solvers, closer.meet
            )
            check_gains(solvers)
        return again if part is given else _instead(found, again, doubtful)

    def number(self, number: Any) -> np.ndarray[Any, Any]:
        """Return what a kernel gives in the precision of the plan."""
        # Plain numbers among what kernels give have no precision of their own.
        return np.asarray(number, self.dtype)

    def operands(self, given: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        """Return the numbers behind the operands of the program."""
        if self._known is None:
            self._known = [
                self._cast(operand.numbers(kind=wide(self.dtype))) if operand.known else None
                for operand in self.program.operands
            ]
        return [
            self._given(operand, given) if fixed is None else given.cut(fixed)
            for fixed, operand in zip(self._known, self.program.operands, strict=True)
        ]

    def _given(self, operand: Operand, given: ResolvedInputs) -> np.ndarray[Any, Any]:
        if operand.part == "imag" and given.numbers[operand.input_key] is False:
            # Not an array, so that kernels see an index that does not absorb.
            return self.dtype.type(0.0)  # type: ignore[no-any-return]
        kind = wide(self.dtype) if operand.part in ("cos", "sin") else None
        raw = operand.given_in(given.numbers, partial(np.asarray, dtype=kind))
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
    found: dict[int, Any], others: Mapping[int, Any], where: np.ndarray[Any, Any]
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
        for light, (components, exponent) in found.items()
    }


def _stack(
    components: Any, batch: tuple[int, ...], reading: Reading, dtype: np.dtype[Any]
) -> np.ndarray[Any, Any]:
    stokes = np.full((*batch, 4), np.nan, dtype=dtype)
    for component in range(reading.components):
        stokes[..., component] = components[component]
    return stokes
