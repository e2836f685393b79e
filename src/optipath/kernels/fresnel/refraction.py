"""Refraction: the direction of light behind a boundary, and kernels told its angle before it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.boundary import absorbing_boundary, refracted_wave
from optipath.kernels.numbers.complex_pairs import hypotenuse

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Factory, KernelFunction, Primitives


def refraction(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, k, cos, sin) -> (cos, sin)`` of the real angle of refraction.

    That is the angle at which planes of constant phase travel on: its tangent is n1 sin over
    the real part of g = sqrt(m2^2 - (n1 sin)^2) (Born & Wolf, Principles of Optics, sec. 14.2),
    which is Snell's law where nothing absorbs. Where all is reflected, it is a right angle.
    """
    boundary, where, length = absorbing_boundary(xp), xp.where, hypotenuse(xp)

    def refract(n1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, Any]:
        at = boundary(n1, n, k, c, s)
        along = at.n1 * at.s
        size = length(along, at.a)
        there = size > 0.0
        size = where(there, size, 1.0)
        return where(there, at.a / size, 1.0), along / size

    return refract


@dataclass(frozen=True)
class Refracting:
    """Makes a kernel that takes an angle before refraction, too, of one that does not.

    Attributes
    ----------
    factory : callable
        Makes the kernel ``(n1, n, k, cos, sin)``.
    """

    factory: Factory

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Make ``(n1, n, k, [n0,] cos, sin)``."""
        kernel, refracted = self.factory(xp), refracted_wave(xp)

        def refracting(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
            if len(angle) > 2:
                angle = refracted(n1, n, *angle)[:2]
            return kernel(n1, n, k, *angle)

        return refracting
