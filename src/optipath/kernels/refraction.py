"""Refraction: the direction of light behind a boundary, and kernels that start in front of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from optipath.kernels.boundary import absorbing_boundary, hypotenuse, lossless_boundary

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.boundary import Boundary
    from optipath.kernels.kernel import Factory, Kernel, KernelFamily
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
class Behind:
    """Makes a kernel for light that has been refracted by parallel boundaries before.

    Attributes
    ----------
    factory : callable
        Makes the kernel ``(*media, cos, sin)``, the medium in front being the first.
    media : int
        How many numbers say what the media are.
    """

    factory: Factory
    media: int

    def __call__(self, xp: Primitives) -> Callable[..., tuple[Any, ...]]:
        """Make ``(*media, n0, cos0, sin0)`` with the incidence in the medium n0 of the stack."""
        kernel, refracted, media = self.factory(xp), lossless_refraction(xp), self.media

        def behind(*given: Any) -> tuple[Any, ...]:
            n0, c0, s0 = given[media:]
            return kernel(*given[:media], *refracted(n0, given[0], c0, s0))

        return behind


def behind(kernel: Kernel, media: int = 3) -> Kernel:
    """Return a kernel of a boundary as one for light refracted into the medium in front of it."""
    without, denser, powers = kernel.without, kernel.denser, kernel.powers
    return replace(
        kernel,
        factory=Behind(kernel.factory, media),
        without=without and (without[0], behind(without[1], media - 1)),
        denser=denser and (*denser[:2], behind(denser[2], media)),
        powers=powers and behind(powers, media),
    )


def all_behind(family: KernelFamily) -> KernelFamily:
    """Return every method of a boundary for light refracted into the medium in front of it."""
    methods = {name: behind(kernel) for name, kernel in family.methods.items()}
    return replace(family, methods=methods)
