"""Double-double arithmetic: numbers of twice the precision, and kernels computed in them.

Dekker, Numer. Math. 18 (1971); Joldes, Muller & Popescu, ACM Trans. Math. Softw. 44 (2017),
algorithms 6 (sum) and 11 (product). Angles and exponents are reduced by multiples of pi/2 and ln 2
in four and three floats (Cody & Waite, Software Manual for the Elementary Functions, 1980).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache, reduce
from math import factorial, frexp
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.kernels.primitives import Primitives

if TYPE_CHECKING:
    from collections.abc import Sequence


_ALIKE = 2.0**-102
"""By what share two numbers may differ that are the same to all digits that they have."""


@dataclass(frozen=True, slots=True, eq=False)
class DoubleDouble:
    """high + low, where low is no more than the rounding of high; in kernels, like a float."""

    xp: Primitives
    high: Any
    low: Any = 0.0

    __array_ufunc__: ClassVar[None] = None  # So that NumPy's numbers leave operators to this class.
    __hash__: ClassVar[None] = None  # type: ignore[assignment]

    @classmethod
    def nearest(cls, xp: Primitives, number: Fraction) -> DoubleDouble:
        """Return the number nearest to a fraction."""
        high = float(number)
        return cls(xp, high, float(number - type(number)(high)))

    def __add__(self, other: Any) -> DoubleDouble:
        high, low = high_and_low(other)
        total, rest = _two_sum(self.high, high)
        small, smaller = _two_sum(self.low, low)
        total, rest = _quick_two_sum(total, rest + small)
        return self._of(*_quick_two_sum(total, rest + smaller))

    __radd__ = __add__

    def __neg__(self) -> DoubleDouble:
        return self._of(-self.high, -self.low)

    def __sub__(self, other: Any) -> DoubleDouble:
        return self.__add__(-other)

    def __rsub__(self, other: Any) -> DoubleDouble:
        return self.__neg__().__add__(other)

    def __mul__(self, other: Any) -> DoubleDouble:
        if _is_power_of_two(other):
            return self._of(self.high * other, self.low * other)
        high, low = high_and_low(other)
        product, rest = self.xp.two_product(self.high, high)
        rest = rest + (self.high * low + self.low * high)
        return self._of(*_quick_two_sum(product, rest))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> DoubleDouble:
        other = self._of(*high_and_low(other))
        quotient = self.high / other.high
        rest = self - other * self._of(quotient)
        return self._of(*_quick_two_sum(quotient, rest.high / other.high))

    def __rtruediv__(self, other: float) -> DoubleDouble:
        return self._of(other) / self

    def __eq__(self, other: object) -> Any:
        return abs((self - other).high) <= _ALIKE * abs(self.high)

    def __lt__(self, other: Any) -> Any:
        return (self - other).high < 0.0

    def __gt__(self, other: Any) -> Any:
        return (self - other).high > 0.0

    def __ge__(self, other: Any) -> Any:
        return (self - other).high >= 0.0

    def __le__(self, other: Any) -> Any:
        return (self - other).high <= 0.0

    def sqrt(self) -> DoubleDouble:
        """Return the square root of a number that is not negative."""
        root = self.xp.sqrt(self.high)
        rest = self - self._of(*self.xp.two_product(root, root))
        step = rest.high / self.xp.where(root > 0.0, 2.0 * root, 1.0)
        return self._of(*_quick_two_sum(root, step))

    def _of(self, high: Any, low: Any = 0.0) -> DoubleDouble:
        return DoubleDouble(self.xp, high, low)


def _is_power_of_two(number: Any) -> bool:
    return isinstance(number, (int, float)) and abs(frexp(number)[0]) in (0.0, 0.5)


def high_and_low(number: Any) -> tuple[Any, Any]:
    """Return a number and its rest, which a plain one does not have."""
    return (number.high, number.low) if isinstance(number, DoubleDouble) else (number, 0.0)


def _two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def _quick_two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    total = a + b
    return total, b - (total - a)


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
    results: list[float] = []
    for _ in range(count):
        results.append(float(number))
        number -= Fraction(results[-1])
    return tuple(results)


_RIGHT_PARTS, _LN2_PARTS = _in_floats(_RIGHT, 4), _in_floats(_LN2, 3)
_ONE_OVER = tuple(Fraction(1, factorial(n)) for n in range(_TERMS))
_SIGNED = tuple(share * (-1) ** (n // 2) for n, share in enumerate(_ONE_OVER))


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
    results = []
    for one, other, rough in ((sin.high, cos.high, plain), (sin.low, cos.low, 0.0 * plain)):
        part = np.where(odd, other, one)
        results.append(np.where(known, np.where(back, -part, part), rough)[()])
    return DoubleDouble(angle.xp, *results)


def exponential(number: DoubleDouble) -> DoubleDouble:
    """Return e to the power of a number."""
    # Beyond, it is 0 or infinite in any case.
    high = np.clip(number.high, -1e4, 1e4)
    power, small = _near_zero(DoubleDouble(number.xp, high, number.low), _LN2_PARTS)
    result, power = _series(_ONE_OVER, small), power.astype(int)
    return DoubleDouble(number.xp, np.ldexp(result.high, power), np.ldexp(result.low, power))


def angle(y: DoubleDouble, x: DoubleDouble) -> DoubleDouble:
    """Return the angle of a point, in rad, by one step from where floats have it."""
    near = DoubleDouble(y.xp, np.arctan2(y.high, x.high))
    s, c = _circular(near, 0), _circular(near, 1)
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


@cache
def twice(xp: Primitives) -> Primitives:
    """Return primitives for numbers of twice the precision of those that `xp` is for."""

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
        sin=lambda angle: _circular(longer(angle), 0),
        cos=lambda angle: _circular(longer(angle), 1),
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
