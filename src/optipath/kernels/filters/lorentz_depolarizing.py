"""Dichroism, retardance and depolarisation at once: a matrix exponential by squarings.

What depolarises per length, diag(0, -d, -d, -d), does not commute with dichroism, so that the
exponential has no closed form of `lorentz`'s kind. By Cayley and Hamilton, exp(X) is a polynomial
of X of the third degree: powers of X are what its characteristic polynomial leaves of them. The
series of a small part of X is so squared again and again (Higham, Functions of Matrices (2008),
sec. 4.5 and 10.3), as exp - 1 in place of exp, so that small products keep their digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.geometry.vectors import dot
from optipath.kernels.numbers.norms import common_size
from optipath.kernels.numbers.vanishing import products

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

Polynomial: TypeAlias = "Sequence[Any]"
"""Four numbers, as `_Ring` has them."""

LARGEST, LARGEST_DICHROISM = 200.0, 80.0
"""How large |p| + |q| + d may be, and |p| of it: exp(80) is a number in float32, too."""

_SQUARINGS, _TERMS = 10, 12


def depolarizing_lorentz(xp: Primitives) -> KernelFunction:
    """Make ``(p1, p2, p3, q1, q2, q3, d, shift) ->`` the sixteen numbers of an exponential.

    It is that of F - diag(0, d, d, d) - shift, with the F of `lorentz`; |p| + |q| + d is to be at
    most `LARGEST`.
    """
    size_of, exp = common_size(xp), xp.exp
    polynomial, times = xp.apart(_polynomial), xp.apart(_times)

    def exponential(*generator_and_shift: Any) -> tuple[Any, ...]:
        *generator, shift = generator_and_shift
        size = size_of(*generator)
        p1, p2, p3, q1, q2, q3, d = (number / size for number in generator)
        x = (0.0, p1, p2, p3, p1, -d, -q3, q2, p2, q3, -d, -q1, p3, -q2, q1, -d)
        square = times(*x, *x)
        cube = times(*x, *square)
        p, q = (p1, p2, p3), (q1, q2, q3)
        P, Q = dot(p, p), dot(q, q)
        less_one, a, b, c = polynomial(size, P, Q, dot(p, q), d)
        left = exp(-shift)
        found = (
            products((a, one), (b, two), (c, three + (Q - P) * one))
            for one, two, three in zip(x, square, cube, strict=True)
        )
        return tuple(
            left * (1.0 + (less_one + entry) if place % 5 == 0 else entry)
            for place, entry in enumerate(found)
        )

    return exponential


def _polynomial(size: Any, P: Any, Q: Any, R: Any, d: Any) -> Polynomial:
    """Return the polynomial of X that is exp(size X) - 1, by |p|^2, |q|^2, p . q and d."""
    # det(x - X) = x y (y^2 + Q) - P y^2 - R^2 with y = x + d.
    square = d * d
    law = P * square + R * R, d * (Q - P + Q - square), -3.0 * square, -3.0 * d
    ring = _Ring(Q - P, law)
    part = size * 2.0**-_SQUARINGS
    series: Polynomial = (1.0, 0.0, 0.0, 0.0)
    for term in range(_TERMS, 1, -1):
        a, b, c, e = (part / term * number for number in ring.once_more(series))
        series = (1.0 + a, b, c, e)
    less_one: Polynomial = [part * number for number in ring.once_more(series)]
    for _ in range(_SQUARINGS):
        square = ring.squared(less_one)
        less_one = [2.0 * e + f for e, f in zip(less_one, square, strict=True)]
    return tuple(less_one)


class _Ring:
    """Polynomials of X as the coefficients of 1, X, X^2 and V = X^3 + k X, k = |q|^2 - |p|^2.

    V is 0 where nothing depolarises and p . q is 0, so that its coefficient, which is large
    where X turns light far, does no harm.
    """

    def __init__(self, k: Any, first: Polynomial) -> None:
        self.k = k
        self.first = first
        self.second = self.once_more(first)
        self.third = self.once_more(self.second)

    def once_more(self, polynomial: Polynomial) -> Polynomial:
        """Return X times a polynomial."""
        a, b, c, e = polynomial
        return _sum((0.0, a - self.k * c, b, c), (e, self.first))

    def squared(self, polynomial: Polynomial) -> Polynomial:
        """Return the square of a polynomial."""
        a, b, c, e = polynomial
        whole = (
            a * a,
            2.0 * b * (a - self.k * c),
            2.0 * a * c + b * b - self.k * (c * c),
            2.0 * (a * e + b * c),
        )
        once = 2.0 * b * e + c * c + self.k * (e * e)
        return _sum(whole, (once, self.first), (2.0 * c * e, self.second), (e * e, self.third))


def _sum(polynomial: Polynomial, *others: tuple[Any, Polynomial]) -> Polynomial:
    """Return a polynomial and multiples of others, together."""
    for factor, other in others:
        polynomial = [a + factor * b for a, b in zip(polynomial, other, strict=True)]
    return polynomial


def _times(*numbers: Any) -> tuple[Any, ...]:
    """Return the product of two matrices, their numbers one after the other."""
    one, other = numbers[:16], numbers[16:]
    return tuple(
        products(*zip(one[row : row + 4], other[column::4], strict=True))
        for row in range(0, 16, 4)
        for column in range(4)
    )
