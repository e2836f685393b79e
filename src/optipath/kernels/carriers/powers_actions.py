"""How the shapes of Mueller matrices act on intensities alone: along x and along y, or in all.

Intensities stand over one denominator, which interfaces multiply: (x, y, over), or (total, over)
where no more is needed. Nothing here subtracts, but for what matrices of one's own bring along.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Primitives

Intensities: TypeAlias = tuple[Any, ...]
"""(x, y, over), or (total, over)."""

PowersAction: TypeAlias = Callable[[Sequence[Any], Intensities, int], Intensities]


def in_all(powers: Intensities) -> Intensities:
    """Return the total over the denominator.

    Examples
    --------
    >>> in_all((1.0, 3.0, 2.0)), in_all((4.0, 2.0))
    ((4.0, 2.0), (4.0, 2.0))
    """
    return (powers[0] + powers[1], powers[2]) if len(powers) == 3 else powers


def along_x_and_y(powers: Intensities) -> tuple[Any, Any, Any]:
    """Return what is along x, what is along y, and the denominator.

    Examples
    --------
    >>> along_x_and_y((4.0, 1.0))
    (2.0, 2.0, 1.0)
    """
    if len(powers) == 3:
        return powers[0], powers[1], powers[2]
    half = 0.5 * powers[0]
    return half, half, powers[1]


def scale_powers(xp: Primitives) -> PowersAction:
    """Make the action of (t,)."""
    del xp

    def act(numbers: Sequence[Any], powers: Intensities, count: int) -> Intensities:
        (t,) = numbers
        *parts, over = in_all(powers) if count == 1 else powers
        return *(t * part for part in parts), over

    return act


def rotation_powers(xp: Primitives) -> PowersAction:
    """Make the action of (cos 2a, sin 2a): shares of cos^2 a and sin^2 a, not divided."""
    where, absolute = xp.where, xp.absolute

    def act(numbers: Sequence[Any], powers: Intensities, count: int) -> Intensities:
        if count == 1 or len(powers) == 2:
            return in_all(powers)
        c, s = numbers
        x, y, over = powers
        # cos^2 a = (1 + cos 2a) / 2, and sin^2 a = (sin 2a)^2 / (2 (1 + cos 2a)).
        larger = 1.0 + absolute(c)
        most, least = larger * larger, s * s
        forward = c >= 0.0
        kept, crossed = where(forward, most, least), where(forward, least, most)
        return kept * x + crossed * y, crossed * x + kept * y, 2.0 * larger * over

    return act


def block_powers(xp: Primitives) -> PowersAction:
    """Make the action of (Fs, Fp, ...), of which only these two are looked at."""
    del xp
    return lambda numbers, powers, count: _passed(numbers[0], numbers[1], powers, count)


def fraction_powers(xp: Primitives) -> PowersAction:
    """Make the action of (Fs d, Fp d, d)."""
    del xp

    def act(numbers: Sequence[Any], powers: Intensities, count: int) -> Intensities:
        Fs, Fp, divisor = numbers
        *parts, over = _passed(Fs, Fp, powers, count)
        return *parts, divisor * over

    return act


def full_powers(xp: Primitives) -> PowersAction:
    """Make the action of sixteen numbers, of which S0 and S1 see four."""
    del xp

    def act(m: Sequence[Any], powers: Intensities, count: int) -> Intensities:
        if count == 1 and len(powers) == 2:
            return m[0] * powers[0], powers[1]
        x, y, over = along_x_and_y(powers)
        s0, s1 = (m[i] * (x + y) + m[i + 1] * (x - y) for i in (0, 4))
        return (s0, over) if count == 1 else (0.5 * (s0 + s1), 0.5 * (s0 - s1), over)

    return act


def _passed(Fs: Any, Fp: Any, powers: Intensities, count: int) -> Intensities:
    if count == 1 and len(powers) == 2:
        return 0.5 * (Fs + Fp) * powers[0], powers[1]
    x, y, over = along_x_and_y(powers)
    return in_all((Fs * x, Fp * y, over)) if count == 1 else (Fs * x, Fp * y, over)
