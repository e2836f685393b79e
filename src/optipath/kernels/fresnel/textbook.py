"""Fresnel's equations as textbooks print them: by angles, and by complex amplitudes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.fresnel.boundary import (
    across,
    boundary_from_behind,
    inhomogeneous_boundary,
)
from optipath.kernels.fresnel.stable import phases_through, sum_squared
from optipath.kernels.primitives import Made
from optipath.kernels.vectors import complex_root, hypotenuse

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.fresnel.boundary import InhomogeneousBoundary
    from optipath.kernels.primitives import KernelFunction, Primitives


def textbook_reflection(xp: Primitives) -> KernelFunction:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Fs, Fp, B, C, S)``.

    As Wilkie & Weidlich, "Polarised light in computer graphics" (SIGGRAPH Asia courses, 2012),
    print them, with the relative index. They lose digits near Brewster's angle, near the normal and
    at grazing incidence. Their phases are of conj(r), so the sine is of d_p - d_s here.
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
        less, more = ab - 2.0 * a * st + st * st, ab + 2.0 * a * st + st * st
        return n, k, a, b, Fs, Fs * (maximum(less, 0.0) / maximum(more, 1e-37))

    return printed


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
        return _reflected(rs, rp)

    return reflect


def _reflected(rs: Complex, rp: Complex) -> tuple[Any, ...]:
    Fs, Fp = power(rs), power(rp)
    return Fs, Fp, 0.5 * (Fs - Fp), *times_conjugate(rs, rp)


def _let_through(xp: Primitives, Ts: Any, Tp: Any, positive: Any, both: Complex) -> tuple[Any, ...]:
    """Return five numbers with the phase of t_s conj(t_p); one Tp has no rounding below 0."""
    re, im = both
    length = xp.sqrt(re * re + im * im)
    share = xp.sqrt(Ts) * xp.sqrt(positive) / xp.where(length > 0.0, length, 1.0)
    return Ts, Tp, 0.5 * (Ts - Tp), share * re, share * im


def plain_amplitudes(_: Primitives) -> KernelFunction:
    """Make ``(Re rs, Im rs, Re rp, Im rp) -> (Fs, Fp, B, C, S)``.

    B = Re((rs - rp) conj(rs + rp)) / 2, where Fs - Fp would lose digits.
    """

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
    waves, where = _waves(xp), xp.where

    def transmit(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        m, m2, g = waves(n1, n, k, s)
        ts = ratio(xp, (2.0, 0.0), (c + g[0], g[1]))
        tp = ratio(xp, (2.0 * m[0], 2.0 * m[1]), (m2[0] * c + g[0], m2[1] * c + g[1]))
        size = power(m)
        Ts = power(ts) * c * g[0]
        through = times_conjugate(g, m2)[0] / where(size > 0.0, size, 1.0)
        Tp = power(tp) * c * through
        return _let_through(xp, Ts, Tp, xp.maximum(Tp, 0.0), times_conjugate(ts, tp))

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


def _reflected_at(xp: Primitives) -> Callable[[InhomogeneousBoundary], tuple[Any, ...]]:
    """Make (Fs, Fp, B, C, S) of a boundary.

    r_s = (g1 - g2) / (g1 + g2) and r_p = (m2^2 g1 - m1^2 g2) / (m2^2 g1 + m1^2 g2).
    """

    def reflect(at: InhomogeneousBoundary) -> tuple[Any, ...]:
        g1, g2, first, second = _absorbing_waves(at)
        rs, rp = (
            ratio(xp, (a - c, b - d), (a + c, b + d))
            for (a, b), (c, d) in ((g1, g2), (first, second))
        )
        return _reflected(rs, rp)

    return reflect


def _transmitted_at(xp: Primitives) -> Callable[[InhomogeneousBoundary], tuple[Any, ...]]:
    """Make (Ts, Tp, B, C, S) of a boundary.

    t_s = 2 g1 / (g1 + g2), t_p = 2 m1 m2 g1 / (m2^2 g1 + m1^2 g2), T_s = |t_s|^2 Re g2 / Re g1,
    T_p = |t_p|^2 Re(m2 conj(g2 / m2)) / Re(m1 conj(g1 / m1)).
    """
    where, maximum = xp.where, xp.maximum

    def transmitted(at: InhomogeneousBoundary) -> tuple[Any, ...]:
        g1, g2, first, second = _absorbing_waves(at)
        m1, m2 = (at.n1, at.n1 * at.kappa), (at.n, at.k)
        ts = ratio(xp, (2.0 * g1[0], 2.0 * g1[1]), _plus(g1, g2))
        both = times(times(m1, m2), g1)
        tp = ratio(xp, (2.0 * both[0], 2.0 * both[1]), _plus(first, second))
        arriving = times_conjugate(m1, ratio(xp, g1, m1))[0]
        carried = maximum(times_conjugate(m2, ratio(xp, g2, m2))[0], 0.0)
        # Where no wave arrives, none is let through.
        there = (g1[0] > 0.0) & (arriving > 0.0)
        Ts = where(there, power(ts) * g2[0] / where(there, g1[0], 1.0), 0.0)
        Tp = where(there, power(tp) * carried / where(there, arriving, 1.0), 0.0)
        return _let_through(xp, Ts, Tp, Tp, times_conjugate(ts, tp))

    return transmitted


amplitude_inhomogeneous_reflection = Made(across, inhomogeneous_boundary, _reflected_at)
amplitude_inhomogeneous_transmission = Made(across, inhomogeneous_boundary, _transmitted_at)
amplitude_transmission_from_behind = Made(across, boundary_from_behind, _transmitted_at)
"""Kernels of ``(n1, k1, n, k, [n0,] cos, sin)``."""


def _absorbing_waves(at: InhomogeneousBoundary) -> tuple[Complex, Complex, Complex, Complex]:
    """Return g1, g2, m2^2 g1 and m1^2 g2."""
    g1, g2 = (at.n1 * at.c, at.n1 * at.e), (at.a, at.b)
    m1, m2 = (at.n1, at.n1 * at.kappa), (at.n, at.k)
    return g1, g2, times(times(m2, m2), g1), times(times(m1, m1), g2)


def _plus(first: Complex, second: Complex) -> Complex:
    return first[0] + second[0], first[1] + second[1]


def _amplitudes_at(xp: Primitives) -> Callable[[InhomogeneousBoundary], tuple[Any, ...]]:
    """Make (Re, Im of r_s, of r_p, of t_s, of t_p) of a boundary.

    With g1 and g2 along the normal, y along the face and g2 - g1 = (m2^2 - m1^2) / (g1 + g2):
    r_s = (g1 - g2) / (g1 + g2), t_s = 1 + r_s, r_p / r_s = (y^2 - g1 g2) / (y^2 + g1 g2) and
    t_p / t_s = m1 m2 / (y^2 + g1 g2), as in `inhomogeneous_reflection` and
    `inhomogeneous_transmission`.
    """
    of_s, of_p = _along_s(xp), _along_p(xp)

    def amplitudes(at: InhomogeneousBoundary) -> tuple[Any, ...]:
        rs, ts = of_s(at)
        rp, tp = of_p(at, rs, ts)
        # Adding 0 turns -0 into 0.
        return tuple(part + 0.0 for number in (rs, rp, ts, tp) for part in number)

    return amplitudes


single_amplitudes = Made(across, inhomogeneous_boundary, _amplitudes_at)


def _along_s(xp: Primitives) -> Callable[[InhomogeneousBoundary], tuple[Complex, Complex]]:
    where = xp.where

    def along_s(at: InhomogeneousBoundary) -> tuple[Complex, Complex]:
        """Return r_s and t_s."""
        P = sum_squared(at)
        # It vanishes only at grazing incidence on an equal medium, which is no interface.
        vanishes = P <= 0.0
        P = where(vanishes, 1.0, P)
        re, im = at.p + at.a, at.fades + at.b
        # g2 - g1. Where nothing fades in front, its imaginary part is that of g2, with all digits.
        less = (at.D * re + at.v * im) / P
        more = where(at.fades > 0.0, (at.v * re - at.D * im) / P, at.b)
        both = 2.0 * (at.fades * less - at.p * more) / P
        through = where(vanishes, 1.0, 2.0 * (at.p * re + at.fades * im) / P)
        return (-(less * re + more * im) / P, both), (through, both)

    return along_s


def _along_p(xp: Primitives) -> Callable[..., tuple[Complex, Complex]]:
    where, length = xp.where, hypotenuse(xp)

    def along_p(at: InhomogeneousBoundary, rs: Complex, ts: Complex) -> tuple[Complex, Complex]:
        """Return r_p and t_p."""
        along = at.slant(where)
        q = length(xp.absolute(along.z + along.re), along.im)
        there = q > 0.0
        q = where(there, q, 1.0)
        u, w = (along.z + along.re) / q, along.im / q
        Z = (along.z - along.re) / q * u - w * w, -2.0 * (along.z / q) * w
        # It vanishes next to a medium of index 0 only: next to the normal, or at grazing incidence.
        sign = where(at.c > at.s, -1.0, 1.0)
        Z = where(there, Z[0], sign), where(there, Z[1], 0.0)
        return times(rs, Z), times(ts, _share_of_p(at, u, w, q))

    def _share_of_p(at: InhomogeneousBoundary, u: Any, w: Any, q: Any) -> Complex:
        """Return m1 m2 / (y^2 + g1 g2)."""
        size = length(at.n, at.k)
        safe = where(size > 0.0, size, 1.0)
        of_second, of_first = phases_through(where, at, at.n / safe, at.k / safe)
        re = u * ((at.n - at.kappa * at.k) / q) + w * ((at.k + at.kappa * at.n) / q)
        im = at.s * at.s * (at.n1 * of_second + size * of_first) / q * (size / q)
        return re, -im

    return along_p
