"""Gains: how much of the light in a loop comes back each time round; 1 or more has no sum."""

from __future__ import annotations

import warnings
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import LoopWarning, ParameterError
from optipath.loops import LITTLE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.loops import Meeting

    Array = np.ndarray[Any, Any]

_MOST = 1 << 22
"""How many entries of matrices are looked at together; larger systems are judged by pivots."""

_WHOLE = 64.0 * np.finfo(np.float64).eps


def check_gains(meetings: Sequence[Meeting]) -> None:
    """Refuse light that gains going round; warn where nearly all of it comes back.

    Raises
    ------
    ParameterError
        Naming the loop and its gain.

    Warns
    -----
    LoopWarning
        With the gain and the condition number of the system.
    """
    faults = []
    for meeting in meetings:
        doubtful = ~np.asarray(reduce(np.logical_and, meeting.conditions, np.True_))
        if not np.any(doubtful):
            continue
        place = meeting.program.steps[meeting.loop.start].label
        gain, condition = _worst(meeting, doubtful)
        if gain >= 1.0 - _WHOLE:
            faults.append(
                f"light that goes round at '{place}' never fades: {gain:.9g} of it comes back each "
                f"time; let some of it leave, or absorb some"
            )
        elif gain > 1.0 - LITTLE:
            warnings.warn(
                f"of the light that goes round at '{place}', {gain:.9g} comes back each time; the "
                f"condition number of the sum is {condition:.2g}, by which errors of the values "
                f"that are given may be enlarged",
                LoopWarning,
                stacklevel=2,
            )
    if faults:
        raise ParameterError(*faults)


def _worst(meeting: Meeting, doubtful: Array) -> tuple[float, float]:
    """Return the largest gain among the doubtful paths of a batch, and the condition there.

    The condition number is that of (I - M)^-1 with respect to I and M, which unlike that of
    their difference sees a loop whose lights all stay alike.
    """
    shape, count = np.atleast_1d(doubtful).shape, len(meeting.unknowns)

    def picked(number: Any) -> Array:
        return np.broadcast_to(np.asarray(number, float), shape)[tuple(where.T)]

    where = np.argwhere(np.atleast_1d(doubtful))
    where = where[: max(1, _MOST // (count * count))]
    # What no light ever gets to may keep all of it.
    lit = np.stack([picked(_lit(number, doubtful.ndim)) for number in meeting.found], axis=-1) > 0
    if count * count > _MOST:
        left = np.where(lit, np.stack([picked(p) for p in meeting.pivots], axis=-1), 1.0)
        least = float(np.min(np.nan_to_num(left, nan=0.0)))
        return 1.0 - least, 2.0 / max(least, np.finfo(float).tiny)
    matrices = np.zeros((len(where), count, count))
    for column, found in enumerate(meeting.columns):
        for row, number in meeting.scattered(found.back).items():
            matrices[:, row, column] = picked(number)
    matrices *= lit[:, :, np.newaxis] & lit[:, np.newaxis, :]
    gains = np.abs(np.linalg.eigvals(matrices)).max(axis=-1)
    worst = int(np.argmax(gains))
    size = np.linalg.norm(matrices[worst], 2)
    with np.errstate(all="ignore"):
        sums = np.linalg.pinv(np.eye(count) - matrices[worst], rcond=0.0)
    return float(gains[worst]), float((1.0 + size) * np.linalg.norm(sums, 2))


def _lit(number: Any, axes: int) -> Array:
    """Return where an unknown is not 0, in any of the columns that may be found together."""
    lit = np.asarray(np.asarray(number) != 0.0)
    while lit.ndim > axes:
        lit = np.asarray(lit.any(axis=0))
    return lit
