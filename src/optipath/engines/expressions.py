"""Formulas as lines of Python, an assignment each, for engines that compile scalars."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from optipath.engines.formulas import Symbol

EXPRESSIONS = {
    "absolute": "abs({0})",
    "add": "{0} + {1}",
    "arctan2": "atan2({0}, {1})",
    "cos": "cos({0})",
    "divide": "{0} / {1}",
    "equal": "{0} == {1}",
    "exp": "exp({0})",
    "exponent": "exponent({0})",
    "fixed": "{0}",
    "floor_divide": "{0} // {1}",
    "greater": "{0} > {1}",
    "greater_equal": "{0} >= {1}",
    "ldexp": "ldexp({0}, {1})",
    "less": "{0} < {1}",
    "less_equal": "{0} <= {1}",
    "logical_and": "{0} & {1}",
    "logical_not": "not {0}",
    "logical_or": "{0} | {1}",
    "maximum": "{0} if {0} >= {1} else {1}",
    "minimum": "{0} if {0} <= {1} else {1}",
    "multiply": "{0} * {1}",
    "multiply_add": "multiply_add({0}, {1}, {2})",
    "negative": "-{0}",
    "not_equal": "{0} != {1}",
    "power": "{0} ** {1}",
    "product_rest": "product_rest({0}, {1})",
    "remainder": "{0} % {1}",
    "sin": "sin({0})",
    "sqrt": "sqrt({0})",
    "subtract": "{0} - {1}",
    "where": "{1} if {0} else {2}",
}


def assignments(steps: Iterable[Symbol], written: Callable[[Any], str]) -> list[str]:
    """Return a line for each operation.

    Parameters
    ----------
    steps : iterable of Symbol
        The operations in order.
    written : callable
        How an operand is written: the name of a symbol, or a number.

    Returns
    -------
    list of str
    """
    return [
        f"{written(step)} = {EXPRESSIONS[step.operation].format(*map(written, step.operands))}"
        for step in steps
    ]
