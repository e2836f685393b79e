"""The roundings of a program's light, step after step, beside the light itself."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.program.execute import evaluated
from optipath.kernels.carriers.noise_carrier import NoiseCarrier
from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.numbers.primitives import NUMPY
from optipath.plan.running.interpreter import Interpreter
from optipath.plan.running.pieces import pieces
from optipath.values.resolved import THERE, Resolved

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines.program.program import Program, Reading
    from optipath.plan.running.reading import ResolvedInputs
    from optipath.values.operands import Operand
    from optipath.values.roundings import Array

_AT_ONCE = 8192
"""How many paths are taken at once."""


class NoiseInterpreter(Interpreter):
    """Finds the noise of light by every element that stands in its way, none of them merged."""

    def __init__(self, program: Program, dtype: np.dtype[Any]) -> None:
        super().__init__(program, ScaledCarrier, dtype)

    def noise(self, given: ResolvedInputs, reading: Reading, exponent: Array) -> tuple[Any, Any]:
        """Return the intensity at an end, and its noise, over two to a power."""
        carrier = NoiseCarrier(NUMPY, self.eps)
        found = np.zeros((2, *given.batch), self.dtype)
        for piece in pieces(given.batch, _AT_ONCE):
            part = given.part(piece.where)
            lights = self._execute(part, carrier)
            (intensity, noise, _, _), power = lights[reading.light]
            for row, number in enumerate((intensity, noise)):
                with np.errstate(over="ignore", under="ignore"):
                    found[(row, *piece.where)] = np.ldexp(number, power - exponent[piece.where])
        return found[0], found[1]

    def emitted(self, given: ResolvedInputs, source: str) -> Array:
        """Return the light that a source emits, as Stokes vectors, in its own shape.

        Shape: returns (..., 4).
        """
        evaluation = self.program.steps[self.program.sources[source][0]].evaluation
        operands, carrier = self.operands(given), self._carriers[self.carrier]
        if evaluation is None:
            return np.zeros(4)
        numbers = evaluated(self.program, evaluation, operands, carrier)
        parts = np.broadcast_arrays(*numbers, *[0.0] * (4 - len(numbers)))
        return np.stack(parts, axis=-1)

    def most(self, given: ResolvedInputs) -> Any:
        """Return more than the noise at any end can be: roundings of all that is emitted.

        Each step hands on those of its light and adds its own, as `NoiseCarrier` does; at a
        junction of a loop there are those of all others besides.
        """
        return self._most(self.operands(given))

    def most_of_one(self, parameters: Mapping[str, Any]) -> float | None:
        """Return the same where sources emit one number each, plain as it is given; else None."""
        found = {}
        for place, operand in self._emitted.items():
            given = {}
            if not operand.known:
                name = operand.value.name
                number = parameters.get(name, operand.value.default)
                if type(number) is not float:
                    return None
                given[name] = Resolved(np.array(number), THERE)
            found[place] = operand.numbers(given)
        most = self._most(found)
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
        places = [place for emission in self._emissions for place in program.given_to[emission]]
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
