"""Steps along an axis, halved where what is drawn over it changes fast."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    Numbers = npt.NDArray[np.float64]


START = 721
"""How many values there are before steps are halved."""

_HALVINGS = 5
_NEAR = 0.01
"""How far the middle of a step may be off the line, of the size of the picture."""

_SMOOTH = 4.0
"""How much nearer to the line the middle of a smooth curve is after its step is halved."""

_FAST = 0.01
"""Where so many steps are rough there may be narrow lines within the others: all are halved."""

_IN_A_ROW = 4
"""A jump leaves a step that no halving mends, or two; fast changes leave many."""


class FineSteps(NamedTuple):
    """Values along an axis.

    Shapes: values (count,); numbers (count, k).
    """

    values: Numbers
    numbers: Numbers
    resolved: bool

    def told(self, name: str) -> str:
        """Return what is to be said where lines are not near.

        >>> FineSteps(np.zeros(721), np.zeros((721, 1)), resolved=False).told("wavelength")
        'it changes faster with wavelength than 721 points tell; give values in a smaller range'
        """
        if self.resolved:
            return ""
        count = len(self.values)
        message = f"it changes faster with {name} than {count} points tell"
        return f"{message}; give values in a smaller range"


def fine_steps(
    values: npt.ArrayLike,
    numbers: Numbers,
    numbers_at: Callable[[Numbers], Numbers],
    on_picture: Callable[[Numbers], Numbers],
) -> FineSteps:
    """Halve steps while the middle of what is drawn over them is off the straight line.

    Shapes: values (n,); numbers (n, k).

    >>> bent = lambda x: np.maximum(x - 1.0, 0.0)[:, np.newaxis]
    >>> x = np.array([0.0, 1.0, 2.0])
    >>> fine_steps(x, bent(x), bent, on_picture=lambda y: y).values
    array([0. , 0.5, 1. , 1.5, 2. ])
    """
    values = np.asarray(values, np.float64)
    points = on_picture(numbers)
    halved = _any_there(points)
    rough = np.zeros_like(halved)
    for _ in range(_HALVINGS):
        (at,) = halved.nonzero()
        if not at.size:
            break
        middles = values[at] + (values[at + 1] - values[at]) / 2.0
        result = numbers_at(middles)
        off = _off_line(points[at], on_picture(result), points[at + 1])
        rough = np.zeros_like(halved)
        rough[at] = off > _SMOOTH * _NEAR
        values = np.insert(values, at + 1, middles)
        numbers = np.insert(numbers, at + 1, result, axis=0)
        points = on_picture(numbers)
        halved = np.zeros(len(values) - 1, np.bool_)
        first = (at + np.arange(at.size))[off > _NEAR]
        # A middle may be on the line by chance: neighbours are halved, too.
        for step in (first - 1, first, first + 1, first + 2):
            halved[step.clip(0, len(halved) - 1)] = True
        halved |= rough.mean() > _FAST
        halved &= _any_there(points)
    in_a_row = np.convolve(rough, np.ones(_IN_A_ROW))
    return FineSteps(values, numbers, resolved=bool(in_a_row.max(initial=0.0) < _IN_A_ROW))


def _any_there(points: Numbers) -> npt.NDArray[np.bool_]:
    """Return at which steps there is something to draw, at one end at least."""
    there = np.isfinite(points)
    return np.asarray((there[:-1] | there[1:]).any(axis=1))


def _off_line(left: Numbers, middle: Numbers, right: Numbers) -> Numbers:
    """Return how far middles are off the line, and 1 where it begins or ends beside them."""
    there = [np.isfinite(each) for each in (left, middle, right)]
    ends = (there[0] != there[1]) | (there[1] != there[2])
    with np.errstate(invalid="ignore"):
        off = np.abs(middle - left / 2.0 - right / 2.0)
    every: Numbers = np.where(ends, 1.0, np.nan_to_num(off, nan=0.0))
    return np.asarray(every.max(axis=1, initial=0.0))
