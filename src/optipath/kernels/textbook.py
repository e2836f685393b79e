"""Fresnel reflection in the angle form that textbooks print."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


def textbook_reflection(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Fs, Fp, B, C, S)``.

    The formulas as Wilkie & Weidlich, "Polarised light in computer graphics"
    (SIGGRAPH Asia courses, 2012), print them, with the relative index. They lose
    digits near Brewster's angle, near the normal and at grazing incidence.
    Their phases are those of conj(r), so the sine is taken of d_p - d_s here.
    """
    sqrt, maximum, atan2, sin, cos = xp.sqrt, xp.maximum, xp.atan2, xp.sin, xp.cos

    def reflect(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        n = n / n1
        k = k / n1
        nk = n * k
        e2 = n * n - k * k
        x = e2 - s * s
        root = sqrt(x * x + 4.0 * nk * nk)
        a = sqrt(maximum(0.5 * (root + x), 0.0))
        b = sqrt(maximum(0.5 * (root - x), 0.0))
        ab = a * a + b * b
        # The printed form divides by cos; the floor keeps tan finite at 90 degrees.
        st = s * (s / maximum(c, 1e-18))

        # On an equal medium at 90 degrees both fractions are 0/0; the floors make them 0.
        Fs = maximum(ab - 2.0 * a * c + c * c, 0.0) / maximum(ab + 2.0 * a * c + c * c, 1e-37)
        ratio = maximum(ab - 2.0 * a * st + st * st, 0.0) / maximum(
            ab + 2.0 * a * st + st * st, 1e-37
        )
        Fp = Fs * ratio

        n2k2 = n * n + k * k
        ds = atan2(2.0 * b * c, c * c - ab)
        dp = atan2(2.0 * c * (e2 * b - 2.0 * nk * a), n2k2 * n2k2 * c * c - ab)
        magnitude = sqrt(Fs * Fp)
        return (
            Fs,
            Fp,
            0.5 * (Fs - Fp),
            cos(ds - dp) * magnitude,
            sin(dp - ds) * magnitude,
        )

    return reflect
