"""Symbol: a number that is not known yet, and remembers what was done to it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from optipath.engines.formulas.recorder import Recorder


class Symbol:
    """An elementwise operation on other symbols and on numbers, recorded and not done.

    Kernels that are given symbols in place of numbers leave a record of what they compute;
    engines make code of it.

    Attributes
    ----------
    operation : str
        What is done; ``"input"`` for a number that is given.
    operands : tuple
        Symbols and NumPy scalars.
    kind : str
        ``"float"``, ``"bool"`` or ``"int"``.
    axes : frozenset of int
        The axes of the batch along which it differs; none for one number for all of it.
    index : int
        Its place in the record; operands come first.
    positive : bool
        Whether it is known not to be negative.
    """

    __slots__ = ("axes", "index", "kind", "operands", "operation", "positive", "recorder")
    __array_ufunc__ = None  # So that NumPy's scalars leave operators to this class.
    __hash__ = object.__hash__

    def __init__(
        self,
        recorder: Recorder,
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

    def __repr__(self) -> str:
        return f"<Symbol {self.index}: {self.operation}>"

    def __add__(self, other: Any) -> Any:
        return self.recorder.record("add", self, other)

    def __radd__(self, other: Any) -> Any:
        return self.recorder.record("add", other, self)

    def __sub__(self, other: Any) -> Any:
        return self.recorder.record("subtract", self, other)

    def __rsub__(self, other: Any) -> Any:
        return self.recorder.record("subtract", other, self)

    def __mul__(self, other: Any) -> Any:
        return self.recorder.record("multiply", self, other)

    def __rmul__(self, other: Any) -> Any:
        return self.recorder.record("multiply", other, self)

    def __truediv__(self, other: Any) -> Any:
        return self.recorder.record("divide", self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return self.recorder.record("divide", other, self)

    def __floordiv__(self, other: Any) -> Any:
        return self.recorder.record("floor_divide", self, other)

    def __mod__(self, other: Any) -> Any:
        return self.recorder.record("remainder", self, other)

    def __pow__(self, other: Any) -> Any:
        return self.recorder.record("power", self, other)

    def __rpow__(self, other: Any) -> Any:
        return self.recorder.record("power", other, self)

    def __neg__(self) -> Any:
        return self.recorder.record("negative", self)

    def __pos__(self) -> Any:
        return self

    def __abs__(self) -> Any:
        return self.recorder.record("absolute", self)

    def __lt__(self, other: Any) -> Any:
        return self.recorder.record("less", self, other)

    def __le__(self, other: Any) -> Any:
        return self.recorder.record("less_equal", self, other)

    def __gt__(self, other: Any) -> Any:
        return self.recorder.record("greater", self, other)

    def __ge__(self, other: Any) -> Any:
        return self.recorder.record("greater_equal", self, other)

    def __eq__(self, other: object) -> Any:
        return self.recorder.record("equal", self, other)

    def __ne__(self, other: object) -> Any:
        return self.recorder.record("not_equal", self, other)

    def __and__(self, other: Any) -> Any:
        return self.recorder.record("logical_and", self, other)

    def __rand__(self, other: Any) -> Any:
        return self.recorder.record("logical_and", other, self)

    def __or__(self, other: Any) -> Any:
        return self.recorder.record("logical_or", self, other)

    def __ror__(self, other: Any) -> Any:
        return self.recorder.record("logical_or", other, self)

    def __invert__(self) -> Any:
        return self.recorder.record("logical_not", self)
