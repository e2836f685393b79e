"""Fresnel reflection that keeps its digits: products and sums of non-negative terms."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


def stable_reflection(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Fs, Fp, B, C, S)``.

    With p = n1 cos, z = (n1 sin)^2, D = m2^2 - n1^2 and g = a + ib = sqrt(m2^2 - z):
    r_s = -D / (p + g)^2 and r_p / r_s = (z - p g) / (z + p g), which are the
    Fresnel equations (Born & Wolf, Principles of Optics, sec. 1.5 and 14.2) freed
    of differences between nearly equal numbers. Total reflection gives
    Fs = Fp = 1 and B = 0 exactly.
    """
    sqrt, where, absolute = xp.sqrt, xp.where, xp.absolute

    def reflect(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        p = n1 * c
        y = n1 * s
        z = y * y
        contrast = (n - n1) * (n + n1)
        # Re g^2, from whichever of cos and sin is small: that one carries the digits.
        u = where(c < s, contrast + p * p, (n - y) * (n + y)) - k * k
        v = 2.0 * n * k
        g2 = sqrt(u * u + v * v)
        larger = sqrt(0.5 * (absolute(u) + g2))
        smaller = 0.5 * v / where(larger > 0.0, larger, 1.0)
        a = where(u >= 0.0, larger, smaller)
        b = where(u >= 0.0, smaller, larger)

        pa, pb = p * a, p * b
        P = (p + a) * (p + a) + b * b
        # P vanishes only at grazing incidence on an equal medium, which is no interface.
        met = P > 0.0
        P = where(met, P, 1.0)
        Ts = where(met, 4.0 * pa / P, 1.0)
        dr = contrast - k * k
        Fs = where(Ts < 0.5, 1.0 - Ts, (dr * dr + v * v) / (P * P))

        b2 = pb * pb
        q = (z + pa) * (z + pa) + b2
        # q vanishes only at normal incidence on an index of 0, where r_p = -r_s.
        slanted = q > 0.0
        q = where(slanted, q, 1.0)
        f = Fs / q
        # Not f times the rest: in total reflection the quotient is 1 to the last bit.
        Fp = Fs * where(slanted, ((z - pa) * (z - pa) + b2) / q, 1.0)
        root = p * sqrt(g2)
        B = 2.0 * f * z * pa
        C = where(slanted, f * (z - root) * (z + root), -Fs)
        S = 2.0 * f * z * pb
        return Fs, Fp, B, C, S

    return reflect
