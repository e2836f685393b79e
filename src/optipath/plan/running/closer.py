"""A closer look at loops: their sums in twice the digits, from what was given.

Where little light leaves, what comes back must be known to many more digits than the result:
1 - gain has lost as many as it has zeros. So the elements of a loop are evaluated, and what
goes round is summed, in numbers of twice the precision, by the same kernels.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.program.execute import evaluated
from optipath.engines.program.loops import LoopSolver
from optipath.kernels import NUMPY, ROTATION, DoubleDouble, StokesCarrier, cosine, sine, twice

if TYPE_CHECKING:
    from optipath.engines.program.program import Loop
    from optipath.kernels.carriers.structures import Numbers
    from optipath.plan.running.interpreter import Interpreter
    from optipath.plan.running.reading import ResolvedInputs
    from optipath.values.operands import Operand

_TWICE = twice(NUMPY)
_COS, _SIN = cosine(_TWICE), sine(_TWICE)


class CloserLook:
    """Solves the loops of a program for what is given.

    Parameters
    ----------
    interpreter : Interpreter
        What runs the program.
    given : ResolvedInputs
        The numbers.
    """

    def __init__(self, interpreter: Interpreter, given: ResolvedInputs) -> None:
        self.interpreter = interpreter
        self.given = given
        self.program = interpreter.program
        self.plain = interpreter.operands(given)
        self._operands: dict[int, Any] = {}
        self._numbers: dict[int, Numbers] = {}

    def meet(self, loop: Loop) -> LoopSolver:
        """Return the lights at the junctions of a loop."""
        return LoopSolver(self.program, loop, self.numbers, _TWICE, _longer, self._rounded)

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
            self._operands[place] = self._number(self.program.operands[place])
        return self._operands[place]

    def _number(self, operand: Operand) -> Any:
        whole = operand if operand.part not in ("cos", "sin") else replace(operand, part="value")
        number = self.interpreter.wide_number(whole, self.given)
        if isinstance(number, tuple):
            c, s = _of_an_angle(*map(_longer, number))
            return {"cos": c, "sin": s}.get(str(operand.part), _TWICE.atan2(s, c))
        if whole is operand:
            return _longer(number)
        return (_COS if operand.part == "cos" else _SIN)(_longer(number))

    def _rounded(self, number: Any) -> Any:
        high = number.high if isinstance(number, DoubleDouble) else number
        return self.interpreter.number(high)


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
