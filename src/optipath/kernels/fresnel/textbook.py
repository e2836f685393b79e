"""Fresnel reflection in the angle form that textbooks print."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def textbook_reflection(xp: Primitives) -> KernelFunction:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Fs, Fp, B, C, S)``.

    The formulas as Wilkie & Weidlich, "Polarised light in computer graphics"
    (SIGGRAPH Asia courses, 2012), print them, with the relative index. They lose
    digits near Brewster's angle, near the normal and at grazing incidence.
    Their phases are those of conj(r), so the sine is taken of d_p - d_s here.
    """
    printed, sqrt, atan2, sin, cos = _printed(xp), xp.sqrt, xp.atan2, xp.sin, xp.cos

    def reflect(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        n, k, a, b, Fs, Fp = printed(n1, n, k, c, s)
        ab = a * a + b * b
        n2k2 = n * n + k * k
        ds = atan2(2.0 * b * c, c * c - ab)
        dp = atan2(2.0 * c * ((n * n - k * k) * b - 2.0 * n * k * a), n2k2 * n2k2 * c * c - ab)
        size = sqrt(Fs * Fp)
        return Fs, Fp, 0.5 * (Fs - Fp), cos(ds - dp) * size, sin(dp - ds) * size

    return reflect


def textbook_transmission(xp: Primitives) -> KernelFunction:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Ts, Tp, B, C, S)``: what is not reflected.

    T = 1 - F, and C + iS = sqrt(Ts Tp) with the phase of t_s / t_p, which is 0 unless
    the medium absorbs.
    """
    printed, sqrt, atan2, sin, cos = _printed(xp), xp.sqrt, xp.atan2, xp.sin, xp.cos

    def transmit(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        n, k, a, b, Fs, Fp = printed(n1, n, k, c, s)
        Ts, Tp = 1.0 - Fs, 1.0 - Fp
        phase = atan2(c * b, s * s + c * a) - atan2(k, n)
        size = sqrt(xp.maximum(Ts, 0.0) * xp.maximum(Tp, 0.0))
        return Ts, Tp, 0.5 * (Ts - Tp), cos(phase) * size, sin(phase) * size

    return transmit


def _printed(xp: Primitives) -> KernelFunction:
    sqrt, where, maximum, absolute = xp.sqrt, xp.where, xp.maximum, xp.absolute

    def printed(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        """Return the relative n and k, a and b, and F_s and F_p."""
        n, k = n / n1, absolute(k / n1)
        nk = n * k
        x = n * n - k * k - s * s
        root = sqrt(x * x + 4.0 * nk * nk)
        a = sqrt(maximum(0.5 * (root + x), 0.0))
        b = sqrt(maximum(0.5 * (root - x), 0.0))
        ab = a * a + b * b
        # The printed form divides by cos; the floor keeps tan finite at 90 degrees.
        st = s * (s / maximum(c, 1e-18))
        # On an equal medium at 90 degrees both fractions are 0/0; the floors make them 0.
        squared = ab - 2.0 * a * c + c * c
        # Some engines' maximum would make a number of an angle that is none.
        squared = where(squared < 0.0, 0.0, squared)
        Fs = squared / maximum(ab + 2.0 * a * c + c * c, 1e-37)
        ratio = maximum(ab - 2.0 * a * st + st * st, 0.0) / maximum(
            ab + 2.0 * a * st + st * st, 1e-37
        )
        return n, k, a, b, Fs, Fs * ratio

    return printed
