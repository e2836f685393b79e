"""Snell's law at a vertex: what the deviation of light there says of its refraction."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING, Any

from optipath.kernels.geometry.vectors import cross, dot, minus, times
from optipath.kernels.geometry.vertex_chain import legs, points_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.geometry.vertex_chain import Leg
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

STRAIGHT = 1e-6
"""The deviation between equal media, in radians, up to which light goes straight on."""

_STRAIGHT_IN_SINGLES, _BELOW_SINGLES = 5e-4, 1e-9
"""The same in single precision, thousands of roundings; and what such a 1 does not notice."""

_ROUNDINGS = 2.0**-10
"""One over how many roundings a cosine may be below 0, where light grazes the surface."""


def refraction_at_vertex(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n2, x0, y0, z0, ..., z2) -> (rarer, denser, cos, sin)``.

    Of the refraction at the middle of three points, by `refracted`.

    Examples
    --------
    Into glass at 45 degrees:

    >>> from math import sqrt
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> behind = (0.0, 1.0, -sqrt(3.5))
    >>> numbers = refraction_at_vertex(FLOAT)(1.0, 1.5, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, *behind)
    >>> [round(number, 12) for number in numbers]
    [1.0, 1.5, 0.707106781187, 0.707106781187]
    """
    along, met = legs(xp), refracted(xp)

    def refraction(n1: Any, n2: Any, *coordinates: Any) -> tuple[Any, Any, Any, Any]:
        before, behind = along(points_of(coordinates))
        return met(n1, n2, before, behind)

    return refraction


def refracted(xp: Primitives) -> Callable[[Any, Any, Leg, Leg], tuple[Any, Any, Any, Any]]:
    """Make ``(n1, n2, leg before, leg behind) -> (rarer, denser, cos, sin)``.

    Both indices in order, and the angle to the normal in the rarer medium: power carried
    through a boundary is the same from either side (Stokes' relations), and from the rarer one
    nothing cancels near the critical angle. Not a number, where no surface refracts light so.

    By the vector form of Snell's law the normal is along N = n2 k_out - n1 k_in (Glassner, ed.,
    An Introduction to Ray Tracing, Academic Press 1989, ch. 4). With d = k_out - k_in,
    over the denser index, cos |N| = 1 - rarer / denser - d^2 / 2 and sin |N| = |k_in x k_out|.
    """
    sqrt, where, maximum, minimum = xp.sqrt, xp.where, xp.maximum, xp.minimum
    below_rounding = xp.below_rounding

    def met(n1: Any, n2: Any, before: Leg, behind: Leg) -> tuple[Any, Any, Any, Any]:
        rarer, denser = minimum(n1, n2), maximum(n1, n2)
        turned = minus(behind.unit, before.unit)
        squared = dot(turned, turned)
        # Of the points' differences: what is parallel in them comes to 0.
        across = times(behind.inverse * before.inverse, cross(behind.along, before.along))
        sine2 = dot(across, across)
        are_equal = rarer == denser
        cos = (denser - rarer) / denser - 0.5 * squared
        # By its own parts: a deviation that is known to few digits is one angle all the same.
        inverse = 1.0 / sqrt(where(are_equal, 1.0, cos * cos + sine2))
        cos = inverse * cos
        # Light along the normal has no slope of the sine, and needs none.
        slants = sine2 > 0.0
        sin = where(slants, inverse * sqrt(where(slants, sine2, 1.0)), 0.0)
        # Of equal media the surface may stand anyhow.
        grazes = 1.0 + _ROUNDINGS * cos >= 1.0
        cos = where(grazes, maximum(cos, 0.0), nan)
        one = dot(before.unit, before.unit)
        singles = below_rounding(one, _BELOW_SINGLES * one)
        limit = where(singles, _STRAIGHT_IN_SINGLES**2, STRAIGHT * STRAIGHT)
        straight = where(squared <= limit, 1.0, nan)
        return rarer, denser, where(are_equal, straight, cos), where(are_equal, 0.0, sin)

    return met
