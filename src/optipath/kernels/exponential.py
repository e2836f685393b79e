"""Exponential, hyperbolic and error functions in operations that every engine does alike.

The coefficients are those of fdlibm (Sun Microsystems, 1993, ``e_exp.c``); errors are below 1 unit
in the last place. Only sums, products, quotients and roots are used, which all libraries round
alike, unlike sines, exponentials and fused products.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache, reduce
from math import exp, pi
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.kernels.primitives import NUMPY, Primitives, is_below_rounding, total
from optipath.kernels.trigonometry import DIGITS, any_quadrant, arc_tangent

if TYPE_CHECKING:
    from collections.abc import Callable


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
    """Make ``exp``, infinite and 0 where that is beyond floats."""
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


_SINE = (1.0, 6.0, 20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0, 342.0)
"""By what each term of the sine's series is less than the one before, up to x^19."""


def scaled_hyperbolic(xp: Primitives) -> Callable[[Any, Any], tuple[Any, Any]]:
    """Make ``(x, shift) -> (cosh x exp(-shift), sinh x exp(-shift))`` for |x| <= shift.

    |x| above shift by a rounding is taken as shift; its slope stays.
    """
    exp, where, absolute, fixed = xp.exp, xp.where, xp.absolute, xp.fixed

    def at_most_one(exponent: Any) -> Any:
        return exp(exponent - where(exponent > 0.0, fixed(exponent), 0.0))

    def hyperbolic(x: Any, shift: Any) -> tuple[Any, Any]:
        growing, falling = at_most_one(x - shift), at_most_one(-x - shift)
        small = absolute(x) < 1.0
        near = where(small, x, 0.0)
        square, series = near * near, 1.0
        for divisor in _SINE[:0:-1]:
            series = 1.0 + square * series / divisor
        sine = where(small, near * series * exp(-shift), 0.5 * (growing - falling))
        return 0.5 * (growing + falling), sine

    return hyperbolic


_STEP = 0.5
_TERMS = 13
"""The step between nodes, off by exp(-(pi / step)^2), and the number of nodes of more weight."""

_NODES = [(_STEP * (i + 0.5)) ** 2 for i in range(_TERMS)]
_WEIGHTS = {node: 2.0 * _STEP / pi * exp(-node) for node in _NODES}


def complementary_error(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``erfc`` for x from 0 to 50, to 4e-16 of 1.

    The midpoint rule for its integral of exp(-t^2) / (t^2 + x^2), which converges faster than any
    power, and the residue that it leaves (D. B. Hunter and T. Regan, Math. Comp. 26, 539 (1972)):
    nothing is subtracted.
    """
    exponential = xp.exp

    def erfc(x: Any) -> Any:
        square = x * x
        series = total([weight / (node + square) for node, weight in _WEIGHTS.items()])
        residue = exponential(-2.0 * pi / _STEP * x)
        return x * exponential(-square) * series + 2.0 * residue / (1.0 + residue)

    return erfc


_OF_PLAIN_NUMBERS = "where", "sqrt", "absolute", "maximum", "minimum", "ldexp", "two_product"


def reproducible(
    xp: Primitives, dtype: str, small_enough: Callable[[Any], Any] | None = None
) -> Primitives:
    """Return primitives whose elementary functions are made of the others."""
    in_precision: dict[str, Any]
    in_precision = {name: _in_precision(getattr(xp, name), dtype) for name in _OF_PLAIN_NUMBERS}
    xp = replace(xp, below_rounding=is_below_rounding, **in_precision)
    digits, where = DIGITS[dtype], xp.where
    polynomials = any_quadrant(xp, digits)
    small = small_enough or (lambda angle: abs(angle) <= digits.most)

    def circular(place: int, plain: Callable[..., Any]) -> Callable[[Any], Any]:
        def value(angle: Any) -> Any:
            if np.iscomplexobj(angle):
                return plain(angle)
            known = small(angle)
            if np.all(known):
                return polynomials(angle)[place]
            near = polynomials(where(known, angle, 0.0))[place]
            return where(known, near, _where_large(plain, angle, np.logical_not(known)))

        return value

    exp = exponential(xp, dtype)
    return replace(
        xp,
        sin=circular(0, np.sin),
        cos=circular(1, np.cos),
        exp=lambda x: np.exp(x) if np.iscomplexobj(x) else exp(x),
        atan2=arc_tangent(xp),
    )


@cache
def reproducible_numpy(dtype: str) -> Primitives:
    """Return primitives of NumPy whose elementary functions every engine does alike."""
    return reproducible(NUMPY, dtype)


def _where_large(plain: Callable[..., Any], angles: Any, large: Any) -> Any:
    """Return a function of some angles in a row, as which NumPy does each alike, else 0."""
    numbers = np.asarray(angles)
    result = np.zeros_like(numbers)
    result[large] = plain(numbers[large].astype(np.float64))
    return result


def _in_precision(function: Callable[..., Any], dtype: str) -> Callable[..., Any]:
    """Return a function that takes plain numbers in the precision of a plan."""
    if dtype == "float64":
        return function
    kind = np.dtype(dtype).type
    return lambda *numbers: function(*[kind(n) if type(n) is float else n for n in numbers])
