"""Vectors and complex numbers as plain components, and their lengths."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.primitives import products

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import KernelFunction, Primitives


Vector: TypeAlias = tuple[Any, Any, Any]


def plus(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def times(number: Any, a: Vector) -> Vector:
    """Return a number times a vector."""
    return number * a[0], number * a[1], number * a[2]


def dot(a: Vector, b: Vector) -> Any:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a cross b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def choice(xp: Primitives) -> Callable[[Any, Vector, Vector], Vector]:
    """Make ``(condition, yes, no) -> vector``."""
    where = xp.where

    def chosen(condition: Any, yes: Vector, no: Vector) -> Vector:
        x, y, z = (where(condition, a, b) for a, b in zip(yes, no, strict=True))
        return x, y, z

    return chosen


def common_size(xp: Primitives) -> Callable[..., Any]:
    """Make ``(x, ...) ->`` the largest absolute value, without a slope, or 1 where all are 0.

    What is divided by it has squares that neither vanish nor are too large.
    """
    maximum, absolute, where, fixed = xp.maximum, xp.absolute, xp.where, xp.fixed

    def size(*numbers: Any) -> Any:
        largest = fixed(reduce(maximum, map(absolute, numbers)))
        return where(largest > 0.0, largest, 1.0)

    return size


def norm(xp: Primitives) -> Callable[..., Any]:
    """Make ``(x, ...) -> sqrt(x^2 + ...)``; its slope is 0 where all are 0."""
    sqrt, where, size_of = xp.sqrt, xp.where, common_size(xp)

    def length(*numbers: Any) -> Any:
        size = size_of(*numbers)
        near_one = [number / size for number in numbers]
        square = products(*zip(near_one, near_one, strict=True))
        some = square > 0.0
        return where(some, size * sqrt(where(some, square, 1.0)), 0.0)

    return length


def brought_near_one(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, ...) ->`` the same, divided by a power of two near the largest."""
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
