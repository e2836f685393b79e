"""Multiples of numbers with an offset."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np

from optipath.values.arrays.jax_values import is_jax
from optipath.values.roundings import ENDLESS

_ROUNDINGS = 2.0**-51
"""How many parts of its terms a sum is rounded by, at most."""


def affine(scale: float, offset: float, numbers: Any, limits: tuple[float, float] = ENDLESS) -> Any:
    """Return a multiple of numbers plus an offset.

    Examples
    --------
    >>> affine(2.0, 0.5, np.float32([0.25]))
    array([1.])
    """
    if not offset and scale in (1.0, -1.0):
        return numbers if scale == 1.0 else -numbers
    if isinstance(numbers, np.ndarray):
        numbers = numbers.astype(np.result_type(numbers, np.float64), copy=False)
    with np.errstate(over="ignore"):  # What is not finite is told by who looks at it.
        found = scale * numbers + offset
    return found if is_jax(found) else _settled(found, limits, offset)


def _settled(found: Any, limits: tuple[float, float], offset: float) -> Any:
    """Return sums; what is beyond a limit by the rounding of a sum alone, as that limit."""
    if limits == ENDLESS or np.iscomplexobj(found):
        return found
    for limit, beyond in zip(limits, (operator.lt, operator.gt), strict=True):
        outside = beyond(found, limit)
        if np.any(outside) and math.isfinite(limit):
            apart = _ROUNDINGS * (abs(limit) + abs(offset))
            settled = np.where(outside & (abs(found - limit) <= apart), limit, found)
            found = settled if np.ndim(found) else type(found)(settled)
    return found
