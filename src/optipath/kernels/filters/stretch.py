"""A stretch of a homogeneous medium: what it does per metre, and how many metres there are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.filters.filters import retarder
from optipath.kernels.filters.rotation import turn, turn_back

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


_LEAST = 2.0**-53
"""What a number times this underflows to 0 is close to where digits get lost."""


def absorption_along(xp: Primitives) -> KernelFunction:
    """Make ``(absorption, length) -> (t,)``: Beer-Lambert, t = exp(-absorption length).

    Where digits of t would be lost to underflow it is 0, lest what is wrong looks like light.
    """
    return _attenuation(xp, 1.0)


def third_of_absorption(xp: Primitives) -> KernelFunction:
    """Make ``(absorption, length) -> (t,)``, the cube root of the same."""
    return _attenuation(xp, 1.0 / 3.0)


def _attenuation(xp: Primitives, share: float) -> KernelFunction:
    exp, where = xp.exp, xp.where

    def attenuate(absorption: Any, length: Any) -> tuple[Any]:
        t = exp(-share * (absorption * length))
        return (where(t * _LEAST > 0.0, t, 0.0),)

    return attenuate


def rotation_along(xp: Primitives) -> KernelFunction:
    """Make ``(rotation, length) -> (cos 2a, -sin 2a)``, the light turned by a."""
    turned_back = turn_back(xp)
    return lambda rotation, length: turned_back(rotation * length)


def dextrorotation_along(xp: Primitives) -> KernelFunction:
    """Make ``(dextrorotation, length) -> (cos 2a, sin 2a)``, the light turned by -a."""
    turned = turn(xp)
    return lambda dextrorotation, length: turned(dextrorotation * length)


def retardance_along(xp: Primitives) -> KernelFunction:
    """Make ``(retardance, length) -> (Fs, Fp, B, C, S)``, the fast axis along x."""
    retard = retarder(xp)
    return lambda retardance, length: retard(retardance * length)
