"""A closer look at loops: their sums in twice the digits, from what was given.

Where little light leaves, what comes back must be known to many more digits than the result:
1 - gain has lost as many as it has zeros. So the elements of a loop are evaluated, and what
goes round is summed, in numbers of twice the precision, by the same kernels.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.program.execute import evaluated
from optipath.engines.program.loops import LoopSolver
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.primitives import NUMPY
from optipath.kernels.numbers.twice import twice
from optipath.values.precision import wide

if TYPE_CHECKING:
    from optipath.engines.program.program import Loop, Program
    from optipath.kernels.carriers.structures import Numbers
    from optipath.plan.running.reading import ResolvedInputs

_TWICE = twice(NUMPY)


class CloserLook:
    """Solves the loops of a program for what is given."""

    def __init__(
        self,
        program: Program,
        given: ResolvedInputs,
        plain: list[np.ndarray[Any, Any]],
        dtype: np.dtype[Any],
    ) -> None:
        self.program = program
        self.given = given
        self.plain = plain
        self.dtype = dtype
        self._operands: dict[int, Any] = {}
        self._numbers: dict[int, Numbers] = {}

    def meet(self, loop: Loop) -> LoopSolver:
        """Return the lights at the junctions of a loop."""
        return LoopSolver(self.program, loop, self.numbers, _TWICE, _longer, self._rounded)

    def evaluations(self) -> dict[int, tuple[np.ndarray[Any, Any], ...]]:
        """Return what every evaluation comes to, rounded, as `execute` may be given it.

        What is reflected at a boundary, what enters a loop there and what comes back then belong
        to the same boundary: next to a critical angle, each follows every digit of the angle.
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
        for place in self.program.given_to[index]:
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
                raw = operand.given_in(self.given.numbers, lambda n: _longer(np.asarray(n, kind)))
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
