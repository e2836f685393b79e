"""Vectors of three components, each a number of its own, and their lengths."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.vanishing import products

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


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
    """Return a . b.

    >>> dot((1.0, 2.0, 3.0), (1.0, 0.0, -1.0))
    -2.0
    """
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a cross b.

    >>> cross((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    (0.0, 0.0, 1.0)
    """
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

    >>> from optipath.kernels.primitives import FLOAT
    >>> common_size(FLOAT)(0.5, -3.0), common_size(FLOAT)(0.0, 0.0)
    (3.0, 1.0)
    """
    maximum, absolute, where, fixed = xp.maximum, xp.absolute, xp.where, xp.fixed

    def size(*numbers: Any) -> Any:
        largest = fixed(reduce(maximum, map(absolute, numbers)))
        return where(largest > 0.0, largest, 1.0)

    return size


def norm(xp: Primitives) -> Callable[..., Any]:
    """Make ``(x, ...) -> sqrt(x^2 + ...)``; its slope is 0 where all are 0.

    >>> from optipath.kernels.primitives import FLOAT
    >>> norm(FLOAT)(3.0, -4.0), norm(FLOAT)(0.0, 0.0), norm(FLOAT)(1e200, 0.0)
    (5.0, 0.0, 1e+200)
    """
    sqrt, where, size_of = xp.sqrt, xp.where, common_size(xp)

    def length(*numbers: Any) -> Any:
        size = size_of(*numbers)
        near_one = [number / size for number in numbers]
        square = products(*zip(near_one, near_one, strict=True))
        some = square > 0.0
        return where(some, size * sqrt(where(some, square, 1.0)), 0.0)

    return length
