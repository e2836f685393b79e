"""Formula: what becomes of the numbers that are given, as one list of operations."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.recorder import ONE_AXIS
from optipath.engines.formulas.symbol import Symbol

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, eq=False)
class Formula:
    """Operations in the order in which they can be done; only those that are needed."""

    dtype: np.dtype[Any]
    results: tuple[Any, ...]
    conditions: tuple[Any, ...] = ()
    wide: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    constants: Mapping[str, Any] = field(default_factory=dict)
    axes: frozenset[int] = ONE_AXIS
    last: int | None = None
    earlier: frozenset[int] = frozenset()

    @cached_property
    def holds(self) -> Any:
        """Whether the results are what the path gives."""
        return reduce(lambda one, other: one & other, self.conditions, np.True_)

    @cached_property
    def needed(self) -> tuple[Symbol, ...]:
        """What the results need, in the order in which it can be done."""
        found: dict[int, Symbol] = {}
        waiting = [output for output in (*self.results, self.holds) if isinstance(output, Symbol)]
        while waiting:
            symbol = waiting.pop()
            if symbol.index not in found:
                found[symbol.index] = symbol
                if symbol.index not in self.earlier:
                    waiting += [o for o in symbol.operands if isinstance(o, Symbol)]
        return tuple(found[index] for index in sorted(found))

    @cached_property
    def inputs(self) -> tuple[Symbol, ...]:
        """The numbers that are given, or computed before."""
        return tuple(s for s in self.needed if s.operation == "input" or s.index in self.earlier)

    @cached_property
    def lefts(self) -> tuple[Symbol, ...]:
        """What is left, beside right angles, of angles that are given in more digits."""
        return tuple(symbol for symbol in self.needed if symbol.operation.startswith("left"))

    @cached_property
    def unread(self) -> frozenset[str]:
        """The inputs of more digits that nothing reads, so that nothing checks their ranges."""
        return frozenset(self.wide) - {self.name_of(symbol) for symbol in self.inputs}

    def name_of(self, symbol: Symbol) -> str:
        """Return what an input is called."""
        return f"#{symbol.index}" if symbol.index in self.earlier else str(symbol.operands[0])

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

    def whole_of(self, left: Symbol) -> Symbol:
        """Return the input of which something is left."""
        # Symbols of earlier stages are no texts, and record what they are compared with.
        given = (symbol for symbol in self.inputs if symbol.operation == "input")
        return next(symbol for symbol in given if symbol.operands == left.operands)

    @cached_property
    def steps(self) -> tuple[Symbol, ...]:
        """The operations on what is given."""
        given = {symbol.index for symbol in (*self.inputs, *self.lefts)}
        return tuple(symbol for symbol in self.needed if symbol.index not in given)

    @cached_property
    def computed(self) -> tuple[Symbol, ...]:
        """The results that are not known, in order."""
        return tuple(result for result in self.results if isinstance(result, Symbol))

    @cached_property
    def uses(self) -> dict[int, int]:
        """How often each symbol is an operand or an output."""
        counts: dict[int, int] = {}
        operands = [o for step in self.steps for o in step.operands]
        for operand in (*operands, *self.results, self.holds):
            if isinstance(operand, Symbol):
                counts[operand.index] = counts.get(operand.index, 0) + 1
        return counts

    @cached_property
    def prologue(self) -> tuple[Symbol, ...]:
        """The operations on what is one number for the whole batch."""
        return tuple(step for step in self.steps if step.uniform)

    @cached_property
    def body(self) -> tuple[Symbol, ...]:
        """The operations on what differs from path to path."""
        return tuple(step for step in self.steps if not step.uniform)

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
