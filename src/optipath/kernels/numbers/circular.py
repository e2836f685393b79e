"""Cosine and sine that are 0 where the angle cannot tell them from 0.

Pi/2 has no exact float: cos(pi/2) is 6e-17, the rounding of the angle itself. A filter
at 90 degrees would so let a trace of the wrong component through, which near Brewster's
angle is all there is. What vanishes when it is added to the angle is no more than the
angle's own rounding, and is taken as 0, in any precision; at angles so huge that their rounding
is no longer small nothing is taken away.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives


def cosine(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``cos``, 0 at the odd multiples of pi/2.

    Examples
    --------
    >>> import math
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> cosine(FLOAT)(math.pi / 2), cosine(FLOAT)(math.pi)
    (0.0, -1.0)
    """
    return without_rounding(xp, xp.cos)


def sine(xp: Primitives) -> Callable[[Any], Any]:
    """Make ``sin``, 0 at the multiples of pi.

    Examples
    --------
    >>> import math
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> sine(FLOAT)(math.pi), sine(FLOAT)(1e-300)
    (0.0, 1e-300)
    """
    return without_rounding(xp, xp.sin)


def without_rounding(xp: Primitives, function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Make a sine or cosine that is 0 where the angle cannot tell it from 0.

    Units: the result in radians.
    """
    where, below_rounding, fixed = xp.where, xp.below_rounding, xp.fixed

    def rounded(angle: Any) -> Any:
        value = function(angle)
        # The value is taken away from itself, not replaced, so that its slope stays.
        return value - where(below_rounding(angle, value), fixed(value), 0.0)

    return rounded
