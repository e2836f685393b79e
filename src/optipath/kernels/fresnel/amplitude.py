"""Fresnel's equations by their complex amplitudes, as one would write them down first."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.numbers.complex_pairs import complex_root

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

Complex: TypeAlias = tuple[Any, Any]
"""Real and imaginary part: every engine has real numbers, not every one complex ones."""


def amplitude_reflection(xp: Primitives) -> KernelFunction:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Fs, Fp, B, C, S)``.

    With the relative index m and g = sqrt(m^2 - sin^2): r_s = (cos - g) / (cos + g) and
    r_p = (m^2 cos - g) / (m^2 cos + g) (Born & Wolf, Principles of Optics, sec. 1.5.2).
    The differences lose digits near the normal, near Brewster's angle, at grazing
    incidence, at the critical angle and between nearly equal media.
    """
    waves = _waves(xp)

    def reflect(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        _, m2, g = waves(n1, n, k, s)
        second = (m2[0] * c, m2[1] * c)
        rs = ratio(xp, (c - g[0], -g[1]), (c + g[0], g[1]))
        rp = ratio(xp, (second[0] - g[0], second[1] - g[1]), (second[0] + g[0], second[1] + g[1]))
        Fs, Fp = power(rs), power(rp)
        return Fs, Fp, 0.5 * (Fs - Fp), *times_conjugate(rs, rp)

    return reflect


def given_amplitudes(xp: Primitives) -> KernelFunction:
    """Make ``(Re rs, Im rs, Re rp, Im rp) -> (Fs, Fp, B, C, S)``.

    B = Re((rs - rp) conj(rs + rp)) / 2, which keeps the digits of what is given where the
    difference of Fs and Fp would lose them.
    """
    del xp

    def reflect(a: Any, b: Any, c: Any, d: Any) -> tuple[Any, ...]:
        rs, rp = (a, b), (c, d)
        B = 0.5 * times_conjugate((a - c, b - d), (a + c, b + d))[0]
        return power(rs), power(rp), B, *times_conjugate(rs, rp)

    return reflect


def amplitude_transmission(xp: Primitives) -> KernelFunction:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Ts, Tp, B, C, S)`` of the power let through.

    t_s = 2 cos / (cos + g), t_p = 2 m cos / (m^2 cos + g), T_s = |t_s|^2 Re g / cos,
    T_p = |t_p|^2 Re(g conj(m^2)) / (|m|^2 cos), and C + iS has the phase of t_s conj(t_p).
    """
    waves, sqrt, where = _waves(xp), xp.sqrt, xp.where

    def transmit(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        m, m2, g = waves(n1, n, k, s)
        ts = ratio(xp, (2.0, 0.0), (c + g[0], g[1]))
        tp = ratio(xp, (2.0 * m[0], 2.0 * m[1]), (m2[0] * c + g[0], m2[1] * c + g[1]))
        size = power(m)
        Ts = power(ts) * c * g[0]
        through = times_conjugate(g, m2)[0] / where(size > 0.0, size, 1.0)
        Tp = power(tp) * c * through
        re, im = times_conjugate(ts, tp)
        length = sqrt(re * re + im * im)
        share = sqrt(Ts) * sqrt(xp.maximum(Tp, 0.0)) / where(length > 0.0, length, 1.0)
        return Ts, Tp, 0.5 * (Ts - Tp), share * re, share * im

    return transmit


def _waves(xp: Primitives) -> Callable[..., tuple[Complex, Complex, Complex]]:
    root = complex_root(xp)

    def waves(n1: Any, n: Any, k: Any, s: Any) -> tuple[Complex, Complex, Complex]:
        """Return m, m^2 and g."""
        n, k = n / n1, xp.absolute(k / n1)
        square = n * n - k * k
        a, b, _ = root(square - s * s, n, k)
        return (n, k), (square, 2.0 * n * k), (a, b)

    return waves


def ratio(xp: Primitives, top: Complex, bottom: Complex) -> Complex:
    """Return a quotient of two complex numbers; where the second is 0, the first."""
    size = power(bottom)
    size = xp.where(size > 0.0, size, 1.0)
    re, im = times_conjugate(top, bottom)
    return re / size, im / size


def times(first: Complex, second: Complex) -> Complex:
    """Return the product of two complex numbers."""
    (a, b), (c, d) = first, second
    return a * c - b * d, a * d + b * c


def times_conjugate(first: Complex, second: Complex) -> Complex:
    """Return a complex number times the conjugate of another."""
    (a, b), (c, d) = first, second
    return a * c + b * d, b * c - a * d


def power(value: Complex) -> Any:
    """Return the square of the length of a complex number."""
    re, im = value
    return re * re + im * im
