"""Fresnel's equations that keep their digits: products and sums of non-negative terms."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.boundary import (
    Boundary,
    absorbing_boundary,
    hypotenuse,
    lossless_boundary,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


_LEAST = 2.0**-52
"""What it takes to nothing has lost digits to an underflow already."""


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
    sqrt, where, length = xp.sqrt, xp.where, hypotenuse(xp)

    def transmit(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        at = boundary(n1, n, k, c, s)
        powers, (re, im), behind, q = transmitted(at)
        size = length(at.n, at.k)
        share = sqrt(behind) / q / where(size > 0.0, size, 1.0)
        C, S = share * (re * at.n + im * at.k), share * (im * at.n - re * at.k)
        absorbs = at.k > 0.0
        C = where(absorbs, C * powers[0], _lossless(where, powers[0], at, re))
        return *powers, C, where(absorbs, S * powers[0], 0.0)

    return transmit


def lossless_transmission(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make the kernel ``(n1, n, cos, sin) -> (Ts, Tp, B, C, S)``: the same, cheaper, for k = 0."""
    boundary, transmitted = lossless_boundary(xp), _transmitted(xp)
    where = xp.where

    def transmit(n1: Any, n: Any, c: Any, s: Any) -> tuple[Any, ...]:
        at = boundary(n1, n, c, s)
        powers, (re, _), _, _ = transmitted(at)
        return *powers, _lossless(where, powers[0], at, re), 0.0

    return transmit


def _lossless(where: Callable[..., Any], Ts: Any, at: Boundary, re: Any) -> Any:
    """Return C = sqrt(Ts Tp) where nothing absorbs: n1 n2 Ts / (z + p a)."""
    return Ts * at.n / where(re > 0.0, re, 1.0)


def _first(xp: Primitives) -> Callable[[Boundary], tuple[Any, Any]]:
    where = xp.where

    def first(at: Boundary) -> tuple[Any, Any]:
        """Return Fs and Ts."""
        P = (at.p + at.a) * (at.p + at.a) + at.b * at.b
        # P vanishes only at grazing incidence on an equal medium, which is no interface.
        there = P > 0.0
        P = where(there, P, 1.0)
        Ts = where(there, 4.0 * at.p / P * at.a, 1.0)
        re, im = at.D / P, at.v / P
        small = re * re + im * im
        # The smaller of the two carries the digits of both.
        return where(Ts < 0.6, 1.0 - Ts, small), where(Ts < 0.6, Ts, 1.0 - small)

    return first


class _Slant(NamedTuple):
    """z / n1 = n1 sin^2, c a and c b, and |z + p g|^2 / n1^2, by which r_p differs from r_s."""

    z: Any
    ca: Any
    cb: Any
    there: Any
    q: Any


def _second(xp: Primitives) -> Callable[[Boundary], _Slant]:
    where = xp.where

    def second(at: Boundary) -> _Slant:
        z, ca, cb = at.n1 * (at.s * at.s), at.c * at.a, at.c * at.b
        q = (z + ca) * (z + ca) + cb * cb
        # It vanishes, or underflows, next to exactly normal and exactly grazing incidence only,
        # where the limits are known; at 90 degrees they are exact.
        there = (_LEAST * q > 0.0) & (at.c > 0.0)
        return _Slant(z, ca, cb, there, where(there, q, 1.0))

    return second


def _reflected(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    where, first, second = xp.where, _first(xp), _second(xp)

    def reflected(at: Boundary) -> tuple[Any, ...]:
        Fs, _ = first(at)
        z, ca, cb, there, q = second(at)
        f = Fs / q
        # Factors that may be tiny come last: no digit is lost to an underflow before them.
        parted = 2.0 * f * (at.s * at.s) * at.c
        B, S = parted * at.a * at.n1, parted * at.b * at.n1
        # The difference is the better one unless it cancels, and exact in total reflection.
        Fp = where(Fs > 4.0 * B, Fs - 2.0 * B, f * ((z - ca) * (z - ca) + cb * cb))
        root = at.c * at.modulus
        C = where(there, f * (z - root) * (z + root), where(at.c < z, Fs, -Fs))
        return Fs, Fp, B, C, S

    return reflected


def _transmitted(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    first, second = _first(xp), _second(xp)

    def transmitted(at: Boundary) -> tuple[Any, ...]:
        """Return (Ts, Tp, B), (z + p g) / n1, |g|^2 + z, and |z + p g|^2 / n1^2."""
        Fs, Ts = first(at)
        z, ca, cb, _, q = second(at)
        behind = at.modulus * at.modulus + at.n1 * z
        B = 0.0 - 2.0 * Fs / q * (at.s * at.s) * at.c * at.a * at.n1
        return (Ts, Ts * behind / q, B), (z + ca, cb), behind, q

    return transmitted
