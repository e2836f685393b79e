"""Variants of Fresnel kernels: powers alone, twice the precision, events and angles of chains.

The denominators of a whole path are multiplied, and divided by once, at its end.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.double_double import DoubleDouble, twice
from optipath.kernels.fresnel.boundary import (
    Boundary,
    absorbing_wave,
    inhomogeneous_boundary,
)
from optipath.kernels.fresnel.stable import sum_squared
from optipath.kernels.vertex_chain import Event

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.kernel import Kernel
    from optipath.kernels.primitives import Factory, KernelFunction, Primitives


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


def lossless_powers(
    boundary: Callable[[Primitives], Callable[..., Boundary]], xp: Primitives
) -> KernelFunction:
    """Make ``(n1, n, [n0,] cos, sin) -> (Fs d, Fp d, d)``: the same, cheaper, for k = 0."""
    boundary_at = boundary(xp)

    def powers(n1: Any, n: Any, *angle: Any) -> tuple[Any, ...]:
        at = boundary_at(n1, n, *angle)
        P, along = sum_squared(at), at.slant(xp.where)
        parted = _of_refracted(xp, angle, at.p, at.D * at.D + at.v * at.v, P * P)
        return parted * along.q, parted * along.less, P * P * along.q

    return powers


def inhomogeneous_powers(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, [n0,] cos, sin) -> (Fs d, Fp d, d)``, as `inhomogeneous_reflection`."""
    boundary, where = inhomogeneous_boundary(xp), xp.where

    def powers(*argument: Any) -> tuple[Any, ...]:
        at = boundary(*argument)
        P, along = sum_squared(at), at.slant(where)
        parted = at.D * at.D + at.v * at.v
        real = _of_refracted(xp, argument[4:], at.p, parted, P * P)
        # Out of a medium that absorbs, it may be more than all.
        parted = where(at.kappa > 0.0, parted, real)
        return parted * along.q, parted * along.less, P * P * along.q

    return powers


def _of_refracted(xp: Primitives, angle: tuple[Any, ...], p: Any, parted: Any, most: Any) -> Any:
    """Return |D|^2, of an angle in n0 no more than |p + g|^4, and that where nothing arrives.

    Beyond total reflection before, D is that of two media which light does not get to.
    """
    return xp.where(p > 0.0, xp.minimum(parted, most), most) if len(angle) > 2 else parted


def compensated(factory: Factory, xp: Primitives) -> KernelFunction:
    """Make a kernel in twice the precision, which rounds what it returns once."""
    kernel, sqrt = factory(twice(xp)), DoubleDouble.sqrt

    def rounded_once(*argument: Any) -> tuple[Any, ...]:
        # Not a plain 0: the rest has the precision of the number.
        *media, c, s = (DoubleDouble(xp, number, 0.0 * number) for number in argument)
        # A cosine and a sine that are rounded belong to no angle; their ratio does.
        length = sqrt(c * c + s * s)
        numbers = kernel(*media, c / length, s / length)
        return tuple(n.high if isinstance(n, DoubleDouble) else n for n in numbers)

    return rounded_once


def at_angle(factory: Factory, xp: Primitives) -> KernelFunction:
    """Make a kernel ``(..., cos, sin) -> (Fs, Fp, B, C, S)`` that is NaN where its cosine is.

    What is known of media, such as that they are equal, can make a number of any angle else.
    """
    kernel = factory(xp)

    def at(*argument: Any) -> tuple[Any, ...]:
        # That S vanishes where nothing absorbs is known, and C beside it tells all.
        *numbers, S = kernel(*argument)
        return *numbers_at(xp, argument[-2], numbers), S

    return at


def numbers_at(xp: Primitives, cos: Any, numbers: Sequence[Any]) -> list[Any]:
    """Return numbers where there is an angle, and NaN elsewhere."""
    is_angle = cos == cos  # noqa: PLR0124 - NaN alone is not
    return [xp.where(is_angle, number, nan) for number in numbers]


def at_event(reflection: Kernel, transmission: Kernel, xp: Primitives) -> KernelFunction:
    """Make ``(event, n1, n, [k,] cos, sin) -> (Fs, Fp, B, C, S)`` of an `Event`; NaN as cos is."""
    where, through, back = xp.where, transmission.made_for(xp), reflection.made_for(xp)

    def at(event: Any, *media_and_angle: Any) -> tuple[Any, ...]:
        refracts, is_behind = event == Event.REFRACTS, event == Event.BEHIND
        # Of the same media at the same angle, the two have most of their terms in common.
        pairs = zip(through(*media_and_angle), back(*media_and_angle), strict=True)
        numbers = [where(refracts, one, other) for one, other in pairs]
        numbers = numbers_at(xp, media_and_angle[-2], numbers)
        as_it_is = zip(BLOCK.identity, numbers, strict=True)
        return tuple(where(is_behind, one, number) for one, number in as_it_is)

    return at
