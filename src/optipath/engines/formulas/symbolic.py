"""Primitives that record: kernels made for them take symbols and leave a formula."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np

from optipath.engines.formulas.operations import OPERATIONS
from optipath.engines.formulas.symbol import Symbol
from optipath.kernels.numbers.primitives import Primitives, is_below_rounding
from optipath.kernels.numbers.reproducible import reproducible
from optipath.kernels.numbers.trigonometry import DIGITS, any_quadrant


def record(operation: str, *operands: Any) -> Any:
    """Return what an operation on symbols comes to, or on numbers if all are known.

    Parameters
    ----------
    operation : str
        One of `OPERATIONS`.
    *operands : Symbol or number
        What it is done to.

    Returns
    -------
    Symbol or number
    """
    for operand in operands:
        if isinstance(operand, Symbol):
            return operand.recorder.record(operation, *operands)
    return OPERATIONS[operation].ufunc(*operands)[()]


def _recording(*names: str, **others: str) -> dict[str, Any]:
    operations = {**{name: name for name in names}, **others}
    return {name: partial(record, operation) for name, operation in operations.items()}


def _of_pair(angle: Any) -> tuple[Any, Any] | None:
    """Return (sin, cos) of an angle, or twice one, that is known by its sine and cosine."""
    if not isinstance(angle, Symbol):
        return None
    if angle.index in angle.recorder.pairs:
        return angle.recorder.pairs[angle.index]
    if angle.operation == "negative":
        pair = _of_pair(angle.operands[0])
        return pair and (-pair[0], pair[1])
    if angle.operation == "multiply":
        twice, inner = angle.operands
        pair = _of_pair(inner)
        if pair and not isinstance(twice, Symbol) and twice == 2.0:
            sin, cos = pair
            return 2.0 * sin * cos, (cos - sin) * (cos + sin)
    return None


def _circular(name: str, angle: Any) -> Any:
    pair = _of_pair(angle)
    return pair[name == "cos"] if pair else record(name, angle)


def _below_rounding(larger: Any, number: Any) -> Any:
    # A sine that is given has digits of its own.
    return np.False_ if _of_pair(larger) else is_below_rounding(larger, number)


SYMBOLIC = Primitives(
    **_recording("where", "sqrt", "absolute", "maximum", "minimum", "exp", "ldexp"),
    sin=partial(_circular, "sin"),
    cos=partial(_circular, "cos"),
    **_recording("fixed", "multiply_add", "integer", atan2="arctan2", scaling="exponent"),
    two_product=lambda a, b: (record("multiply", a, b), record("product_rest", a, b)),
    below_rounding=_below_rounding,
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
        pair = _of_pair(angle)
        if pair or not isinstance(angle, Symbol):
            return pair[place] if pair else record(name, angle)
        angle.recorder.require(abs(angle) <= digits.most)
        return polynomials(angle)[place]

    return replace(
        SYMBOLIC, sin=partial(sine_or_cosine, "sin", 0), cos=partial(sine_or_cosine, "cos", 1)
    )


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

    return reproducible(replace(SYMBOLIC, below_rounding=is_below_rounding), dtype, small_enough)
