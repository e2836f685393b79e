"""Symbols: numbers not known yet, and the operations recorded of them."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from functools import cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.kernels.exponential import reproducible
from optipath.kernels.primitives import NUMPY, Primitives, is_below_rounding, product_rest
from optipath.kernels.trigonometry import DIGITS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


def _operator(operation: str, *, reflected: bool = False) -> Callable[..., Any]:
    """Return the method of an operator; reflected, of one whose second operand is the symbol."""

    def method(self: Symbol, *others: Any) -> Any:
        operands = (*others, self) if reflected else (self, *others)
        return self.recorder.record(operation, *operands)

    return method


@dataclass(eq=False, repr=False, slots=True)
class Symbol:
    """An elementwise operation on other symbols and on numbers, recorded and not done."""

    __array_ufunc__ = None  # So that NumPy's scalars leave operators to this class.
    __hash__ = None  # type: ignore[assignment] # Nor is it looked up in place of a number.

    recorder: Recorder
    operation: str
    operands: tuple[Any, ...]
    kind: str
    _: KW_ONLY
    axes: frozenset[int]
    index: int
    positive: bool = False

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


class About(NamedTuple):
    """What is known of an operation."""

    ufunc: Callable[..., Any]
    kind: str
    text: str
    commutes: bool = False


OPERATIONS = {
    "absolute": About(np.absolute, "same", "abs({0})"),
    "add": About(np.add, "same", "{0} + {1}", commutes=True),
    "arctan2": About(np.arctan2, "float", "atan2({0}, {1})"),
    "cos": About(np.cos, "float", "cos({0})"),
    "divide": About(np.divide, "float", "{0} / {1}"),
    "equal": About(np.equal, "bool", "{0} == {1}", commutes=True),
    "exp": About(np.exp, "float", "exp({0})"),
    "exponent": About(NUMPY.scaling, "int", "exponent({0})"),
    "fixed": About(lambda number: number, "same", "{0}"),
    "floor_divide": About(np.floor_divide, "same", "{0} // {1}"),
    "greater": About(np.greater, "bool", "{0} > {1}"),
    "greater_equal": About(np.greater_equal, "bool", "{0} >= {1}"),
    "integer": About(NUMPY.integer, "int", "int({0})"),
    "ldexp": About(np.ldexp, "float", "ldexp({0}, {1})"),
    "less": About(np.less, "bool", "{0} < {1}"),
    "less_equal": About(np.less_equal, "bool", "{0} <= {1}"),
    "logical_and": About(np.logical_and, "bool", "{0} & {1}", commutes=True),
    "logical_not": About(np.logical_not, "bool", "not {0}"),
    "logical_or": About(np.logical_or, "bool", "{0} | {1}", commutes=True),
    "maximum": About(np.maximum, "same", "{0} if {0} >= {1} else {1}", commutes=True),
    "minimum": About(np.minimum, "same", "{0} if {0} <= {1} else {1}", commutes=True),
    "multiply": About(np.multiply, "same", "{0} * {1}", commutes=True),
    "negative": About(np.negative, "same", "-{0}"),
    "not_equal": About(np.not_equal, "bool", "{0} != {1}", commutes=True),
    "power": About(np.power, "float", "{0} ** {1}"),
    "product_rest": About(product_rest, "float", "product_rest({0}, {1})", commutes=True),
    "remainder": About(np.remainder, "same", "{0} % {1}"),
    "sin": About(np.sin, "float", "sin({0})"),
    "sqrt": About(np.sqrt, "float", "sqrt({0})"),
    "subtract": About(np.subtract, "same", "{0} - {1}"),
    "within": About(lambda n, low, high: (low <= n) & (n <= high), "bool", "{1} <= {0} <= {2}"),
    "where": About(np.where, "same", "{1} if {0} else {2}"),
}


ONE_AXIS = frozenset({0})
"""What differs from path to path, where paths have no order of their own."""


class Recorder:
    """A record of operations in the order in which they can be done.

    >>> import numpy as np
    >>> recorder = Recorder(np.dtype("float64"))
    >>> x = recorder.input("x")
    >>> (x + 1.0) is (1.0 + x), x * 0.0, x * 1.0 is x
    (True, np.float64(0.0), True)
    """

    def __init__(self, dtype: np.dtype[Any]) -> None:
        self.dtype = dtype
        self.kinds = {"bool": np.bool_, "int": np.int64, "float": dtype.type}
        self.symbols: list[Symbol] = []
        self.requirements: list[Any] = []
        self.wide: dict[Any, tuple[float, float]] = {}
        self.constants: dict[Any, Any] = {}
        self._known: dict[Any, Symbol] = {}

    def opaque(self, number: Any) -> Any:
        """Return a symbol for a number that is known, so that nothing comes of knowing it."""
        if isinstance(number, Symbol):
            return number
        name = f"={number!r}"
        self.constants[name] = number
        return self.input(name, axes=frozenset())

    def input(
        self, name: Any, kind: str = "float", *, axes: frozenset[int] = ONE_AXIS, left: str = ""
    ) -> Symbol:
        """Return the symbol of a number that is given, or of what is left of an angle."""
        operation = left or "input"
        return self.entered((operation, name), operation, (name,), kind, axes)

    def record(self, operation: str, *operands: Any) -> Any:
        """Return what an operation comes to: a symbol, or a number where that is known."""
        about = OPERATIONS[operation]
        if operation == "where":
            kind = strongest(operands[1:])
            kinds: Any = ("bool", kind, kind)
        elif operation == "ldexp":
            kind, kinds = "float", ("float", "int")
        else:
            # Whole numbers beside others are made like them.
            kind = "float" if about.kind == "float" else strongest(operands)
            kinds = (kind,) * len(operands)
        symbols = [operand for operand in operands if isinstance(operand, Symbol)]
        if len(symbols) < len(operands):
            pairs = zip(operands, kinds, strict=True)
            operands = tuple([o if isinstance(o, Symbol) else self.kinds[k](o) for o, k in pairs])
        if not symbols:
            with np.errstate(all="ignore"):
                return about.ufunc(*operands)[()]
        rule = _RULES.get(operation)
        if rule is not None and (simpler := rule(*operands)) is not None:
            return simpler
        names: Any = tuple(map(key_of, operands))
        if about.commutes:
            names = frozenset(names)
        kind = kind if about.kind == "same" else about.kind
        axes = symbols[0].axes.union(*[symbol.axes for symbol in symbols[1:]])
        symbol = self.entered((operation, names), operation, operands, kind, axes)
        symbol.positive = kind == "float" and stays_positive(operation, operands)
        return symbol

    def require(self, condition: Any) -> None:
        """Note what must be true for the formula to hold."""
        if not any(condition is known for known in self.requirements):
            self.requirements.append(condition)

    def entered(
        self, key: Any, operation: str, operands: tuple[Any, ...], kind: str, axes: frozenset[int]
    ) -> Symbol:
        """Return the symbol of a key, recorded if it is not."""
        symbol = self._known.get(key)
        if symbol is None:
            symbol = Symbol(self, operation, operands, kind, axes=axes, index=len(self.symbols))
            self._known[key] = symbol
            self.symbols.append(symbol)
        return symbol


def key_of(operand: Any) -> Any:
    """Return what tells an operand from others: the place of a symbol, the digits of a number."""
    if isinstance(operand, Symbol):
        return operand.index
    # Quicker than NumPy's own, and tells 0.0 from -0.0 as well.
    return float.__repr__(operand) if isinstance(operand, float) else repr(operand)


def strongest(operands: Iterable[Any]) -> str:
    """Return the kind of what an operation on numbers of several kinds gives."""
    kinds = [o.kind if isinstance(o, Symbol) else _kind(o) for o in operands]
    return "float" if "float" in kinds else "int" if "int" in kinds else "bool"


def _kind(number: Any) -> str:
    if isinstance(number, (bool, np.bool_)):
        return "bool"
    return "int" if isinstance(number, (int, np.integer)) else "float"


def is_number(operand: Any, value: float) -> bool:
    """Tell whether an operand is known, and this number."""
    return not isinstance(operand, Symbol) and bool(operand == value)


def is_positive(operand: Any) -> bool:
    """Tell whether an operand is known not to be negative."""
    return operand.positive if isinstance(operand, Symbol) else bool(operand >= 0.0)


def stays_positive(operation: str, operands: tuple[Any, ...]) -> bool:
    """Tell whether a result is known not to be negative."""
    match operation:
        case "absolute" | "sqrt" | "exp":
            return True
        case "multiply" if operands[0] is operands[1]:
            return True
        case "add" | "multiply" | "divide" | "minimum":
            return all(map(is_positive, operands))
        case "maximum":
            return any(map(is_positive, operands))
        case "where":
            return all(map(is_positive, operands[1:]))
        case "ldexp":
            return is_positive(operands[0])
    return False


Rule: TypeAlias = "Callable[..., Any]"
"""Returns the operand or number that an operation comes to; None where nothing is simpler.

A product with 0 is 0: numbers that are not finite are detected in the intensity they reach.
"""


def _either(rule: Rule) -> Rule:
    """Return the rule of an operation whose operands may be exchanged."""

    def either(a: Any, b: Any) -> Any:
        result = rule(a, b)
        return rule(b, a) if result is None else result

    return either


def _subtract(a: Any, b: Any) -> Any:
    if is_number(b, 0.0):
        return a
    if is_number(a, 0.0):
        return -b
    if isinstance(b, Symbol) and b.operation == "where" and is_number(b.operands[2], 0.0):
        condition, yes, no = b.operands
        if yes is a:
            return b.recorder.record("where", condition, no, a)
    return None


def _multiply(a: Any, b: Any) -> Any:
    if is_number(a, 0.0):
        return a * 0.0 if a.dtype.kind == "i" else abs(a)
    return b if is_number(a, 1.0) else None


def _divide(a: Any, b: Any) -> Any:
    if is_number(a, 0.0):
        return abs(a)
    return a if is_number(b, 1.0) else None


def _where(condition: Any, yes: Any, no: Any) -> Any:
    if not isinstance(condition, Symbol):
        return yes if condition else no
    numbers = not isinstance(yes, Symbol) and not isinstance(no, Symbol)
    return yes if yes is no or (numbers and bool(yes == no)) else None


def _and(a: Any, b: Any) -> Any:
    if not isinstance(a, Symbol):
        return b if a else np.False_
    return a if a is b else None


def _or(a: Any, b: Any) -> Any:
    if not isinstance(a, Symbol):
        return np.True_ if a else b
    return a if a is b else None


def _maximum(a: Any, b: Any) -> Any:
    if is_number(b, 0.0):
        if is_positive(a):
            return a
        if a.operation == "negative" and is_positive(a.operands[0]):
            return b
    return a if a is b else None


def _minimum(a: Any, b: Any) -> Any:
    return b if a is b or (is_number(b, 0.0) and is_positive(a)) else None


def _against_zero(result: Any) -> Rule:
    """Return the rule of comparing what is not negative with 0."""
    return lambda a, b: result if is_number(b, 0.0) and is_positive(a) else None


def _power(a: Any, b: Any) -> Any:
    if is_number(b, 1.0):
        return a
    return a * a if is_number(b, 2.0) else None


_RULES: dict[str, Rule] = {
    "absolute": lambda a: a if a.positive else None,
    "add": _either(lambda a, b: b if is_number(a, 0.0) else None),
    "divide": _divide,
    "equal": lambda a, b: np.True_ if a is b and a.kind == "bool" else None,
    "fixed": lambda a: a,
    "greater_equal": _against_zero(np.True_),
    "less": _against_zero(np.False_),
    "logical_and": _either(_and),
    "logical_or": _either(_or),
    "maximum": _either(_maximum),
    "minimum": _either(_minimum),
    "multiply": _either(_multiply),
    "negative": lambda a: a.operands[0] if a.operation == "negative" else None,
    "power": _power,
    "subtract": _subtract,
    "where": _where,
}


def record(operation: str, *operands: Any) -> Any:
    """Return what an operation on symbols comes to, or on numbers if all are known."""
    for operand in operands:
        if isinstance(operand, Symbol):
            return operand.recorder.record(operation, *operands)
    return OPERATIONS[operation].ufunc(*operands)[()]


def _recording(*names: str, **others: str) -> dict[str, Any]:
    operations = {**{name: name for name in names}, **others}
    return {name: partial(record, operation) for name, operation in operations.items()}


SYMBOLIC = Primitives(
    **_recording("where", "sqrt", "absolute", "maximum", "minimum", "sin", "cos", "exp"),
    **_recording("ldexp", "fixed", "integer", atan2="arctan2", scaling="exponent"),
    two_product=lambda a, b: (record("multiply", a, b), record("product_rest", a, b)),
    below_rounding=is_below_rounding,
)
"""Primitives that record what kernels do with them, each function as one operation."""


@cache
def reproducible_symbolic(dtype: str) -> Primitives:
    """Return recording primitives alike in every engine; large angles become a requirement."""

    def small_enough(angle: Any) -> Any:
        if isinstance(angle, Symbol):
            angle.recorder.require(abs(angle) <= DIGITS[dtype].most)
            return True
        return abs(angle) <= DIGITS[dtype].most

    return reproducible(SYMBOLIC, dtype, small_enough)
