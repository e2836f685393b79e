"""Gains: how much of the light in a loop comes back each time round; 1 or more has no sum."""

from __future__ import annotations

import warnings
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import LoopWarning, ParameterError
from optipath.loops import LITTLE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.loops import Meeting

    Array = np.ndarray[Any, Any]

_MOST = 1 << 22
"""How many entries of matrices are looked at together; larger systems are judged by pivots."""


_FEW_DIGITS = 1e-9


class Worst(NamedTuple):
    """That path of a batch of which most stays in a loop.

    Attributes
    ----------
    closed : bool
        Whether all of some light stays, or more.
    leaves : float
        How much leaves each time round, as a share.
    condition : float
        The condition number of the sum.
    """

    closed: bool
    leaves: float
    condition: float


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
        if np.all(reduce(np.logical_and, meeting.conditions, np.True_)):
            continue
        place = meeting.program.steps[meeting.loop.start].label
        worst = _worst(meeting)
        if worst.closed:
            faults.append(
                f"light that goes round at '{place}' never fades: {1.0 - worst.leaves:.9g} of it "
                f"comes back each time; let some of it leave, or absorb some"
            )
        elif worst.leaves < LITTLE:
            warnings.warn(
                f"of the light that goes round at '{place}', all but {worst.leaves:.2g} comes back "
                f"each time; the condition number of the sum is {worst.condition:.2g}, by which "
                f"errors of the values that are given may be enlarged",
                LoopWarning,
                stacklevel=2,
            )
    if faults:
        raise ParameterError(*faults)


def _worst(meeting: Meeting) -> Worst:
    """Return the worst of the doubtful paths of a batch.

    The condition number is that of (I - M)^-1 with respect to I and M, which unlike that of
    their difference sees a loop whose lights all stay alike.
    """
    columns = [meeting.scattered(column.back) for column in meeting.columns]
    numbers = [*meeting.pivots, *(number for column in columns for number in column.values())]
    shape = np.broadcast_shapes((1,), *map(np.shape, numbers))
    holds = reduce(np.logical_and, meeting.conditions, np.True_)
    where = np.argwhere(~np.broadcast_to(holds, shape))
    count = len(meeting.unknowns)

    def picked(number: Any) -> Array:
        return np.broadcast_to(np.asarray(number, float), shape)[tuple(where.T)]

    # What no light ever gets to may keep all of it.
    lit = np.stack([picked(_lit(number, shape)) for number in meeting.found], axis=-1) > 0.0
    pivots = np.where(lit, np.stack([picked(p) for p in meeting.pivots], axis=-1), 1.0)
    pivots = np.nan_to_num(pivots, nan=0.0)
    least, most = pivots.min(axis=-1), max(1, _MOST // (count * count))
    first = np.argsort(least)[:most]
    closed = bool(least[first[0]] <= 0.0)
    if count * count > _MOST:
        leaves = float(least[first[0]])
        return Worst(closed, leaves, 2.0 / max(leaves, np.finfo(float).tiny))
    where, lit = where[first], lit[first]
    matrices = np.zeros((len(where), count, count))
    for place, column in enumerate(columns):
        for row, number in column.items():
            matrices[:, row, place] = picked(number)
    matrices *= lit[:, :, np.newaxis] & lit[:, np.newaxis, :]
    gain, condition = _largest_gain(matrices)
    leaves = 1.0 - gain
    if not closed and leaves < _FEW_DIGITS:
        # Next to 1, a gain has lost the digits that the pivots still have.
        leaves = max(leaves, float(least[first[0]]))
    return Worst(closed, leaves, condition)


def _largest_gain(matrices: Array) -> tuple[float, float]:
    """Return the largest spectral radius of several matrices, and the condition of that one."""
    gains = np.abs(np.linalg.eigvals(matrices)).max(axis=-1)
    worst = matrices[int(np.argmax(gains))]
    with np.errstate(all="ignore"):
        sums = np.linalg.pinv(np.eye(len(worst)) - worst, rcond=0.0)
    condition = (1.0 + np.linalg.norm(worst, 2)) * np.linalg.norm(sums, 2)
    return float(gains.max()), float(condition)


def _lit(number: Any, shape: tuple[int, ...]) -> Array:
    """Return where an unknown is not 0, for any of the paths that share a loop."""
    lit = np.asarray(np.asarray(number) != 0.0)
    while lit.ndim > len(shape):
        lit = np.asarray(lit.any(axis=0))
    own = shape[len(shape) - lit.ndim :]
    shared = tuple(axis for axis, length in enumerate(own) if length == 1)
    return np.asarray(lit.any(axis=shared, keepdims=True))
