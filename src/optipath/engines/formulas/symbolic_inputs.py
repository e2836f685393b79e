"""The operands of a program as symbols: what is given, and the sines and cosines of angles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.left import FROM_ANY, FROM_NEARER
from optipath.engines.formulas.of_angles import is_in_first_quadrant, of_angle
from optipath.engines.formulas.recorder import ONE_AXIS
from optipath.engines.formulas.symbolic import SYMBOLIC, reproducible_symbolic
from optipath.kernels.numbers.trigonometry import DIGITS
from optipath.values.operands import ABSENT, MANY, ONE, WIDE
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from optipath.engines.formulas.recorder import Recorder
    from optipath.engines.program.program import Program
    from optipath.kernels.numbers.primitives import Primitives
    from optipath.values.input_key import InputKey
    from optipath.values.operands import Operand

Limits = tuple[float, float]

_APART = 1e-6
"""How far the squares of a cosine and a sine may be from 1 together."""


class SymbolicInputs:
    """Makes the symbols of a program's operands."""

    def __init__(
        self,
        recorder: Recorder,
        forms: Mapping[InputKey, str],
        limits: Mapping[Hashable, Limits],
        *,
        axes: Mapping[str, frozenset[int]],
        known: Callable[[Any], Any] | None = None,
        single: bool = False,
        counted: bool = False,
    ) -> None:
        self.recorder = recorder
        self.forms = forms
        self.limits = limits
        self.axes = axes
        self.known = known
        self.single = single
        self.counted = counted

    @property
    def primitives(self) -> Primitives:
        """What kernels are to be made of."""
        return SYMBOLIC if self.counted else reproducible_symbolic(self.recorder.dtype.name)

    def of(self, program: Program) -> list[Any]:
        """Return a symbol, or a number that is known, for each operand."""
        found = [
            self._operand(operand, f".{place}") for place, operand in enumerate(program.operands)
        ]
        if self.known is None:
            return found
        return [operand if isinstance(operand, bool) else self.known(operand) for operand in found]

    def _operand(self, operand: Operand, name: str) -> Any:
        if operand.known:
            numbers = operand.numbers(kind=wide(self.recorder.dtype))
            if operand.part == "present":
                return self._input(name, MANY, "bool") if numbers.ndim else True
            if numbers.ndim:
                return self._input(name, MANY)
            with np.errstate(over="ignore", under="ignore"):
                return self.recorder.dtype.type(numbers[()])
        key = operand.input_key
        if key not in self.forms:
            return self._of_pair(operand)
        form = self.forms[key]
        if key.part == "present":
            return form == ONE if form in (ONE, ABSENT) else self._input(str(key), form, "bool")
        if form == ABSENT:
            return self.recorder.dtype.type(0.0)
        given = self._given(key, form)
        if operand.part in ("cos", "sin") and not self.counted:
            return self._circular(operand, form, given)
        return operand.evaluated(self.primitives, given)

    def _input(self, name: str, form: str, kind: str = "float", left: str = "") -> Any:
        axes = frozenset[int]() if form == ONE else self.axes.get(name, ONE_AXIS)
        return self.recorder.input(name, kind, axes=axes, left=left)

    def _given(self, key: InputKey, form: str) -> Any:
        low, high = key.limits_in(self.limits)
        given = self._input(str(key), form)
        if form == WIDE:
            # What is looked at is the number that is given, not what is left of it.
            most = float(np.finfo(np.float64).max)
            self.recorder.wide[str(key)] = float(max(low, -most)), float(min(high, most))
        elif form != ONE or self.single:
            most = float(np.finfo(self.recorder.dtype).max)
            kind = self.recorder.dtype.type
            self.recorder.require(kind(max(low, -most)) <= given)
            self.recorder.require(given <= kind(min(high, most)))
        # From here on it is known, and no longer asked.
        given.positive = low >= 0.0
        return given

    def _of_pair(self, operand: Operand) -> Any:
        """Return what an operand sees of an angle that is given by its cosine and sine."""
        low, high = self.limits[operand.input_key.quantity]
        least = 0.0 if low >= 0.0 and high <= np.pi / 2 else -1.0
        cos, sin = (
            self._part(operand.input_key._replace(part=part), least) for part in ("cos", "sin")
        )
        self.recorder.require(abs(cos * cos + sin * sin - 1.0) <= _APART)
        return operand.evaluated(self.primitives, (cos, sin))

    def _part(self, key: InputKey, least: float) -> Any:
        kind = self.recorder.dtype.type
        if self.forms[key] == WIDE:
            self.recorder.wide[str(key)] = least, 1.0
        given = self._input(str(key), self.forms[key])
        self.recorder.require(kind(least) <= given)
        self.recorder.require(given <= kind(1.0))
        given.positive = least == 0.0
        return given

    def _circular(self, operand: Operand, form: str, angle: Any) -> Any:
        kind, negative = self.recorder.dtype, operand.value.is_negative
        if negative:
            angle = -angle
        digits = DIGITS[kind.name]
        first = is_in_first_quadrant(operand, self.limits[operand.input_key.quantity])
        left = None
        if form in (ONE, WIDE) and kind != wide(kind):
            # Next to a right angle it is all that there is, and has more digits than the angle.
            name = str(operand.input_key)
            left = self._input(name, form, left=FROM_NEARER if first else FROM_ANY)
            left = -left if negative else left
        if not first:
            self.recorder.require(abs(angle) <= digits.most)
        return of_angle(self.primitives, digits, operand, angle, left, first=first)
