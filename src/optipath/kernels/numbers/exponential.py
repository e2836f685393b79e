"""The exponential function in the operations that every engine does alike.

The coefficients are those of fdlibm (Sun Microsystems, 1993, ``e_exp.c``); errors are below
1 unit in the last place.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives


class _Digits(NamedTuple):
    """What exponentials of one precision are made of: ln 2 in two parts, and where they end."""

    high: float
    low: float
    rounding: float
    least: float
    most: float


_DIGITS = {
    "float64": _Digits(
        6.93147180369123816490e-01, 1.90821492927058770002e-10, 1.5 * 2.0**52, -760.0, 720.0
    ),
    "float32": _Digits(0.693359375, -2.12194440054690583e-4, 1.5 * 2.0**23, -120.0, 95.0),
}
_ONE_OVER_LN2 = 1.44269504088896338700
_SERIES = (
    1.66666666666666019037e-01,
    -2.77777777770155933842e-03,
    6.61375632143793436117e-05,
    -1.65339022054652515390e-06,
    4.13813679705723846039e-08,
)


def exponential(xp: Primitives, dtype: str) -> Callable[[Any], Any]:
    """Make ``exp``, infinite and 0 where that is beyond floats.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> exp = exponential(FLOAT, "float64")
    >>> exp(-0.5), exp(0.0), exp(-1000.0)
    (0.6065306597126334, 1.0, 0.0)
    """
    where, ldexp, integer = xp.where, xp.ldexp, xp.integer
    digits = _DIGITS[dtype]

    def exp(x: Any) -> Any:
        # Asked so that NaN stays NaN.
        x = where(x > digits.most, digits.most, where(x < digits.least, digits.least, x))
        power = x * _ONE_OVER_LN2 + digits.rounding - digits.rounding
        high, low = x - power * digits.high, power * digits.low
        rest = high - low
        square = rest * rest
        highest, *others = reversed(_SERIES)
        series = reduce(lambda total, other: total * square + other, others, highest)
        c = rest - square * series
        return ldexp(1.0 - ((low - rest * c / (2.0 - c)) - high), integer(power))

    return exp
