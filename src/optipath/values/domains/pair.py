"""Pairs of numbers, which may be the two parts of one."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

_REAL = (float, int, np.floating, np.integer)


def is_pair(value: Any) -> bool:
    """Tell whether a value is two real numbers written by hand; arrays are of several paths.

    Examples
    --------
    >>> is_pair((0.2, 3.4)), is_pair([0.2, 3.4]), is_pair((1.5, 1.6, 1.7))
    (True, True, False)
    >>> is_pair(np.array([0.2, 3.4]))
    False
    """
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        return False
    return all(map(is_real, value))


def is_real(number: Any) -> bool:
    """Tell whether something is a finite real number, and no array of it.

    Examples
    --------
    >>> is_real(2), is_real(True), is_real(math.nan), is_real("2")
    (True, False, False, False)
    """
    # What is too large for a float is none of these.
    of_type = isinstance(number, _REAL) and not isinstance(number, bool)
    return of_type and -math.inf < number < math.inf
