"""The cosine or the sine of an angle that is given, as formulas have it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.numbers.circular import without_rounding
from optipath.kernels.numbers.trigonometry import any_quadrant, first_quadrant

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Primitives
    from optipath.kernels.numbers.trigonometry import Digits
    from optipath.values.operands import Operand


def is_in_first_quadrant(operand: Operand, limits: tuple[float, float]) -> bool:
    """Tell whether the angle of an operand is known to be within 0 .. pi/2."""
    low, high = limits
    return not operand.value.is_negative and low >= 0.0 and high <= np.pi / 2


def of_angle(
    xp: Primitives, digits: Digits, operand: Operand, angle: Any, left: Any, *, first: bool
) -> Any:
    """Return the cosine or the sine that an operand is."""
    if first:
        return first_quadrant(xp, digits)(angle, left)[operand.part == "cos"]
    value = any_quadrant(xp, digits)(angle, left)[operand.part == "cos"]
    return without_rounding(xp, lambda _: value)(angle) if left is None else value
