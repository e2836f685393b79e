"""Numbers of twice the precision, each the unevaluated sum of two floats.

Dekker, Numer. Math. 18 (1971); Joldes, Muller & Popescu, ACM Trans. Math. Softw. 44
(2017), whose algorithms 6 and 11 are the sum and the product here.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import frexp
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from fractions import Fraction

    from optipath.kernels.numbers.primitives import Primitives

_ALIKE = 2.0**-102
"""By what share two numbers may differ that are the same to all digits that they have."""


@dataclass(frozen=True, slots=True, eq=False)
class DoubleDouble:
    """high + low, where low is no more than the rounding of high.

    It takes the place of a float in a kernel. Two that are the same to all digits that they
    have are equal.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> third = 1.0 / DoubleDouble(FLOAT, 3.0)
    >>> abs((third + third + third - 1.0).high) < 1e-31
    True
    """

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
        if not isinstance(other, DoubleDouble):
            other = self._of(other)
        product, rest = self.xp.two_product(self.high, other.high)
        rest = rest + (self.high * other.low + self.low * other.high)
        return self._of(*_quick_two_sum(product, rest))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> DoubleDouble:
        if not isinstance(other, DoubleDouble):
            other = self._of(other)
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
