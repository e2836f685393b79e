"""Physical Mueller matrices: what passive elements can do, and measured matrices that do not."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import LightError
from optipath.faults import shown
from optipath.kernels.carriers.structures import is_physical
from optipath.kernels.primitives import FLOAT, NUMPY
from optipath.light import decompositions
from optipath.light.decompositions import tolerance_for
from optipath.light.polarization_state import length
from optipath.light.polarization_state import problem_of as problem_of_light
from optipath.values.domains import can_be_light, surely_light
from optipath.values.jax_values import is_traced, namespace
from optipath.values.precision import rounding_of

if TYPE_CHECKING:
    from optipath.values.precision import Array


_AT_ONCE = 4096
"""How many matrices are looked at together: they stay in the cache, and in memory that is there."""

_FEW = 4
"""How many are quicker looked at one after the other."""


def gain(matrix: Array) -> Array:
    """Return by how much the light that is let through best is brighter behind, shape (...).

    M00 + abs((M01, M02, M03)), the intensity of what fully polarised light becomes (Gil and
    Ossikovski, Polarized Light and the Mueller Matrix Approach, sec. 5.4).
    """
    # No squares, which of what is far too much would overflow.
    length = namespace(matrix).hypot
    across = length(length(matrix[..., 0, 1], matrix[..., 0, 2]), matrix[..., 0, 3])
    return matrix[..., 0, 0] + across  # type: ignore[no-any-return]


def are_passive(matrix: Array, tolerance: float) -> Array:
    """Tell which matrices (..., 4, 4) a passive element can have, within their rounding."""
    if is_traced(matrix):
        xp: Any = namespace(matrix)
        numbers = [matrix[..., row, column] for row in range(4) for column in range(4)]
        return is_physical(xp, numbers, 0.25 * tolerance) & (gain(matrix) <= 1.0 + tolerance)  # type: ignore[no-any-return]
    flat = np.asarray(matrix).reshape(-1, 4, 4)
    if len(flat) <= _FEW and all(
        _is_passive(one, tolerance) for one in flat.reshape(-1, 16).tolist()
    ):
        return np.ones(matrix.shape[:-2], bool)
    result = np.empty(len(flat), bool)
    for start in range(0, len(flat), _AT_ONCE):
        some = slice(start, start + _AT_ONCE)
        result[some] = _surely_passive(flat[some], tolerance)
    doubtful = ~result
    if doubtful.any():
        left = flat[doubtful]
        result[doubtful] = (decompositions.lack(left) <= tolerance) & (
            gain(left) <= 1.0 + tolerance
        )
    return result.reshape(matrix.shape[:-2])


def problem_of(matrix: Array, tolerance: float) -> str:
    """Return why no passive element has a matrix (4, 4), as the end of a sentence."""
    lacks = decompositions.lack(matrix)
    if lacks <= tolerance:
        return (
            f"makes light up to {float(gain(matrix)):.10g} times as bright "
            f"(M00 + |(M01, M02, M03)|), as no passive element does"
        )
    return (
        f"is unphysical, having a coherency eigenvalue of {-lacks:.3g} times the largest (Cloude's "
        f"criterion), so that light could be polarised by more than 100 %"
    )


def cure_of(matrices: Array, tolerance: float) -> str:
    """Return a cure for matrices (..., 4, 4) that makes all of them `are_passive`."""
    result = "matrix"
    if np.any(decompositions.lack(matrices) > tolerance):
        result = "op.Mueller(matrix).nearest_physical().matrix"
        matrices = decompositions.nearest_physical(matrices)
    most = float(np.max(gain(matrices)))
    # Somewhat more than it, if it has more digits than are written.
    text = f"{most:.10g}" if float(f"{most:.10g}") >= most else f"{most * (1.0 + 1e-9):.10g}"
    return f"{result} / {text}" if most > 1.0 else result


def _is_passive(numbers: list[float], tolerance: float) -> bool:
    """Tell of one matrix what `_surely_passive` tells of many."""
    dim = numbers[0] + hypot(*numbers[1:4]) <= 1.0 + tolerance
    return dim and bool(is_physical(FLOAT, numbers, 0.25 * tolerance))


def _surely_passive(matrices: Array, spare: float) -> Array:
    """Tell of which matrices elimination says so, which is quick."""
    numbers = np.ascontiguousarray(matrices.reshape(-1, 16).T)
    m00, m01, m02, m03 = numbers[:4]
    with np.errstate(all="ignore"):
        room = 1.0 + spare - m00
        dim = (room >= 0.0) & (m01 * m01 + m02 * m02 + m03 * m03 <= room * room)
        # No eigenvalue is less than a quarter of their sum M00 where it is the largest.
        return np.asarray(is_physical(NUMPY, [*numbers], 0.25 * spare) & dim)


_CURE = (
    "act with matrix.nearest_physical(); or, for measured noise, on Light(..., physical=False), "
    "which may be what no light is"
)

_BEYOND = 12.0
"""By how many times its lack of coherency over M00 a matrix takes light beyond 100 %, at most: a
Jones matrix transmits twice its size, 3 may be negative, and S0 shrinks as (S1, S2, S3) grows."""

_LEFT = 16.0
"""How many roundings of 1 are left where matrices that let nothing through were multiplied."""


def becomes_no_light(matrix: Any, noise: Any, arriving: Any, made: Any) -> Any:
    """Tell which light (..., 4) a matrix makes unphysical, beyond the rounding of all three.

    No matrix does so that `Mueller.is_physical` accepts by default, or whose entries may be
    rounding only, as of crossed polarizers.
    """
    xp = namespace(made)
    tolerance = max(tolerance_for(matrix), tolerance_for(arriving))
    left = _LEFT * max(rounding_of(matrix), 2.0**-52)
    rounding = _BEYOND * tolerance * abs(matrix[..., 0, 0]) + left + noise
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
        f"{problem_of_light(behind)}{more}, by a Mueller matrix that is unphysical; {_CURE}"
    )


def nan_where_no_light(matrix: Any, noise: Any, arriving: Any, made: Any) -> Any:
    """Return light that JAX traces, NaN where it is none, with its slopes. Shape (..., 4)."""
    xp = namespace(made)
    # A product, since a choice would have slopes of 0.
    share = xp.where(becomes_no_light(matrix, noise, arriving, made), np.nan, 1.0)
    return made * share[..., np.newaxis].astype(made.dtype)
