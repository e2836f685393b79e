"""Sine, cosine and arc tangent in operations that every engine does alike.

Libraries take sines one by one, most of the time of a path. The coefficients are those of fdlibm
(Sun Microsystems, 1993, ``k_sin.c``, ``k_cos.c``), and of the Cephes library (Moshier, Methods and
Programs for Mathematical Functions, 1989, ``atan.c``); errors are below 2 units in the last place.

Right angles: pi/2 has no exact float, and cos(pi/2) is 6e-17, the rounding of the angle itself, by
which a filter at 90 degrees would let the wrong component through. What vanishes when it
is added to the angle is taken as 0, but for angles so huge that their rounding is no
longer small.
"""

from __future__ import annotations

import math
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


SinCos = tuple[Any, Any]


class Digits(NamedTuple):
    """What sines of one precision are made of."""

    most: float
    rounding: float
    right: tuple[float, ...]
    right_high: float
    right_low: float
    sine: tuple[float, ...]
    cosine: tuple[float, ...]


_SINE = (
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
)
_COSINE = (
    4.16666666666666019037e-02,
    -1.38888888888741095749e-03,
    2.48015872894767294178e-05,
    -2.75573143513906633035e-07,
    2.08757232129817482790e-09,
    -1.13596475577881948265e-11,
)
DIGITS = {
    "float64": Digits(
        most=1e5,
        rounding=1.5 * 2.0**52,
        right=(1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21),
        right_high=1.5707963267948966,
        right_low=6.123233995736766e-17,
        sine=_SINE,
        cosine=_COSINE,
    ),
    "float32": Digits(
        most=5e3,
        rounding=1.5 * 2.0**23,
        right=(1.5703125, 0.0004837512969970703, 7.549533620476723e-08, 2.563344151594519e-12),
        right_high=1.5707963705062866,
        right_low=-4.371138828673793e-08,
        sine=_SINE[:4],
        cosine=_COSINE[:4],
    ),
}


def from_axes(xp: Primitives, digits: Digits) -> Callable[[Any], Any]:
    """Make ``angle -> left``: the angle less the nearest right angles, 0 if that is rounding."""
    return without_rounding(xp, lambda angle: _quarters(digits)(angle)[1])


def from_nearer_axis(xp: Primitives, digits: Digits) -> Callable[[Any], Any]:
    """Make ``angle -> left`` for angles in 0 .. pi/2: the angle, or pi/2 less it; 0 if rounding."""
    maximum, minimum = xp.maximum, xp.minimum

    def left(angle: Any) -> Any:
        # Exact; of the angle next to pi/2 there is nothing left.
        apart = digits.right_high - angle
        return minimum(angle, maximum(apart + minimum(apart, digits.right_low), 0.0))

    return left


def any_quadrant(xp: Primitives, digits: Digits) -> Callable[..., SinCos]:
    """Make ``(angle, [left]) -> (sin, cos)`` of an angle of at most `digits.most` in size.

    Of an angle that was given in more digits, ``left`` is that of `from_axes` in these.
    """
    where, absolute, near_zero = xp.where, xp.absolute, _near_zero(digits)
    quarters, rounded = _quarters(digits), _rounded(digits)

    def sine_cosine(angle: Any, left: Any = None) -> SinCos:
        turns, reduced = quarters(angle) if left is None else (rounded(angle - left), left)
        sine, cosine = near_zero(reduced)
        # The quadrant, -2 and 2 being the same.
        quadrant = turns - 4.0 * (turns * 0.25 + digits.rounding - digits.rounding)
        odd = absolute(quadrant) == 1.0
        sine_sign = where(absolute(quadrant - 0.5) > 1.0, -1.0, 1.0)
        cosine_sign = where(absolute(quadrant + 0.5) > 1.0, -1.0, 1.0)
        return sine_sign * where(odd, cosine, sine), cosine_sign * where(odd, sine, cosine)

    return sine_cosine


def first_quadrant(xp: Primitives, digits: Digits) -> Callable[..., SinCos]:
    """Make ``(angle, [left]) -> (sin, cos)`` of an angle within 0 .. pi/2.

    The cosine is 0 where the angle may be a right one. Of an angle that was given in more digits,
    ``left`` is that of `from_nearer_axis` in these.
    """
    where, near_zero, reduced = xp.where, _near_zero(digits), from_nearer_axis(xp, digits)

    def sine_cosine(angle: Any, left: Any = None) -> SinCos:
        left = reduced(angle) if left is None else left
        far = angle > left
        sine, cosine = near_zero(left)
        return where(far, cosine, sine), where(far, sine, cosine)

    return sine_cosine


def _rounded(digits: Digits) -> Callable[[Any], Any]:
    """Make ``angle -> turns``, the nearest number of right angles."""
    return lambda angle: angle * (1.0 / digits.right_high) + digits.rounding - digits.rounding


def _quarters(digits: Digits) -> Callable[[Any], tuple[Any, Any]]:
    rounded, parts = _rounded(digits), digits.right

    def quarters(angle: Any) -> tuple[Any, Any]:
        """Return the nearest number of right angles, and what is left without them."""
        turns, left = rounded(angle), angle
        # Each part is taken away without error but for the last.
        for part in parts:
            left = left - turns * part
        return turns, left

    return quarters


def _near_zero(digits: Digits) -> Callable[[Any], SinCos]:
    def polynomial(x: Any, coefficients: Any) -> Any:
        return reduce(lambda total, other: total * x + other, reversed(coefficients))

    def sine_cosine(x: Any) -> SinCos:
        """Return sine and cosine of x within -pi/4 .. pi/4."""
        square = x * x
        sine = square * x * polynomial(square, digits.sine) + x
        fourth = square * square
        cosine = 1.0 - (0.5 * square - fourth * polynomial(square, digits.cosine))
        return sine, cosine

    return sine_cosine


def cosine(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``cos``, 0 at the odd multiples of pi/2."""
    return without_rounding(xp, xp.cos)


def sine(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``sin``, 0 at the multiples of pi."""
    return without_rounding(xp, xp.sin)


def without_rounding(xp: Primitives, function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Make a sine or cosine that is 0 where the angle cannot tell it from 0."""
    where, below_rounding, fixed = xp.where, xp.below_rounding, xp.fixed

    def rounded(angle: Any) -> Any:
        value = function(angle)
        # The value is taken away from itself, not replaced, so that its slope stays.
        return value - where(below_rounding(angle, value), fixed(value), 0.0)

    return rounded


_ABOVE = (
    -8.750608600031904122785e-1,
    -1.615753718733365076637e1,
    -7.500855792314704667340e1,
    -1.228866684490136173410e2,
    -6.485021904942025371773e1,
)
_BELOW = (
    1.0,
    2.485846490142306297962e1,
    1.650270098316988542046e2,
    4.328810604912902668951e2,
    4.853903996359136964868e2,
    1.945506571482613964425e2,
)
_EIGHTH = math.tan(math.pi / 8.0)
_RIGHT_LOW = 6.123233995736766e-17
"""What pi / 2 is more than its float."""


def arc_tangent(xp: Primitives) -> Callable[[Any, Any], Any]:
    """Make ``(y, x) -> angle`` of a point, within -pi .. pi; that of the origin is 0."""
    where, absolute = xp.where, xp.absolute
    maximum, minimum = xp.maximum, xp.minimum

    def angle(y: Any, x: Any) -> Any:
        up, along = absolute(y), absolute(x)
        longer, shorter = maximum(up, along), minimum(up, along)
        # One quotient, of what is left beside 0 or beside pi / 4.
        far = shorter > _EIGHTH * longer
        above, below = where(far, shorter - longer, shorter), where(far, shorter + longer, longer)
        t = above / where(below > 0.0, below, 1.0)
        square = t * t
        over, under = (
            reduce(lambda total, other: total * square + other, parts[1:], parts[0])
            for parts in (_ABOVE, _BELOW)
        )
        small = t * (square * over / under)
        first = where(far, 0.25 * math.pi + (small + 0.5 * _RIGHT_LOW + t), small + t)
        first = where(up > along, 0.5 * math.pi - (first - _RIGHT_LOW), first)
        first = where(x < 0.0, math.pi - (first - 2.0 * _RIGHT_LOW), first)
        return where(y < 0.0, -first, first)

    return angle
