"""How much is reflected along s and along p, and nothing else: no phase, and one denominator.

What an intensity asks of an interface. The denominators of a whole path are multiplied, and
divided by once, at its end.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.boundary import (
    Boundary,
    absorbing_wave,
    denser_boundary,
    lossless_boundary,
)
from optipath.kernels.fresnel.from_absorbing import slant_of
from optipath.kernels.fresnel.inhomogeneous import inhomogeneous_boundary
from optipath.kernels.fresnel.stable import slant, sum_squared

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def reflected_powers(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, k, [n0,] cos, sin) -> (Fs d, Fp d, d)``.

    With Fs = |D|^2 / |p + g|^4 and Fp / Fs = |z - p g|^2 / |z + p g|^2, as in
    `stable_reflection`. The root g = a + ib comes as (ar + ibr) / r, with r the larger of a and
    b; so r^2 and a b = n k give both without a division, and r goes into the denominator.
    """
    wave = absorbing_wave(xp)
    sqrt, where, absolute = xp.sqrt, xp.where, xp.absolute

    def powers(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
        n1, n, k, c, s, p, D, u = wave(n1, n, k, *angle)
        ab, size = n * k, absolute(u)
        v = 2.0 * ab
        # What underflows here is too little beside p^2 to be seen.
        squared = sqrt(size * size + v * v)
        r2 = 0.5 * (size + squared)
        r = sqrt(r2)
        forward = u >= 0.0
        ar, br = where(forward, r2, ab), where(forward, ab, r2)
        z = n1 * (s * s)
        P = (p * p + squared) * r + 2.0 * p * ar
        q = (z * z + c * c * squared) * r + 2.0 * z * c * ar
        apart, across = z * r - c * ar, c * br
        parted = _of_refracted(xp, angle, p, (D * D + v * v) * r2, P * P)
        return parted * (q * r), parted * (apart * apart + across * across), P * P * (q * r)

    return powers


def lossless_powers(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, [n0,] cos, sin) -> (Fs d, Fp d, d)``: the same, cheaper, for k = 0."""
    boundary = lossless_boundary(xp)
    return lambda n1, n, *angle: _powers(xp, angle, boundary(n1, n, *angle))


def denser_powers(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, [n0,] cos, sin) -> (Fs d, Fp d, d)``: cheaper again, for n >= n1."""
    boundary = denser_boundary(xp)
    return lambda n1, n, *angle: _powers(xp, angle, boundary(n1, n, *angle))


def inhomogeneous_powers(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, [n0,] cos, sin) -> (Fs d, Fp d, d)``, as `inhomogeneous_reflection`."""
    boundary, where = inhomogeneous_boundary(xp), xp.where

    def powers(*given: Any) -> tuple[Any, ...]:
        at = boundary(*given)
        P, along = sum_squared(at), slant_of(where, at)
        parted = at.D * at.D + at.v * at.v
        real = _of_refracted(xp, given[4:], at.p, parted, P * P)
        # Out of a medium that absorbs, it may be more than all.
        parted = where(at.kappa > 0.0, parted, real)
        return parted * along.q, parted * along.less, P * P * along.q

    return powers


def _of_refracted(xp: Primitives, angle: tuple[Any, ...], p: Any, parted: Any, most: Any) -> Any:
    """Return |D|^2, of an angle in n0 no more than |p + g|^4, and that where nothing arrives.

    Next to where all has been reflected before, p and g are what rounding has left of them, and
    beyond, D is that of two media which light does not get to.
    """
    return xp.where(p > 0.0, xp.minimum(parted, most), most) if len(angle) > 2 else parted


def _powers(xp: Primitives, angle: tuple[Any, ...], at: Boundary) -> tuple[Any, ...]:
    P, along = sum_squared(at), slant(at)
    parted = _of_refracted(xp, angle, at.p, at.D * at.D + at.v * at.v, P * P)
    return parted * along.q, parted * along.less, P * P * along.q
