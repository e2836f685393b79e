"""Structures: the shapes of Mueller matrices, how each acts on light, Cloude's coherency matrix.

A structure knows how many numbers describe it, how they act on light (components apart, never
stacked), and how they look as a matrix. A phase common to a column is not carried, as it is
unobservable.

Intensities have one denominator, which interfaces multiply: (x, y, over), or (total, over). Nothing
here subtracts, but for matrices of one's own.

S. R. Cloude, Optik 75, 26 (1986): a Mueller matrix is physical if no eigenvalue of its
coherency matrix is negative.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from operator import sub
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.kernels.carriers.carried import (
    Carried,
    all_four,
    along_axes,
    carry,
    leaving,
    stokes_of,
)
from optipath.kernels.primitives import NUMPY, made, not_below_rounding, products
from optipath.kernels.vectors import hypotenuse

if TYPE_CHECKING:
    from optipath.kernels.primitives import Primitives


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


Intensities: TypeAlias = tuple[Any, ...]
"""(x, y, over), or (total, over)."""

PowersAction: TypeAlias = Callable[[Sequence[Any], Intensities, int], Intensities]


def in_all(powers: Intensities) -> Intensities:
    """Return the total over the denominator.

    >>> in_all((1.0, 3.0, 2.0)), in_all((4.0, 2.0))
    ((4.0, 2.0), (4.0, 2.0))
    """
    return (powers[0] + powers[1], powers[2]) if len(powers) == 3 else powers


def along_x_and_y(powers: Intensities) -> tuple[Any, Any, Any]:
    """Return what is along x, what is along y, and the denominator.

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
        stored, crossed = where(forward, most, least), where(forward, least, most)
        return stored * x + crossed * y, crossed * x + stored * y, 2.0 * larger * over

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


Numbers: TypeAlias = Sequence[Any]
Action: TypeAlias = Callable[[Numbers, Carried, int], Carried]
Row: TypeAlias = tuple[Any, Any, Any, Any]


@dataclass(frozen=True)
class Structure:
    """One shape of Mueller matrix."""

    name: str
    identity: tuple[float, ...]
    action: Callable[[Primitives], Action]
    rows: Callable[[Primitives, Numbers], tuple[Row, Row, Row, Row]]
    powers: Callable[[Primitives], PowersAction]
    jones: Callable[[Primitives], JonesAction] | None = None
    unpolarising: Callable[[Numbers], Numbers] | None = None

    def made_for(self, primitives: Primitives) -> Action:
        """Return the action in terms of these primitives, made once and kept."""
        action: Action = made(self.action, primitives)
        return action

    def jones_for(self, primitives: Primitives) -> JonesAction:
        """Return the action on Jones columns, made once and kept."""
        assert self.jones is not None  # noqa: S101 - the composer refuses what may depolarise
        action: JonesAction = made(self.jones, primitives)
        return action

    def known_rows(self, numbers: Sequence[float | None]) -> tuple[tuple[float | None, ...], ...]:
        """Return what is known of a matrix, for what is known of its numbers.

        >>> BLOCK.known_rows((None, None, None, None, 0.0))[3]
        (0.0, 0.0, 0.0, None)
        """
        several = numbers or (None,) * len(self.identity)
        # What depends on a number that is not known comes to NaN.
        rows = self.rows(NUMPY, [math.nan if number is None else number for number in several])
        return tuple(
            tuple(float(entry) if math.isfinite(entry) else None for entry in row) for row in rows
        )

    def powers_for(self, primitives: Primitives) -> PowersAction:
        """Return the action on intensities along x and y, made once and kept."""
        action: PowersAction = made(self.powers, primitives)
        return action


def turn_linear(numbers: Numbers, s1: Any, s2: Any) -> tuple[Any, Any]:
    """Return (S1, S2) in a frame turned by a, from (cos 2a, sin 2a)."""
    c, s = numbers
    return c * s1 + s * s2, c * s2 - s * s1


def _scale(xp: Primitives) -> Action:
    def act(numbers: Numbers, carried: Carried, count: int) -> Carried:
        (t,) = numbers
        return tuple(t * component for component in leaving(xp, carried, count))

    return act


def _rotation(xp: Primitives) -> Action:
    absolute, where = xp.absolute, xp.where

    def act(numbers: Numbers, carried: Carried, count: int) -> Carried:
        if count == 1:
            return leaving(xp, carried, 1)
        c, s = numbers
        weak, s1, s2, s3 = all_four(carried)
        t1, t2 = turn_linear(numbers, s1, s2)
        # |s1| - |t1| without a difference: 1 - |cos| is sin^2 / (1 + |cos|).
        forward = t1 >= 0.0
        larger = 1.0 + absolute(c)
        share = where(forward == (c * s1 >= 0.0), s * s / larger, larger)
        turned = weak + 0.5 * (absolute(s1) * share - where(forward, s * s2, -s * s2))
        weak = not_below_rounding(xp, turned, absolute(s1) + absolute(s2))
        return (weak, t1, t2, s3)[:count]

    return act


def _block(xp: Primitives) -> Action:
    where, minimum = xp.where, xp.minimum

    def act(numbers: Numbers, carried: Carried, count: int) -> Carried:
        Fs, Fp, B, C, S = numbers
        x, y = along_axes(xp, carried)
        if count == 1:
            return (0.5 * (Fs * x + Fp * y),)
        weak, s1, s2, s3 = all_four(carried)
        behind = minimum(Fs * x, Fp * y), 2.0 * B * weak + where(s1 >= 0.0, Fs, Fp) * s1
        if count == 2:
            return behind
        across = products((C, s2), (S, s3))
        return *behind, across, *([products((C, s3), (-S, s2))] if count == 4 else [])

    return act


def grey_block(numbers: Numbers) -> Numbers:
    """Return the numbers of a block that dims light along both axes by the mean of these."""
    Fs, Fp, _, C, S = numbers
    mean = 0.5 * (Fs + Fp)
    return mean, mean, 0.0, C, S


def _grey_full(m: Numbers) -> Numbers:
    rows = (m[0], 0.0, 0.0, 0.0), (0.0, *m[5:8]), (0.0, *m[9:12]), (0.0, *m[13:16])
    return tuple(entry for row in rows for entry in row)


def _block_of_powers(xp: Primitives) -> Action:
    block = _block(xp)
    return lambda numbers, carried, count: block(_block_numbers(numbers), carried, min(count, 2))


def _block_numbers(numbers: Numbers) -> Numbers:
    Fs, Fp, divisor = numbers
    Fs, Fp = Fs / divisor, Fp / divisor
    return Fs, Fp, 0.5 * (Fs - Fp), 0.0, 0.0


def _full(xp: Primitives) -> Action:
    def act(m: Numbers, carried: Carried, count: int) -> Carried:
        stokes = stokes_of(xp, carried)
        rows = [products(*zip(m[i : i + 4], stokes, strict=True)) for i in range(0, 4 * count, 4)]
        s0, s1, s2, s3 = (*rows, 0.0, 0.0, 0.0)[:4]
        return carry(xp, (s0, s1, s2, s3), count)

    return act


def _scale_rows(xp: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    del xp
    (t,) = numbers
    return (t, 0.0, 0.0, 0.0), (0.0, t, 0.0, 0.0), (0.0, 0.0, t, 0.0), (0.0, 0.0, 0.0, t)


def _rotation_rows(xp: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    del xp
    c, s = numbers
    return (1.0, 0.0, 0.0, 0.0), (0.0, c, s, 0.0), (0.0, -s, c, 0.0), (0.0, 0.0, 0.0, 1.0)


def _block_rows(xp: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    Fs, Fp, B, C, S = numbers
    # The first is never less than |B|, not even by a rounding, the second is smooth.
    A = 0.5 * (Fs + Fp) if xp.within else xp.minimum(Fs, Fp) + xp.absolute(B)
    return (A, B, 0.0, 0.0), (B, A, 0.0, 0.0), (0.0, 0.0, C, S), (0.0, 0.0, -S, C)


def _powers_rows(xp: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    return _block_rows(xp, _block_numbers(numbers))


def _full_rows(xp: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    del xp
    m = tuple(numbers)
    return m[0:4], m[4:8], m[8:12], m[12:16]


SCALE = Structure("scale", (1.0,), _scale, _scale_rows, scale_powers, scale_jones)
"""One number t: t times the unit matrix."""

ROTATION = Structure(
    "rotation",
    (1.0, 0.0),
    _rotation,
    _rotation_rows,
    rotation_powers,
    rotation_jones,
)
"""(cos 2a, sin 2a): the frame turned by a about the direction of travel."""

BLOCK = Structure(
    "retarding diattenuator",
    (1.0, 1.0, 0.0, 1.0, 0.0),
    _block,
    _block_rows,
    block_powers,
    block_jones,
    grey_block,
)
"""(Fs, Fp, B, C, S): [[A,B,0,0],[B,A,0,0],[0,0,C,S],[0,0,-S,C]]; A + B acts along x, A - B on y."""

DEPOLARIZING_BLOCK = replace(BLOCK, name="depolarising diattenuator", jones=None)
"""The same with C and S of any size that light allows: incoherent sums of such matrices."""

POWERS = Structure("powers", (1.0, 1.0, 1.0), _block_of_powers, _powers_rows, fraction_powers)
"""(Fs d, Fp d, d): what acts along x and y over one denominator, and nothing of the phase."""

FULL = Structure(
    "full",
    tuple(float(i % 5 == 0) for i in range(16)),
    _full,
    _full_rows,
    full_powers,
    unpolarising=_grey_full,
)
"""Sixteen numbers, row by row."""


PAULI = np.array(
    [[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]], np.complex128
)
"""The matrices s_i for which S_i = <E| s_i |E>, in the order and with the signs of `Light`."""

# M_ij = 1/2 tr(s_i T s_j T*) with T = sum_k c_k s_k, and c_k conj(c_l) gathered into C_kl.
TO_MUELLER = 0.5 * np.einsum("iab,kbc,jcd,lda->klij", *[PAULI] * 4).reshape(16, 16)
"""What sixteen entries of a coherency matrix are multiplied by, from the right."""
FROM_MUELLER = 0.25 * TO_MUELLER.conj().T
"""What sixteen entries of a Mueller matrix are multiplied by, from the right."""


def is_physical(xp: Primitives, numbers: Numbers, spare: float) -> Any:
    """Tell whether no eigenvalue of the coherency matrix is below minus `spare` times M00.

    By elimination without pivots, which a positive matrix needs none of (Higham, Accuracy and
    Stability of Numerical Algorithms, sec. 10.1): right but for a few roundings of M00.

    >>> from optipath.kernels.primitives import FLOAT
    >>> mirror, turned_over = np.diag([1.0, 1.0, -1.0, -1.0]), np.diag([1.0, 1.0, 1.0, -1.0])
    >>> [bool(is_physical(FLOAT, m.ravel().tolist(), 1e-14)) for m in (mirror, turned_over)]
    [True, False]
    """
    real, imaginary = (
        [[_sum(numbers, *places) for places in row] for row in part] for part in _FOUR_TIMES
    )
    shift = 4.0 * spare * numbers[0]
    result: Any = np.True_
    for k in range(4):
        pivot = real[k][k] + shift
        result = result & (pivot >= 0.0)
        divisor = xp.where(pivot > 0.0, pivot, 1.0)
        for i in range(k + 1, 4):
            a, b = real[i][k] / divisor, imaginary[i][k] / divisor
            real[i][i] = real[i][i] - (a * real[i][k] + b * imaginary[i][k])
            for j in range(k + 1, i):
                c, d = real[j][k], imaginary[j][k]
                real[i][j] = real[i][j] - (a * c + b * d)
                imaginary[i][j] = imaginary[i][j] - (b * c - a * d)
    return result


def _places(part: Any) -> list[list[tuple[list[int], list[int]]]]:
    """Return which numbers of a matrix are added and subtracted for four times each entry."""
    weights = [[part[:, 4 * row + column] for column in range(row + 1)] for row in range(4)]
    return [
        [(np.flatnonzero(w > 0.0).tolist(), np.flatnonzero(w < 0.0).tolist()) for w in row]
        for row in weights
    ]


_FOUR_TIMES = _places(FROM_MUELLER.real), _places(FROM_MUELLER.imag)
"""The lower half of a coherency matrix, its real and its imaginary part."""


def _sum(numbers: Numbers, added: list[int], subtracted: list[int]) -> Any:
    if not added:
        return 0.0
    first, *others = [numbers[place] for place in added]
    return reduce(sub, [numbers[place] for place in subtracted], sum(others, first))
