"""Filters, sources, rotations and parts of an optical bench, as Mueller structures."""

from __future__ import annotations

import math
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any

from optipath.kernels.trigonometry import cosine, sine

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import KernelFunction, Primitives


def polarizer(xp: Primitives) -> KernelFunction:
    """Make ``(k1, k2) -> (Fs, Fp, B, C, S)`` from the principal transmittances.

    Chipman, Lam & Young, Polarized Light and Optical Systems (2018).
    """
    sqrt = xp.sqrt
    return lambda k1, k2: (k1, k2, 0.5 * (k1 - k2), sqrt(k1) * sqrt(k2), 0.0)


def retarder(xp: Primitives) -> KernelFunction:
    """Make ``(retardance,) -> (Fs, Fp, B, C, S)``, the fast axis along x.

    The slow component gains the phase exp(+i retardance), the field being exp(-i w t).
    """
    sin, cos = sine(xp), cosine(xp)
    return lambda retardance: (1.0, 1.0, 0.0, cos(retardance), -sin(retardance))


def attenuator(_: Primitives) -> KernelFunction:
    """Make ``(transmittance,) -> (t,)``."""
    return lambda transmittance: (transmittance,)


def complement(_: Primitives) -> KernelFunction:
    """Make ``(reflectance,) -> (1 - reflectance,)``: what a lossless splitter lets through."""
    return lambda reflectance: (1.0 - reflectance,)


def depolarizer(_: Primitives) -> KernelFunction:
    """Make ``(depolarization,) ->`` the sixteen numbers of diag(1, p, p, p), p = 1 - d."""
    return lambda depolarization: diagonal(1.0 - depolarization)


def diagonal(p: Any) -> tuple[Any, ...]:
    """Return the sixteen numbers of diag(1, p, p, p)."""
    return 1.0, *(p if place % 5 == 0 else 0.0 for place in range(1, 16))


def mirror(_: Primitives) -> KernelFunction:
    """Make ``(reflectance,) -> (Fs, Fp, B, C, S)`` of an ideal mirror, r_p = -r_s."""
    return lambda reflectance: (reflectance, reflectance, 0.0, -reflectance, 0.0)


def given(_: Primitives) -> KernelFunction:
    """Make the function that returns the numbers it is given."""
    return lambda *numbers: numbers


def unpolarized(_: Primitives) -> KernelFunction:
    """Make ``(intensity,) -> (I, 0, 0, 0)``."""
    return lambda intensity: (intensity, 0.0, 0.0, 0.0)


def polarized(_: Primitives) -> KernelFunction:
    """Make ``(I, s0, s1, s2, s3) -> (I s0, I s1, I s2, I s3)``."""
    return lambda intensity, *state: tuple(intensity * component for component in state)


def product(_: Primitives) -> KernelFunction:
    """Make ``(I, density) -> (I density,)``: what is emitted at a wavelength."""
    return lambda intensity, density: (intensity * density,)


def turn(xp: Primitives) -> KernelFunction:
    """Make ``(angle, ...) -> (cos 2a, sin 2a)``, for one angle or several turns in a row."""
    sin, cos = sine(xp), cosine(xp)

    def turned(*angles: Any) -> tuple[Any, Any]:
        twice = 2.0 * reduce(add, angles)
        return cos(twice), sin(twice)

    return turned


def turn_back(xp: Primitives) -> KernelFunction:
    """Make ``(angle,) -> (cos 2a, -sin 2a)``, the turn undone."""
    turned = turn(xp)

    def turned_back(angle: Any) -> tuple[Any, Any]:
        c, s = turned(angle)
        return c, -s

    return turned_back


def align(_: Primitives) -> KernelFunction:
    """Make ``(d, e) -> (cos 2a, sin 2a)``, (d - e)(d + e) and 2 d e over d^2 + e^2.

    d = x . x', e = z . (x cross x').
    """

    def aligned(d: Any, e: Any) -> tuple[Any, Any]:
        norm = d * d + e * e
        return (d - e) * (d + e) / norm, 2.0 * d * e / norm

    return aligned


_TURN, _REST_OF_TURN = 2.0 * math.pi, 2.4492935982947064e-16
"""2 pi as the sum of two floats."""

INFINITE = 1e30
"""The extinction ratio from which on nothing is left, and r - 1 is r in any precision."""


def faraday_rotation(xp: Primitives) -> KernelFunction:
    """Make ``(verdet, field, length) -> (cos 2a, -sin 2a)``, the light turned by V B L.

    Hecht, Optics, sec. 8.11.2.
    """
    turned_back = turn_back(xp)
    return lambda verdet, field, length: turned_back(verdet * field * length)


def waveplate(xp: Primitives) -> KernelFunction:
    """Make ``(thickness, birefringence, wavelength) -> (Fs, Fp, B, C, S)``, fast along x.

    The retardance is 2 pi thickness birefringence / wavelength; Born & Wolf, Principles of Optics,
    sec. 15.4.2. Its rounding, thousands of radians in a thick plate, is kept beside it.
    """
    sin, cos, two_product, without = xp.sin, xp.cos, xp.two_product, _without_trace(xp)

    def retard(thickness: Any, birefringence: Any, wavelength: Any) -> tuple[Any, ...]:
        path, rest_of_path = two_product(thickness, birefringence)
        turns = path / wavelength
        back, rest_of_back = two_product(turns, wavelength)
        rest_of_turns = ((path - back) - rest_of_back + rest_of_path) / wavelength
        angle, rest = two_product(turns, _TURN)
        rest = rest + (turns * _REST_OF_TURN + rest_of_turns * _TURN)
        c, s, c_rest, s_rest = cos(angle), sin(angle), cos(rest), sin(rest)
        C, S = c * c_rest - s * s_rest, s * c_rest + c * s_rest
        return 1.0, 1.0, 0.0, without(angle, C), -without(angle, S)

    return retard


def _without_trace(xp: Primitives) -> Callable[[Any, Any], Any]:
    """Make ``(angle, value) -> value``, 0 where the angle, of half a turn at most, has no more."""
    absolute, minimum, where = xp.absolute, xp.minimum, xp.where

    def cleared(angle: Any, value: Any) -> Any:
        trace = xp.below_rounding(minimum(absolute(angle), math.pi), absolute(value))
        return value - where(trace, xp.fixed(value), 0.0)

    return cleared


def polarizing_reflection(xp: Primitives) -> KernelFunction:
    """Make ``(Tp/Ts, Rs/Rp) -> (Fs, Fp, B, C, S)`` of what is reflected, r_p = -r_s in phase."""
    shared = _shared(xp)

    def reflect(of_transmitted: Any, of_reflected: Any) -> tuple[Any, ...]:
        s, p, half, across = shared(of_reflected, of_transmitted)
        return s, p, half, -across, 0.0

    return reflect


def polarizing_transmission(xp: Primitives) -> KernelFunction:
    """Make ``(Tp/Ts, Rs/Rp) -> (Fs, Fp, B, C, S)`` of what is transmitted, without retardance."""
    shared = _shared(xp)

    def transmit(of_transmitted: Any, of_reflected: Any) -> tuple[Any, ...]:
        p, s, half, across = shared(of_transmitted, of_reflected)
        return s, p, -half, across, 0.0

    return transmit


def _shared(xp: Primitives) -> KernelFunction:
    """Make ``(r, t) -> (Rs, Rp, (Rs - Rp) / 2, sqrt(Rs Rp))``; of ``(t, r)``, Tp and Ts so.

    Without loss, Ts + Rs = Tp + Rp = 1: Rs = (1 - 1/t) / (1 - 1/(r t)) and Rp = Rs / r.
    """
    sqrt, where, minimum = xp.sqrt, xp.where, xp.minimum

    def shared(r: Any, t: Any) -> tuple[Any, ...]:
        one, other = minimum(r, INFINITE), minimum(t, INFINITE)
        leak = where(r < INFINITE, 1.0 / one, 0.0)
        stored, of_other = ((ratio - 1.0) / ratio for ratio in (one, other))
        # 1 - 1/(r t), as a sum of what is not negative.
        most = of_other / (of_other + stored * where(t < INFINITE, 1.0 / other, 0.0))
        across = where(r < INFINITE, 1.0 / sqrt(one), 0.0)
        return most, most * leak, 0.5 * most * stored, most * across

    return shared
