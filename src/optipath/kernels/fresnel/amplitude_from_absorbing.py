"""Fresnel's equations out of an absorbing medium by their complex amplitudes, as first written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.amplitude import power, ratio, times, times_conjugate
from optipath.kernels.fresnel.inhomogeneous import inhomogeneous_boundary

if TYPE_CHECKING:
    from optipath.kernels.fresnel.amplitude import Complex
    from optipath.kernels.fresnel.inhomogeneous import InhomogeneousBoundary
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def amplitude_inhomogeneous_reflection(xp: Primitives) -> KernelFunction:
    """Make the kernel ``(n1, k1, n, k, [n0,] cos, sin) -> (Fs, Fp, B, C, S)``.

    r_s = (g1 - g2) / (g1 + g2) and r_p = (m2^2 g1 - m1^2 g2) / (m2^2 g1 + m1^2 g2).
    """
    boundary = inhomogeneous_boundary(xp)

    def reflect(*given: Any) -> tuple[Any, ...]:
        at = boundary(*given)
        g1, g2, first, second = _waves(at)
        rs = ratio(xp, _less(g1, g2), _plus(g1, g2))
        rp = ratio(xp, _less(first, second), _plus(first, second))
        Fs, Fp = power(rs), power(rp)
        return Fs, Fp, 0.5 * (Fs - Fp), *times_conjugate(rs, rp)

    return reflect


def amplitude_inhomogeneous_transmission(xp: Primitives) -> KernelFunction:
    """Make the kernel ``(n1, k1, n, k, [n0,] cos, sin) -> (Ts, Tp, B, C, S)``.

    t_s = 2 g1 / (g1 + g2), t_p = 2 m1 m2 g1 / (m2^2 g1 + m1^2 g2), T_s = |t_s|^2 Re g2 / Re g1,
    T_p = |t_p|^2 Re(m2 conj(g2 / m2)) / Re(m1 conj(g1 / m1)).
    """
    boundary, transmitted = inhomogeneous_boundary(xp), _transmitted(xp)
    return lambda *given: transmitted(boundary(*given))


def amplitude_transmission_from_behind(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, [n0,] cos, sin) -> (Ts, Tp, B, C, S)`` for light from behind."""
    boundary, transmitted = inhomogeneous_boundary(xp), _transmitted(xp)
    return lambda *given: transmitted(boundary(*given).from_behind(xp.where))


def _transmitted(xp: Primitives) -> Any:
    where, sqrt, maximum = xp.where, xp.sqrt, xp.maximum

    def transmitted(at: InhomogeneousBoundary) -> tuple[Any, ...]:
        g1, g2, first, second = _waves(at)
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
        re, im = times_conjugate(ts, tp)
        length = sqrt(re * re + im * im)
        share = sqrt(Ts) * sqrt(Tp) / where(length > 0.0, length, 1.0)
        return Ts, Tp, 0.5 * (Ts - Tp), share * re, share * im

    return transmitted


def _waves(at: InhomogeneousBoundary) -> tuple[Complex, Complex, Complex, Complex]:
    """Return g1, g2, m2^2 g1 and m1^2 g2."""
    g1, g2 = (at.n1 * at.c, at.n1 * at.e), (at.a, at.b)
    m1, m2 = (at.n1, at.n1 * at.kappa), (at.n, at.k)
    return g1, g2, times(times(m2, m2), g1), times(times(m1, m1), g2)


def _plus(first: Complex, second: Complex) -> Complex:
    return first[0] + second[0], first[1] + second[1]


def _less(first: Complex, second: Complex) -> Complex:
    return first[0] - second[0], first[1] - second[1]
