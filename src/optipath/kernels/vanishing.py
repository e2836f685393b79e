"""Numbers that are 0, or that may be no more than the rounding of others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from optipath.kernels.primitives import Primitives


_SEVERAL = 64.0
"""How many roundings a negative intensity may come from."""


def products(*pairs: tuple[Any, Any]) -> Any:
    """Return the sum of products, without those that have a plain 0 for a factor.

    >>> products((2.0, 3.0), (1.0, 0.0), (1.0, 4.0))
    10.0
    """
    terms = [a * b for a, b in pairs if not (_is_plain_zero(a) or _is_plain_zero(b))]
    return sum(terms[1:], start=terms[0]) if terms else 0.0 * pairs[0][0] * pairs[0][1]


def _is_plain_zero(number: Any) -> bool:
    return type(number) is float and number == 0.0


def not_below_rounding(xp: Primitives, weak: Any, size: Any) -> Any:
    """Return an intensity, 0 where it is negative by no more than the roundings of a size.

    Matrices of one's own may make light that cannot be; its negative intensities stay.

    >>> from optipath.kernels.primitives import FLOAT
    >>> not_below_rounding(FLOAT, -1e-17, 0.5), not_below_rounding(FLOAT, -0.1, 0.5)
    (0.0, -0.1)
    """
    return _taken_as_0(xp, (weak < 0.0) & vanishes(weak, _SEVERAL * size), weak)


def not_above_rounding(xp: Primitives, number: Any, size: Any) -> Any:
    """Return a number, 0 where it is no more than the roundings of a size.

    >>> from optipath.kernels.primitives import FLOAT
    >>> not_above_rounding(FLOAT, -1e-16, 1.0), not_above_rounding(FLOAT, 1e-6, 1.0)
    (0.0, 1e-06)
    """
    return _taken_as_0(xp, vanishes(number, _SEVERAL * size), number)


def _taken_as_0(xp: Primitives, condition: Any, number: Any) -> Any:
    """Return a number, 0 where a condition holds; its slope stays."""
    if xp.within:
        return number - xp.where(condition, xp.fixed(number), 0.0)
    return xp.where(condition, 0.0, number)


def vanishes(number: Any, other: Any) -> Any:
    """Tell whether a number is no more than the rounding of another."""
    return other + number == other
