"""Slopes of the Stokes vector by differences, extrapolated to steps of 0.

Ridders' method (C. J. F. Ridders, Adv. Eng. Softw. 4, 75 (1982); Numerical Recipes, sec. 5.7): the
steps become shorter, each quotient is extrapolated with those before, and what is estimated to
have the least error is kept, of truncation and of rounding, each component of each path by itself.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.sweeps.uncertainty.light_at import LightAt
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

_FIRST = 0.0437
"""The first step, as a share of the value, or of 1: no round one, which a retarder of so many
waves would repeat itself by."""
_SHRINK = 1.7
_STEPS = 46
_COLUMNS = 9
_LEAST = 4
_ENOUGH = 1e-12
_ROUNDING = 1e-15
_DOUBT = 16.0
_NEAR = 0.01
"""Closer to an end of its range a value has differences to one side alone."""


def slopes_by_differences(light_at: LightAt) -> npt.NDArray[np.float64]:
    """Return the slopes of the Stokes vector along each value that is uncertain.

    Shape: returns (..., 4, k).
    """
    light = light_at({})
    stokes, noise = np.asarray(light.stokes, np.float64), np.asarray(light.noise, np.float64)
    columns = [_slope(light_at, each, stokes, noise) for each in light_at.uncertain]
    return np.stack(columns, axis=-1)


def _slope(light_at: LightAt, along: UncertainValue, stokes: Any, noise: Any) -> Any:
    """Return the slope along one value, of shape (..., 4)."""
    step, left, right = _steps(along)
    # Quotients of both sides have errors of even orders of the step alone.
    order = _column(np.where((left == 0.0) | (right == 0.0), 1, 2))
    best, least = np.full_like(stokes, np.nan), np.full_like(stokes, np.inf)
    row: list[Any] = []
    for number in range(_STEPS):
        h = step / _SHRINK**number
        ends = [np.clip(along.value + by, along.low, along.high) for by in (h * right, -h * left)]
        above, below = (
            np.asarray(light_at.beside({along.name: end}, [along.name]).stokes) for end in ends
        )
        width = _column(ends[0] - ends[1])
        with np.errstate(all="ignore"):
            size = np.maximum(above[..., :1], below[..., :1])
            rounding = np.fmax(_ROUNDING * size, 4.0 * noise[..., np.newaxis]) / width
            before, row = row, [(above - below) / width]
            for column, known in enumerate(before[: _COLUMNS - 1], 1):
                weight = 1.0 / (_SHRINK ** (column * order) - 1.0)
                row.append(row[-1] + (row[-1] - known) * weight)
                error = np.maximum(np.abs(row[-1] - row[-2]), np.abs(row[-1] - known))
                error = error + rounding
                best = np.where(error < least, row[-1], best)
                least = np.fmin(error, least)
            steepest = np.max(np.abs(best), axis=-1, keepdims=True)
        done = (least <= _ENOUGH * steepest) | (least <= 2.0 * rounding) | np.isnan(stokes)
        if number >= _LEAST and np.all(done):
            break
    # What may be all error is none.
    return np.where(np.abs(best) <= _DOUBT * least, 0.0, best)


def _steps(along: UncertainValue) -> tuple[Any, Any, Any]:
    """Return the longest step, and whether it goes to the left and to the right, as 0 and 1."""
    before, behind = along.value - along.low, along.high - along.value
    near = np.minimum(before, behind) < _NEAR * along.scale
    left = np.where(near & (behind >= before), 0.0, 1.0)
    right = np.where(near & (behind < before), 0.0, 1.0)
    room = np.minimum(np.where(left, before, np.inf), np.where(right, behind, np.inf))
    return np.minimum(_FIRST * along.scale, room), left, right


def _column(numbers: Any) -> Any:
    return np.asarray(numbers)[..., np.newaxis]
