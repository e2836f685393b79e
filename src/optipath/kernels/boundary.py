"""The boundary of two media as light meets it: the wave in front and the wave behind."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


class Boundary(NamedTuple):
    """What reflection and transmission are made of.

    Indices are divided by a power of two near the largest of them, so that no square
    overflows; every result is a ratio in which it falls out.

    Attributes
    ----------
    p : float
        n1 cos, the wave in front along the normal.
    a, b : float
        The wave behind along the normal, g = a + ib = sqrt(m2^2 - (n1 sin)^2), a, b >= 0.
    squared : float
        |g|^2.
    D, v : float
        m2^2 - n1^2 = D + iv.
    s, c : float
        The sine and the cosine.
    n1, n, k : float
        The indices, divided.
    """

    p: Any
    a: Any
    b: Any
    squared: Any
    D: Any
    v: Any
    s: Any
    c: Any
    n1: Any
    n: Any
    k: Any


def near_one(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(n1, n, ...) ->`` the same, divided by a power of two near the largest.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> near_one(FLOAT)(1.0, 6.0)
    (0.125, 0.75)
    """
    frexp, ldexp, maximum = xp.frexp, xp.ldexp, xp.maximum

    def divided(*indices: Any) -> tuple[Any, ...]:
        _, exponent = frexp(reduce(maximum, indices))
        return tuple(ldexp(index, -exponent) for index in indices)

    return divided


_SMALL, _FAR = 2.0**-60, 2.0**100
"""What has a square that may vanish in float32, and what takes it back among the others."""


def hypotenuse(xp: Primitives) -> Callable[[Any, Any], Any]:
    """Make ``(x, y) -> sqrt(x^2 + y^2)`` for x, y >= 0 within 1e-180 .. 1e18, or 0.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> hypotenuse(FLOAT)(3e-170, 4e-170)
    5e-170
    """
    sqrt, where, maximum = xp.sqrt, xp.where, xp.maximum

    def length(x: Any, y: Any) -> Any:
        small = maximum(x, y) < _SMALL
        x, y = where(small, _FAR * x, x), where(small, _FAR * y, y)
        squared = sqrt(x * x + y * y)
        return where(small, squared * (1.0 / _FAR), squared)

    return length


def complex_root(xp: Primitives) -> Callable[[Any, Any, Any], tuple[Any, Any, Any]]:
    """Make ``(u, n, k) -> (a, b, |g|^2)`` with g = a + ib = sqrt(u + 2ink), a, b >= 0.

    The larger of a and b is a sum; the smaller is what ab = nk leaves for it.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> complex_root(FLOAT)(-3.0, 2.0, 1.0)[:2]
    (1.0, 2.0)
    """
    sqrt, where, absolute, length = xp.sqrt, xp.where, xp.absolute, hypotenuse(xp)

    def root(u: Any, n: Any, k: Any) -> tuple[Any, Any, Any]:
        size = absolute(u)
        squared = length(size, 2.0 * n * k)
        larger = sqrt(0.5 * (size + squared))
        # In this order, since n k may underflow.
        smaller = n / where(larger > 0.0, larger, 1.0) * k
        forward = u >= 0.0
        return where(forward, larger, smaller), where(forward, smaller, larger), squared

    return root


def absorbing_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, k, cos, sin) -> Boundary``."""
    wave, root = absorbing_wave(xp), complex_root(xp)

    def boundary(n1: Any, n: Any, k: Any, c: Any, s: Any) -> Boundary:
        n1, n, k, p, contrast, u = wave(n1, n, k, c, s)
        a, b, squared = root(u, n, k)
        return Boundary(p, a, b, squared, contrast - k * k, 2.0 * n * k, s, c, n1, n, k)

    return boundary


def absorbing_wave(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(n1, n, k, cos, sin) -> (n1, n, k, p, n^2 - n1^2, Re g^2)``, the indices divided."""
    divided, wave, absolute = near_one(xp), _wave(xp), xp.absolute

    def absorbing(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, ...]:
        # The absolute value makes -0 a 0.
        n1, n, k = divided(n1, n, absolute(k))
        return n1, n, k, *wave(n1, n, k, c, s)

    return absorbing


def lossless_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, cos, sin) -> Boundary``, for media that absorb nothing."""
    wave = _lossless_wave(xp)
    sqrt, where, absolute = xp.sqrt, xp.where, xp.absolute

    def boundary(n1: Any, n: Any, c: Any, s: Any) -> Boundary:
        n1, n, p, contrast, u = wave(n1, n, c, s)
        squared = absolute(u)
        size = sqrt(squared)
        forward = u >= 0.0
        a, b = where(forward, size, 0.0), where(forward, 0.0, size)
        return Boundary(p, a, b, squared, contrast, 0.0, s, c, n1, n, 0.0)

    return boundary


def denser_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, cos, sin) -> Boundary`` for n >= n1 without absorption.

    The same again, where nothing is reflected totally: Re g^2 is never negative.
    """
    sqrt, wave = xp.sqrt, _lossless_wave(xp)

    def boundary(n1: Any, n: Any, c: Any, s: Any) -> Boundary:
        n1, n, p, contrast, u = wave(n1, n, c, s)
        return Boundary(p, sqrt(u), 0.0, u, contrast, 0.0, s, c, n1, n, 0.0)

    return boundary


def _lossless_wave(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    divided, wave = near_one(xp), _wave(xp)

    def lossless(n1: Any, n: Any, c: Any, s: Any) -> tuple[Any, ...]:
        n1, n = divided(n1, n)
        return n1, n, *wave(n1, n, 0.0, c, s)

    return lossless


def _wave(xp: Primitives) -> Callable[..., tuple[Any, Any, Any]]:
    where = xp.where

    def wave(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, Any, Any]:
        p = n1 * c
        y = n1 * s
        contrast = (n - n1) * (n + n1)
        # Re g^2, from whichever of cos and sin is small: that one carries the digits.
        u = where(c < s, contrast + p * p, (n - y) * (n + y)) - k * k
        return p, contrast, u

    return wave
