"""Numbers of many digits: mpmath, exact floats, exact right angles, and kernels in them."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.extras import needing
from optipath.kernels.numbers.primitives import Primitives

with needing("50-digit references"):
    import mpmath

DIGITS = 50
WORKING_DIGITS = 2 * DIGITS
_HUGE = 1e9


def exactly(number: Any) -> Any:
    """Return a float of any precision as a number of many digits.

    Examples
    --------
    >>> with mpmath.workdps(30):
    ...     print(exactly(np.float64(0.1)))
    0.100000000000000005551115123126
    """
    if np.isinf(number):
        return mpmath.mpf(float(number))
    mantissa, exponent = np.frexp(number)
    high = float(mantissa)
    rest = float(mantissa - type(mantissa)(high))
    return mpmath.ldexp(mpmath.mpf(high) + mpmath.mpf(rest), int(exponent))


def exact_angle(angle: float) -> Any:
    """Return an angle; the float nearest to a multiple of 45 degrees is that multiple.

    To the digits that mpmath works with.

    Examples
    --------
    >>> with mpmath.workdps(WORKING_DIGITS):
    ...     bool(abs(mpmath.cos(exact_angle(np.pi / 2))) < 1e-99)
    True
    """
    eighth = +mpmath.pi / 4
    multiple = mpmath.nint(mpmath.mpf(angle) / eighth) * eighth
    # Of angles so huge that their rounding is a turn, every one is nearest to some multiple.
    near = float(multiple) == angle and abs(angle) < _HUGE
    return multiple if near else mpmath.mpf(angle)


def cos_sin(angle: Any) -> tuple[Any, Any]:
    """Return the cosine and the sine; what is less than the working precision is 0.

    Examples
    --------
    >>> cos_sin(exact_angle(np.pi / 2))
    (mpf('0.0'), mpf('1.0'))
    """
    least = mpmath.mpf(10) ** -(mpmath.mp.dps - 5)
    c, s = mpmath.cos(angle), mpmath.sin(angle)
    if abs(c) < least:
        return mpmath.mpf(0), mpmath.sign(s)
    return (mpmath.sign(c), mpmath.mpf(0)) if abs(s) < least else (c, s)


_OF_ONE_NAME = ("sqrt", "sin", "cos", "exp", "atan2", "ldexp")

MANY_DIGITS = Primitives(
    **{name: getattr(mpmath, name) for name in _OF_ONE_NAME},
    where=lambda condition, yes, no: yes if condition else no,
    absolute=abs,
    scaling=lambda number: mpmath.frexp(number)[1],
    maximum=max,
    minimum=min,
    two_product=lambda a, b: (a * b, mpmath.mpf(0)),
    below_rounding=lambda larger, number: float(larger) + float(number) == float(larger),
    fixed=lambda value: value,
)
"""For elements of one's own, whose formulas are the only ones there are."""

__all__ = ["DIGITS", "MANY_DIGITS", "WORKING_DIGITS", "cos_sin", "exact_angle", "exactly", "mpmath"]
