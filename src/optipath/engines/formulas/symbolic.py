"""Primitives that record: kernels made for them take symbols and leave a formula."""

from __future__ import annotations

from functools import cache, partial
from typing import Any

from optipath.engines.formulas.operations import OPERATIONS
from optipath.engines.formulas.symbol import Symbol
from optipath.kernels.numbers.primitives import Primitives, is_below_rounding
from optipath.kernels.numbers.reproducible import reproducible
from optipath.kernels.numbers.trigonometry import DIGITS


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
    """Return primitives that record elementary functions as every engine does them alike.

    Angles that are too large for them become a requirement of the record.
    """

    def small_enough(angle: Any) -> Any:
        if isinstance(angle, Symbol):
            angle.recorder.require(abs(angle) <= DIGITS[dtype].most)
            return True
        return abs(angle) <= DIGITS[dtype].most

    return reproducible(SYMBOLIC, dtype, small_enough)
