"""Light along a chain of vertices: angles and planes of incidence out of the points alone.

A chain is the point where light starts, one for each specular reflection, and the point
where it ends. The surface at a vertex is perpendicular to the bisector of its two legs.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.rotation import align
from optipath.kernels.vectors import Vector, choice, cross, dot, minus, plus, times

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.primitives import Primitives

_PARALLEL = 2.0**-50
"""The sine of twice an incidence below which it is the rounding of the points."""


class Leg(NamedTuple):
    """The way from a vertex to the next.

    Attributes
    ----------
    along : tuple
        From point to point.
    inverse : float
        One over its length.
    unit : tuple
        The direction.
    """

    along: Vector
    inverse: Any
    unit: Vector


def incidence(xp: Primitives) -> Callable[..., tuple[Any, Any]]:
    """Make ``(x0, y0, z0, ..., z2) -> (cos, sin)`` of the incidence at the middle of three points.

    With unit directions, half of |k_out - k_in| and of |k_out + k_in|: each keeps its digits
    where it is small.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> incidence(FLOAT)(0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0, 2.0, 3.0)
    (0.7071067811865476, 0.7071067811865476)
    """
    sqrt, along = xp.sqrt, legs(xp)

    def met(*coordinates: Any) -> tuple[Any, Any]:
        before, behind = along(points_of(coordinates))
        across, together = minus(behind.unit, before.unit), plus(behind.unit, before.unit)
        return 0.5 * sqrt(dot(across, across)), 0.5 * sqrt(dot(together, together))

    return met


def turn_between_planes(xp: Primitives) -> Callable[..., tuple[Any, Any]]:
    """Make ``(x0, y0, ...) -> (cos 2a, sin 2a)`` between the planes of the last two vertices.

    The points are all from the start of the chain to the one behind these vertices.
    """
    along, planes, aligned = legs(xp), axes(xp), align(xp)

    def turned(*coordinates: Any) -> tuple[Any, Any]:
        several = along(points_of(coordinates))
        *_, x, new_x = planes(several)
        c, s = aligned(dot(x, new_x), dot(several[-2].unit, cross(x, new_x)))
        return c, s

    return turned


def arriving(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(x0, y0, ...) -> (x, z)``, six numbers: how light arrives at the last vertex."""
    return _frame(xp, -2)


def reflected(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(x0, y0, ...) -> (x, z)``, six numbers: how light leaves the last vertex."""
    return _frame(xp, -1)


def _frame(xp: Primitives, leg: int) -> Callable[..., tuple[Any, ...]]:
    along, planes, sqrt = legs(xp), axes(xp), xp.sqrt

    def axes_of(*coordinates: Any) -> tuple[Any, ...]:
        several = along(points_of(coordinates))
        x, z = planes(several)[-1], several[leg].unit
        # Next to the normal, where the plane is known to fewer digits than the direction.
        x = minus(x, times(dot(x, z), z))
        return *times(1.0 / sqrt(dot(x, x)), x), *z

    return axes_of


def points_of(coordinates: Sequence[Any]) -> list[Vector]:
    """Return coordinates in a row as points.

    Examples
    --------
    >>> points_of((1, 2, 3, 4, 5, 6))
    [(1, 2, 3), (4, 5, 6)]
    """
    rows = range(0, len(coordinates), 3)
    return [(coordinates[i], coordinates[i + 1], coordinates[i + 2]) for i in rows]


def legs(xp: Primitives) -> Callable[[Sequence[Vector]], list[Leg]]:
    """Make ``points -> legs``."""
    sqrt = xp.sqrt

    def between(points: Sequence[Vector]) -> list[Leg]:
        found = []
        for start, end in pairwise(points):
            along = minus(end, start)
            inverse = 1.0 / sqrt(dot(along, along))
            found.append(Leg(along, inverse, times(inverse, along)))
        return found

    return between


def axes(xp: Primitives) -> Callable[[Sequence[Leg]], list[Vector]]:
    """Make ``legs -> x at each vertex``: k_out cross k_in, across the plane of incidence.

    Light along the normal, and light that goes straight through, has no plane of its own, and
    keeps the x that it came with; the first of a chain, one that is perpendicular to it.
    """
    sqrt, where, chosen = xp.sqrt, xp.where, choice(xp)

    def planes(several: Sequence[Leg]) -> list[Vector]:
        found, x = [], perpendicular(several[0].unit)
        for before, behind in pairwise(several):
            # Of the points' differences: what is parallel in them comes to 0.
            across = times(behind.inverse * before.inverse, cross(behind.along, before.along))
            squared = dot(across, across)
            has_plane = squared > _PARALLEL * _PARALLEL
            own = times(1.0 / sqrt(where(has_plane, squared, 1.0)), across)
            x = chosen(has_plane, own, x)
            found.append(x)
        return found

    def perpendicular(k: Vector) -> Vector:
        # What world x leaves of itself across the light, or world y where light goes along x.
        u, v, w = k
        near_x = u * u > 0.5
        across = chosen(
            near_x, (-(u * v), 1.0 - v * v, -(v * w)), (1.0 - u * u, -(u * v), -(u * w))
        )
        return times(1.0 / sqrt(dot(across, across)), across)

    return planes
