"""Hyperbolic functions, scaled before they are too large; those of small numbers have digits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives

_SINE = (1.0, 6.0, 20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0, 342.0)
"""By what each term of the sine's series is less than the one before, up to x^19."""


def scaled_hyperbolic(xp: Primitives) -> Callable[[Any, Any], tuple[Any, Any]]:
    """Make ``(x, shift) -> (cosh x exp(-shift), sinh x exp(-shift))`` for |x| <= shift.

    Where |x| is more by a rounding, of which large numbers have large ones, it is taken as shift;
    its slope stays.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> scaled_hyperbolic(FLOAT)(1e-20, 0.0), scaled_hyperbolic(FLOAT)(1000.0, 1000.0)
    ((1.0, 1e-20), (0.5, 0.5))
    """
    exp, where, absolute, fixed = xp.exp, xp.where, xp.absolute, xp.fixed

    def at_most_one(exponent: Any) -> Any:
        return exp(exponent - where(exponent > 0.0, fixed(exponent), 0.0))

    def hyperbolic(x: Any, shift: Any) -> tuple[Any, Any]:
        growing, falling = at_most_one(x - shift), at_most_one(-x - shift)
        small = absolute(x) < 1.0
        near = where(small, x, 0.0)
        square, series = near * near, 1.0
        for divisor in _SINE[:0:-1]:
            series = 1.0 + square * series / divisor
        sine = where(small, near * series * exp(-shift), 0.5 * (growing - falling))
        return 0.5 * (growing + falling), sine

    return hyperbolic
