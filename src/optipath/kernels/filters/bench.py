"""What parts of a bench do: Faraday's rotation, wave plates by thickness, polarising splitters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from optipath.kernels.filters.rotation import turn_back

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

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

    The retardance is 2 pi thickness birefringence / wavelength; Born & Wolf, Principles of
    Optics, sec. 15.4.2. What rounds off it, thousands of radians in a thick plate, is kept
    beside it, so that cosine and sine have all digits that the three numbers have.
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
        kept, of_other = ((ratio - 1.0) / ratio for ratio in (one, other))
        # 1 - 1/(r t), as a sum of what is not negative.
        most = of_other / (of_other + kept * where(t < INFINITE, 1.0 / other, 0.0))
        across = where(r < INFINITE, 1.0 / sqrt(one), 0.0)
        return most, most * leak, 0.5 * most * kept, most * across

    return shared
