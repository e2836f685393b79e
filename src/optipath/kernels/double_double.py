"""Numbers of twice the precision, each the unevaluated sum of two floats.

Dekker, Numer. Math. 18 (1971); Joldes, Muller & Popescu, ACM Trans. Math. Softw. 44
(2017), whose algorithms 6 and 11 are the sum and the product here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any, NoReturn

from optipath.kernels.primitives import Primitives


@dataclass(frozen=True, slots=True, eq=False)
class DoubleDouble:
    """high + low, where low is no more than the rounding of high.

    It takes the place of a float in a kernel; the plain numbers it is multiplied with there
    are powers of two, whose products are exact.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> third = 1.0 / DoubleDouble(FLOAT, 3.0)
    >>> abs((third + third + third - 1.0).high) < 1e-31
    True
    """

    xp: Primitives
    high: Any
    low: Any = 0.0

    def __add__(self, other: Any) -> DoubleDouble:
        high, low = _parts(other)
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
        if not isinstance(other, DoubleDouble):
            return self._of(self.high * other, self.low * other)
        product, rest = self.xp.two_product(self.high, other.high)
        rest = rest + (self.high * other.low + self.low * other.high)
        return self._of(*_quick_two_sum(product, rest))

    __rmul__ = __mul__

    def __truediv__(self, other: DoubleDouble) -> DoubleDouble:
        quotient = self.high / other.high
        rest = self - other * self._of(quotient)
        return self._of(*_quick_two_sum(quotient, rest.high / other.high))

    def __rtruediv__(self, other: float) -> DoubleDouble:
        return self._of(other) / self

    def __lt__(self, other: Any) -> Any:
        difference = self - other
        return difference.high < 0.0

    def __gt__(self, other: Any) -> Any:
        difference = self - other
        return difference.high > 0.0

    def __ge__(self, other: Any) -> Any:
        difference = self - other
        return difference.high >= 0.0

    def sqrt(self) -> DoubleDouble:
        """Return the square root of a number that is not negative."""
        root = self.xp.sqrt(self.high)
        rest = self - self._of(*self.xp.two_product(root, root))
        step = rest.high / self.xp.where(root > 0.0, 2.0 * root, 1.0)
        return self._of(*_quick_two_sum(root, step))

    def _of(self, high: Any, low: Any = 0.0) -> DoubleDouble:
        return DoubleDouble(self.xp, high, low)


def twice(xp: Primitives) -> Primitives:
    """Return primitives for numbers of twice the precision of those that `xp` is for."""

    def where(condition: Any, yes: Any, no: Any) -> DoubleDouble:
        pairs = zip(_parts(yes), _parts(no), strict=True)
        return DoubleDouble(xp, *(xp.where(condition, one, other) for one, other in pairs))

    def ldexp(number: DoubleDouble, exponent: Any) -> DoubleDouble:
        high, low = number.high, number.low
        return DoubleDouble(xp, xp.ldexp(high, exponent), xp.ldexp(low, exponent))

    return Primitives(
        where=where,
        sqrt=DoubleDouble.sqrt,
        absolute=lambda number: where(number < 0.0, -number, number),
        maximum=lambda one, other: where(one < other, other, one),
        minimum=lambda one, other: where(other < one, other, one),
        frexp=lambda number: (number, xp.frexp(number.high)[1]),
        ldexp=ldexp,
        fixed=lambda number: number,
        **dict[str, Any](
            (name, partial(_missing, name))
            for name in ("sin", "cos", "exp", "atan2", "two_product", "hidden")
        ),
    )


def _missing(name: str, *_: Any) -> NoReturn:
    raise NotImplementedError(f"{name} is not available in twice the precision")


def _parts(number: Any) -> tuple[Any, Any]:
    return (number.high, number.low) if isinstance(number, DoubleDouble) else (number, 0.0)


def _two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def _quick_two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    total = a + b
    return total, b - (total - a)
