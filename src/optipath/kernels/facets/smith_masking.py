"""Smith's masking: how much of a rough surface is seen along a direction."""

from __future__ import annotations

from math import pi, sqrt
from typing import TYPE_CHECKING, Any

from optipath.kernels.numbers.error_function import complementary_error
from optipath.kernels.numbers.norms import norm

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.geometry.vectors import Vector
    from optipath.kernels.numbers.primitives import Primitives

_STEEPEST = 32.0
"""A ratio of a direction's slope to the surface's beyond which nothing at all is masked."""

MASKINGS = ("smith", "separate", "none")
"""How the masking of two directions goes together: by one height, by itself, or not at all."""


def smith_cosine(xp: Primitives) -> Callable[[Vector, Any, Any], Any]:
    """Make ``(k, alpha_x, alpha_y) -> |k_z| (1 + Lambda)``, the cosine over the share that is seen.

    It is the projected area of all facets that face the direction k. With a = 1 / (alpha
    tan(theta)) and the alpha along k, Lambda = exp(-a^2) / (2 a sqrt(pi)) - erfc(a) / 2 (B. G.
    Smith, IEEE Trans. Antennas Propag. 15, 668 (1967); E. Heitz, J. Computer Graphics Techniques
    3(2), 48 (2014), sec. 5). All terms are finite at grazing and at normal incidence.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> cosine = smith_cosine(FLOAT)
    >>> cosine((0.0, 0.0, -1.0), 0.5, 0.5), round(cosine((1.0, 0.0, 0.0), 0.5, 0.5), 6)
    (1.0, 0.141047)
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
