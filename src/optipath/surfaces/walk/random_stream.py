"""NumPy's generator SFC64, carried on in compiled code."""

from __future__ import annotations

from typing import Any

import numba as nb
import numpy as np

_ONE = np.uint64(1)
_SHIFTS = np.uint64(11), np.uint64(3), np.uint64(24), np.uint64(40)
_STEP = 2.0**-53


@nb.njit(error_model="numpy")
def uniform(state: Any) -> float:
    """Return a number from 0 up to 1, and move the state on by one.

    The number that ``numpy.random.Generator(SFC64).random()`` gives for the same state
    (C. Doty-Humphrey, PractRand, sfc64).
    """
    right, left, around, back = _SHIFTS
    a, b, c, counter = state[0], state[1], state[2], state[3]
    found = a + b + counter
    state[0] = b ^ (b >> right)
    state[1] = c + (c << left)
    state[2] = ((c << around) | (c >> back)) + found
    state[3] = counter + _ONE
    return np.float64(found >> right) * _STEP
