"""Refraction: the direction of light behind a boundary, and kernels told its angle before it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.fresnel.boundary import absorbing_boundary, refracted_wave
from optipath.kernels.fresnel.inhomogeneous import phase_index
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


def effective_index(xp: Primitives) -> KernelFunction:
    """Make ``(n1, k1, n, k, cos, sin) -> (n', k')`` of the wave behind a boundary.

    Its real wave vector is as long as n' = sqrt(y^2 + (Re g)^2), with y along the face, so that
    Snell's law holds with n' for the real angle; its imaginary one, along the normal, as long as
    k' = Im g. So n'^2 - k'^2 = n^2 - k^2 and n' k' cos(theta') = n k (Born & Wolf, Principles of
    Optics, sec. 14.2; P. E. Ciddor, Am. J. Phys. 44, 786 (1976)).
    """
    boundary, arriving, length = absorbing_boundary(xp), phase_index(xp), hypotenuse(xp)

    def index(n1: Any, k1: Any, n: Any, k: Any, c: Any, s: Any) -> tuple[Any, Any]:
        (q,) = arriving(n1, k1, c, s)
        at = boundary(q, n, k, c, s)
        # The indices are divided by a power of two there.
        divided = q / at.n1
        return divided * length(at.n1 * at.s, at.a), divided * at.b

    return index


@dataclass(frozen=True)
class Refracting:
    """Makes a kernel that takes an angle before refraction, too, of one that does not."""

    factory: Factory

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Make ``(n1, n, k, [n0,] cos, sin)``."""
        kernel, refracted = self.factory(xp), refracted_wave(xp)

        def refracting(n1: Any, n: Any, k: Any, *angle: Any) -> tuple[Any, ...]:
            if len(angle) > 2:
                angle = refracted(n1, n, *angle)[:2]
            return kernel(n1, n, k, *angle)

        return refracting
