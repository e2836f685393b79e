"""What sources emit: the four Stokes components."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def unpolarized(xp: Primitives) -> KernelFunction:
    """Make ``(intensity,) -> (I, 0, 0, 0)``."""
    del xp
    return lambda intensity: (intensity, 0.0, 0.0, 0.0)


def polarized(xp: Primitives) -> KernelFunction:
    """Make ``(I, s0, s1, s2, s3) -> (I s0, I s1, I s2, I s3)``."""
    del xp
    return lambda intensity, *state: tuple(intensity * component for component in state)


def product(xp: Primitives) -> KernelFunction:
    """Make ``(I, density) -> (I density,)``: what is emitted at a wavelength."""
    del xp
    return lambda intensity, density: (intensity * density,)
