"""The angle of a point in the operations that every engine does alike.

The fraction is that of the Cephes library (Moshier, Methods and Programs for Mathematical
Functions, 1989, ``atan.c``); errors are below 2 units in the last place.
"""

from __future__ import annotations

import math
from functools import reduce
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives

_ABOVE = (
    -8.750608600031904122785e-1,
    -1.615753718733365076637e1,
    -7.500855792314704667340e1,
    -1.228866684490136173410e2,
    -6.485021904942025371773e1,
)
_BELOW = (
    1.0,
    2.485846490142306297962e1,
    1.650270098316988542046e2,
    4.328810604912902668951e2,
    4.853903996359136964868e2,
    1.945506571482613964425e2,
)
_EIGHTH = math.tan(math.pi / 8.0)
_RIGHT_LOW = 6.123233995736766e-17
"""What pi / 2 is more than its float."""


def arc_tangent(xp: Primitives) -> Callable[[Any, Any], Any]:
    """Make ``(y, x) -> angle`` of a point, within -pi .. pi; that of the origin is 0.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> angle = arc_tangent(FLOAT)
    >>> angle(1.0, -1.0), angle(-2.0, 0.0), angle(0.0, 0.0)
    (2.356194490192345, -1.5707963267948966, 0.0)
    """
    where, absolute = xp.where, xp.absolute
    maximum, minimum = xp.maximum, xp.minimum

    def angle(y: Any, x: Any) -> Any:
        up, along = absolute(y), absolute(x)
        longer, shorter = maximum(up, along), minimum(up, along)
        # One quotient, of what is left beside 0 or beside pi / 4.
        far = shorter > _EIGHTH * longer
        above, below = where(far, shorter - longer, shorter), where(far, shorter + longer, longer)
        t = above / where(below > 0.0, below, 1.0)
        square = t * t
        over, under = (
            reduce(lambda total, other: total * square + other, parts[1:], parts[0])
            for parts in (_ABOVE, _BELOW)
        )
        small = t * (square * over / under)
        first = where(far, 0.25 * math.pi + (small + 0.5 * _RIGHT_LOW + t), small + t)
        first = where(up > along, 0.5 * math.pi - (first - _RIGHT_LOW), first)
        first = where(x < 0.0, math.pi - (first - 2.0 * _RIGHT_LOW), first)
        return where(y < 0.0, -first, first)

    return angle
