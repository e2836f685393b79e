"""Formula: the numbers of a run as one list of operations, staged, and the engines that run it.

Near a right angle, a rounded angle loses the digits of its cosine: a formula of fewer digits is
given both, the angle rounded and its remainder.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, reduce
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np

from optipath.engines.symbols import ONE_AXIS, SYMBOLIC, Recorder, Symbol
from optipath.extras import missing_extra
from optipath.kernels.trigonometry import (
    DIGITS,
    any_quadrant,
    first_quadrant,
    from_axes,
    from_nearer_axis,
    without_rounding,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.errors import MissingExtraError
    from optipath.kernels.primitives import Primitives
    from optipath.kernels.trigonometry import Digits
    from optipath.values.operands import Operand


@dataclass(frozen=True, eq=False)
class Formula:
    """Operations in the order in which they can be done; only those that are needed."""

    dtype: np.dtype[Any]
    results: tuple[Any, ...]
    conditions: tuple[Any, ...] = ()
    wide: Mapping[Any, tuple[float, float]] = field(default_factory=dict)
    constants: Mapping[Any, Any] = field(default_factory=dict)
    axes: frozenset[int] = ONE_AXIS
    last: int | None = None
    earlier: frozenset[int] = frozenset()
    apart: bool = False

    @cached_property
    def holds(self) -> Any:
        """Whether the results are what the path gives."""
        return reduce(lambda one, other: one & other, self.conditions, np.True_)

    @property
    def checks(self) -> tuple[Any, ...]:
        """What must be true: all conditions in one, or apart, each by itself."""
        return self.conditions if self.apart else (self.holds,)

    @property
    def needed(self) -> tuple[Symbol, ...]:
        """What the results need, in the order in which it can be done."""
        return self._needed[0]

    @property
    def items(self) -> dict[int, dict[int, int]]:
        """The results of each call that are needed: their places and symbols."""
        return self._needed[1]

    @cached_property
    def _needed(self) -> tuple[tuple[Symbol, ...], dict[int, dict[int, int]]]:
        ends = [output for output in (*self.results, *self.checks) if isinstance(output, Symbol)]
        wanted = {symbol.index for symbol in ends}
        results: list[Symbol] = []
        items: dict[int, dict[int, int]] = {}
        # Whatever reads a symbol has been recorded after it.
        recorded = ends[0].recorder.symbols[: max(wanted) + 1] if ends else []
        for symbol in reversed(recorded):
            if symbol.index not in wanted:
                continue
            results.append(symbol)
            operands: Sequence[Any] = () if symbol.index in self.earlier else symbol.operands
            if symbol.operation == "item":
                made, place = operands
                items.setdefault(made.index, {})[place] = symbol.index
            elif symbol.operation == "call":
                template, *arguments = operands
                # Of the arguments, those that the results need which are wanted.
                operands = [
                    arguments[at] for at in template.needs(tuple(sorted(items[symbol.index])))
                ]
            wanted |= {operand.index for operand in operands if isinstance(operand, Symbol)}
        return tuple(reversed(results)), items

    @cached_property
    def inputs(self) -> tuple[Symbol, ...]:
        """The numbers that are given, or computed before."""
        return tuple([s for s in self.needed if s.operation == "input" or s.index in self.earlier])

    @cached_property
    def lefts(self) -> tuple[Symbol, ...]:
        """What is left, beside right angles, of angles that are given in more digits."""
        return tuple([symbol for symbol in self.needed if symbol.operation.startswith("left")])

    @cached_property
    def unread(self) -> frozenset[Any]:
        """The inputs of more digits that nothing reads, so that nothing checks their ranges."""
        return frozenset(self.wide) - {self.name_of(symbol) for symbol in self.inputs}

    def name_of(self, symbol: Symbol) -> Any:
        """Return what an input is called."""
        return f"#{symbol.index}" if symbol.index in self.earlier else symbol.operands[0]

    def place_of(self, symbol: Symbol) -> str:
        """Return where an input differs.

        ``"one"`` for one number, ``"row"`` and ``"column"`` for an array along all but the
        inner loop, or along that alone, and ``"cell"`` for one along all axes.
        """
        if symbol.uniform:
            return "one"
        if self.last is None or self.name_of(symbol) in self.wide:
            return "cell"
        if self.last not in symbol.axes:
            return "row"
        return "column" if len(symbol.axes) == 1 else "cell"

    @cached_property
    def places(self) -> tuple[tuple[Any, str], ...]:
        """What each input is called, and where it differs."""
        return tuple([(self.name_of(s), self.place_of(s)) for s in self.inputs])

    def whole_of(self, left: Symbol) -> Symbol:
        """Return the input of which something is left."""
        # Symbols of earlier stages are no texts, and record what they are compared with.
        arguments = (symbol for symbol in self.inputs if symbol.operation == "input")
        return next(symbol for symbol in arguments if symbol.operands == left.operands)

    @cached_property
    def steps(self) -> tuple[Symbol, ...]:
        """The operations on what is given."""
        arguments = {symbol.index for symbol in (*self.inputs, *self.lefts)}
        return tuple([symbol for symbol in self.needed if symbol.index not in arguments])

    @cached_property
    def computed(self) -> tuple[Symbol, ...]:
        """The results that are not known, in order."""
        return tuple([result for result in self.results if isinstance(result, Symbol)])

    @cached_property
    def uses(self) -> dict[int, int]:
        """How often each symbol is an operand or an output."""
        counts: dict[int, int] = {}
        operands = [o for step in self.steps for o in step.operands]
        for operand in (*operands, *self.results, *self.checks):
            if isinstance(operand, Symbol):
                counts[operand.index] = counts.get(operand.index, 0) + 1
        return counts

    @cached_property
    def prologue(self) -> tuple[Symbol, ...]:
        """The operations on what is one number for the whole batch."""
        return tuple([step for step in self.steps if step.uniform])

    @cached_property
    def body(self) -> tuple[Symbol, ...]:
        """The operations on what differs from path to path."""
        return tuple([step for step in self.steps if not step.uniform])

    @property
    def length(self) -> int:
        """How many operations there are, those of calls included."""
        inside: list[int] = [
            step.operands[0].length(tuple(sorted(self.items[step.index])))
            for step in self.steps
            if step.operation == "call"
        ]
        plain = [step for step in self.steps if step.operation not in ("call", "item")]
        return len(plain) + sum(inside)

    @cached_property
    def operations(self) -> dict[str, int]:
        """How many operations there are, in all and of the dear sorts."""
        counts = {"all": 0, "sqrt": 0, "divide": 0, "sin and cos": 0, "others": 0}
        for step in self.steps:
            name = step.operation
            name = "sin and cos" if name in ("sin", "cos", "arctan2", "exp") else name
            counts[name if name in counts else "others"] += 1
        counts["all"] = sum(counts.values())
        del counts["others"]
        return counts


def stages(whole: Formula, axes: frozenset[int], last: int | None) -> tuple[Formula, ...]:
    """Return formulas to be done one after the other; the last gives the results.

    What depends on a few axes of the batch only is computed along these alone, by an earlier stage.
    """
    known: list[Symbol] = []
    outcomes: list[Formula] = []
    fewer = {step.axes for step in whole.steps if step.axes < axes and step.axes}
    for own in sorted(fewer, key=lambda several: (len(several), sorted(several))):
        # What is needed of a stage once it is done.
        operands = [o for step in whole.steps if step.axes > own for o in step.operands]
        later = {o.index for o in (*operands, *whole.computed) if isinstance(o, Symbol)}
        results = tuple(s for s in whole.steps if s.axes == own and s.index in later)
        outcomes.append(_stage(whole, results, own, last, known))
        known += results
    done = {symbol.index for symbol in known}
    results = tuple(
        result
        for result in whole.results
        if not (isinstance(result, Symbol) and result.index in done)
    )
    return (*outcomes, _stage(whole, results, axes, last, known, frozenset()))


def _stage(
    whole: Formula,
    results: tuple[object, ...],
    own: frozenset[int],
    last: int | None,
    known: Sequence[Symbol],
    *others: frozenset[int],
) -> Formula:
    """Return what is to be done along some axes; conditions along others may be looked at too."""
    conditions = tuple(
        condition
        for condition in whole.conditions
        if (condition.axes if isinstance(condition, Symbol) else frozenset()) in (own, *others)
    )
    return replace(
        whole,
        results=results,
        conditions=conditions,
        axes=own,
        last=last if last in own and len(own) > 1 else None,
        earlier=frozenset(symbol.index for symbol in known if symbol.axes < own),
    )


FROM_NEARER, FROM_ANY = "left from the nearer axis", "left from axes"
"""Operations on an angle that is given: within 0 .. pi/2, or any."""

LEFT = {FROM_NEARER: from_nearer_axis, FROM_ANY: from_axes}
DOUBLE = DIGITS["float64"]


@cache
def left_formula(operation: str) -> Formula:
    """Return what is left of an angle as a formula of double precision, for engines that compile.

    >>> [step.operation for step in left_formula(FROM_NEARER).steps]
    ['subtract', 'minimum', 'add', 'maximum', 'minimum']
    """
    recorder = Recorder(np.dtype(np.float64))
    left = LEFT[operation](SYMBOLIC, DOUBLE)(recorder.input("angle"))
    return Formula(recorder.dtype, (left,))


def is_in_first_quadrant(operand: Operand, limits: tuple[float, float]) -> bool:
    """Tell whether the angle of an operand is known to be within 0 .. pi/2."""
    low, high = limits
    return not operand.value.is_negative and low >= 0.0 and high <= np.pi / 2


def of_angle(
    xp: Primitives, digits: Digits, part: str | int, angle: Any, left: Any, *, first: bool
) -> Any:
    """Return the cosine or the sine of an angle."""
    if first:
        return first_quadrant(xp, digits)(angle, left)[part == "cos"]
    value = any_quadrant(xp, digits)(angle, left)[part == "cos"]
    return without_rounding(xp, lambda _: value)(angle) if left is None else value


class Engine(ABC):
    """Makes a function of a formula: the one entry of an engine, in a file of its own.

    JAX takes the steps of the program with their kernels instead: of a formula it would know
    neither where a kernel ends, which XLA compiles by itself, nor what a slope is at an edge.
    """

    name: ClassVar[str]
    extra: ClassVar[str] = ""
    precisions: ClassVar[tuple[str, ...]] = ("float64", "float32")
    longest: ClassVar[float] = math.inf

    @abstractmethod
    def compiled(self, formula: Any) -> Any:
        """Return the function of a formula."""

    def is_ready(self, formula: Any) -> bool:
        """Tell whether a formula runs without compiling; of an extra it is not known here."""
        del formula
        return not self.extra

    @property
    def is_installed(self) -> bool:
        """Whether what it needs is there, found without importing it."""
        return not self.extra or find_spec(self.name) is not None

    @property
    def missing(self) -> MissingExtraError:
        """The error that it is not installed."""
        return missing_extra(f"plans of engine '{self.name}'", self.name)


ArrayPath: TypeAlias = "Callable[[Range, Range, list[Any], Any, int], bool]"
"""A formula that can be done to arrays.

It is given a range of rows and of columns; the inputs in the order of the formula, each a number
or an array along one axis (`Formula.place_of`); an array of shape (results, paths) to be filled;
and its column for the first cell. It returns whether the formula holds for all of the range.
"""

Range: TypeAlias = tuple[int, int]
