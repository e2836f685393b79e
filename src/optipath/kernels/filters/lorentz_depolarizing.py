"""Dichroism, retardance and depolarisation at once: a matrix exponential by squarings.

What depolarises per length, diag(0, -d, -d, -d), does not commute with dichroism, so that the
exponential has no closed form of `lorentz`'s kind. Scaling and squaring (Higham, Functions of
Matrices (2008), ch. 10), of exp(X) - 1 in place of exp(X): small products keep their digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.numbers.norms import norm
from optipath.kernels.numbers.vanishing import products

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

Matrix: TypeAlias = "Sequence[Any]"
"""Sixteen numbers, row by row."""

LARGEST, LARGEST_DICHROISM = 200.0, 80.0
"""How large |p| + |q| + d may be, and |p| of it: exp(80) is a number in float32, too."""

_SQUARINGS = 10
_THIRDS = (
    (1.0, 2.0),
    (6.0, 24.0, 120.0),
    (720.0, 5040.0, 40320.0),
    (362880.0, 3628800.0, 39916800.0),
)
"""The factorials of exp(X) - 1 up to X^11 / 11!, three for each power of X^3."""


def depolarizing_lorentz(xp: Primitives) -> KernelFunction:
    """Make ``(p1, p2, p3, q1, q2, q3, d) ->`` the sixteen numbers of an exponential.

    It is that of F - diag(0, d, d, d) - |p|, with the F of `lorentz`; |p| + |q| + d is to be at
    most `LARGEST`.
    """
    length, exp, times = norm(xp), xp.exp, xp.apart(_times)

    def exponential(*generator: Any) -> tuple[Any, ...]:
        part = 2.0**-_SQUARINGS
        p1, p2, p3, q1, q2, q3, d = (part * number for number in generator)
        x = (0.0, p1, p2, p3, p1, -d, -q3, q2, p2, q3, -d, -q1, p3, -q2, q1, -d)
        less_one = _less_one(x, times)
        for _ in range(_SQUARINGS):
            square = times(*less_one, *less_one)
            less_one = [2.0 * e + f for e, f in zip(less_one, square, strict=True)]
        left = exp(-length(*generator[:3]))
        return tuple(left * (e + 1.0 if place % 5 == 0 else e) for place, e in enumerate(less_one))

    return exponential


def _less_one(x: Matrix, times: Any) -> Matrix:
    """Return exp(X) - 1 by its series, three terms at a time (Paterson and Stockmeyer)."""
    square = times(*x, *x)
    cube = times(*x, *square)
    whole: Matrix = ()
    for one, two, three in _THIRDS[:0:-1]:
        terms = [
            (1.0 / one if place % 5 == 0 else 0.0) + a / two + b / three
            for place, (a, b) in enumerate(zip(x, square, strict=True))
        ]
        further = times(*cube, *whole) if whole else (0.0,) * 16
        whole = [a + b for a, b in zip(terms, further, strict=True)]
    further = times(*cube, *whole)
    return [a + 0.5 * b + c for a, b, c in zip(x, square, further, strict=True)]


def _times(*numbers: Any) -> tuple[Any, ...]:
    """Return the product of two matrices, their numbers one after the other."""
    one, other = numbers[:16], numbers[16:]
    return tuple(
        products(*zip(one[row : row + 4], other[column::4], strict=True))
        for row in range(0, 16, 4)
        for column in range(4)
    )
