"""Primitives for numbers of twice the precision, so that any kernel can be done in it."""

from __future__ import annotations

from functools import cache
from typing import Any

from optipath.kernels.numbers.double_double import DoubleDouble, high_and_low
from optipath.kernels.numbers.double_double_series import angle, cosine, exponential, sine
from optipath.kernels.numbers.primitives import Primitives


@cache
def twice(xp: Primitives) -> Primitives:
    """Return primitives for numbers of twice the precision of those that `xp` is for.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> double = twice(FLOAT)
    >>> one = double.cos(DoubleDouble(FLOAT, 0.1)), double.sin(DoubleDouble(FLOAT, 0.1))
    >>> bool(abs((one[0] * one[0] + one[1] * one[1] - 1.0).high) < 1e-31)
    True
    """

    def longer(number: Any) -> DoubleDouble:
        return number if isinstance(number, DoubleDouble) else DoubleDouble(xp, number)

    def where(condition: Any, yes: Any, no: Any) -> DoubleDouble:
        pairs = zip(high_and_low(yes), high_and_low(no), strict=True)
        return DoubleDouble(xp, *(xp.where(condition, one, other) for one, other in pairs))

    def ldexp(number: DoubleDouble, exponent: Any) -> DoubleDouble:
        high, low = number.high, number.low
        return DoubleDouble(xp, xp.ldexp(high, exponent), xp.ldexp(low, exponent))

    def two_product(one: Any, other: Any) -> tuple[DoubleDouble, DoubleDouble]:
        product = longer(one) * other
        return product, 0.0 * product

    return Primitives(
        where=where,
        sqrt=lambda number: longer(number).sqrt(),
        absolute=lambda number: where(number < 0.0, -number, number),
        maximum=lambda one, other: where(one < other, other, one),
        minimum=lambda one, other: where(other < one, other, one),
        sin=lambda angle: sine(longer(angle)),
        cos=lambda angle: cosine(longer(angle)),
        exp=lambda number: exponential(longer(number)),
        atan2=lambda y, x: angle(longer(y), longer(x)),
        scaling=lambda number: xp.scaling(number.high),
        ldexp=ldexp,
        two_product=two_product,
        below_rounding=lambda larger, number: xp.below_rounding(
            high_and_low(larger)[0], high_and_low(number)[0]
        ),
        fixed=lambda number: number,
        integer=lambda number: xp.integer(high_and_low(number)[0]),
    )
