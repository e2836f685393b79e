"""A program traced by JAX, light and slopes."""

from __future__ import annotations

from contextlib import nullcontext
from functools import cache, reduce
from operator import and_
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np

from optipath.engines.program import execute
from optipath.errors import ComposerError
from optipath.kernels.carriers.carrier import Carrier, MatrixCarrier
from optipath.kernels.primitives import NUMPY
from optipath.values.angles import CosSin
from optipath.values.jax_primitives import JAX, sloped, with_slopes
from optipath.values.jax_values import is_jax, is_traced
from optipath.values.operands import part_of
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.engines.program import LoopSolver, Program, Reading
    from optipath.kernels.carriers.carried import Components, SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.values.operands import Operand
    from optipath.values.parameters import Resolved


class JaxPath:
    """A program for JAX."""

    def __init__(self, program: Program, carrier: type[Carrier], dtype: np.dtype[Any]) -> None:
        self.program = program
        self.carrier = carrier(JAX)
        self.dtype = dtype
        self._jitted = jax.jit(self._traced, static_argnames=("batch", "absent", "ends"))
        self._known_traced = any(operand.traced for operand in program.operands)

    def run(
        self,
        resolved: Mapping[str, Resolved],
        batch: tuple[int, ...],
        arguments: Mapping[str, Any],
        ends: tuple[str, str] | None = None,
    ) -> tuple[list[Any], Any]:
        """Return Stokes vectors (..., 4) at every end, and whether nobody needs to look at a loop.

        For a source and a reading, the Mueller matrices (..., 4, 4) from one to the other. What is
        not read is NaN, and so is light that gains on each round.
        """
        values, absent = self._split(resolved, arguments)
        with self._precision(values):
            run = self._traced if self._known_traced else self._jitted
            arrays, sound = run(values, batch=batch, absent=absent, ends=ends)
        return list(arrays), sound

    def _traced(
        self,
        values: Any,
        *,
        batch: tuple[int, ...],
        absent: frozenset[str],
        ends: tuple[str, str] | None,
    ) -> tuple[tuple[Any, ...], Any]:
        operands = self._operands(values, absent)
        if ends is None:
            result, solvers = self._stokes(operands, self.carrier, batch)
            arrays = [*result.values()]
        else:
            columns: list[Any] = []
            solvers = []
            for column in np.eye(4, dtype=self.dtype):
                emitted = {
                    step: tuple(map(self._number, column if name == ends[0] else 0.0 * column))
                    for name, (step, _) in self.program.sources.items()
                }
                result, others = self._stokes(operands, MatrixCarrier(JAX), batch, emitted)
                columns.append(result[ends[1]])
                # All light gains no more than unpolarised light does, which has some of each.
                solvers = solvers or others
            arrays = [jnp.stack(columns, axis=-1)]
        factor = self._factor(solvers, batch)
        tails = ([1] * (array.ndim - factor.ndim) for array in arrays)
        factors = (factor.reshape(*factor.shape, *tail) for tail in tails)
        return tuple(map(jnp.multiply, factors, arrays)), _are_sound(solvers)

    def _factor(self, solvers: Sequence[LoopSolver], batch: tuple[int, ...]) -> Any:
        """Return 1 where light that goes round adds up, and NaN where it gains."""
        slack = float(np.sqrt(np.finfo(self.dtype).eps))
        holds = reduce(and_, (solver.adds_up(slack) for solver in solvers), True)  # noqa: FBT003
        # As a factor it makes slopes NaN as well, and those of light that fades stay as they are.
        return self._number(jnp.broadcast_to(jnp.where(holds, 1.0, jnp.nan), batch))

    def _stokes(
        self,
        operands: Sequence[Any],
        carrier: Carrier,
        batch: tuple[int, ...],
        emitted: Mapping[int, Components] | None = None,
    ) -> tuple[dict[str, Any], list[LoopSolver]]:
        """Return the Stokes vector of every reading, and what has been solved for loops."""
        solvers: list[LoopSolver] = []
        fixed = JAX.fixed(operands)
        result = execute(
            self.program, fixed, StepByStep(carrier), emitted, self._number, None, solvers
        )
        # Where the smaller of two intensities changes, the light that is carried has no slope,
        # but what matrices make of it has: light comes from the one, its slope from the other.
        matrices = StepByStep(MatrixCarrier(sloped(self.dtype)))
        smooth = execute(self.program, operands, matrices, emitted, self._number)
        stokes = {}
        for name, reading in self.program.readings.items():
            components, exponent = result[reading.light]
            if not isinstance(exponent, int):
                components = tuple(JAX.ldexp(part, exponent) for part in components)
            both = components, smooth[reading.light][0]
            stokes[name] = with_slopes(*(self._stacked(parts, reading, batch) for parts in both))
        return stokes, solvers

    def _number(self, number: Any) -> Any:
        if isinstance(number, jax.Array):
            return number.astype(self.dtype)
        with np.errstate(over="ignore", under="ignore"):
            return jnp.asarray(np.asarray(number, self.dtype))

    def _stacked(self, components: Sequence[Any], reading: Reading, batch: tuple[int, ...]) -> Any:
        unread = [jnp.nan] * (4 - reading.components)
        parts = (*components[: reading.components], *unread)
        return jnp.stack([jnp.broadcast_to(self._number(p), batch) for p in parts], axis=-1)

    def _operands(self, values: Mapping[str, Any], absent: frozenset[str]) -> list[Any]:
        return [
            self._number(values[f".{place}"])
            if f".{place}" in values
            else self._operand(operand, values, absent)
            for place, operand in enumerate(self.program.operands)
        ]

    def _operand(self, operand: Operand, values: Mapping[str, Any], absent: frozenset[str]) -> Any:
        value = operand.value
        if operand.part == "present":
            if operand.known:
                return operand.raw()
            return values.get(f"{value.name} present", value.name not in absent)
        if operand.known and not operand.traced:
            return self._number(operand.numbers())
        if operand.known:
            raw = operand.placed(jnp.asarray(getattr(value, "default", value)))
        elif (placed := str(operand.input_key)) in values:
            raw = jnp.asarray(values[placed])
        else:
            raw = operand.placed(jnp.asarray(values[value.name]))
        if operand.part == "imag" and not jnp.iscomplexobj(raw):
            return self.dtype.type(0.0)  # Known while JAX traces: nothing absorbs.
        raw = part_of(raw, operand.input_part, operand.tail)
        # A cosine is 0 at a right angle, but with its slope.
        return operand.evaluated(JAX, self._number(raw))

    def _split(
        self, resolved: Mapping[str, Resolved], arguments: Mapping[str, Any]
    ) -> tuple[dict[str, Any], frozenset[str]]:
        """Return the values, with cosines and sines of angles, and the names of what is absent."""
        values: dict[str, Any] = {}
        absent = set()
        for name, (value, present) in resolved.items():
            # In a precision and an order of bytes that JAX has.
            sort = np.complex128 if np.iscomplexobj(value) else np.float64
            values[name] = value if is_jax(value) else np.asarray(value, sort)
            if not np.all(present) and np.any(present):
                values[f"{name} present"] = present
            elif not np.all(present):
                absent.add(name)
        kind = wide(self.dtype)
        for place, operand in enumerate(self.program.operands):
            if operand.known or operand.part == "present":
                continue
            name, key = operand.value.name, operand.input_key
            pair, angle = arguments.get(name), values[name]
            if key.is_affine and not is_jax(angle):
                # What it is a multiple of, JAX would round before.
                angle = values[str(key)] = operand.placed(angle)
            if operand.part not in ("cos", "sin"):
                continue
            if isinstance(pair, CosSin) and not key.is_affine:
                values[f".{place}"] = operand.evaluated(JAX, (pair.cos, pair.sin))
            elif kind != self.dtype and not is_jax(angle):
                values[f".{place}"] = operand.evaluated(NUMPY, np.asarray(angle).astype(kind))
        return values, frozenset(absent)

    def _precision(self, values: Mapping[str, Any]) -> Any:
        """Return a context in which JAX computes in the precision of the plan."""
        if self.dtype == np.float32 or jax.config.jax_enable_x64:
            return nullcontext()
        if self._known_traced or any(map(is_traced, values.values())):
            raise ComposerError(
                "JAX computes in float32 until it is told otherwise, but the plan is in "
                "float64; begin with jax.config.update('jax_enable_x64', True), or compose "
                "with dtype='float32'"
            )
        return double_precision()(True)  # noqa: FBT003 - as JAX has it


def _are_sound(solvers: Sequence[LoopSolver]) -> Any:
    """Return whether so much light leaves every loop that nobody needs to look at it."""
    conditions = [condition for solver in solvers for condition in solver.conditions]
    return jnp.all(jnp.stack([jnp.all(holds) for holds in conditions])) if conditions else True


@cache
def double_precision() -> Any:
    """Return what makes a context in which JAX computes in float64, or does not."""
    if hasattr(jax, "enable_x64"):
        return jax.enable_x64
    from jax.experimental import enable_x64  # noqa: PLC0415 - where older versions have it

    return enable_x64


class StepByStep(Carrier):
    """Carries light as another carrier does, each element a piece of its own.

    In one piece, XLA would compute the light in front again for each component behind: 10^9 times
    for a filter of four plates.
    """

    def __init__(self, carrier: Carrier) -> None:
        super().__init__(carrier.xp)
        self._carrier = carrier

    def emit(self, stokes: Components, count: int = 4) -> Any:
        return self._carrier.emit(stokes, count)

    def act(self, structure: Structure, numbers: Numbers, state: Any, count: int = 4) -> Any:
        def through(numbers: Numbers, state: Any) -> Any:
            return self._carrier.act(structure, numbers, state, count)

        return self.xp.apart(through)(tuple(numbers), state)

    def add(self, first: Any, second: Any) -> Any:
        return self._carrier.add(first, second)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Any]) -> dict[int, Any]:
        return self._carrier.meet(solver, arriving)

    def read(self, state: Any, count: int = 4) -> tuple[Components, Any]:
        return self._carrier.read(state, count)
