"""Primitives that record: kernels made for them take symbols and leave a formula."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from typing import Any

from optipath.formulas.operations import OPERATIONS
from optipath.formulas.symbol import Symbol
from optipath.kernels import Primitives
from optipath.kernels.trigonometry import DIGITS, any_quadrant


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
    **_recording("where", "sqrt", "absolute", "maximum", "minimum", "sin", "cos", "exp", "ldexp"),
    **_recording("fixed", "multiply_add", atan2="arctan2"),
    frexp=lambda number: (number, record("exponent", number)),
    two_product=lambda a, b: (record("multiply", a, b), record("product_rest", a, b)),
    hidden=lambda larger, number: record("equal", record("add", larger, number), larger),
)
"""Primitives that record what kernels do with them."""


@cache
def with_polynomials(dtype: str) -> Primitives:
    """Return primitives that record sines and cosines as polynomials.

    Angles that are too large for them become a requirement of the record.
    """
    digits = DIGITS[dtype]
    polynomials = any_quadrant(SYMBOLIC, digits)

    def sine_or_cosine(name: str, place: int, angle: Any) -> Any:
        if not isinstance(angle, Symbol):
            return record(name, angle)
        angle.recorder.require(abs(angle) <= digits.most)
        return polynomials(angle, 0.0)[place]

    return replace(
        SYMBOLIC, sin=partial(sine_or_cosine, "sin", 0), cos=partial(sine_or_cosine, "cos", 1)
    )
