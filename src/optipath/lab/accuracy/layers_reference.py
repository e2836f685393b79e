"""The reference for stacks whose layers absorb: boundary after boundary added from the far side."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

from optipath.lab.accuracy.boundary_reference import (
    ExactBoundary,
    between,
    boundary,
    mueller_numbers,
    powers,
    refracted,
)
from optipath.lab.accuracy.many_digits import mpmath

if TYPE_CHECKING:
    from collections.abc import Sequence


def absorbing_stack(
    indices: Sequence[Any], depths: Sequence[Any], y: Any, *, way: bool
) -> list[list[Any]]:
    """Return the Mueller matrix of a stack of thick layers, of which some absorb."""
    faces = [_both_sides(*pair, y) for pair in pairwise(indices)]
    total = [(r, t) for r, t, _ in faces[-1]]
    for here, n, depth in reversed([*zip(faces[:-1], indices[1:-1], depths, strict=True)]):
        left = mpmath.exp(-depth * mpmath.sqrt(n * n - y * y).imag) if n.imag else 1
        total = [
            _added(r, t, up, left**2 * below, left * through)
            for (r, t, up), (below, through) in zip(here, total, strict=True)
        ]
    A, B, C, S = mueller_numbers(*(pair[0] if way else pair[1] for pair in total))
    return [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]


def _both_sides(first: Any, second: Any, y: Any) -> list[tuple[Any, Any, Any]]:
    """Return what is reflected, and let through from in front and from behind, of each part."""
    front, behind = _lit(first, second, y), _lit(second, first, y)
    numbers = front.reflected, front.transmitted, behind.transmitted
    return list(zip(*map(powers, numbers), strict=True))


def _added(r: Any, t: Any, up: Any, below: Any, through: Any) -> tuple[Any, Any]:
    """Return what is reflected and let through of a boundary with others below it."""
    if not t:
        return r, t
    rounds = 1 / (1 - r * below)
    return r + t * up * below * rounds, t * through * rounds


def _lit(first: Any, second: Any, y: Any) -> ExactBoundary:
    if first.imag:
        return between(first, second, y)
    return boundary(second / first.real, *refracted(1 / first.real, y))
