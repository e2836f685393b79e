"""Complex numbers as pairs of real ones: lengths and roots that keep their digits at any size."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import KernelFunction, Primitives


def brought_near_one(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, ...) ->`` the same, divided by a power of two near the largest.

    >>> from optipath.kernels.primitives import FLOAT
    >>> brought_near_one(FLOAT)(1.0, 6.0)
    (0.125, 0.75)
    """
    scaling, ldexp, maximum, inside = xp.scaling, xp.ldexp, xp.maximum, from_within(xp)

    def divided(*indices: Any) -> tuple[Any, ...]:
        exponent = scaling(reduce(maximum, indices))
        return tuple(ldexp(inside(index), -exponent) for index in indices)

    return divided


def from_within(xp: Primitives, power: int = 1) -> Callable[[Any], Any]:
    """Make ``number -> number`` for one that is not negative; for slopes, one just above 0 for 0.

    At grazing incidence, and without absorption, branches for exactly that have no slopes.
    """
    where, within = xp.where, xp.within**power
    if not within:
        return lambda number: number
    return lambda number: number + where(number > 0.0, 0.0, within)


_SMALL, _FAR = 2.0**-60, 2.0**100
"""What has a square that may vanish in float32, and what takes it back among the others."""

_VANISHING = 2.0**-500


def hypotenuse(xp: Primitives) -> Callable[[Any, Any], Any]:
    """Make ``(x, y) -> sqrt(x^2 + y^2)`` for x, y >= 0, the larger of at most 1e18.

    Below 1e-150 it is the larger, as it is where the other is much smaller.

    >>> from optipath.kernels.primitives import FLOAT
    >>> hypotenuse(FLOAT)(3e-140, 4e-140), hypotenuse(FLOAT)(1e-240, 0.0)
    (5e-140, 1e-240)
    """
    sqrt, where, maximum = xp.sqrt, xp.where, xp.maximum

    def length(x: Any, y: Any) -> Any:
        longer = maximum(x, y)
        small = longer < _SMALL
        x, y = where(small, _FAR * x, x), where(small, _FAR * y, y)
        squared = sqrt(x * x + y * y)
        # Where even these squares vanish, it is the longer side.
        near = where(longer < _VANISHING, longer, squared * (1.0 / _FAR))
        return where(small, near, squared)

    return length


def complex_root(xp: Primitives) -> Callable[[Any, Any, Any], tuple[Any, Any, Any]]:
    """Make ``(u, n, k) -> (a, b, |g|^2)`` with g = a + ib = sqrt(u + 2ink), a, b >= 0.

    The larger of a and b is a sum; the smaller is what ab = nk leaves for it.

    >>> from optipath.kernels.primitives import FLOAT
    >>> complex_root(FLOAT)(-3.0, 2.0, 1.0)[:2]
    (1.0, 2.0)
    """
    sqrt, where, absolute, length = xp.sqrt, xp.where, xp.absolute, hypotenuse(xp)

    def root(u: Any, n: Any, k: Any) -> tuple[Any, Any, Any]:
        size = absolute(u)
        squared = length(size, 2.0 * n * k)
        larger = sqrt(0.5 * (size + squared))
        # In this order, since n k may underflow.
        smaller = n / where(larger > 0.0, larger, 1.0) * k
        forward = u >= 0.0
        return where(forward, larger, smaller), where(forward, smaller, larger), squared

    return root
