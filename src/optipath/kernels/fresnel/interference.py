"""What light in front of a boundary carries by interference, where the medium in front absorbs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.boundary import refracted_wave
from optipath.kernels.numbers.complex_pairs import brought_near_one, complex_root, from_within

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def interference(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, n0, cos, sin) -> (Is, Ip)`` with 1 = R + T + I, I of either sign.

    The angle is that in a medium n0 from which parallel boundaries have refracted the light. In a
    medium that absorbs, the power of a wave that arrives and of one that is reflected is not the
    sum of theirs: a flux Re(w1 (1 - r)(1 + r*)) is Re(w1) (1 - |r|^2) + 2 Im(w1) Im(r), with
    r = (w1 - w2) / (w1 + w2), w = g for s and w = g / m^2 for p (Byrnes, arXiv:1603.02720). So
    I = 4 (Im w1 / Re w1) (Re w1 Im w2 - Re w2 Im w1) / |w1 + w2|^2; for p, with G = |g|^2 and
    z = (n0 sin)^2, w m^2 conj(m^2) = Re(g) (G + z) + i Im(g) (z - G).
    """
    divided, refracted, root = brought_near_one(xp), refracted_wave(xp), complex_root(xp)
    inside, where = from_within(xp, 6), xp.where

    def wave(n: Any, k: Any, n0: Any, c: Any, s: Any) -> tuple[Any, ...]:
        return root(refracted(n, n, n0, c, s)[3] - k * k, n, k)

    def shares(n1: Any, k1: Any, n: Any, k: Any, n0: Any, c: Any, s: Any) -> tuple[Any, Any]:
        k1, k = (inside(xp.absolute(number)) for number in (k1, k))
        n1, k1, n, k, n0 = divided(n1, k1, n, k, n0)
        a1, b1, G1 = wave(n1, k1, n0, c, s)
        a2, b2, G2 = wave(n, k, n0, c, s)
        z = (n0 * s) * (n0 * s)
        along, across = a1 + a2, b1 + b2
        P = along * along + across * across
        re, im = z + (a1 * a2 - b1 * b2), a1 * b2 + a2 * b1
        q = re * re + im * im
        # Without a wave in front there is no light.
        there = (a1 > 0.0) & (P > 0.0) & (q > 0.0)
        share = where(there, 4.0 * b1 / where(there, a1 * P, 1.0), 0.0)
        sum1, sum2, less1, less2 = G1 + z, G2 + z, z - G1, z - G2
        of_p = a1 * sum1 * (b2 * less2) - a2 * sum2 * (b1 * less1)
        across_p = where(there, less1 / where(there, sum1 * q, 1.0), 0.0)
        return share * (a1 * b2 - a2 * b1), share * across_p * of_p

    return shares
