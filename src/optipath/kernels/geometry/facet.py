"""Light at a facet whose normal is known: its plane of incidence, and where it goes on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.filters.rotation import align
from optipath.kernels.fresnel.boundary import lossless_boundary
from optipath.kernels.geometry.vectors import Vector, choice, cross, dot, minus, plus, times

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives


def plane_at_facet(xp: Primitives) -> Callable[[Vector, Vector, Vector], tuple[Any, ...]]:
    """Make ``(k, x, normal) -> (cos, sin, s, cos 2a, sin 2a)`` of light that arrives at a facet.

    The normal is on the side of the light, which goes along k in a frame with x. The plane of
    incidence is across s, along normal cross k; along the normal, s is x. The frame is turned
    by a from x to s.

    Examples
    --------
    Light that goes down and along x, onto a floor:

    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> k, y, up = (0.6, 0.0, -0.8), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    >>> plane_at_facet(FLOAT)(k, y, up)
    (0.8, 0.6, (-0.0, 1.0, 0.0), 1.0, 0.0)
    """
    sqrt, where, maximum, chosen, aligned = xp.sqrt, xp.where, xp.maximum, choice(xp), align(xp)

    def plane(k: Vector, x: Vector, normal: Vector) -> tuple[Any, ...]:
        across = cross(normal, k)
        squared = dot(across, across)
        slants = squared > 0.0
        sin = sqrt(squared)
        s = chosen(slants, times(1.0 / where(slants, sin, 1.0), across), x)
        # Light may graze a facet by less than a rounding.
        cos = maximum(-dot(normal, k), 0.0)
        return cos, sin, s, *aligned(dot(x, s), dot(k, cross(x, s)))

    return plane


def reflected_at_facet(k: Vector, normal: Vector, cos: Any) -> Vector:
    """Return the direction of what a facet reflects.

    Examples
    --------
    >>> reflected_at_facet((0.6, 0.0, -0.8), (0.0, 0.0, 1.0), 0.8)
    (0.6, 0.0, 0.8)
    """
    return plus(k, times(2.0 * cos, normal))


def refracted_at_facet(xp: Primitives) -> Callable[..., Vector]:
    """Make ``(n1, n, k, normal, cos, sin) -> direction`` of what a facet lets through.

    Snell's law as a vector (Glassner, ed., An Introduction to Ray Tracing, Academic Press 1989,
    ch. 4): n k' = n1 k + (n1 cos - g) normal, with the wave g of the boundary. Where all is
    reflected, it means nothing.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> direction = refracted_at_facet(FLOAT)(1.0, 1.5, (0.6, 0.0, -0.8), (0.0, 0.0, 1.0), 0.8, 0.6)
    >>> [round(number, 12) for number in direction]
    [0.4, 0.0, -0.916515138991]
    """
    boundary = lossless_boundary(xp)

    def refracted(n1: Any, n: Any, k: Vector, normal: Vector, cos: Any, sin: Any) -> Vector:
        at = boundary(n1, n, cos, sin)
        inverse = 1.0 / at.n
        return minus(times(at.n1 * inverse, k), times((at.a - at.p) * inverse, normal))

    return refracted
