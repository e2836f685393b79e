"""Fresnel's equations that keep their digits: products and sums of non-negative terms."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.boundary import Boundary, absorbing_boundary, lossless_boundary

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
    boundary, reflected = absorbing_boundary(xp), _reflected(xp)
    return lambda n1, n, k, c, s: reflected(boundary(n1, n, k, c, s))


def lossless_reflection(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make the kernel ``(n1, n, cos, sin) -> (Fs, Fp, B, C, S)``: the same, cheaper, for k = 0."""
    boundary, reflected = lossless_boundary(xp), _reflected(xp)
    return lambda n1, n, c, s: reflected(boundary(n1, n, c, s))


def stable_transmission(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make the kernel ``(n1, n, k, cos, sin) -> (Ts, Tp, B, C, S)`` of the power let through.

    Ts = 4 p a / |p + g|^2, Tp = Ts n1^2 (|g|^2 + z) / |z + p g|^2, and t_s / t_p =
    (z + p g) / (n1 m2). In a medium that absorbs, C and S have the phase between the
    fields just behind the boundary.
    """
    boundary, transmitted = absorbing_boundary(xp), _transmitted(xp)
    sqrt, where = xp.sqrt, xp.where

    def transmit(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        at = boundary(n1, n, k, c, s)
        powers, (re, im), behind, inverse = transmitted(at)
        size = at.n * at.n + at.k * at.k
        share = powers[0] * inverse * sqrt(behind / where(size > 0.0, size, 1.0))
        return *powers, share * (re * at.n + im * at.k), share * (im * at.n - re * at.k)

    return transmit


def lossless_transmission(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make the kernel ``(n1, n, cos, sin) -> (Ts, Tp, B, C, S)``: the same, cheaper, for k = 0."""
    boundary, transmitted = lossless_boundary(xp), _transmitted(xp)
    where = xp.where

    def transmit(n1: Any, n: Any, c: Any, s: Any) -> tuple[Any, ...]:
        at = boundary(n1, n, c, s)
        powers, (re, _), _, _ = transmitted(at)
        return *powers, powers[0] * at.n / where(re > 0.0, re, 1.0), 0.0

    return transmit


def _first(xp: Primitives) -> Callable[[Boundary], tuple[Any, Any]]:
    where = xp.where

    def first(at: Boundary) -> tuple[Any, Any]:
        """Return Fs and Ts."""
        P = (at.p + at.a) * (at.p + at.a) + at.b * at.b
        # P vanishes only at grazing incidence on an equal medium, which is no interface.
        there = P > 0.0
        inverse = 1.0 / where(there, P, 1.0)
        Ts = where(there, 4.0 * at.p * at.a * inverse, 1.0)
        dr, di = at.D * inverse, at.v * inverse
        return where(Ts < 0.5, 1.0 - Ts, dr * dr + di * di), Ts

    return first


def _second(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    where = xp.where

    def second(at: Boundary) -> tuple[Any, ...]:
        """Return c a, c b, where z + p g is not 0, and n1^2 / |z + p g|^2."""
        ca, cb = at.c * at.a, at.c * at.b
        q = (at.z + ca) * (at.z + ca) + cb * cb
        slanted = q > 0.0
        return ca, cb, slanted, 1.0 / where(slanted, q, 1.0)

    return second


def _reflected(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    where, first, second = xp.where, _first(xp), _second(xp)

    def reflected(at: Boundary) -> tuple[Any, ...]:
        Fs, _ = first(at)
        ca, cb, slanted, inverse = second(at)
        f = Fs * inverse
        B = 2.0 * f * at.z * ca
        # The difference is the better one unless it cancels, and exact in total reflection.
        apart = at.z - ca
        Fp = where(4.0 * B < Fs, Fs - 2.0 * B, f * (apart * apart + cb * cb))
        root = at.c * at.modulus
        # z + p g vanishes, or its square underflows, at normal and at grazing incidence only.
        limit = where(at.c < at.z, Fs, -Fs)
        C = where(slanted, f * (at.z - root) * (at.z + root), limit)
        S = 2.0 * f * at.z * cb
        return Fs, Fp, B, C, S

    return reflected


def _transmitted(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    first, second = _first(xp), _second(xp)

    def transmitted(at: Boundary) -> tuple[Any, ...]:
        """Return (Ts, Tp, B), z + p g, |g|^2 + z, and n1^2 / |z + p g|^2."""
        Fs, Ts = first(at)
        ca, cb, _, inverse = second(at)
        behind = at.modulus * at.modulus + at.n1 * at.z
        B = -2.0 * Fs * at.z * ca * inverse
        return (Ts, Ts * behind * inverse, B), (at.z + ca, cb), behind, inverse

    return transmitted
