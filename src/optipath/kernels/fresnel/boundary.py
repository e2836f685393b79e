"""The boundary of two media as light meets it: the wave in front and the wave behind."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.numbers.complex_pairs import (
    brought_near_one,
    complex_root,
    from_within,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


LOST = -1.0
"""What n^2 - y^2 is taken for where all has been reflected before: all is reflected here, too."""


class Boundary(NamedTuple):
    """What reflection and transmission are made of.

    Indices are divided by a power of two near the largest of them, so that no square
    overflows; every result is a ratio in which it falls out.
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

    @property
    def squares(self) -> tuple[Any, Any]:
        """p^2 + |g|^2 and 2 Re(p conj g)."""
        return self.p * self.p + self.squared, 2.0 * self.p * self.a


def absorbing_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, k, [n0,] cos, sin) -> Boundary``.

    The angle is that in the medium n1, or in a medium n0 from which parallel boundaries have
    refracted the light into n1.
    """
    wave, root = absorbing_wave(xp), complex_root(xp)

    def boundary(n1: Any, n: Any, k: Any, *angle: Any) -> Boundary:
        n1, n, k, c, s, p, D, u = wave(n1, n, k, *angle)
        a, b, squared = root(u, n, k)
        return Boundary(p, a, b, squared, D, 2.0 * n * k, s, c, n1, n, k)

    return boundary


def absorbing_wave(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, k, [n0,] cos, sin) -> (n1, n, k, cos, sin, p, D, Re g^2)``.

    The indices come out divided; the angle is that in the medium n1.
    """
    divided, wave, absolute = brought_near_one(xp), _wave(xp), xp.absolute
    # Much nearer to its edge than the square of a cosine to its own: a medium without absorption
    # is one at grazing incidence, too.
    inside = from_within(xp, 6)

    def absorbing(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
        *n0, c, s = angle
        # The absolute value makes -0 a 0.
        n1, n, k, *n0 = divided(n1, n, inside(absolute(k)), *n0)
        return n1, n, k, *wave(n1, n, k, *n0, c, s)

    return absorbing


def lossless_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, [n0,] cos, sin) -> Boundary``, for media that absorb nothing."""
    wave = _lossless_wave(xp)
    sqrt, where, absolute = xp.sqrt, xp.where, xp.absolute

    def boundary(n1: Any, n: Any, *angle: Any) -> Boundary:
        n1, n, c, s, p, D, u = wave(n1, n, *angle)
        squared = absolute(u)
        size = sqrt(squared)
        forward = u >= 0.0
        a, b = where(forward, size, 0.0), where(forward, 0.0, size)
        return Boundary(p, a, b, squared, D, 0.0, s, c, n1, n, 0.0)

    return boundary


def denser_boundary(xp: Primitives) -> Callable[..., Boundary]:
    """Make ``(n1, n, [n0,] cos, sin) -> Boundary`` for n >= n1 without absorption.

    The same again, where nothing is reflected totally: Re g^2 is never negative.
    """
    sqrt, wave, lossless = xp.sqrt, _lossless_wave(xp), lossless_boundary(xp)

    def boundary(n1: Any, n: Any, *angle: Any) -> Boundary:
        if len(angle) > 2:
            # All may have been reflected before.
            return lossless(n1, n, *angle)
        n1, n, c, s, p, D, u = wave(n1, n, *angle)
        return Boundary(p, sqrt(u), 0.0, u, D, 0.0, s, c, n1, n, 0.0)

    return boundary


def _lossless_wave(xp: Primitives) -> KernelFunction:
    divided, wave = brought_near_one(xp), _wave(xp)

    def lossless(n1: Any, n: Any, *angle: Any) -> tuple[Any, ...]:
        *n0, c, s = angle
        n1, n, *n0 = divided(n1, n, *n0)
        return n1, n, *wave(n1, n, 0.0, *n0, c, s)

    return lossless


def _wave(xp: Primitives) -> KernelFunction:
    where, behind, inside = xp.where, refracted_wave(xp), from_within(xp)

    def wave(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
        """Return the cosine and sine in n1, p, D = n^2 - k^2 - n1^2, and Re g^2."""
        k2 = k * k
        D = contrast(where, n1, n, k2)
        if len(angle) > 2:
            c, s, p, squared = behind(n1, n, *angle)
            return c, s, p, D, squared - k2
        c, s = inside(angle[0]), angle[1]
        p = n1 * c
        y = n1 * s
        # From whichever of cos and sin is small: that one carries the digits.
        return c, s, p, D, where(c < s, D + p * p, n * n - (y * y + k2))

    return wave


def contrast(where: Callable[..., Any], n1: Any, n: Any, loss: Any) -> Any:
    """Return n^2 - n1^2 - loss, with few roundings."""
    # Up to 2 n1, d is exact, and so is its product with n1 in front of vacuum.
    d = n - n1
    return where(d > n1, n * n - (n1 * n1 + loss), 2.0 * n1 * d + (d * d - loss))


def refracted_wave(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, n0, cos0, sin0) -> (cos, sin, p, n^2 - y^2)`` for the angle in n1.

    Parallel boundaries have refracted the light from n0 into n1; y = n0 sin0 is what Snell's law
    keeps.
    """
    sqrt, where, maximum, minimum = xp.sqrt, xp.where, xp.maximum, xp.minimum
    inside = from_within(xp)

    def refracted(n1: Any, n: Any, n0: Any, c0: Any, s0: Any) -> tuple[Any, ...]:
        along, y = squared_along_normal(xp, n0, inside(c0), s0)
        squared = along(n1)
        # Where all has been reflected before, there is no light, and any angle will do.
        p, lost = sqrt(maximum(squared, 0.0)), squared < 0.0
        return p / n1, minimum(y / n1, 1.0), p, where(lost, LOST, along(n))

    return refracted


def squared_along_normal(
    xp: Primitives, n0: Any, c0: Any, s0: Any
) -> tuple[Callable[[Any], Any], Any]:
    """Return ``n -> n^2 - y^2`` and the wave y = n0 sin0 along the face."""
    p0, y = n0 * c0, n0 * s0

    def along(m: Any) -> Any:
        return xp.where(c0 < s0, (m - n0) * (m + n0) + p0 * p0, (m - y) * (m + y))

    return along, y
