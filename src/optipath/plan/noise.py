"""Noise: how much of light may be rounding, by every element in its way."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.program import evaluated
from optipath.kernels.carriers.carrier import ScaledCarrier
from optipath.kernels.carriers.noise import NoiseCarrier
from optipath.kernels.primitives import NUMPY
from optipath.plan.interpreter import Interpreter
from optipath.plan.reading import pieces
from optipath.values.jax_values import is_traced
from optipath.values.parameters import THERE, Resolved

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines.program import Program, Reading
    from optipath.plan.reading import Batch
    from optipath.values.operands import Operand
    from optipath.values.precision import Array


_AT_ONCE = 8192
"""How many paths are taken at once."""


class NoiseInterpreter(Interpreter):
    """Finds the noise of light by every element that stands in its way, none of them merged."""

    def __init__(self, program: Program, dtype: np.dtype[Any]) -> None:
        super().__init__(program, ScaledCarrier, dtype)

    def noise(self, arguments: Batch, reading: Reading) -> tuple[Any, Any]:
        """Return the intensity at an end, and its noise."""
        carrier = NoiseCarrier(NUMPY, self.eps)
        result = np.zeros((2, *arguments.shape), self.dtype)
        for piece in pieces(arguments.shape, _AT_ONCE):
            lights = self._execute(arguments.part(piece.where), carrier)
            (intensity, noise, _, _), power = lights[reading.light]
            for row, number in enumerate((intensity, noise)):
                with np.errstate(over="ignore", under="ignore"):
                    result[(row, *piece.where)] = np.ldexp(number, power)
        return result[0], result[1]

    def emitted(self, arguments: Batch, source: str) -> Array:
        """Return the light that a source emits, as Stokes vectors (..., 4), in its own shape."""
        evaluation = self.program.steps[self.program.sources[source][0]].evaluation
        operands, carrier = self.operands(arguments), self._carriers[self.carrier]
        if evaluation is None:
            return np.zeros(4)
        numbers = evaluated(self.program, evaluation, operands, carrier)
        parts = np.broadcast_arrays(*numbers, *[0.0] * (4 - len(numbers)))
        return np.stack(parts, axis=-1)

    def most(self, arguments: Batch) -> Any:
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
    answers: Any, end: str, parameters: Mapping[str, Any], where: Any, stokes: Array
) -> Array:
    """Return what is noise in light, wherever a component of it is small enough for that."""
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
    part = argument.part((doubtful,)) if argument.shape else argument
    again, noise = interpreter.noise(part, readings[end])
    intensity = stokes[doubtful][..., 0].reshape(part.shape)
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
