"""The complementary error function of positive numbers, as a sum of positive terms."""

from __future__ import annotations

from math import exp, pi
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives

_STEP = 0.5
_TERMS = 13
"""The step between nodes, by which the sum is off by exp(-(pi / step)^2), and how many of them
have a weight above that."""

_NODES = [(_STEP * (i + 0.5)) ** 2 for i in range(_TERMS)]
_WEIGHTS = [2.0 * _STEP / pi * exp(-node) for node in _NODES]


def complementary_error(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``erfc`` for x from 0 to 50, to 4e-16 of 1.

    The midpoint rule for its integral of exp(-t^2) / (t^2 + x^2), which converges faster than any
    power, and the residue that it leaves (D. B. Hunter and T. Regan, Math. Comp. 26, 539 (1972)):
    nothing is subtracted.

    Examples
    --------
    >>> from math import erfc
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> abs(complementary_error(FLOAT)(0.7) - erfc(0.7)) < 4e-16
    True
    """
    exponential = xp.exp

    def erfc(x: Any) -> Any:
        square = x * x
        series = sum(
            weight / (node + square) for node, weight in zip(_NODES, _WEIGHTS, strict=True)
        )
        residue = exponential(-2.0 * pi / _STEP * x)
        return x * exponential(-square) * series + 2.0 * residue / (1.0 + residue)

    return erfc
