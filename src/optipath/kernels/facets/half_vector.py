"""The facet that sends light from one direction into another: its normal is halfway between."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.filters.rotation import align
from optipath.kernels.geometry.vectors import Vector, choice, cross, dot, minus, plus, times
from optipath.kernels.numbers.norms import norm

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives

_PARALLEL = 2.0**-50
"""A sine of the incidence below which it is the rounding of the directions."""


class FacetBetween(NamedTuple):
    """How light meets the facet that reflects it from one direction into another."""

    cos: Any
    sin: Any
    slopes: tuple[Any, Any]
    tilt: Any
    turn_in: tuple[Any, Any]
    turn_out: tuple[Any, Any]


def facet_between(xp: Primitives) -> Callable[[Vector, Vector, Vector, Vector], FacetBetween]:
    """Make ``(k_in, x_in, k_out, x_out) -> FacetBetween``, of unit vectors.

    The normal is along k_out - k_in, and s along the product of this and k_out + k_in, which are
    at right angles: neither next to normal nor next to grazing incidence is a digit lost. Light
    that goes back the way it came keeps its x, as at any boundary.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> x = (0.0, 1.0, 0.0)
    >>> met = facet_between(FLOAT)((0.6, 0.0, -0.8), x, (0.6, 0.0, 0.8), x)
    >>> met.cos, met.sin, met.slopes, met.turn_in, met.turn_out
    (0.8, 0.6, (0.0, 0.0), (1.0, 0.0), (1.0, 0.0))
    """
    length, aligned, chosen, where = norm(xp), align(xp), choice(xp), xp.where

    def between(k_in: Vector, x_in: Vector, k_out: Vector, x_out: Vector) -> FacetBetween:
        across, together = minus(k_out, k_in), plus(k_out, k_in)
        sin = 0.5 * length(*together)
        # At right angles, were it not for the rounding of lengths, which a small difference shows.
        oblique = sin > 0.5
        rest = dot(across, together) / where(oblique, dot(together, together), 1.0)
        across = minus(across, times(where(oblique, rest, 0.0), together))
        cos = 0.5 * length(*across)
        has_plane = sin > _PARALLEL
        own = times(1.0 / where(has_plane, sin, 1.0), cross(across, together))
        s = chosen(has_plane, own, x_in)

        def turn(k: Vector, x: Vector) -> tuple[Any, Any]:
            c, e = aligned(dot(x, s), dot(k, cross(x, s)))
            return c, e

        c, e = turn(k_out, x_out)
        slopes = 0.0 - across[0] / across[2], 0.0 - across[1] / across[2]
        return FacetBetween(cos, sin, slopes, 0.5 * across[2] / cos, turn(k_in, x_in), (c, 0.0 - e))

    return between
