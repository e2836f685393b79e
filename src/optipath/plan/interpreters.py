"""Interpreters with the bits of formulas, and with bounds of rounding noise."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.execute import evaluated, execute
from optipath.engines.formula import (
    DOUBLE,
    FROM_ANY,
    FROM_NEARER,
    LEFT,
    is_in_first_quadrant,
    of_angle,
)
from optipath.engines.program import carrying
from optipath.kernels.carriers.carrier import MatrixCarrier, ScaledCarrier, StokesCarrier
from optipath.kernels.carriers.noise import NoiseCarrier
from optipath.kernels.exponential import reproducible_numpy
from optipath.kernels.primitives import NUMPY
from optipath.kernels.trigonometry import DIGITS
from optipath.light.underflow import underflows
from optipath.plan.interpreter import Interpreter
from optipath.plan.reading import pieces
from optipath.values.jax_values import is_traced
from optipath.values.parameters import THERE, Resolved

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines.program import Program, Reading
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.inputs import Inputs
    from optipath.plan.interpreter import Shared
    from optipath.plan.reading import ResolvedInputs, RunOptions
    from optipath.values.operands import Operand
    from optipath.values.precision import Array


def interpreter_for(
    program: Program, inputs: Inputs, carrier: type[Carrier], options: RunOptions
) -> Interpreter:
    """Return what runs a program step by step."""
    dtype = np.dtype(options.dtype)
    if options.reproducible:
        return ReproducibleInterpreter(program, carrier, dtype, inputs)
    return Interpreter(program, carrier, dtype)


class ReproducibleInterpreter(Interpreter):
    """Runs a program so that a path comes to the same bits alone and in any batch.

    A given number is an array here, since kernels choose the cheaper way where one is a plain 0.
    """

    def __init__(
        self, program: Program, carrier: type[Carrier], dtype: np.dtype[Any], inputs: Inputs
    ) -> None:
        super().__init__(program, carrier, dtype)
        self.limits = inputs.limits
        self.xp = reproducible_numpy(dtype.name)
        self._carriers = {kind: kind(self.xp) for kind in (carrier, ScaledCarrier, MatrixCarrier)}
        self._carrying = carrying(program, carrier, self.xp, dtype.name)

    def lights(
        self, arguments: ResolvedInputs, shared: Shared | None = None
    ) -> list[np.ndarray[Any, Any]]:
        result = super().lights(_as_batch(arguments), shared)
        return [stokes.reshape(*arguments.batch, 4) for stokes in result]

    def _results(self, arguments: ResolvedInputs, shared: Shared) -> list[Array]:
        program, carrier = self._carrying
        if program is self.program:
            result = self._stacked(arguments, carrier, shared)
        else:
            with np.errstate(all="ignore"):
                lights = execute(program, self.operands(arguments), carrier, number=self.number)
            result = self._read(arguments, lights)
        if self.carrier is not StokesCarrier:
            return result
        faint = np.any([underflows(stokes[..., 0]) for stokes in result], axis=0)
        if not np.any(faint):
            return result
        again = self._stacked(arguments, self._carriers[ScaledCarrier], shared)
        return [
            np.where(faint[..., np.newaxis], one, other)
            for other, one in zip(result, again, strict=True)
        ]

    def matrix(
        self, arguments: ResolvedInputs, source: str, reading: Reading
    ) -> np.ndarray[Any, Any]:
        return super().matrix(_as_batch(arguments), source, reading).reshape(*arguments.batch, 4, 4)

    def bounds(self, arguments: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        return [
            result.reshape(4, *arguments.batch) for result in super().bounds(_as_batch(arguments))
        ]

    def operands(self, arguments: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        # Numbers that are known are no arrays, so that kernels see which of them are 0.
        return [
            number[()] if operand.known else number
            for operand, number in zip(
                self.program.operands, super().operands(arguments), strict=True
            )
        ]

    def _operand_array(self, operand: Operand, arguments: ResolvedInputs) -> np.ndarray[Any, Any]:
        key, numbers = operand.input_key, arguments.numbers
        if operand.part == "present" or numbers.get(key) is False:
            return super()._operand_array(operand, arguments)
        if key not in numbers:
            raw = operand.number_in(numbers, lambda number: self._cast(np.atleast_1d(number)))
            return self._cast(operand.evaluated(self.xp, raw))
        number = np.atleast_1d(numbers[key])
        if operand.part in ("cos", "sin"):
            return self._circular(operand, number)
        return self._cast(operand.evaluated(self.xp, number))

    def _circular(self, operand: Operand, angle: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        """Return the cosines or sines of angles, as formulas have them."""
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


def _as_batch(arguments: ResolvedInputs) -> ResolvedInputs:
    """Return what is given, one path as a batch of one."""
    return arguments if arguments.batch else arguments._replace(batch=(1,))


_AT_ONCE = 8192
"""How many paths are taken at once."""


class NoiseInterpreter(Interpreter):
    """Finds the noise of light by every element that stands in its way, none of them merged."""

    def __init__(self, program: Program, dtype: np.dtype[Any]) -> None:
        super().__init__(program, ScaledCarrier, dtype)

    def noise(self, arguments: ResolvedInputs, reading: Reading) -> tuple[Any, Any]:
        """Return the intensity at an end, and its noise."""
        carrier = NoiseCarrier(NUMPY, self.eps)
        result = np.zeros((2, *arguments.batch), self.dtype)
        for piece in pieces(arguments.batch, _AT_ONCE):
            part = arguments.part(piece.where)
            lights = self._execute(part, carrier)
            (intensity, noise, _, _), power = lights[reading.light]
            for row, number in enumerate((intensity, noise)):
                with np.errstate(over="ignore", under="ignore"):
                    result[(row, *piece.where)] = np.ldexp(number, power)
        return result[0], result[1]

    def emitted(self, arguments: ResolvedInputs, source: str) -> Array:
        """Return the light that a source emits, as Stokes vectors (..., 4), in its own shape."""
        evaluation = self.program.steps[self.program.sources[source][0]].evaluation
        operands, carrier = self.operands(arguments), self._carriers[self.carrier]
        if evaluation is None:
            return np.zeros(4)
        numbers = evaluated(self.program, evaluation, operands, carrier)
        parts = np.broadcast_arrays(*numbers, *[0.0] * (4 - len(numbers)))
        return np.stack(parts, axis=-1)

    def most(self, arguments: ResolvedInputs) -> Any:
        """Return an upper bound of the noise at any end: all rounding of what is emitted."""
        return self._most(self.operands(arguments))

    def most_of_one(self, parameters: Mapping[str, Any]) -> float | None:
        """Return the same where sources emit one number each, plain as it is given; else None."""
        results = {}
        for place, operand in self._emitted.items():
            arguments = {}
            if not operand.known:
                name = operand.value.name
                number = parameters.get(name, operand.value.default)
                if type(number) is not float:
                    return None
                arguments[name] = Resolved(np.array(number), THERE)
            results[place] = operand.numbers(arguments)
        most = self._most(results)
        return None if np.ndim(most) else float(most)

    @cached_property
    def _emissions(self) -> list[int]:
        """The evaluations by which sources emit."""
        steps = (self.program.steps[step] for step, _ in self.program.sources.values())
        return [step.evaluation for step in steps if step.evaluation is not None]

    @cached_property
    def _emitted(self) -> dict[int, Operand]:
        """The operands of these, by place."""
        program = self.program
        places = [place for emission in self._emissions for place in program.passed_to[emission]]
        return {place: program.operands[place] for place in places}

    def _most(self, operands: Any) -> Any:
        carrier = self._carriers[self.carrier]
        emitted = sum(evaluated(self.program, e, operands, carrier)[0] for e in self._emissions)
        junctions = sum(len(loop.junctions) for loop in self.program.loops)
        return 2.0 * (len(self.program.steps) + 2) * (1 + 4 * junctions) * self.eps * emitted

    @property
    def eps(self) -> float:
        """The rounding of 1."""
        return float(np.finfo(self.dtype).eps)


_SAME = 1e-3
"""How far light may be from what it is when it is computed again."""


def noise_at(
    answers: Any,
    end: str,
    parameters: Mapping[str, Any],
    where: Any,
    stokes: Array,
    exponent: Any = 0,
) -> Array:
    """Return what is noise in light, wherever a component of it is small enough for that."""
    del exponent
    result = np.zeros(stokes.shape[:-1], stokes.dtype)
    interpreter = answers.noise
    readings = interpreter.program.readings
    if end not in readings or any(map(is_traced, parameters.values())):
        return result
    most = interpreter.most_of_one(parameters)
    if most is not None and not _as_little(stokes, most).any():
        return result
    argument = answers.whole.reader.read(parameters)
    argument = argument.part(where) if where else argument
    doubtful = _as_little(stokes, interpreter.most(argument)).any(axis=-1)
    if not doubtful.any():
        return result
    part = argument.part((doubtful,)) if argument.batch else argument
    again, noise = interpreter.noise(part, readings[end])
    intensity = stokes[doubtful][..., 0].reshape(part.batch)
    with np.errstate(over="ignore", invalid="ignore"):
        same = np.abs(again - intensity) <= 4.0 * noise + _SAME * np.abs(intensity)
    result[doubtful] = np.where(same, noise, 0.0)
    return result


def matrix_noise_at(
    answers: Any, source: str, end: str, parameters: Mapping[str, Any], matrix: Array
) -> Array:
    """Return the noise in the matrix of a path: that in a source's light, as a share."""
    interpreter = answers.noise
    traced = is_traced(matrix) or any(map(is_traced, parameters.values()))
    if traced or len(interpreter.program.sources) > 1:
        return np.zeros(matrix.shape[:-2])
    emitted = interpreter.emitted(answers.whole.reader.read(parameters), source)
    stokes = (np.asarray(matrix) @ emitted[..., np.newaxis])[..., 0]
    noise = noise_at(answers, end, parameters, (), stokes)
    lit = emitted[..., 0] > 0.0
    return np.where(lit, noise / np.where(lit, emitted[..., 0], 1.0), 0.0)


def _as_little(stokes: Array, most: Any) -> Array:
    """Return which components, other than 0, are no larger than noise can be at most."""
    sizes = np.abs(stokes)
    return (sizes > 0.0) & (sizes <= np.asarray(most)[..., np.newaxis])
