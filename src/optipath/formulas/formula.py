"""Formula: what becomes of the numbers that are given, as one list of operations."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.formulas.symbol import Symbol

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np


@dataclass(frozen=True, eq=False)
class Formula:
    """Operations in the order in which they can be done; only those that are needed.

    Attributes
    ----------
    dtype : dtype
        The precision of the operations.
    outputs : tuple
        Symbols, or numbers that are known; the last is whether the formula holds.
    wide : mapping of str to (float, float)
        The inputs whose arrays have more digits than the formula, and their ranges.
    constants : mapping of str to float
        The inputs whose numbers are known.
    """

    dtype: np.dtype[Any]
    outputs: tuple[Any, ...]
    wide: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    constants: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def needed(self) -> tuple[Symbol, ...]:
        """What the outputs need, in the order in which it can be done."""
        found: dict[int, Symbol] = {}
        waiting = [output for output in self.outputs if isinstance(output, Symbol)]
        while waiting:
            symbol = waiting.pop()
            if symbol.index not in found:
                found[symbol.index] = symbol
                waiting += [o for o in symbol.operands if isinstance(o, Symbol)]
        return tuple(found[index] for index in sorted(found))

    @cached_property
    def inputs(self) -> tuple[Symbol, ...]:
        """The numbers that are given."""
        return tuple(symbol for symbol in self.needed if symbol.operation == "input")

    @cached_property
    def rests(self) -> tuple[Symbol, ...]:
        """What the precision of the formula loses of numbers that are given."""
        return tuple(symbol for symbol in self.needed if symbol.operation == "rest")

    def whole_of(self, rest: Symbol) -> Symbol:
        """Return the input that a rest belongs to."""
        return next(symbol for symbol in self.inputs if symbol.operands == rest.operands)

    @cached_property
    def steps(self) -> tuple[Symbol, ...]:
        """The operations on what is given."""
        return tuple(s for s in self.needed if s.operation not in ("input", "rest"))

    @property
    def results(self) -> tuple[Any, ...]:
        """The outputs but for the last."""
        return self.outputs[:-1]

    @property
    def holds(self) -> Any:
        """Whether the results are what the path gives."""
        return self.outputs[-1]

    @cached_property
    def uses(self) -> dict[int, int]:
        """How often each symbol is an operand or an output."""
        counts: dict[int, int] = {}
        operands = [o for step in self.steps for o in step.operands]
        for operand in (*operands, *self.outputs):
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
