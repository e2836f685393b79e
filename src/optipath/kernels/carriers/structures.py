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
from optipath.kernels.primitives import NUMPY, made, not_below_rounding, products, total
from optipath.kernels.vectors import hypotenuse

if TYPE_CHECKING:
    from optipath.kernels.primitives import Primitives


Column: TypeAlias = tuple[Any, Any, Any, Any]
"""(Re Ex, Im Ex, Re Ey, Im Ey)."""

Columns: TypeAlias = tuple[Column, Column]
Numbers: TypeAlias = Sequence[Any]
Row: TypeAlias = tuple[Any, Any, Any, Any]
Intensities: TypeAlias = tuple[Any, ...]
"""(x, y, over), or (total, over)."""

Action: TypeAlias = "Callable[[Primitives, Numbers, Carried, int], Carried]"
PowersAction: TypeAlias = "Callable[[Primitives, Numbers, Intensities, int], Intensities]"
JonesAction: TypeAlias = "Callable[[Primitives, Numbers, Columns], Columns]"


@dataclass(frozen=True)
class Structure:
    """One shape of Mueller matrix: how its numbers act on Stokes components, intensities, fields.

    `unpolarising` makes of its numbers those of an element that dims light alike along all axes.
    """

    name: str
    identity: tuple[float, ...]
    action: Action
    rows: Callable[[Primitives, Numbers], tuple[Row, Row, Row, Row]]
    powers: PowersAction
    jones: JonesAction | None = None
    unpolarising: Callable[[Numbers], Numbers] | None = None

    def __hash__(self) -> int:
        # As of kernels: what else belongs to a name is compared where names are equal.
        return hash(self.name)

    def known_rows(self, numbers: Sequence[float | None]) -> tuple[tuple[float | None, ...], ...]:
        """Return what is known of a matrix, for what is known of its numbers."""
        several = numbers or (None,) * len(self.identity)
        # What depends on a number that is not known comes to NaN.
        rows = self.rows(NUMPY, [math.nan if number is None else number for number in several])
        return tuple(
            tuple(float(entry) + 0.0 if math.isfinite(entry) else None for entry in row)
            for row in rows
        )


def _scale_jones(xp: Primitives, numbers: Numbers, columns: Columns) -> Columns:
    r = xp.sqrt(numbers[0])
    first, second = (tuple(r * part for part in column) for column in columns)
    return first, second


def _rotation_jones(xp: Primitives, numbers: Numbers, columns: Columns) -> Columns:
    """Turn fields by the half of the angle."""
    twice_c, twice_s = numbers
    larger = xp.sqrt(0.5 * (1.0 + xp.absolute(twice_c)))
    smaller = 0.5 * twice_s / larger
    c = xp.where(twice_c >= 0.0, larger, smaller)
    s = xp.where(twice_c >= 0.0, smaller, larger)

    def turned(column: Column) -> Column:
        a, b, d, e = column
        return c * a + s * d, c * b + s * e, c * d - s * a, c * e - s * b

    return turned(columns[0]), turned(columns[1])


def _block_jones(xp: Primitives, numbers: Numbers, columns: Columns) -> Columns:
    """Multiply by diag(r_s, r_p) with r_s real."""
    Fs, Fp, _, C, S = numbers
    size = made(hypotenuse, xp)(xp.absolute(C), xp.absolute(S))
    there = size > 0.0
    size = xp.where(there, size, 1.0)
    rs, rp = xp.sqrt(Fs), xp.sqrt(Fp)
    # r_p has the phase of conj(C + iS).
    re, im = xp.where(there, rp * (C / size), rp), rp * (S / size)

    def passed(column: Column) -> Column:
        a, b, d, e = column
        return rs * a, rs * b, re * d + im * e, re * e - im * d

    return passed(columns[0]), passed(columns[1])


def in_all(powers: Intensities) -> Intensities:
    """Return the total over the denominator."""
    return (powers[0] + powers[1], powers[2]) if len(powers) == 3 else powers


def along_x_and_y(powers: Intensities) -> tuple[Any, Any, Any]:
    """Return what is along x, what is along y, and the denominator."""
    if len(powers) == 3:
        return powers[0], powers[1], powers[2]
    half = 0.5 * powers[0]
    return half, half, powers[1]


def _scale_powers(_: Primitives, numbers: Numbers, powers: Intensities, count: int) -> Intensities:
    (t,) = numbers
    *parts, over = in_all(powers) if count == 1 else powers
    return *(t * part for part in parts), over


def _rotation_powers(
    xp: Primitives, numbers: Numbers, powers: Intensities, count: int
) -> Intensities:
    """Mix intensities by the shares cos^2 a and sin^2 a, not divided."""
    if count == 1 or len(powers) == 2:
        return in_all(powers)
    c, s = numbers
    x, y, over = powers
    # cos^2 a = (1 + cos 2a) / 2, and sin^2 a = (sin 2a)^2 / (2 (1 + cos 2a)).
    larger = 1.0 + xp.absolute(c)
    most, least = larger * larger, s * s
    forward = c >= 0.0
    stored, crossed = xp.where(forward, most, least), xp.where(forward, least, most)
    return stored * x + crossed * y, crossed * x + stored * y, 2.0 * larger * over


def _block_powers(_: Primitives, numbers: Numbers, powers: Intensities, count: int) -> Intensities:
    Fs, Fp = numbers[:2]
    if count == 1 and len(powers) == 2:
        return 0.5 * (Fs + Fp) * powers[0], powers[1]
    x, y, over = along_x_and_y(powers)
    return in_all((Fs * x, Fp * y, over)) if count == 1 else (Fs * x, Fp * y, over)


def _fraction_powers(
    xp: Primitives, numbers: Numbers, powers: Intensities, count: int
) -> Intensities:
    *parts, over = _block_powers(xp, numbers, powers, count)
    return *parts, numbers[2] * over


def _full_powers(_: Primitives, m: Numbers, powers: Intensities, count: int) -> Intensities:
    if count == 1 and len(powers) == 2:
        return m[0] * powers[0], powers[1]
    x, y, over = along_x_and_y(powers)
    s0, s1 = (m[i] * (x + y) + m[i + 1] * (x - y) for i in (0, 4))
    return (s0, over) if count == 1 else (0.5 * (s0 + s1), 0.5 * (s0 - s1), over)


def turn_linear(numbers: Numbers, s1: Any, s2: Any) -> tuple[Any, Any]:
    """Return (S1, S2) in a frame turned by a, from (cos 2a, sin 2a)."""
    c, s = numbers
    return c * s1 + s * s2, c * s2 - s * s1


def _scale(xp: Primitives, numbers: Numbers, carried: Carried, count: int) -> Carried:
    (t,) = numbers
    return tuple(t * component for component in leaving(xp, carried, count))


def _rotation(xp: Primitives, numbers: Numbers, carried: Carried, count: int) -> Carried:
    if count == 1:
        return leaving(xp, carried, 1)
    c, s = numbers
    weak, s1, s2, s3 = all_four(carried)
    t1, t2 = turn_linear(numbers, s1, s2)
    # |s1| - |t1| without a difference: 1 - |cos| is sin^2 / (1 + |cos|).
    forward = t1 >= 0.0
    larger = 1.0 + xp.absolute(c)
    share = xp.where(forward == (c * s1 >= 0.0), s * s / larger, larger)
    turned = weak + 0.5 * (xp.absolute(s1) * share - xp.where(forward, s * s2, -s * s2))
    weak = not_below_rounding(xp, turned, xp.absolute(s1) + xp.absolute(s2))
    return (weak, t1, t2, s3)[:count]


def _block(xp: Primitives, numbers: Numbers, carried: Carried, count: int) -> Carried:
    Fs, Fp, B, C, S = numbers
    x, y = along_axes(xp, carried)
    if count == 1:
        return (0.5 * (Fs * x + Fp * y),)
    weak, s1, s2, s3 = all_four(carried)
    behind = xp.minimum(Fs * x, Fp * y), 2.0 * B * weak + xp.where(s1 >= 0.0, Fs, Fp) * s1
    if count == 2:
        return behind
    across = products((C, s2), (S, s3))
    return *behind, across, *([products((C, s3), (-S, s2))] if count == 4 else [])


def grey_block(numbers: Numbers) -> Numbers:
    """Return the numbers of a block that dims light along both axes by the mean of these."""
    Fs, Fp, _, C, S = numbers
    mean = 0.5 * (Fs + Fp)
    return mean, mean, 0.0, C, S


def _grey_full(m: Numbers) -> Numbers:
    rows = (m[0], 0.0, 0.0, 0.0), (0.0, *m[5:8]), (0.0, *m[9:12]), (0.0, *m[13:16])
    return tuple(entry for row in rows for entry in row)


def _block_of_powers(xp: Primitives, numbers: Numbers, carried: Carried, count: int) -> Carried:
    return _block(xp, _block_numbers(numbers), carried, min(count, 2))


def _block_numbers(numbers: Numbers) -> Numbers:
    Fs, Fp, divisor = numbers
    Fs, Fp = Fs / divisor, Fp / divisor
    return Fs, Fp, 0.5 * (Fs - Fp), 0.0, 0.0


def _full(xp: Primitives, m: Numbers, carried: Carried, count: int) -> Carried:
    stokes = stokes_of(xp, carried)
    rows = [products(*zip(m[i : i + 4], stokes, strict=True)) for i in range(0, 4 * count, 4)]
    s0, s1, s2, s3 = (*rows, 0.0, 0.0, 0.0)[:4]
    return carry(xp, (s0, s1, s2, s3), count)


def _scale_rows(_: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    (t,) = numbers
    return (t, 0.0, 0.0, 0.0), (0.0, t, 0.0, 0.0), (0.0, 0.0, t, 0.0), (0.0, 0.0, 0.0, t)


def _rotation_rows(_: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    c, s = numbers
    return (1.0, 0.0, 0.0, 0.0), (0.0, c, s, 0.0), (0.0, -s, c, 0.0), (0.0, 0.0, 0.0, 1.0)


def _block_rows(xp: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    Fs, Fp, B, C, S = numbers
    # The first is never less than |B|, not even by a rounding, the second is smooth.
    A = 0.5 * (Fs + Fp) if xp.within else xp.minimum(Fs, Fp) + xp.absolute(B)
    return (A, B, 0.0, 0.0), (B, A, 0.0, 0.0), (0.0, 0.0, C, S), (0.0, 0.0, -S, C)


def _powers_rows(xp: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    return _block_rows(xp, _block_numbers(numbers))


def _full_rows(_: Primitives, numbers: Numbers) -> tuple[Row, Row, Row, Row]:
    m = tuple(numbers)
    return m[0:4], m[4:8], m[8:12], m[12:16]


SCALE = Structure("scale", (1.0,), _scale, _scale_rows, _scale_powers, _scale_jones)
"""One number t: t times the unit matrix."""

ROTATION = Structure(
    "rotation", (1.0, 0.0), _rotation, _rotation_rows, _rotation_powers, _rotation_jones
)
"""(cos 2a, sin 2a): the frame turned by a about the direction of travel."""

_NO_CHANGE = 1.0, 1.0, 0.0, 1.0, 0.0
BLOCK = Structure(
    "retarding diattenuator",
    _NO_CHANGE,
    _block,
    _block_rows,
    _block_powers,
    _block_jones,
    grey_block,
)
"""(Fs, Fp, B, C, S): [[A,B,0,0],[B,A,0,0],[0,0,C,S],[0,0,-S,C]]; A + B acts along x, A - B on y."""

DEPOLARIZING_BLOCK = replace(BLOCK, name="depolarising diattenuator", jones=None)
"""The same with C and S of any size that light allows: incoherent sums of such matrices."""

POWERS = Structure("powers", (1.0, 1.0, 1.0), _block_of_powers, _powers_rows, _fraction_powers)
"""(Fs d, Fp d, d): what acts along x and y over one denominator, and nothing of the phase."""

_UNIT_MATRIX = tuple(float(i % 5 == 0) for i in range(16))
FULL = Structure("full", _UNIT_MATRIX, _full, _full_rows, _full_powers, unpolarising=_grey_full)
"""Sixteen numbers, row by row."""


def mueller_of_jones(j: Numbers) -> tuple[Any, ...]:
    """Return the sixteen entries of the Mueller matrix of (Re J00, Im J00, Re J01, ..., Im J11).

    As `PAULI` has it, M_ij = 1/2 tr(s_i J s_j J*).
    """
    a, b, c, d = (j[0:2], j[2:4], j[4:6], j[6:8])
    xx, xy, yx, yy = (products(*zip(e, e, strict=True)) for e in (a, b, c, d))
    ab, cd, ac, bd, ad, bc = map(_conjugate, (a, c, a, b, a, b), (b, d, c, d, d, c))
    x, y, of_x, of_y = xx + xy, yx + yy, xx - xy, yx - yy
    return (
        *(0.5 * (x + y), 0.5 * (of_x + of_y), ab[0] + cd[0], -ab[1] - cd[1]),
        *(0.5 * (x - y), 0.5 * (of_x - of_y), ab[0] - cd[0], cd[1] - ab[1]),
        *(ac[0] + bd[0], ac[0] - bd[0], ad[0] + bc[0], bc[1] - ad[1]),
        *(ac[1] + bd[1], ac[1] - bd[1], ad[1] + bc[1], ad[0] - bc[0]),
    )


def _conjugate(a: Numbers, b: Numbers) -> tuple[Any, Any]:
    """Return conj(a) b."""
    return products((a[0], b[0]), (a[1], b[1])), products((a[0], b[1]), (-a[1], b[0]))


def _matrix_jones(_: Primitives, numbers: Numbers, columns: Columns) -> Columns:
    a, b, c, d = (numbers[part : part + 2] for part in range(16, 24, 2))

    def passed(column: Column) -> Column:
        x, y = column[:2], column[2:]
        return *_sum_of_two(a, x, b, y), *_sum_of_two(c, x, d, y)

    return passed(columns[0]), passed(columns[1])


def _sum_of_two(a: Numbers, x: Numbers, b: Numbers, y: Numbers) -> tuple[Any, Any]:
    """Return a x + b y of complex numbers."""
    real = products((a[0], x[0]), (-a[1], x[1]), (b[0], y[0]), (-b[1], y[1]))
    return real, products((a[0], x[1]), (a[1], x[0]), (b[0], y[1]), (b[1], y[0]))


def _grey_jones(numbers: Numbers) -> Numbers:
    return *_grey_full(numbers), *numbers[16:]


JONES = Structure(
    "Jones matrix",
    (*_UNIT_MATRIX, *(float(i in (0, 6)) for i in range(8))),
    _full,
    _full_rows,
    _full_powers,
    _matrix_jones,
    _grey_jones,
)
"""A full one of what does not depolarize, and its Jones matrix, `mueller_of_jones`."""


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
    return reduce(
        sub, [numbers[place] for place in subtracted], total([numbers[at] for at in added])
    )
