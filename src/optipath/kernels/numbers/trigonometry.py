"""Sine and cosine as polynomials, in the operations that every engine does many at a time.

The libraries that engines stand on take sines one after the other; that alone was most of
the time of a path. The coefficients are those of fdlibm (Sun Microsystems, 1993, ``k_sin.c``,
``k_cos.c``); errors are below 2 units in the last place.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.numbers.circular import without_rounding

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives

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
    """Make ``angle -> left``: what is left of an angle when the nearest right angles are taken off.

    It is 0 where the angle cannot tell itself from a multiple of a right one.

    Examples
    --------
    >>> import math
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> left = from_axes(FLOAT, DIGITS["float64"])
    >>> left(math.pi + 0.25), left(math.pi), left(math.nextafter(math.pi, 4.0))
    (0.2499999999999999, 0.0, 3.216245299353273e-16)
    """
    return without_rounding(xp, lambda angle: _quarters(digits)(angle)[1])


def from_nearer_axis(xp: Primitives, digits: Digits) -> Callable[[Any], Any]:
    """Make ``angle -> left`` for angles within 0 .. pi/2: the angle, or what pi/2 is more than it.

    It is 0 where the angle cannot tell itself from a right one.

    Examples
    --------
    >>> import math
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> left = from_nearer_axis(FLOAT, DIGITS["float64"])
    >>> left(0.5), left(math.nextafter(math.pi / 2, 0.0)), left(math.pi / 2)
    (0.5, 2.83276944882399e-16, 0.0)
    """
    maximum, minimum = xp.maximum, xp.minimum

    def left(angle: Any) -> Any:
        # Exact; of the angle next to pi/2 there is nothing left.
        apart = digits.right_high - angle
        return minimum(angle, maximum(apart + minimum(apart, digits.right_low), 0.0))

    return left


def any_quadrant(xp: Primitives, digits: Digits) -> Callable[..., SinCos]:
    """Make ``(angle, [left]) -> (sin, cos)`` of an angle of at most `digits.most` in size.

    Of an angle that has been given in more digits, `from_axes` in its own gives what is left.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> any_quadrant(FLOAT, DIGITS["float64"])(2.5)
    (0.5984721441039564, -0.8011436155469337)
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

    The cosine is 0 where the angle cannot tell itself from a right one. Of an angle that has
    been given in more digits, `from_nearer_axis` in its own gives what is left.

    Examples
    --------
    >>> import math
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> sine_cosine = first_quadrant(FLOAT, DIGITS["float64"])
    >>> sine_cosine(1.2), sine_cosine(math.pi / 2)
    ((0.9320390859672263, 0.3623577544766736), (1.0, 0.0))
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
        total = coefficients[-1]
        for other in coefficients[-2::-1]:
            total = total * x + other
        return total

    def sine_cosine(x: Any) -> SinCos:
        """Return sine and cosine of x within -pi/4 .. pi/4."""
        square = x * x
        sine = square * x * polynomial(square, digits.sine) + x
        fourth = square * square
        cosine = 1.0 - (0.5 * square - fourth * polynomial(square, digits.cosine))
        return sine, cosine

    return sine_cosine
