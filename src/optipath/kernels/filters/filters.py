"""Filters: polarisers, retarders, attenuators, depolarisers, ideal mirrors, given matrices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.numbers.circular import cosine, sine

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def polarizer(xp: Primitives) -> KernelFunction:
    """Make ``(k1, k2) -> (Fs, Fp, B, C, S)`` from the principal transmittances.

    Chipman, Lam & Young, Polarized Light and Optical Systems (2018).
    """
    sqrt = xp.sqrt

    def polarize(k1: Any, k2: Any) -> tuple[Any, ...]:
        return k1, k2, 0.5 * (k1 - k2), sqrt(k1) * sqrt(k2), 0.0

    return polarize


def retarder(xp: Primitives) -> KernelFunction:
    """Make ``(retardance,) -> (Fs, Fp, B, C, S)``, the fast axis along x.

    The slow component gains the phase exp(+i retardance), the field being exp(-i w t).
    """
    sin, cos = sine(xp), cosine(xp)

    def retard(retardance: Any) -> tuple[Any, ...]:
        return 1.0, 1.0, 0.0, cos(retardance), -sin(retardance)

    return retard


def attenuator(xp: Primitives) -> KernelFunction:
    """Make ``(transmittance,) -> (t,)``."""
    del xp
    return lambda transmittance: (transmittance,)


def complement(xp: Primitives) -> KernelFunction:
    """Make ``(reflectance,) -> (1 - reflectance,)``: what a lossless splitter lets through."""
    del xp
    return lambda reflectance: (1.0 - reflectance,)


def depolarizer(xp: Primitives) -> KernelFunction:
    """Make ``(depolarization,) ->`` the sixteen numbers of diag(1, p, p, p), p = 1 - d."""
    del xp

    def depolarize(depolarization: Any) -> tuple[Any, ...]:
        p = 1.0 - depolarization
        rows = (1.0, 0.0, 0.0, 0.0), (0.0, p, 0.0, 0.0), (0.0, 0.0, p, 0.0), (0.0, 0.0, 0.0, p)
        return tuple(entry for row in rows for entry in row)

    return depolarize


def mirror(xp: Primitives) -> KernelFunction:
    """Make ``(reflectance,) -> (Fs, Fp, B, C, S)`` of an ideal mirror, r_p = -r_s."""
    del xp
    return lambda reflectance: (reflectance, reflectance, 0.0, -reflectance, 0.0)


def given(xp: Primitives) -> KernelFunction:
    """Make the function that returns the numbers it is given."""
    del xp
    return lambda *numbers: numbers
