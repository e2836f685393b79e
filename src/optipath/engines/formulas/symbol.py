"""Symbol: a number that is not known yet, and remembers what was done to it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable


class Record(Protocol):
    """What symbols ask of whoever keeps what is done to them."""

    def record(self, operation: str, *operands: Any) -> Any:
        """Return what an operation comes to: a symbol, or a number where that is known."""

    def require(self, condition: Any) -> None:
        """Note what must be true for the formula to hold."""


def _operator(operation: str, *, reflected: bool = False) -> Callable[..., Any]:
    """Return the method of an operator; reflected, of one whose second operand is the symbol."""

    def method(self: Symbol, *others: Any) -> Any:
        operands = (*others, self) if reflected else (self, *others)
        return self.recorder.record(operation, *operands)

    return method


class Symbol:
    """An elementwise operation on other symbols and on numbers, recorded and not done.

    Kernels that are given symbols in place of numbers leave a record of what they compute;
    engines make code of it.
    """

    __slots__ = ("axes", "index", "kind", "operands", "operation", "positive", "recorder")
    __array_ufunc__ = None  # So that NumPy's scalars leave operators to this class.
    __hash__ = None  # type: ignore[assignment] # Nor is it looked up in place of a number.

    def __init__(
        self,
        recorder: Record,
        operation: str,
        operands: tuple[Any, ...],
        kind: str,
        *,
        axes: frozenset[int],
        index: int,
        positive: bool = False,
    ) -> None:
        self.recorder = recorder
        self.operation = operation
        self.operands = operands
        self.kind = kind
        self.axes = axes
        self.index = index
        self.positive = positive

    @property
    def uniform(self) -> bool:
        """Whether it is one number for the whole batch."""
        return not self.axes

    def __bool__(self) -> bool:
        raise TypeError("a number that is not known yet is neither true nor false; use xp.where")

    def __str__(self) -> str:
        raise TypeError("a number that is not known yet has no digits; use xp.where")

    def __repr__(self) -> str:
        return f"<Symbol {self.index}: {self.operation}>"

    def __pos__(self) -> Any:
        return self

    __add__, __radd__ = _operator("add"), _operator("add", reflected=True)
    __sub__, __rsub__ = _operator("subtract"), _operator("subtract", reflected=True)
    __mul__, __rmul__ = _operator("multiply"), _operator("multiply", reflected=True)
    __truediv__, __rtruediv__ = _operator("divide"), _operator("divide", reflected=True)
    __floordiv__ = _operator("floor_divide")
    __mod__ = _operator("remainder")
    __pow__, __rpow__ = _operator("power"), _operator("power", reflected=True)
    __and__, __rand__ = _operator("logical_and"), _operator("logical_and", reflected=True)
    __or__, __ror__ = _operator("logical_or"), _operator("logical_or", reflected=True)
    __neg__ = _operator("negative")
    __abs__ = _operator("absolute")
    __invert__ = _operator("logical_not")
    __lt__ = _operator("less")
    __le__ = _operator("less_equal")
    __gt__ = _operator("greater")
    __ge__ = _operator("greater_equal")
    __eq__ = _operator("equal")
    __ne__ = _operator("not_equal")
