"""The amplitudes of one boundary, each by itself: what is reflected and let through of s and p."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.amplitude import times
from optipath.kernels.fresnel.from_absorbing import phases_through, slant_of
from optipath.kernels.fresnel.inhomogeneous import inhomogeneous_boundary
from optipath.kernels.fresnel.stable import sum_squared
from optipath.kernels.numbers.complex_pairs import hypotenuse

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.fresnel.amplitude import Complex
    from optipath.kernels.fresnel.inhomogeneous import InhomogeneousBoundary
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def single_amplitudes(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, cos, sin) -> (Re, Im of r_s, of r_p, of t_s, of t_p)``.

    With g1 and g2 along the normal, y along the face and g2 - g1 = (m2^2 - m1^2) / (g1 + g2):
    r_s = (g1 - g2) / (g1 + g2), t_s = 1 + r_s, r_p / r_s = (y^2 - g1 g2) / (y^2 + g1 g2) and
    t_p / t_s = m1 m2 / (y^2 + g1 g2), as in `inhomogeneous_reflection` and
    `inhomogeneous_transmission`.
    """
    boundary, of_s, of_p = inhomogeneous_boundary(xp), _along_s(xp), _along_p(xp)

    def amplitudes(*given: Any) -> tuple[Any, ...]:
        at = boundary(*given)
        rs, ts = of_s(at)
        rp, tp = of_p(at, rs, ts)
        # Adding 0 turns -0 into 0.
        return tuple(part + 0.0 for number in (rs, rp, ts, tp) for part in number)

    return amplitudes


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
        along = slant_of(where, at)
        q = length(xp.absolute(along.z + along.ca), along.cb)
        there = q > 0.0
        q = where(there, q, 1.0)
        u, w = (along.z + along.ca) / q, along.cb / q
        Z = (along.z - along.ca) / q * u - w * w, -2.0 * (along.z / q) * w
        # It vanishes next to a medium of index 0 only: next to the normal, or at grazing incidence.
        sign = where(at.c > at.s, -1.0, 1.0)
        Z = where(there, Z[0], sign), where(there, Z[1], 0.0)
        return times(rs, Z), times(ts, _let_through(at, u, w, q))

    def _let_through(at: InhomogeneousBoundary, u: Any, w: Any, q: Any) -> Complex:
        """Return m1 m2 / (y^2 + g1 g2)."""
        size = length(at.n, at.k)
        safe = where(size > 0.0, size, 1.0)
        of_second, of_first = phases_through(where, at, at.n / safe, at.k / safe)
        re = u * ((at.n - at.kappa * at.k) / q) + w * ((at.k + at.kappa * at.n) / q)
        im = at.s * at.s * (at.n1 * of_second + size * of_first) / q * (size / q)
        return re, -im

    return along_p
