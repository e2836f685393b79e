"""Beckmann's density of slopes: those of a surface whose heights are normally distributed."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.numbers.primitives import Primitives


def beckmann(xp: Primitives) -> Callable[[Any, Any, Any, Any], Any]:
    """Make ``(slope_x, slope_y, alpha_x, alpha_y) -> density``, which is 1 over all slopes.

    exp(-(slope_x / alpha_x)^2 - (slope_y / alpha_y)^2) / (pi alpha_x alpha_y); alpha^2 is twice
    the mean square slope along an axis (E. Heitz, "Generating procedural Beckmann surfaces",
    2015).

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> beckmann(FLOAT)(0.0, 0.0, 1.0, 1.0) * pi
    1.0
    """
    exp = xp.exp

    def density(slope_x: Any, slope_y: Any, alpha_x: Any, alpha_y: Any) -> Any:
        x, y = slope_x / alpha_x, slope_y / alpha_y
        return exp(-(x * x + y * y)) / alpha_x / alpha_y / pi

    return density
