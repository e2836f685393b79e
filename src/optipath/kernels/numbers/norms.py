"""The size of vectors, at any scale, with slopes at 0 as well."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

from optipath.kernels.numbers.vanishing import products

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives


def common_size(xp: Primitives) -> Callable[..., Any]:
    """Make ``(x, ...) ->`` the largest absolute value, without a slope, or 1 where all are 0.

    What is divided by it has squares that neither vanish nor are too large.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> common_size(FLOAT)(0.5, -3.0), common_size(FLOAT)(0.0, 0.0)
    (3.0, 1.0)
    """
    maximum, absolute, where, fixed = xp.maximum, xp.absolute, xp.where, xp.fixed

    def size(*numbers: Any) -> Any:
        largest = fixed(reduce(maximum, map(absolute, numbers)))
        return where(largest > 0.0, largest, 1.0)

    return size


def norm(xp: Primitives) -> Callable[..., Any]:
    """Make ``(x, ...) -> sqrt(x^2 + ...)``; its slope is 0 where all are 0.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> norm(FLOAT)(3.0, -4.0), norm(FLOAT)(0.0, 0.0), norm(FLOAT)(1e200, 0.0)
    (5.0, 0.0, 1e+200)
    """
    sqrt, where, size_of = xp.sqrt, xp.where, common_size(xp)

    def length(*numbers: Any) -> Any:
        size = size_of(*numbers)
        near_one = [number / size for number in numbers]
        square = products(*zip(near_one, near_one, strict=True))
        some = square > 0.0
        return where(some, size * sqrt(where(some, square, 1.0)), 0.0)

    return length
