"""Refraction: the direction of light behind a boundary, and kernels told its angle before it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.boundary import absorbing_boundary, hypotenuse, lossless_boundary

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.boundary import Boundary
    from optipath.kernels.kernel import Factory
    from optipath.kernels.primitives import Primitives


def refraction(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(n1, n, k, cos, sin) -> (cos, sin)`` of the real angle of refraction.

    That is the angle at which planes of constant phase travel on: its tangent is n1 sin over
    the real part of g = sqrt(m2^2 - (n1 sin)^2) (Born & Wolf, Principles of Optics, sec. 14.2),
    which is Snell's law where nothing absorbs. Where all is reflected, it is a right angle.
    """
    boundary, direction = absorbing_boundary(xp), _direction(xp)
    return lambda n1, n, k, c, s: direction(boundary(n1, n, k, c, s))


def lossless_refraction(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(n1, n, cos, sin) -> (cos, sin)``: the same, cheaper, for k = 0."""
    boundary, direction = lossless_boundary(xp), _direction(xp)
    return lambda n1, n, c, s: direction(boundary(n1, n, c, s))


def _direction(xp: Primitives) -> Callable[[Boundary], tuple[Any, Any]]:
    where, length = xp.where, hypotenuse(xp)

    def direction(at: Boundary) -> tuple[Any, Any]:
        along = at.n1 * at.s
        size = length(along, at.a)
        there = size > 0.0
        size = where(there, size, 1.0)
        return where(there, at.a / size, 1.0), along / size

    return direction


@dataclass(frozen=True)
class Refracting:
    """Makes a kernel that takes an angle before refraction, too, of one that does not.

    Attributes
    ----------
    factory : callable
        Makes the kernel ``(n1, n, k, cos, sin)``.
    """

    factory: Factory

    def __call__(self, xp: Primitives) -> Callable[..., tuple[Any, ...]]:
        """Make ``(n1, n, k, [n0,] cos, sin)``."""
        kernel, refracted = self.factory(xp), lossless_refraction(xp)

        def refracting(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
            if len(angle) > 2:
                n0, c, s = angle
                angle = refracted(n0, n1, c, s)
            return kernel(n1, n, k, *angle)

        return refracting
