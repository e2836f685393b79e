"""The slanted way through a layer that absorbs: how much light is left, and how much is not."""

from __future__ import annotations

import math
from functools import reduce
from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.boundary import squared_along_normal
from optipath.kernels.numbers.complex_pairs import brought_near_one, complex_root, from_within

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

_LEAST = 2.0**-53
"""What a number times this underflows to 0 is close to where digits get lost."""

_ODD = tuple(range(15, 0, -2))
"""Down to 1, from where a fraction of them is right to the last digit of a long double."""


def attenuation(xp: Primitives) -> KernelFunction:
    """Make ``(n, k, length, wavelength, n0, cos, sin) -> (left, absorbed)``, which add up to 1.

    The angle is that in a medium n0 from which parallel boundaries have refracted the light. Down
    once through the layer goes left = exp(-x), x = 4 pi Im(g) length / wavelength, with
    g = sqrt(m^2 - (n0 sin)^2), the wave along the normal (Byrnes, arXiv:1603.02720, sec. on
    incoherent layers). Where digits of it would be lost to underflow it is 0.
    """
    wave, where, exp, lost = _decay(xp), xp.where, xp.exp, _one_less_exponential(xp)

    def attenuate(n: Any, k: Any, length: Any, wavelength: Any, *angle: Any) -> tuple[Any, ...]:
        x = 4.0 * math.pi * wave(n, k, *angle) * (length / wavelength)
        left = exp(-x)
        return where(left * _LEAST > 0.0, left, 0.0), lost(x, left)

    return attenuate


def _decay(xp: Primitives) -> Callable[..., Any]:
    """Make ``(n, k, n0, cos, sin) -> Im g``, without loss however weakly the layer absorbs."""
    divided, root, cosine = brought_near_one(xp), complex_root(xp), from_within(xp)
    scaling, ldexp, maximum, inside = xp.scaling, xp.ldexp, xp.maximum, from_within(xp, 6)

    def decay(n: Any, k: Any, n0: Any, c: Any, s: Any) -> Any:
        k = inside(xp.absolute(k))
        exponent = scaling(reduce(maximum, (n, k, n0)))
        n, k, n0 = divided(n, k, n0)
        along, _ = squared_along_normal(xp, n0, cosine(c), s)
        return ldexp(root(along(n) - k * k, n, k)[1], exponent)

    return decay


def _one_less_exponential(xp: Primitives) -> Callable[[Any, Any], Any]:
    """Make ``(x, exp(-x)) -> 1 - exp(-x)`` for x >= 0, by sums of what is not negative.

    Up to 1 it is 2 / (1 + coth y) with y = x / 2, and y coth y = 1 + y^2 / (3 + y^2 / (5 + ...)
    is Lambert's continued fraction (Abramowitz & Stegun 4.5.70).
    """
    where, minimum = xp.where, xp.minimum

    def lost(x: Any, left: Any) -> Any:
        y = 0.5 * minimum(x, 1.0)
        square = y * y
        hyperbolic = reduce(lambda below, odd: odd + square / below, _ODD[1:], 1.0 * _ODD[0])
        return where(x < 1.0, 2.0 * y / (y + hyperbolic), 1.0 - left)

    return lost
