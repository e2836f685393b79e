"""One interaction of light with a facet: the library's kernels, compiled."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.structures import BLOCK, ROTATION
from optipath.kernels.fresnel.stable import (
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
)
from optipath.kernels.geometry.facet import (
    plane_at_facet,
    reflected_at_facet,
    refracted_at_facet,
)
from optipath.surfaces.walk.compiled_kernels import compiled_kernel

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def _plane(xp: Primitives) -> KernelFunction:
    """Make ``(k, x, normal) -> (cos, sin, s, cos 2a, sin 2a, direction of the reflection)``."""
    plane = plane_at_facet(xp)

    def met(*numbers: Any) -> tuple[Any, ...]:
        k, x, normal = numbers[:3], numbers[3:6], numbers[6:]
        cos, sin, s, *turn = plane(k, x, normal)
        return cos, sin, *s, *turn, *reflected_at_facet(k, normal, cos)

    return met


def _boundary(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, cos, sin, k, normal) -> (of what is reflected, of what is not, direction)``.

    Of what is let through, Ts, Tp, B and C: its S is 0.
    """
    reflect, transmit = lossless_reflection(xp), lossless_transmission(xp)
    refract = refracted_at_facet(xp)

    def met(n1: Any, n: Any, cos: Any, sin: Any, *vectors: Any) -> tuple[Any, ...]:
        let_through = transmit(n1, n, cos, sin)[:4]
        direction = refract(n1, n, vectors[:3], vectors[3:], cos, sin)
        return *reflect(n1, n, cos, sin), *let_through, *direction

    return met


def _acted(xp: Primitives) -> KernelFunction:
    """Make ``(carried, cos 2a, sin 2a, Fs, Fp, B, C, S) -> carried``: turned, then met."""
    turn, act = ROTATION.made_for(xp), BLOCK.made_for(xp)

    def acted(*numbers: Any) -> tuple[Any, ...]:
        carried, rotation, block = numbers[:4], numbers[4:6], numbers[6:]
        return act(block, turn(rotation, carried, 4), 4)

    return acted


plane = compiled_kernel("plane", _plane, 9)
boundary = compiled_kernel("boundary", _boundary, 10)
opaque_reflection = compiled_kernel("opaque_reflection", stable_reflection, 5)
acted = compiled_kernel("acted", _acted, 11)
