"""Fresnel's equations that keep their digits: products and sums of non-negative terms.

Of an arriving and a reflected wave in an absorbing medium each carries power, and the two
together carry more or less by their interference: what is reflected and what is let through do
not add up to 1 there (Born & Wolf, Principles of Optics, sec. 14; S. J. Byrnes, "Multilayer
optical calculations", arXiv:1603.02720).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.fresnel.boundary import (
    Boundary,
    InhomogeneousBoundary,
    absorbing_boundary,
    across,
    boundary_from_behind,
    denser_boundary,
    inhomogeneous_boundary,
    lossless_boundary,
)
from optipath.kernels.primitives import Made
from optipath.kernels.vectors import hypotenuse

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.fresnel.boundary import Slant
    from optipath.kernels.primitives import KernelFunction, Primitives


AnyBoundary: TypeAlias = Boundary | InhomogeneousBoundary

_LOST, _LEAST, _EQUAL = 2.0**-52, 2.0**-970, 2.0**-120
"""What the first takes to 0 has lost digits; below the second, the inverse is too large; squares of
media that differ by less than the third, with an inverse in float32, are equal."""


def _reflected(xp: Primitives) -> Callable[[AnyBoundary], tuple[Any, ...]]:
    """Make ``Boundary -> (Fs, Fp, B, C, S)``; out of an absorbing medium, the same from behind.

    With g1 and g2 along the normal, z = (n1 sin)^2 and D = m2^2 - m1^2: r_s = -D / (g1 + g2)^2
    and r_p / r_s = (z - g1 g2) / (z + g1 g2), which are the Fresnel equations (Born & Wolf,
    Principles of Optics, sec. 1.5 and 14.2) freed of differences between nearly equal numbers.
    Total reflection gives Fs = Fp = 1 and B = 0 exactly.
    """
    where, first = xp.where, _first(xp)
    return lambda at: in_plane(where, first(at)[0], at.slant(where), at.c)


stable_reflection = Made(across, absorbing_boundary, _reflected)
lossless_reflection = Made(across, lossless_boundary, _reflected)
denser_reflection = Made(across, denser_boundary, _reflected)
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


stable_transmission = Made(across, absorbing_boundary, _let_through)
lossless_transmission = Made(across, lossless_boundary, _let_through_lossless)


def _lossless(where: Callable[..., Any], Ts: Any, at: Boundary, re: Any) -> Any:
    """Return C = sqrt(Ts Tp) where nothing absorbs: n1 n2 Ts / (z + p a)."""
    return Ts * at.n / where(re > 0.0, re, 1.0)


def _first(xp: Primitives) -> Callable[[AnyBoundary], tuple[Any, Any]]:
    where = xp.where

    def first(at: AnyBoundary) -> tuple[Any, Any]:
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


def sum_squared(at: AnyBoundary) -> Any:
    """Return P = |g1 + g2|^2."""
    even, mixed = at.squares
    return even + mixed


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
    B, S = parted * along.re, parted * along.im
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
        along = at.slant(where)
        _, q = is_there(where, along.q)
        behind = at.squared + at.n1 * along.z
        B = 0.0 - 2.0 * Fs / q * (at.s * at.s) * at.c * at.a * at.n1
        powers = Ts, Ts * (behind / q), B
        return powers, (along.z + along.re, along.im), behind, q

    return transmitted


def _transmitted_within(xp: Primitives) -> Callable[[InhomogeneousBoundary], tuple[Any, ...]]:
    """Make ``InhomogeneousBoundary -> (Ts, Tp, B, C, S)``.

    It is the power that is carried behind over that which arrives, of the arriving wave alone:
    Ts = 4 |g1|^2 Re g2 / (Re g1 |g1 + g2|^2), Tp / Ts = (|g2|^2 + y^2) |m1|^4 /
    ((|g1|^2 + y^2) |y^2 + g1 g2|^2), and t_s / t_p = (y^2 + g1 g2) / (m1 m2) (S. J. Byrnes,
    arXiv:1603.02720, where Tp = |t_p|^2 Re(m2 conj(cos2)) / Re(m1 conj(cos1))).
    """
    where, sqrt, length = xp.where, xp.sqrt, hypotenuse(xp)

    def transmitted(at: InhomogeneousBoundary) -> tuple[Any, ...]:
        P, entering, small = through_and_back(where, *at.squares, at.D, at.v)
        Fs = where(entering < 0.6, 1.0 - entering, small)
        # Where no wave arrives, none is let through.
        arrives = at.c > 0.0
        more = where(arrives, at.e * (at.e / where(arrives, at.c, 1.0)), 0.0)
        direct = (entering < 0.6) | (at.fades > 0.0)
        Ts = where(direct, 4.0 * (at.p + at.n1 * more) * at.a * (1.0 / P), 1.0 - small)
        along = at.slant(where)
        _, q = is_there(where, along.q)
        behind = at.squared + at.n1 * along.z
        kappa2 = at.kappa * at.kappa
        # (|g1|^2 + y^2) / n1^2 = 1 - kappa^2 + 2 e^2, and e is at least kappa.
        before = 1.0 + (at.e * at.e + (at.e - at.kappa) * (at.e + at.kappa))
        Tp = Ts * (behind / q) * ((1.0 + kappa2) * (1.0 + kappa2) / before)
        apart = 4.0 * at.fades / P * (at.b - at.fades * (behind / (at.n1 * at.n1) / before))
        B = 0.0 - 2.0 * (Fs + apart) / q * (at.s * at.s) * (at.c + more) * at.a * at.n1
        share = Ts * sqrt(behind / q) / sqrt(q) * sqrt((1.0 + kappa2) / before)
        size = length(at.n, at.k)
        n, k = (part / where(size > 0.0, size, 1.0) for part in (at.n, at.k))
        re, im = along.z + along.re, along.im
        C = share * (re * n + im * k + at.kappa * (im * n - re * k))
        of_second, of_first = phases_through(where, at, n, k)
        S = share * at.n1 * (at.s * at.s) * of_second + share * (at.s * at.s) * size * of_first
        absorbs = (at.k > 0.0) | (at.kappa > 0.0)
        C = where(absorbs, C, Ts * at.n / where(re > 0.0, re, 1.0))
        # Adding 0 turns -0 into 0.
        return Ts, Tp, B, C, where(absorbs, S, 0.0) + 0.0

    return transmitted


inhomogeneous_reflection = Made(across, inhomogeneous_boundary, _reflected)
inhomogeneous_transmission = Made(across, inhomogeneous_boundary, _transmitted_within)
transmission_from_behind = Made(across, boundary_from_behind, _transmitted_within)
"""Kernels of ``(n1, k1, n, k, [n0,] cos, sin)``."""


def phases_through(
    where: Callable[..., Any], at: InhomogeneousBoundary, n: Any, k: Any
) -> tuple[Any, Any]:
    """Return the two parts of Im((y^2 + g1 g2) conj(m1 m2)) / y^2, without its difference.

    From g - m = -y^2 / (g + m) on both sides, (y^2 + g1 g2 - m1 m2) / y^2 is
    1 - g1 / (g2 + m2) - m2 / (g1 + m1); the first part, over n1 |m2|, is that of the first two
    terms, the second, over |m2|^2, that of the last.
    """
    kappa = at.kappa
    re, im = at.a + at.n, at.b + at.k
    sum2 = re * re + im * im
    sum2 = where(sum2 > 0.0, sum2, 1.0)
    alpha, beta = n * re - k * im, n * im + k * re
    real = n - (at.c * at.n1 * alpha + at.e * at.n1 * beta) / sum2
    imaginary = (at.c * at.n1 * beta - at.e * at.n1 * alpha) / sum2 - k
    re, im = 1.0 + at.c, at.e + kappa
    last = (im + kappa * re) / (re * re + im * im)
    return imaginary - kappa * real, last


def interference(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, n0, cos, sin) -> (Is, Ip, Is', Ip')`` with 1 = R + T + I.

    The last two are those of light from behind. In a medium that absorbs, what a wave that
    arrives and one that is reflected carry together is not the sum of theirs: a flux
    Re(w1 (1 - r)(1 + r*)) is Re(w1) (1 - |r|^2) + 2 Im(w1) Im(r), with r = (w1 - w2) / (w1 + w2),
    w = g for s and w = g / m^2 for p (Byrnes, arXiv:1603.02720). So I, which may have either sign,
    is 4 (Im w1 / Re w1) (Re w1 Im w2 - Re w2 Im w1) / |w1 + w2|^2. With z = (n0 sin)^2 and
    G = |g|^2, w for p goes as Re(g) (G + z) + i Im(g) (z - G).
    """
    boundary, shares = inhomogeneous_boundary(xp), _shares(xp)

    def both(*argument: Any) -> tuple[Any, ...]:
        at = boundary(*argument)
        return *shares(at), *shares(at.from_behind(xp.where))

    return both


def _shares(xp: Primitives) -> Callable[[InhomogeneousBoundary], tuple[Any, Any]]:
    where = xp.where

    def shares(at: InhomogeneousBoundary) -> tuple[Any, Any]:
        P, q, n2 = sum_squared(at), at.slant(where).q, at.n1 * at.n1
        z, G1, G2 = n2 * (at.s * at.s), at.p * at.p + at.fades * at.fades, at.squared
        # Where no wave arrives there is no light.
        there = (at.p > 0.0) & (P > 0.0) & (q * n2 > 0.0)
        share = where(there, 4.0 * (at.fades / where(there, at.p * P, 1.0)), 0.0)
        of_s = at.p * at.b - at.a * at.fades
        of_p = at.p * (G1 + z) * (at.b * (z - G2)) - at.a * (G2 + z) * (at.fades * (z - G1))
        of_p = of_p * ((z - G1) / where(there, (G1 + z) * q * n2, 1.0))
        return share * of_s, share * of_p

    return shares
