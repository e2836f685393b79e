"""A stretch of a homogeneous medium: what it does per metre, and how many metres there are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.filters.filters import retarder
from optipath.kernels.filters.lorentz import lorentz
from optipath.kernels.filters.lorentz_depolarizing import depolarizing_lorentz
from optipath.kernels.filters.rotation import turn, turn_back
from optipath.kernels.numbers.hyperbolic import scaled_hyperbolic
from optipath.kernels.numbers.norms import norm

if TYPE_CHECKING:
    from collections.abc import Callable

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
    left = _left(xp)
    return lambda absorption, length: (left(share * (absorption * length)),)


def _left(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``depth -> exp(-depth)``, 0 where that has lost digits."""
    exp, where = xp.exp, xp.where

    def left(depth: Any) -> Any:
        t = exp(-depth)
        return where(t * _LEAST > 0.0, t, 0.0)

    return left


def absorption_beside_dichroism(xp: Primitives) -> KernelFunction:
    """Make ``(absorption, dichroism, circular dichroism, length) -> (t,)``.

    It is what the least absorbed of all states keeps; what dichroism does besides takes nothing
    from that one. By how much less it is absorbed, `_excess`, has no slope in either.
    """
    return _least_attenuation(xp, 1.0)


def third_of_absorption_beside_dichroism(xp: Primitives) -> KernelFunction:
    """Make ``(absorption, dichroism, circular dichroism, length) -> (t,)``, the cube root."""
    return _least_attenuation(xp, 1.0 / 3.0)


def _least_attenuation(xp: Primitives, share: float) -> KernelFunction:
    attenuate, excess, where, fixed = _attenuation(xp, share), _excess(xp), xp.where, xp.fixed

    def attenuate_least(absorption: Any, linear: Any, circular: Any, length: Any) -> tuple[Any]:
        least = absorption - excess(linear, circular)
        # A rounding below 0 is taken away from itself, so that its slope stays.
        return attenuate(least - where(least < 0.0, fixed(least), 0.0), length)

    return attenuate_least


def _excess(xp: Primitives) -> Callable[..., Any]:
    """Make ``(dichroism, ...) ->`` by how much the mean of all states is absorbed more per metre.

    It is taken out of the absorption and put back with the dichroism, which scales both by what
    cancels: a constant for slopes, as its own has a jump where there is no dichroism.
    """
    size, fixed = norm(xp), xp.fixed
    return lambda *dichroism: fixed(size(*dichroism))


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


def dichroism_along(xp: Primitives) -> KernelFunction:
    """Make ``(dichroism, retardance, length) -> (Fs, Fp, B, C, S)``, both along x.

    All are scaled, so that light along the axis that absorbs less keeps all.
    """
    retard, hyperbolic, left, excess = retarder(xp), scaled_hyperbolic(xp), _left(xp), _excess(xp)

    def filtered(dichroism: Any, retardance: Any, length: Any) -> tuple[Any, ...]:
        along = dichroism * length
        size = excess(dichroism) * length
        half = left(size)
        _, _, _, c, s = retard(retardance * length)
        _, difference = hyperbolic(along, size)
        return left(size - along), left(size + along), difference, half * c, half * s

    return filtered


def depolarization_along(xp: Primitives) -> KernelFunction:
    """Make ``(depolarization, length) ->`` the sixteen numbers of diag(1, t, t, t)."""
    exp = xp.exp

    def depolarize(depolarization: Any, length: Any) -> tuple[Any, ...]:
        t = exp(-(depolarization * length))
        return (1.0, *(t if place % 5 == 0 else 0.0 for place in range(1, 16)))

    return depolarize


def dichroism_and_retardance_along(xp: Primitives) -> KernelFunction:
    """Make the function of all that a pure medium does at once, the fast axis along x.

    It takes ``(dichroism, circular dichroism, retardance, rotation, dichroic angle, angle,
    length)``, and returns the sixteen numbers, scaled so that light absorbed least keeps all.
    """
    generator, exponential, excess = _generator(xp), lorentz(xp), _excess(xp)
    return lambda *rates: exponential(*generator(*rates), excess(*rates[:2]) * rates[-1])


def depolarizing_dichroism_along(xp: Primitives) -> KernelFunction:
    """Make the same with the depolarisation as one more argument, the first."""
    generator, exponential, excess = _generator(xp), depolarizing_lorentz(xp), _excess(xp)

    def depolarize(depolarization: Any, *rates: Any) -> tuple[Any, ...]:
        length = rates[-1]
        shift = excess(*rates[:2]) * length
        return exponential(*generator(*rates), depolarization * length, shift)

    return depolarize


def _generator(xp: Primitives) -> KernelFunction:
    """Make the six numbers that `lorentz` takes of what is given per metre."""
    turned = turn(xp)

    def of_rates(
        linear: Any,
        circular: Any,
        retardance: Any,
        rotation: Any,
        dichroic_angle: Any,
        angle: Any,
        length: Any,
    ) -> tuple[Any, ...]:
        cos, sin = turned(dichroic_angle - angle)
        along = linear * length
        return (
            along * cos,
            along * sin,
            circular * length,
            retardance * length,
            0.0,
            2.0 * (rotation * length),
        )

    return of_rates
