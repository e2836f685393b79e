"""How the shapes of Mueller matrices that do not depolarise act on Jones columns.

A phase that all of a column has in common is not carried: nothing can see it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.numbers.complex_pairs import hypotenuse

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Primitives

Column: TypeAlias = tuple[Any, Any, Any, Any]
"""(Re Ex, Im Ex, Re Ey, Im Ey)."""

Columns: TypeAlias = tuple[Column, Column]
JonesAction: TypeAlias = Callable[[Sequence[Any], Columns], Columns]


def scale_jones(xp: Primitives) -> JonesAction:
    """Make the action of (t,): the fields are scaled by the root."""
    sqrt = xp.sqrt

    def act(numbers: Sequence[Any], columns: Columns) -> Columns:
        r = sqrt(numbers[0])
        first, second = (tuple(r * part for part in column) for column in columns)
        return first, second

    return act


def rotation_jones(xp: Primitives) -> JonesAction:
    """Make the action of (cos 2a, sin 2a), by the half of the angle."""
    sqrt, where, absolute = xp.sqrt, xp.where, xp.absolute

    def act(numbers: Sequence[Any], columns: Columns) -> Columns:
        twice_c, twice_s = numbers
        larger = sqrt(0.5 * (1.0 + absolute(twice_c)))
        smaller = 0.5 * twice_s / larger
        c = where(twice_c >= 0.0, larger, smaller)
        s = where(twice_c >= 0.0, smaller, larger)

        def turned(column: Column) -> Column:
            a, b, d, e = column
            return c * a + s * d, c * b + s * e, c * d - s * a, c * e - s * b

        return turned(columns[0]), turned(columns[1])

    return act


def block_jones(xp: Primitives) -> JonesAction:
    """Make the action of (Fs, Fp, B, C, S): diag(r_s, r_p) with r_s real."""
    sqrt, where, absolute, length = xp.sqrt, xp.where, xp.absolute, hypotenuse(xp)

    def act(numbers: Sequence[Any], columns: Columns) -> Columns:
        Fs, Fp, _, C, S = numbers
        size = length(absolute(C), absolute(S))
        there = size > 0.0
        size = where(there, size, 1.0)
        rs, rp = sqrt(Fs), sqrt(Fp)
        # r_p has the phase of conj(C + iS).
        re, im = where(there, rp * (C / size), rp), rp * (S / size)

        def passed(column: Column) -> Column:
            a, b, d, e = column
            return rs * a, rs * b, re * d + im * e, re * e - im * d

        return passed(columns[0]), passed(columns[1])

    return act
