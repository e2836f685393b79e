"""The shapes a Mueller matrix can have, and how each acts on the light that is carried.

A structure knows how many numbers describe it, which of them do nothing, how they act
on light (its components kept apart, never stacked), and how they look as a matrix.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.carriers.carried import (
    Carried,
    all_four,
    along_axes,
    carry,
    leaving,
    stokes_of,
)
from optipath.kernels.carriers.jones_actions import (
    JonesAction,
    block_jones,
    rotation_jones,
    scale_jones,
)
from optipath.kernels.carriers.powers_actions import (
    PowersAction,
    block_powers,
    fraction_powers,
    full_powers,
    rotation_powers,
    scale_powers,
)
from optipath.kernels.numbers.primitives import made
from optipath.kernels.numbers.vanishing import not_below_rounding, products

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Primitives

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
"""(Fs, Fp, B, C, S): [[A,B,0,0],[B,A,0,0],[0,0,C,S],[0,0,-S,C]], axes along the frame.

Fs = A + B and Fp = A - B act along x and y; each of the three keeps digits that the
other two have lost.
"""

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
