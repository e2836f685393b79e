"""Light along a chain of vertices: its legs, and the angles of incidence between them.

A chain is the point where light starts, one for each specular reflection, and the point
where it ends. The surface at a vertex is perpendicular to the bisector of its two legs.
"""

from __future__ import annotations

from itertools import pairwise
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.geometry.vectors import Vector, choice, dot, minus, plus, times

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.numbers.primitives import Primitives

SHORTEST, LONGEST = 1e-70, 1e70
"""The legs whose squares, and those of their products, keep all digits."""

_LEAST, _INVERSE = SHORTEST * SHORTEST, 1.0 / LONGEST


class Leg(NamedTuple):
    """The way from a vertex to the next."""

    along: Vector
    inverse: Any
    unit: Vector


def incidence(xp: Primitives) -> Callable[..., tuple[Any, Any]]:
    """Make ``(x0, y0, z0, ..., z2) -> (cos, sin)`` of the incidence at the middle of three points.

    With unit directions, half of |k_out - k_in| and of |k_out + k_in|: each keeps its digits
    where it is small.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> incidence(FLOAT)(0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0, 2.0, 3.0)
    (0.7071067811865476, 0.7071067811865476)
    """
    along, between = legs(xp), incidence_between(xp)

    def met(*coordinates: Any) -> tuple[Any, Any]:
        return between(*along(points_of(coordinates)))

    return met


def incidence_between(xp: Primitives) -> Callable[[Leg, Leg], tuple[Any, Any]]:
    """Make ``(leg before, leg behind) -> (cos, sin)`` of the incidence, as `incidence` has it."""
    sqrt = xp.sqrt

    def met(before: Leg, behind: Leg) -> tuple[Any, Any]:
        across, together = minus(behind.unit, before.unit), plus(behind.unit, before.unit)
        return 0.5 * sqrt(dot(across, across)), 0.5 * sqrt(dot(together, together))

    return met


def points_of(coordinates: Sequence[Any]) -> list[Vector]:
    """Return coordinates in a row as points.

    Examples
    --------
    >>> points_of((1, 2, 3, 4, 5, 6))
    [(1, 2, 3), (4, 5, 6)]
    """
    rows = range(0, len(coordinates), 3)
    return [(coordinates[i], coordinates[i + 1], coordinates[i + 2]) for i in rows]


def legs(xp: Primitives) -> Callable[..., list[Leg]]:
    """Make ``points, ended -> legs``; one that is too short or too long is not finite.

    What has ended, by a condition for each vertex between the points, goes straight on, wherever
    the points behind it are.
    """
    sqrt, where, chosen = xp.sqrt, xp.where, choice(xp)

    def between(points: Sequence[Vector], ended: Sequence[Any] = ()) -> list[Leg]:
        found: list[Leg] = []
        for start, end in pairwise(points):
            along = minus(end, start)
            if found and ended:
                along = chosen(ended[len(found) - 1], found[-1].along, along)
            squared = dot(along, along)
            inverse = 1.0 / sqrt(squared)
            # Both limits are 0 in single precision, which has none of the other numbers.
            kept = (squared > _LEAST) & (inverse > _INVERSE)
            inverse = where(kept, inverse, nan)
            found.append(Leg(along, inverse, times(inverse, along)))
        return found

    return between
