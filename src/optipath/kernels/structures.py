"""The shapes a Mueller matrix can have, and how each acts on Stokes components.

A structure knows how many numbers describe it, how they act on the four
components of a light (kept apart, never stacked), which numbers do nothing,
and how they look as a full matrix. Only arithmetic: every engine can use it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

Number: TypeAlias = Any
Numbers: TypeAlias = Sequence[Number]
Stokes: TypeAlias = tuple[Number, Number, Number, Number]


IDENTITY_COLUMNS: tuple[Stokes, ...] = (
    (1.0, 0.0, 0.0, 0.0),
    (0.0, 1.0, 0.0, 0.0),
    (0.0, 0.0, 1.0, 0.0),
    (0.0, 0.0, 0.0, 1.0),
)
"""The lights whose images are the columns of a Mueller matrix."""


@dataclass(frozen=True)
class Structure:
    """One shape of Mueller matrix.

    Attributes
    ----------
    name : str
        What explanations call it.
    identity : tuple of float
        The numbers that leave every light as it is.
    apply : callable
        ``apply(numbers, stokes) -> stokes``.
    """

    name: str
    identity: tuple[float, ...]
    apply: Callable[[Numbers, Stokes], Stokes]

    def matrix(self, numbers: Numbers) -> list[Stokes]:
        """Return the rows of the 4x4 matrix that the numbers describe."""
        return list(zip(*(self.apply(numbers, c) for c in IDENTITY_COLUMNS), strict=True))


def _apply_scale(numbers: Numbers, stokes: Stokes) -> Stokes:
    (t,) = numbers
    s0, s1, s2, s3 = stokes
    return t * s0, t * s1, t * s2, t * s3


def _apply_rotation(numbers: Numbers, stokes: Stokes) -> Stokes:
    c, s = numbers
    s0, s1, s2, s3 = stokes
    return s0, c * s1 + s * s2, c * s2 - s * s1, s3


def _apply_block(numbers: Numbers, stokes: Stokes) -> Stokes:
    A, B, C, S = numbers
    s0, s1, s2, s3 = stokes
    return A * s0 + B * s1, B * s0 + A * s1, C * s2 + S * s3, C * s3 - S * s2


def _apply_full(numbers: Numbers, stokes: Stokes) -> Stokes:
    s0, s1, s2, s3 = stokes
    m = numbers
    return (
        m[0] * s0 + m[1] * s1 + m[2] * s2 + m[3] * s3,
        m[4] * s0 + m[5] * s1 + m[6] * s2 + m[7] * s3,
        m[8] * s0 + m[9] * s1 + m[10] * s2 + m[11] * s3,
        m[12] * s0 + m[13] * s1 + m[14] * s2 + m[15] * s3,
    )


SCALE = Structure("scale", (1.0,), _apply_scale)
"""One number t: t times the unit matrix."""

ROTATION = Structure("rotation", (1.0, 0.0), _apply_rotation)
"""(cos 2a, sin 2a): the frame turned by a about the direction of travel."""

BLOCK = Structure("retarding diattenuator", (1.0, 0.0, 1.0, 0.0), _apply_block)
"""(A, B, C, S): [[A,B,0,0],[B,A,0,0],[0,0,C,S],[0,0,-S,C]], axes along the frame."""

FULL = Structure("full", tuple(float(i % 5 == 0) for i in range(16)), _apply_full)
"""Sixteen numbers, row by row."""
