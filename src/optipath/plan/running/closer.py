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
from optipath.engines.program.loops import Meeting
from optipath.kernels import NUMPY, ROTATION, DoubleDouble, Plain, cosine, sine, twice

if TYPE_CHECKING:
    from optipath.engines.program.program import Loop
    from optipath.kernels.carriers.structures import Numbers
    from optipath.plan.running.interpreter import Stepwise
    from optipath.plan.running.reading import Given
    from optipath.values.operands import View

_TWICE = twice(NUMPY)
_COS, _SIN = cosine(_TWICE), sine(_TWICE)


class CloserLook:
    """Solves the loops of a program for what is given.

    Parameters
    ----------
    stepwise : Stepwise
        What runs the program.
    given : Given
        The numbers.
    """

    def __init__(self, stepwise: Stepwise, given: Given) -> None:
        self.stepwise = stepwise
        self.given = given
        self.program = stepwise.program
        self.plain = stepwise.leaves(given)
        self._leaves: dict[int, Any] = {}
        self._numbers: dict[int, Numbers] = {}

    def meet(self, loop: Loop) -> Meeting:
        """Return the lights at the knots of a loop."""
        return Meeting(self.program, loop, self.numbers, _TWICE, _longer, self._rounded)

    def numbers(self, index: int) -> Numbers:
        """Return what an evaluation comes to."""
        if index not in self._numbers:
            self._numbers[index] = self._evaluated(index)
        return self._numbers[index]

    def _evaluated(self, index: int) -> Numbers:
        evaluation = self.program.evaluations[index]
        leaves = list(self.plain)
        for place in evaluation.arguments:
            leaves[place] = self._leaf(place)
        try:
            numbers = evaluated(evaluation, leaves, Plain(_TWICE), _longer)
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            numbers = evaluated(evaluation, self.plain, Plain(NUMPY), _longer)
        if evaluation.kernel.structure is ROTATION:
            # A cosine and a sine that are rounded belong to no angle; their ratio does.
            numbers = _of_an_angle(*numbers)
        return numbers

    def _leaf(self, place: int) -> Any:
        if place not in self._leaves:
            self._leaves[place] = self._number(self.program.leaves[place])
        return self._leaves[place]

    def _number(self, view: View) -> Any:
        whole = view if view.part not in ("cos", "sin") else replace(view, part="value")
        number = self.stepwise.wide_number(whole, self.given)
        if isinstance(number, tuple):
            c, s = _of_an_angle(*map(_longer, number))
            return {"cos": c, "sin": s}.get(str(view.part), _TWICE.atan2(s, c))
        if whole is view:
            return _longer(number)
        return (_COS if view.part == "cos" else _SIN)(_longer(number))

    def _rounded(self, number: Any) -> Any:
        high = number.high if isinstance(number, DoubleDouble) else number
        return self.stepwise.number(high)


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
