"""Recorder: keeps what kernels do to symbols, each operation once."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.engines.formulas.operations import OPERATIONS
from optipath.engines.formulas.simplify import UNKNOWN, simplified, stays_positive
from optipath.engines.formulas.symbol import Symbol

ONE_AXIS = frozenset({0})
"""What differs from path to path, where paths have no order of their own."""


class Recorder:
    """A record of operations in the order in which they can be done.

    Examples
    --------
    >>> import numpy as np
    >>> recorder = Recorder(np.dtype("float64"))
    >>> x = recorder.input("x")
    >>> (x + 1.0) is (1.0 + x), x * 0.0, x * 1.0 is x
    (True, np.float64(0.0), True)
    """

    def __init__(self, dtype: np.dtype[Any]) -> None:
        self.dtype = dtype
        self.symbols: list[Symbol] = []
        self.requirements: list[Any] = []
        self.wide: dict[str, tuple[float, float]] = {}
        self.constants: dict[str, Any] = {}
        self._known: dict[Any, Symbol] = {}

    def opaque(self, number: Any) -> Any:
        """Return a symbol for a number that is known, so that nothing comes of knowing it."""
        if isinstance(number, Symbol):
            return number
        name = f"={number!r}"
        self.constants[name] = number
        return self.input(name, axes=frozenset())

    def input(
        self,
        name: str,
        kind: str = "float",
        *,
        axes: frozenset[int] = ONE_AXIS,
        left: str = "",
    ) -> Symbol:
        """Return the symbol of a number that is given, or of what is left of an angle."""
        operation = left or "input"
        return self._entered((operation, name), operation, (name,), kind, axes)

    def record(self, operation: str, *operands: Any) -> Any:
        """Return what an operation comes to: a symbol, or a number where that is known."""
        about = OPERATIONS[operation]
        operands = self._alike(operation, operands)
        symbols = [operand for operand in operands if isinstance(operand, Symbol)]
        if not symbols:
            with np.errstate(all="ignore"):
                return about.ufunc(*operands)[()]
        found = simplified(operation, operands)
        if found is not UNKNOWN:
            return found
        names = [o.index if isinstance(o, Symbol) else repr(o) for o in operands]
        if about.commutes:
            names.sort(key=str)
        kind = _kind(operands[-1]) if about.kind == "same" else about.kind
        axes = frozenset().union(*[symbol.axes for symbol in symbols])
        symbol = self._entered((operation, *names), operation, operands, kind, axes)
        symbol.positive = kind == "float" and stays_positive(operation, operands)
        return symbol

    def require(self, condition: Any) -> None:
        """Note what must be true for the formula to hold."""
        if not any(condition is known for known in self.requirements):
            self.requirements.append(condition)

    def _alike(self, operation: str, operands: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the operands, whole numbers beside others made like them."""
        if operation == "ldexp":
            return self._number(operands[0], "float"), self._number(operands[1], "int")
        if operation == "where":
            return self._number(operands[0], "bool"), *self._alike("", operands[1:])
        kinds = {_kind(operand) for operand in operands}
        kind = "float" if OPERATIONS.get(operation, _SAME).kind == "float" else ""
        kind = kind or next(name for name in ("float", "int", "bool") if name in kinds)
        return tuple([self._number(operand, kind) for operand in operands])

    def _number(self, value: Any, kind: str) -> Any:
        if isinstance(value, Symbol):
            return value
        return {"bool": np.bool_, "int": np.int64, "float": self.dtype.type}[kind](value)

    def _entered(
        self, key: Any, operation: str, operands: tuple[Any, ...], kind: str, axes: frozenset[int]
    ) -> Symbol:
        if key not in self._known:
            symbol = Symbol(self, operation, operands, kind, axes=axes, index=len(self.symbols))
            self._known[key] = symbol
            self.symbols.append(symbol)
        return self._known[key]


_SAME = OPERATIONS["add"]


def _kind(operand: Any) -> str:
    if isinstance(operand, Symbol):
        return operand.kind
    if isinstance(operand, (bool, np.bool_)):
        return "bool"
    return "int" if isinstance(operand, (int, np.integer)) else "float"
