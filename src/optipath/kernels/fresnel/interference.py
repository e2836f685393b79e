"""What light in front of a boundary carries by interference, where the medium in front absorbs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.from_absorbing import slant_of
from optipath.kernels.fresnel.inhomogeneous import InhomogeneousBoundary, inhomogeneous_boundary
from optipath.kernels.fresnel.stable import sum_squared

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def interference(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, n0, cos, sin) -> (Is, Ip, Is', Ip')`` with 1 = R + T + I.

    The last two are those of light from behind. In a medium that absorbs, what a wave that
    arrives and one that is reflected carry together is not the sum of theirs: a flux
    Re(w1 (1 - r)(1 + r*)) is Re(w1) (1 - |r|^2) + 2 Im(w1) Im(r), with r = (w1 - w2) / (w1 + w2),
    w = g for s and w = g / m^2 for p (Byrnes, arXiv:1603.02720). So I, which may have either sign,
    is 4 (Im w1 / Re w1) (Re w1 Im w2 - Re w2 Im w1) / |w1 + w2|^2. With z = (n0 sin)^2 and
    G = |g|^2, w for p goes as Re(g) (G + z) + i Im(g) (z - G).
    """
    boundary, shares = inhomogeneous_boundary(xp), _shares(xp)

    def both(*given: Any) -> tuple[Any, ...]:
        at = boundary(*given)
        return *shares(at), *shares(at.from_behind(xp.where))

    return both


def _shares(xp: Primitives) -> Callable[[InhomogeneousBoundary], tuple[Any, Any]]:
    where = xp.where

    def shares(at: InhomogeneousBoundary) -> tuple[Any, Any]:
        P, q, n2 = sum_squared(at), slant_of(where, at).q, at.n1 * at.n1
        z, G1, G2 = n2 * (at.s * at.s), at.p * at.p + at.fades * at.fades, at.squared
        # Where no wave arrives there is no light.
        there = (at.p > 0.0) & (P > 0.0) & (q * n2 > 0.0)
        share = where(there, 4.0 * (at.fades / where(there, at.p * P, 1.0)), 0.0)
        of_s = at.p * at.b - at.a * at.fades
        of_p = at.p * (G1 + z) * (at.b * (z - G2)) - at.a * (G2 + z) * (at.fades * (z - G1))
        of_p = of_p * ((z - G1) / where(there, (G1 + z) * q * n2, 1.0))
        return share * of_s, share * of_p

    return shares
