"""Facets: light at one of known normal, single scattering, Beckmann's slopes, Smith's masking."""

from __future__ import annotations

from math import pi, sqrt
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, get_args

from optipath.kernels.carriers.structures import BLOCK, turn_linear
from optipath.kernels.exponential import complementary_error
from optipath.kernels.filters import align
from optipath.kernels.fresnel.boundary import lossless_boundary
from optipath.kernels.vectors import Vector, choice, cross, dot, minus, norm, plus, times
from optipath.kernels.vertex_chain import points_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.kernel import Kernel
    from optipath.kernels.primitives import KernelFunction, Primitives


def plane_at_facet(xp: Primitives) -> Callable[[Vector, Vector, Vector], tuple[Any, ...]]:
    """Make ``(k, x, normal) -> (cos, sin, s, cos 2a, sin 2a)`` of light that arrives at a facet.

    The normal is on the side of the light. The plane of incidence is across s, along normal cross
    k; along the normal, s is x. The frame is turned by a from x to s.
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
    """Return the direction of what a facet reflects."""
    return plus(k, times(2.0 * cos, normal))


def refracted_at_facet(xp: Primitives) -> Callable[..., Vector]:
    """Make ``(n1, n, k, normal, cos, sin) -> direction`` of what a facet lets through.

    Snell's law as a vector (Glassner, ed., An Introduction to Ray Tracing, Academic Press 1989,
    ch. 4): n k' = n1 k + (n1 cos - g) normal, with the wave g of the boundary. Where all is
    reflected, it means nothing.
    """
    boundary = lossless_boundary(xp)

    def refracted(n1: Any, n: Any, k: Vector, normal: Vector, cos: Any, sin: Any) -> Vector:
        at = boundary(n1, n, cos, sin)
        inverse = 1.0 / at.n
        return minus(times(at.n1 * inverse, k), times((at.a - at.p) * inverse, normal))

    return refracted


def facet_scattering(reflection: Kernel, masking: str, xp: Primitives) -> KernelFunction:
    """Make ``(alpha_x, alpha_y, k_in, x_in, k_out, x_out, n1, n, [k]) -> sixteen numbers``.

    The Mueller matrix of the facet between two directions, row by row, times density / (4 tilt^4) G
    / (cos_in cos_out); three numbers of each vector.
    """
    facet, density = facet_between(xp), beckmann(xp)
    reflect, cosines = reflection.made_for(xp), masked_cosines(xp, masking)

    def scattered(alpha_x: Any, alpha_y: Any, *numbers: Any) -> tuple[Any, ...]:
        k_in, x_in, k_out, x_out = points_of(numbers[:12])
        met = facet(k_in, x_in, k_out, x_out)
        rows = BLOCK.rows(xp, reflect(*numbers[12:], met.cos, met.sin))
        # One after the other, so that tiny numbers are not lost together.
        share = 0.25 * density(*met.slopes, alpha_x, alpha_y) / met.tilt**2 / met.tilt**2
        share = share / cosines(k_in, k_out, alpha_x, alpha_y)
        turned = _turned(rows, met.turn_in, met.turn_out)
        return tuple(share * entry for row in turned for entry in row)

    return scattered


def _turned(rows: Any, turn_in: Sequence[Any], turn_out: Sequence[Any]) -> Any:
    """Return the rows of a Mueller matrix between a turn before and a turn behind."""
    c, s = turn_in
    first, *middle, last = [(a, *turn_linear((c, -s), b1, b2), d) for a, b1, b2, d in rows]
    columns = [turn_linear(turn_out, *pair) for pair in zip(*middle, strict=True)]
    return first, *zip(*columns, strict=True), last


_PARALLEL = 2.0**-50
"""A sine of the incidence below which it is the rounding of the directions."""


class FacetBetween(NamedTuple):
    """How light meets the facet that reflects it from one direction into another."""

    cos: Any
    sin: Any
    slopes: tuple[Any, Any]
    tilt: Any
    turn_in: tuple[Any, ...]
    turn_out: tuple[Any, ...]


def facet_between(xp: Primitives) -> Callable[[Vector, Vector, Vector, Vector], FacetBetween]:
    """Make ``(k_in, x_in, k_out, x_out) -> FacetBetween``, of unit vectors.

    The normal is along k_out - k_in, and s along the product of this and k_out + k_in, which are
    at right angles: neither next to normal nor next to grazing incidence is a digit lost. Light
    that goes back the way it came keeps its x, as at any boundary.
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

        def turn(k: Vector, x: Vector) -> tuple[Any, ...]:
            return aligned(dot(x, s), dot(k, cross(x, s)))

        c, e = turn(k_out, x_out)
        slopes = 0.0 - across[0] / across[2], 0.0 - across[1] / across[2]
        return FacetBetween(cos, sin, slopes, 0.5 * across[2] / cos, turn(k_in, x_in), (c, 0.0 - e))

    return between


def beckmann(xp: Primitives) -> Callable[[Any, Any, Any, Any], Any]:
    """Make ``(slope_x, slope_y, alpha_x, alpha_y) -> density``, which is 1 over all slopes.

    exp(-(slope_x / alpha_x)^2 - (slope_y / alpha_y)^2) / (pi alpha_x alpha_y); alpha^2 is twice
    the mean square slope along an axis (E. Heitz, "Generating procedural Beckmann surfaces",
    2015).
    """
    exp = xp.exp

    def density(slope_x: Any, slope_y: Any, alpha_x: Any, alpha_y: Any) -> Any:
        x, y = slope_x / alpha_x, slope_y / alpha_y
        return exp(-(x * x + y * y)) / alpha_x / alpha_y / pi

    return density


_STEEPEST = 32.0
"""A ratio of a direction's slope to the surface's beyond which nothing at all is masked."""

Masking: TypeAlias = Literal["smith", "separate", "none"]
MASKINGS: tuple[Masking, ...] = get_args(Masking)
"""How the masking of two directions goes together: by one height, by itself, or not at all."""


def smith_cosine(xp: Primitives) -> Callable[[Vector, Any, Any], Any]:
    """Make ``(k, alpha_x, alpha_y) -> |k_z| (1 + Lambda)``, the cosine over the share that is seen.

    It is the projected area of all facets that face the direction k. With a = 1 / (alpha
    tan(theta)) and the alpha along k, Lambda = exp(-a^2) / (2 a sqrt(pi)) - erfc(a) / 2 (B. G.
    Smith, IEEE Trans. Antennas Propag. 15, 668 (1967); E. Heitz, J. Computer Graphics Techniques
    3(2), 48 (2014), sec. 5). All terms are finite at grazing and at normal incidence.
    """
    exp, maximum, absolute = xp.exp, xp.maximum, xp.absolute
    length, erfc = norm(xp), complementary_error(xp)

    def cosine(k: Vector, alpha_x: Any, alpha_y: Any) -> Any:
        cos, spread = absolute(k[2]), length(alpha_x * k[0], alpha_y * k[1])
        a = cos / maximum(spread, cos / _STEEPEST)
        return cos * (1.0 - 0.5 * erfc(a)) + 0.5 / sqrt(pi) * spread * exp(-(a * a))

    return cosine


def masked_cosines(xp: Primitives, masking: str) -> Callable[[Vector, Vector, Any, Any], Any]:
    """Make ``(k_in, k_out, alpha_x, alpha_y) -> cos_in cos_out / G``.

    G is the share of the facets that are seen along both directions: 1 / (1 + Lambda_in +
    Lambda_out) of ``"smith"``, since what is high is seen along both (V. Ross, D. Dion and G.
    Potvin, J. Opt. Soc. Am. A 22, 2442 (2005)), the product of 1 / (1 + Lambda) of ``"separate"``,
    and 1 of ``"none"``.
    """
    cosine, absolute = smith_cosine(xp), xp.absolute

    def cosines(k_in: Vector, k_out: Vector, alpha_x: Any, alpha_y: Any) -> Any:
        cos_in, cos_out = absolute(k_in[2]), absolute(k_out[2])
        if masking == "none":
            return cos_in * cos_out
        seen_in, seen_out = cosine(k_in, alpha_x, alpha_y), cosine(k_out, alpha_x, alpha_y)
        if masking == "separate":
            return seen_in * seen_out
        return cos_out * seen_in + (seen_out - cos_out) * cos_in

    return cosines
