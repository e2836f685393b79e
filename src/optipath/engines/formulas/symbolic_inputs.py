"""The leaves of a program as symbols: what is given, and the sines and cosines of angles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.left import FROM_ANY, FROM_NEARER
from optipath.engines.formulas.recorder import ONE_AXIS
from optipath.engines.formulas.symbol import Symbol
from optipath.engines.formulas.symbolic import SYMBOLIC, record, with_polynomials
from optipath.kernels import cosine, sine, without_rounding
from optipath.kernels.numbers.trigonometry import DIGITS, any_quadrant, first_quadrant
from optipath.values.operands import ABSENT, MANY, ONE, WIDE, ZERO
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.engines.formulas.recorder import Recorder
    from optipath.engines.program.program import Program
    from optipath.kernels import Primitives
    from optipath.values.operands import Raw, View

Limits = tuple[float, float]

_APART = 1e-6
"""How far the squares of a cosine and a sine may be from 1 together."""


class Leaves:
    """Makes the symbols of a program's leaves.

    Parameters
    ----------
    recorder : Recorder
        Where they are recorded.
    forms : mapping of Raw to str
        What is given for each number.
    limits : mapping of str to tuple of float
        The range of each parameter; a value outside it is against a requirement.
    polynomials : bool
        Whether sines and cosines are to be polynomials.
    axes : mapping of str to frozenset of int
        Along which axes of the batch each array differs, by its name as an input; along the
        only one where nothing is said.
    known : callable, optional
        What is done to each number that is known.
    """

    def __init__(
        self,
        recorder: Recorder,
        forms: Mapping[Raw, str],
        limits: Mapping[str, Limits],
        *,
        polynomials: bool,
        axes: Mapping[str, frozenset[int]],
        known: Callable[[Any], Any] | None = None,
    ) -> None:
        self.recorder = recorder
        self.forms = forms
        self.limits = limits
        self.polynomials = polynomials
        self.axes = axes
        self.known = known

    @property
    def primitives(self) -> Primitives:
        """What kernels are to be made of."""
        return with_polynomials(self.recorder.dtype.name) if self.polynomials else SYMBOLIC

    def of(self, program: Program) -> list[Any]:
        """Return a symbol, or a number that is known, for each leaf."""
        found = [self._leaf(view, f".{place}") for place, view in enumerate(program.leaves)]
        if self.known is None:
            return found
        return [leaf if isinstance(leaf, bool) else self.known(leaf) for leaf in found]

    def _leaf(self, view: View, name: str) -> Any:
        if view.known:
            if view.part == "present":
                return self._input(name, MANY, "bool") if view.present().ndim else True
            numbers = view.numbers({}, wide(self.recorder.dtype))
            if numbers.ndim:
                return self._input(name, MANY)
            with np.errstate(over="ignore", under="ignore"):
                return self.recorder.dtype.type(numbers[()])
        raw = view.raw
        if raw not in self.forms:
            return self._of_pair(view)
        form = self.forms[raw]
        if raw.part == "present":
            return form == ONE if form in (ONE, ABSENT) else self._input(str(raw), form, "bool")
        if form == ZERO:
            return self.recorder.dtype.type(view.part == "cos")
        if form == ABSENT:
            return self.recorder.dtype.type(0.0)
        given = self._given(raw, form)
        if view.part in ("cos", "sin"):
            return self._circular(view, form, given)
        return -given if view.value.negative else given

    def _input(self, name: str, form: str, kind: str = "float", left: str = "") -> Any:
        axes = frozenset[int]() if form == ONE else self.axes.get(name, ONE_AXIS)
        return self.recorder.input(name, kind, axes=axes, left=left)

    def _given(self, raw: Raw, form: str) -> Any:
        low, high = self.limits[raw.name]
        given = self._input(str(raw), form)
        if form == WIDE:
            # What is looked at is the number that is given, not what is left of it.
            most = float(np.finfo(np.float64).max)
            self.recorder.wide[str(raw)] = float(max(low, -most)), float(min(high, most))
        elif form != ONE or not self.polynomials:
            most = float(np.finfo(self.recorder.dtype).max)
            kind = self.recorder.dtype.type
            self.recorder.require(kind(max(low, -most)) <= given)
            self.recorder.require(given <= kind(min(high, most)))
        # From here on it is known, and no longer asked.
        given.positive = low >= 0.0
        return given

    def _of_pair(self, view: View) -> Any:
        """Return what a view sees of an angle that is given by its cosine and sine."""
        low, high = self.limits[view.raw.name]
        least = 0.0 if low >= 0.0 and high <= np.pi / 2 else -1.0
        cos, sin = (self._part(view.raw._replace(part=part), least) for part in ("cos", "sin"))
        self.recorder.require(abs(cos * cos + sin * sin - 1.0) <= _APART)
        if view.part == "cos":
            return cos
        found = sin if view.part == "sin" else record("arctan2", sin, cos)
        if found is not sin and isinstance(found, Symbol):
            self.recorder.pairs[found.index] = sin, cos
        return -found if view.value.negative else found

    def _part(self, raw: Raw, least: float) -> Any:
        kind = self.recorder.dtype.type
        if self.forms[raw] == ZERO:
            return kind(0.0)
        if self.forms[raw] == WIDE:
            self.recorder.wide[str(raw)] = least, 1.0
        given = self._input(str(raw), self.forms[raw])
        self.recorder.require(kind(least) <= given)
        self.recorder.require(given <= kind(1.0))
        given.positive = least == 0.0
        return given

    def _circular(self, view: View, form: str, angle: Any) -> Any:
        kind, negative = self.recorder.dtype, view.value.negative
        if negative:
            angle = -angle
        if not self.polynomials:
            return (cosine if view.part == "cos" else sine)(SYMBOLIC)(angle)
        digits = DIGITS[kind.name]
        low, high = self.limits[view.value.name]
        first = not negative and low >= 0.0 and high <= np.pi / 2
        left = None
        if form in (ONE, WIDE) and kind != wide(kind):
            # Next to a right angle it is all that there is, and has more digits than the angle.
            left = self._input(str(view.raw), form, left=FROM_NEARER if first else FROM_ANY)
            left = -left if negative else left
        if first:
            return first_quadrant(SYMBOLIC, digits)(angle, left)[view.part == "cos"]
        self.recorder.require(abs(angle) <= digits.most)
        value = any_quadrant(SYMBOLIC, digits)(angle, left)[view.part == "cos"]
        return without_rounding(SYMBOLIC, lambda _: value)(angle) if left is None else value
