"""Sine, cosine, exponential and arc tangent in twice the precision, by their series.

Angles and exponents are brought next to 0 by multiples of pi/2 and of ln 2, which are known to
four and three floats (Cody & Waite, Software Manual for the Elementary Functions, 1980).
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from math import factorial
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.numbers.double_double import DoubleDouble

if TYPE_CHECKING:
    from collections.abc import Sequence

_TERMS = 28
"""How many terms of a series make all digits, next to 0."""

_HUGE = 2.0**52
"""From where on an angle is not known to a right angle."""

_RIGHT = Fraction(
    "1.570796326794896619231321691639751442098584699687552910487472296153908203143104499314017"
)
_LN2 = Fraction(
    "0.693147180559945309417232121458176568075500134360255254120680009493393621969694715605863"
)


def _in_floats(number: Fraction, count: int) -> tuple[float, ...]:
    found: list[float] = []
    for _ in range(count):
        found.append(float(number))
        number -= Fraction(found[-1])
    return tuple(found)


_RIGHT_PARTS, _LN2_PARTS = _in_floats(_RIGHT, 4), _in_floats(_LN2, 3)
_ONE_OVER = tuple(Fraction(1, factorial(n)) for n in range(_TERMS))
_SIGNED = tuple(share * (-1) ** (n // 2) for n, share in enumerate(_ONE_OVER))


def sine(angle: DoubleDouble) -> DoubleDouble:
    """Return the sine of an angle.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> float((sine(DoubleDouble(FLOAT, 0.5)) - 0.479425538604203).high)
    -5.103969860556012e-18
    """
    return _circular(angle, 0)


def cosine(angle: DoubleDouble) -> DoubleDouble:
    """Return the cosine of an angle."""
    return _circular(angle, 1)


def _circular(angle: DoubleDouble, quarter: int) -> DoubleDouble:
    """Return the sine of an angle and some right angles."""
    known = abs(angle.high) < _HUGE
    parts = (np.where(known, part, 0.0)[()] for part in (angle.high, angle.low))
    turns, small = _near_zero(DoubleDouble(angle.xp, *parts), _RIGHT_PARTS)
    square = small * small
    sin, cos = small * _series(_SIGNED[1::2], square), _series(_SIGNED[::2], square)
    turns = np.remainder(turns + quarter, 4.0)
    odd, back = np.remainder(turns, 2.0) == 1.0, turns >= 2.0
    plain = (np.sin, np.cos)[quarter](angle.high)
    found = []
    for one, other, rough in ((sin.high, cos.high, plain), (sin.low, cos.low, 0.0 * plain)):
        part = np.where(odd, other, one)
        found.append(np.where(known, np.where(back, -part, part), rough)[()])
    return DoubleDouble(angle.xp, *found)


def exponential(number: DoubleDouble) -> DoubleDouble:
    """Return e to the power of a number.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> float((exponential(DoubleDouble(FLOAT, 1.0)) - 2.718281828459045).high)
    1.4456468917292502e-16
    """
    # Beyond, it is 0 or infinite in any case.
    high = np.clip(number.high, -1e4, 1e4)
    power, small = _near_zero(DoubleDouble(number.xp, high, number.low), _LN2_PARTS)
    found, power = _series(_ONE_OVER, small), power.astype(int)
    return DoubleDouble(number.xp, np.ldexp(found.high, power), np.ldexp(found.low, power))


def angle(y: DoubleDouble, x: DoubleDouble) -> DoubleDouble:
    """Return the angle of a point, by one step from where floats have it.

    Units: the result in radians.
    """
    near = DoubleDouble(y.xp, np.arctan2(y.high, x.high))
    s, c = sine(near), cosine(near)
    along = x * c + y * s
    return near + (y * c - x * s) / DoubleDouble(y.xp, np.where(along.high == 0.0, 1.0, along.high))


def _near_zero(number: DoubleDouble, parts: Sequence[float]) -> tuple[Any, DoubleDouble]:
    """Return how many times something fits into a number, and what is left."""
    count, left = _rest(number, parts)
    # Of large numbers the quotient is rounded, and what is left may be more than half.
    more, left = _rest(left, parts)
    return count + more, left


def _rest(number: DoubleDouble, parts: Sequence[float]) -> tuple[Any, DoubleDouble]:
    count = np.rint(number.high / parts[0])
    times = DoubleDouble(number.xp, count)
    return count, reduce(lambda left, part: left - times * part, parts, number)


def _series(shares: Sequence[Fraction], x: DoubleDouble) -> DoubleDouble:
    last, *others = (DoubleDouble.nearest(x.xp, share) for share in reversed(shares))
    return reduce(lambda sum_so_far, share: sum_so_far * x + share, others, last)
