"""Fresnel's equations that keep their digits: products and sums of non-negative terms."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.fresnel.boundary import (
    Across,
    Boundary,
    absorbing_boundary,
    denser_boundary,
    lossless_boundary,
)
from optipath.kernels.vectors import hypotenuse

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.fresnel.boundary import InhomogeneousBoundary
    from optipath.kernels.primitives import Primitives


_LOST, _LEAST, _EQUAL = 2.0**-52, 2.0**-970, 2.0**-120
"""What the first takes to 0 has lost digits; below the second, the inverse is too large; squares of
media that differ by less than the third, with an inverse in float32, are equal."""


def _reflected(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    """Make ``Boundary -> (Fs, Fp, B, C, S)``.

    With p = n1 cos, z = (n1 sin)^2, D = m2^2 - n1^2 and g = a + ib = sqrt(m2^2 - z):
    r_s = -D / (p + g)^2 and r_p / r_s = (z - p g) / (z + p g), which are the
    Fresnel equations (Born & Wolf, Principles of Optics, sec. 1.5 and 14.2) freed
    of differences between nearly equal numbers. Total reflection gives
    Fs = Fp = 1 and B = 0 exactly.
    """
    where, first = xp.where, _first(xp)
    return lambda at: in_plane(where, first(at)[0], slant(at), at.c)


stable_reflection = Across(absorbing_boundary, _reflected)
lossless_reflection = Across(lossless_boundary, _reflected)
denser_reflection = Across(denser_boundary, _reflected)
"""Cheaper ones for k = 0, and for n >= n1 besides."""


def _let_through(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    """Make ``Boundary -> (Ts, Tp, B, C, S)`` of the power let through.

    Ts = 4 p a / |p + g|^2, Tp = Ts n1^2 (|g|^2 + z) / |z + p g|^2, and t_s / t_p =
    (z + p g) / (n1 m2). In a medium that absorbs, C and S have the phase between the
    fields just behind the boundary.
    """
    sqrt, where, length, transmitted = xp.sqrt, xp.where, hypotenuse(xp), _transmitted(xp)

    def transmit(at: Boundary) -> tuple[Any, ...]:
        powers, (re, im), behind, q = transmitted(at)
        size = length(at.n, at.k)
        n, k = (part / where(size > 0.0, size, 1.0) for part in (at.n, at.k))
        share = powers[0] * sqrt(behind / q) / sqrt(q)
        absorbs = at.k > 0.0
        C = where(absorbs, share * (re * n + im * k), _lossless(where, powers[0], at, re))
        # Im(g conj m2) without a difference, from g - m2 = -(n1 sin)^2 / (g + m2).
        re, im = at.a + at.n, at.b + at.k
        sum2 = re * re + im * im
        apart = at.c * at.n1 * (n * im + k * re) / where(sum2 > 0.0, sum2, 1.0) - k
        # Adding 0 turns -0 into 0.
        return *powers, C, where(absorbs, share * at.n1 * (at.s * at.s) * apart, 0.0) + 0.0

    return transmit


def _let_through_lossless(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    where, transmitted = xp.where, _transmitted(xp)

    def transmit(at: Boundary) -> tuple[Any, ...]:
        powers, (re, _), _, _ = transmitted(at)
        return *powers, _lossless(where, powers[0], at, re), 0.0

    return transmit


stable_transmission = Across(absorbing_boundary, _let_through)
lossless_transmission = Across(lossless_boundary, _let_through_lossless)


def _lossless(where: Callable[..., Any], Ts: Any, at: Boundary, re: Any) -> Any:
    """Return C = sqrt(Ts Tp) where nothing absorbs: n1 n2 Ts / (z + p a)."""
    return Ts * at.n / where(re > 0.0, re, 1.0)


def _first(xp: Primitives) -> Callable[[Boundary], tuple[Any, Any]]:
    where = xp.where

    def first(at: Boundary) -> tuple[Any, Any]:
        """Return Fs and Ts."""
        _, Ts, small = through_and_back(where, *at.squares, at.D, at.v)
        # The smaller of the two carries the digits of both.
        return where(Ts < 0.6, 1.0 - Ts, small), where(Ts < 0.6, Ts, 1.0 - small)

    return first


def through_and_back(
    where: Callable[..., Any], even: Any, mixed: Any, D: Any, v: Any
) -> tuple[Any, Any, Any]:
    """Return P = |g1 + g2|^2, 1 - Fs, and Fs, which has its digits where it is small."""
    P = even + mixed
    # At grazing incidence on an equal medium there is no interface. Asked so that NaN stays NaN.
    vanishes, missing = P < _EQUAL, mixed - (P - even)
    P = where(vanishes, 1.0, P)
    inverse = 1.0 / P
    # A quotient has one rounding less than a product with an inverse.
    re, im = D / P, v * inverse
    small = re * re + im * im
    # What the sum P has lost is known exactly, since its first term is the larger.
    twice = 2.0 * inverse
    return P, where(vanishes, 1.0, mixed * twice), small - missing * twice * small


def sum_squared(at: Boundary | InhomogeneousBoundary) -> Any:
    """Return P = |g1 + g2|^2."""
    even, mixed = at.squares
    return even + mixed


class Slant(NamedTuple):
    """How r_p differs from r_s: by z and p g, all of it divided by n1."""

    z: Any
    ca: Any
    cb: Any
    z2: Any
    g2: Any
    q: Any

    @property
    def less(self) -> Any:
        """|z - c g|^2, which over q is |r_p / r_s|^2."""
        return (self.z - self.ca) * (self.z - self.ca) + self.cb * self.cb


def slant(at: Boundary) -> Slant:
    """Return how the two polarisations differ at a boundary."""
    z, ca, cb = at.n1 * (at.s * at.s), at.c * at.a, at.c * at.b
    z2, g2 = z * z, at.c * at.c * at.squared
    return Slant(z, ca, cb, z2, g2, (z2 + g2) + 2.0 * z * ca)


def is_there(where: Callable[..., Any], q: Any) -> tuple[Any, Any]:
    """Return whether the q of a `Slant` is there, and q where it is."""
    # It vanishes, or underflows, next to exactly normal and exactly grazing incidence only,
    # where the limits are known; at 90 degrees they are exact.
    there = (_LOST * q > 0.0) & (q > _LEAST)
    return there, where(there, q, 1.0)


def in_plane(
    where: Callable[..., Any], Fs: Any, along: Slant, c: Any
) -> tuple[Any, Any, Any, Any, Any]:
    """Return (Fs, Fp, B, C, S) of what is reflected, from Fs."""
    there, q = is_there(where, along.q)
    f = Fs / q
    parted = 2.0 * f * along.z
    B, S = parted * along.ca, parted * along.cb
    # The difference is the better one unless it cancels, and exact in total reflection.
    Fp = where(Fs > 4.0 * B, Fs - 2.0 * B, f * along.less)
    # Near the normal C is -A, and a little of what is small there.
    near = 4.0 * along.z2 < along.g2
    C = where(near, parted * along.z - (Fs - B), f * (along.z2 - along.g2))
    return Fs, Fp, B, where(there & (c > 0.0), C, where(c < along.z, Fs, -Fs)), S


def _transmitted(xp: Primitives) -> Callable[[Boundary], tuple[Any, ...]]:
    where, first = xp.where, _first(xp)

    def transmitted(at: Boundary) -> tuple[Any, ...]:
        """Return (Ts, Tp, B), (z + p g) / n1, |g|^2 + z, and |z + p g|^2 / n1^2."""
        Fs, Ts = first(at)
        along = slant(at)
        _, q = is_there(where, along.q)
        behind = at.squared + at.n1 * along.z
        B = 0.0 - 2.0 * Fs / q * (at.s * at.s) * at.c * at.a * at.n1
        powers = Ts, Ts * (behind / q), B
        return powers, (along.z + along.ca, along.cb), behind, q

    return transmitted
