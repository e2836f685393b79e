"""Where compiled code writes what happens to one photon."""

from __future__ import annotations

from typing import Any

import numba as nb

WIDTH = 24
"""How many numbers an event takes; before the events, the end of the photon takes as many."""

(
    LAYER,
    COLUMN,
    LINE,
    FACET,
    SIDE,
    REFLECTED,
    COS,
    SIN,
    COS_2A,
    SIN_2A,
    SHARE,
    N1,
    N2,
) = range(13)
POINT, NORMAL, DIRECTION = 13, 16, 19
"""The places of an event's numbers; vectors take three, and the direction is that before it."""

OUTCOME, EVENTS, FIRST_K, FIRST_X, LAST_K, LAST_X = 0, 1, 2, 5, 8, 11
"""The places of the numbers of the end; vectors take three."""


@nb.njit(error_model="numpy")
def put(record: Any, at: int, vector: Any) -> None:
    """Write three numbers.

    Parameters
    ----------
    record : pointer or ndarray
        Where.
    at : int
        The place of the first.
    vector : tuple of float
        The numbers.
    """
    record[at], record[at + 1], record[at + 2] = vector
