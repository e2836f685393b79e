"""The turn of a reference frame about the direction of travel."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any

from optipath.kernels.numbers.circular import cosine, sine

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def turn(xp: Primitives) -> KernelFunction:
    """Make ``(angle, ...) -> (cos 2a, sin 2a)``, for one angle or several turns in a row."""
    sin, cos = sine(xp), cosine(xp)

    def turned(*angles: Any) -> tuple[Any, Any]:
        twice = 2.0 * reduce(add, angles)
        return cos(twice), sin(twice)

    return turned


def turn_back(xp: Primitives) -> KernelFunction:
    """Make ``(angle,) -> (cos 2a, -sin 2a)``, the turn undone."""
    turned = turn(xp)

    def turned_back(angle: Any) -> tuple[Any, Any]:
        c, s = turned(angle)
        return c, -s

    return turned_back


def align(xp: Primitives) -> KernelFunction:
    """Make ``(d, e) -> (cos 2a, sin 2a)`` for d = x . x' and e = z . (x cross x').

    No angle is formed: (d - e)(d + e) and 2 d e over d^2 + e^2.
    """
    del xp

    def aligned(d: Any, e: Any) -> tuple[Any, Any]:
        norm = d * d + e * e
        return (d - e) * (d + e) / norm, 2.0 * d * e / norm

    return aligned
