"""What an operation comes to before the numbers are known."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.symbol import Symbol

if TYPE_CHECKING:
    from collections.abc import Callable

UNKNOWN = object()
"""What `simplified` returns where nothing is simpler."""


def simplified(operation: str, operands: tuple[Any, ...]) -> Any:
    """Return the operand or number that an operation comes to, or `UNKNOWN`.

    A product with 0 is 0: a number that is not finite is found out elsewhere, since it
    reaches the intensity.
    """
    rule = _RULES.get(operation)
    return UNKNOWN if rule is None else rule(*operands)


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


def _add(a: Any, b: Any) -> Any:
    if is_number(a, 0.0):
        return b
    return a if is_number(b, 0.0) else UNKNOWN


def _subtract(a: Any, b: Any) -> Any:
    if is_number(b, 0.0):
        return a
    if is_number(a, 0.0):
        return -b
    if isinstance(b, Symbol) and b.operation == "where" and is_number(b.operands[2], 0.0):
        condition, yes, no = b.operands
        if yes is a:
            return b.recorder.record("where", condition, no, a)
    return UNKNOWN


def _multiply(a: Any, b: Any) -> Any:
    for one, other in ((a, b), (b, a)):
        if is_number(one, 0.0):
            return one * 0.0 if one.dtype.kind == "i" else abs(one)
        if is_number(one, 1.0):
            return other
    return UNKNOWN


def _divide(a: Any, b: Any) -> Any:
    if is_number(a, 0.0):
        return abs(a)
    return a if is_number(b, 1.0) else UNKNOWN


def _negative(a: Any) -> Any:
    return a.operands[0] if a.operation == "negative" else UNKNOWN


def _absolute(a: Any) -> Any:
    return a if a.positive else UNKNOWN


def _where(condition: Any, yes: Any, no: Any) -> Any:
    if not isinstance(condition, Symbol):
        return yes if condition else no
    alike = yes is no or (
        not isinstance(yes, Symbol) and not isinstance(no, Symbol) and bool(yes == no)
    )
    return yes if alike else UNKNOWN


def _and(a: Any, b: Any) -> Any:
    for one, other in ((a, b), (b, a)):
        if not isinstance(one, Symbol):
            return other if one else np.False_
    return a if a is b else UNKNOWN


def _or(a: Any, b: Any) -> Any:
    for one, other in ((a, b), (b, a)):
        if not isinstance(one, Symbol):
            return np.True_ if one else other
    return a if a is b else UNKNOWN


def _less(a: Any, b: Any) -> Any:
    """Nothing that is not negative is less than 0."""
    return np.False_ if is_number(b, 0.0) and is_positive(a) else UNKNOWN


def _greater_equal(a: Any, b: Any) -> Any:
    return np.True_ if is_number(b, 0.0) and is_positive(a) else UNKNOWN


def _equal(a: Any, b: Any) -> Any:
    return np.True_ if a is b and a.kind == "bool" else UNKNOWN


def _maximum(a: Any, b: Any) -> Any:
    for one, other in ((a, b), (b, a)):
        if is_number(other, 0.0):
            if is_positive(one):
                return one
            if one.operation == "negative" and is_positive(one.operands[0]):
                return other
    return a if a is b else UNKNOWN


def _minimum(a: Any, b: Any) -> Any:
    for one, other in ((a, b), (b, a)):
        if is_number(other, 0.0) and is_positive(one):
            return other
    return a if a is b else UNKNOWN


def _fixed(a: Any) -> Any:
    return a


def _power(a: Any, b: Any) -> Any:
    if is_number(b, 1.0):
        return a
    return a * a if is_number(b, 2.0) else UNKNOWN


_RULES: dict[str, Callable[..., Any]] = {
    "absolute": _absolute,
    "add": _add,
    "divide": _divide,
    "equal": _equal,
    "fixed": _fixed,
    "greater_equal": _greater_equal,
    "less": _less,
    "logical_and": _and,
    "logical_or": _or,
    "maximum": _maximum,
    "minimum": _minimum,
    "multiply": _multiply,
    "negative": _negative,
    "power": _power,
    "subtract": _subtract,
    "where": _where,
}
