"""Planes of incidence along a chain of vertices: their axes, and the turns between them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from optipath.kernels.filters.rotation import align
from optipath.kernels.geometry.events import ended
from optipath.kernels.geometry.vectors import Vector, choice, cross, dot, minus, times
from optipath.kernels.geometry.vertex_chain import legs, points_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.geometry.vertex_chain import Leg
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

_PARALLEL = 2.0**-50
"""The sine of twice an incidence below which it is the rounding of the points."""

_PARALLEL_IN_SINGLES, _BELOW_SINGLES = 2.0**-19, 1e-9
"""The same in single precision; and what a 1 does not notice there."""

_NEARLY = 2.0**-26
"""The same below which half of the digits are, so that other knowledge of a plane is better."""


@dataclass(frozen=True)
class OfPlanes:
    """Makes ``(x0, y0, z0, ...) -> numbers`` of the planes of incidence of a chain.

    The points are all from the start of the chain to the one behind the last vertex.
    """

    known: bool = False
    events: int = 0

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function of coordinates."""
        raise NotImplementedError

    def met(self, xp: Primitives) -> Callable[..., tuple[list[Leg], list[Vector]]]:
        """Make ``(x0, y0, z0, ...) -> legs and the x of each vertex``."""
        along, planes = legs(xp), axes(xp)

        def of(*numbers: Any) -> tuple[list[Leg], list[Vector]]:
            vectors = points_of(numbers[self.events :])
            # Of n vertices there are n + 2 points.
            count = len(vectors) // 2 + 1 if self.known else len(vectors)
            several = along(vectors[:count], ended(numbers[: self.events]))
            return several, planes(several, vectors[count:])

        return of


@dataclass(frozen=True)
class TurnBetweenPlanes(OfPlanes):
    """Makes ``(cos 2a, sin 2a)`` of the turn between the planes of the last two vertices.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> up_sideways_on = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0)
    >>> TurnBetweenPlanes()(FLOAT)(*up_sideways_on)
    (-1.0, 0.0)
    """

    across: bool = False

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function of coordinates."""
        met, aligned = self.met(xp), align(xp)

        def turned(*coordinates: Any) -> tuple[Any, Any]:
            several, planes = met(*coordinates)
            *_, x, new_x = planes
            z, along = several[-2].unit, dot(x, new_x)
            if self.across:
                along = along - dot(x, z) * dot(new_x, z)
            c, s = aligned(along, dot(z, cross(x, new_x)))
            return c, s

        return turned


@dataclass(frozen=True)
class AxesAtVertex(OfPlanes):
    """Makes ``(x, z)``, six numbers: how light arrives at the last vertex, or leaves it."""

    leaves: bool = False

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function of coordinates."""
        met, sqrt = self.met(xp), xp.sqrt

        def axes_of(*coordinates: Any) -> tuple[Any, ...]:
            several, planes = met(*coordinates)
            x, z = planes[-1], several[-1 if self.leaves else -2].unit
            # Next to the normal, where the plane is known to fewer digits than the direction.
            x = minus(x, times(dot(x, z), z))
            return *times(1.0 / sqrt(dot(x, x)), x), *z

        return axes_of


def axes(xp: Primitives) -> Callable[[Sequence[Leg], Sequence[Vector]], list[Vector]]:
    """Make ``(legs, known) -> x at each vertex``: k_out cross k_in, across the plane of incidence.

    Light along the normal, and light that goes straight through, has no plane of its own. It
    takes the known x, or else keeps the one that it came with; the first of a chain, one that
    is perpendicular to it.
    """
    sqrt, where, chosen = xp.sqrt, xp.where, choice(xp)

    def planes(several: Sequence[Leg], known: Sequence[Vector]) -> list[Vector]:
        least = _NEARLY if known else parallel(several[0].unit)
        found, x = [], (0.0, 0.0, 0.0) if known else perpendicular(several[0].unit)
        for vertex, (before, behind) in enumerate(pairwise(several)):
            # Of the points' differences: what is parallel in them comes to 0.
            across = times(behind.inverse * before.inverse, cross(behind.along, before.along))
            squared = dot(across, across)
            has_plane = squared > least * least
            own = times(1.0 / sqrt(where(has_plane, squared, 1.0)), across)
            x = chosen(has_plane, own, known[vertex] if known else x)
            found.append(x)
        return found

    def parallel(k: Vector) -> Any:
        # By what the rounding of a direction is, the sine that is none.
        one = dot(k, k)
        singles = xp.below_rounding(one, _BELOW_SINGLES * one)
        return where(singles, _PARALLEL_IN_SINGLES, _PARALLEL)

    def perpendicular(k: Vector) -> Vector:
        # What world x leaves of itself across the light, or world y where light goes along x.
        u, v, w = k
        near_x = u * u > 0.5
        across = chosen(
            near_x, (-(u * v), 1.0 - v * v, -(v * w)), (1.0 - u * u, -(u * v), -(u * w))
        )
        return times(1.0 / sqrt(dot(across, across)), across)

    return planes
