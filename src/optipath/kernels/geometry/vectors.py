"""Vectors of three components, each a number of its own, so that kernels stay elementwise."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives

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

    Examples
    --------
    >>> dot((1.0, 2.0, 3.0), (1.0, 0.0, -1.0))
    -2.0
    """
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a cross b.

    Examples
    --------
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
