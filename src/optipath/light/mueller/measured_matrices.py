"""Matrices as they are measured, which may make of light what no light is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import LightError, shown
from optipath.light.mueller.cloude import tolerance_for
from optipath.light.mueller.normalised import rounding_of as spacing_of
from optipath.light.physical_light import problem_of
from optipath.light.polarization_state import length
from optipath.values.arrays.jax_values import namespace
from optipath.values.domains.states import can_be_light, surely_light
from optipath.values.roundings import rounding_of

if TYPE_CHECKING:
    from optipath.values.roundings import Array

_CURE = (
    "act with matrix.nearest_physical(); or, for measured noise, on Light(..., physical=False), "
    "which may be what no light is"
)

_BEYOND = 12.0
"""By how many times what its coherency lacks, over M00, a matrix takes light beyond 100 %, at most.

Three eigenvalues are negative at most; a Jones matrix of the size of one lets twice as much
through, and light that it takes away shortens S0 and lengthens (S1, S2, S3) by as much.
"""

_LEFT = 16.0
"""How many roundings of 1 are left where matrices that let nothing through were multiplied."""


def becomes_no_light(matrix: Any, noise: Any, arriving: Any, made: Any) -> Any:
    """Tell of which light a matrix makes what no light is, beyond the rounding of all three.

    A matrix that is physical by the default of `Mueller.is_physical` does so of none, nor does one
    whose entries may be no more than what is left of roundings of 1, as of crossed polarisers.

    Shapes: matrix (..., 4, 4); noise (...); arriving, made (..., 4); returns (...).

    Examples
    --------
    >>> light = np.array([1.0, 0.0, 0.0, 1.0])
    >>> print(becomes_no_light(np.eye(4), 0.0, light, np.array([1.0, 0.0, 0.0, 1.7])))
    True
    """
    xp = namespace(made)
    tolerance = max(tolerance_for(matrix), tolerance_for(arriving))
    rounding = _BEYOND * tolerance * abs(matrix[..., 0, 0]) + _LEFT * spacing_of(matrix) + noise
    is_light = can_be_light(arriving, rounding_of(arriving)) & (arriving[..., 0] >= 0.0)
    with np.errstate(over="ignore", invalid="ignore"):
        beyond = length(made[..., 1], made[..., 2], made[..., 3]) - made[..., 0]
    # Numbers below the smallest normal one have lost digits; of infinite ones nothing is said.
    least = float(np.finfo(made.dtype).tiny)
    return is_light & (beyond > xp.maximum(rounding * arriving[..., 0], least)) & (beyond < np.inf)


def check_becomes_light(matrix: Array, noise: Array, arriving: Array, made: Array) -> None:
    """Refuse a matrix that makes of light what no light is."""
    if surely_light(made):
        return
    bad = np.asarray(becomes_no_light(matrix, noise, arriving, made))
    if not bad.any():
        return
    place = tuple(int(i) for i in np.argwhere(bad)[0])
    intensity = arriving[..., :1]
    before, behind = (
        np.broadcast_to(stokes / np.where(intensity > 0.0, intensity, 1.0), made.shape)[place]
        for stokes in (arriving, made)
    )
    more = f" (one of {bad.sum()} such)" if bad.sum() > 1 else ""
    raise LightError(
        f"light like {shown(before.tolist())} becomes {shown(behind.tolist())}, "
        f"{problem_of(behind)}{more}, by a Mueller matrix that is unphysical; {_CURE}"
    )


def nan_where_no_light(matrix: Any, noise: Any, arriving: Any, made: Any) -> Any:
    """Return light that JAX traces, NaN where it is none, with its slopes.

    Shape: returns (..., 4).
    """
    xp = namespace(made)
    # A product, since a choice would have slopes of 0.
    share = xp.where(becomes_no_light(matrix, noise, arriving, made), np.nan, 1.0)
    return made * share[..., np.newaxis].astype(made.dtype)
