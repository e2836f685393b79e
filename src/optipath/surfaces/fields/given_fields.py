"""What height fields are made of, as it is given: read, or refused in a sentence each."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from optipath.errors import SurfaceError, shown
from optipath.surfaces.fields.mesh_resolution import correlation_lengths
from optipath.values.affine import real_number
from optipath.values.arrays.array_likes import as_given
from optipath.values.roundings import as_doubles
from optipath.values.whole_numbers import is_whole

Array = np.ndarray[Any, Any]
Pair = tuple[float, float]

FEWEST_LENGTHS = 10
"""How many correlation lengths a period needs, to have enough different waves."""


_FARTHEST = 1e30
"""The largest length, and one over the least, whose ratios to others still have squares."""


def length_faults(what: str, value: object, cure: str = "") -> list[str]:
    """Return the sentence for what is no positive number; none for one that is.

    Examples
    --------
    >>> length_faults("alpha", -0.1), length_faults("alpha", 0.1)
    (['alpha must be a positive number, not -0.1'], [])
    """
    if (real_number(value) or 0.0) > 0.0:
        return []
    return [f"{what} must be a positive number{cure}, not {shown(value)}"]


def pair_of(what: str, value: Any, faults: list[str]) -> Pair:
    """Return positive numbers for x and for y, of one number or of a pair.

    Examples
    --------
    >>> pair_of("size", 400, [])
    (400.0, 400.0)
    """
    both = _both(value)
    if len(both) == 2 and not any(length_faults(what, each) for each in both):
        if not all(1.0 / _FARTHEST <= each <= _FARTHEST for each in both):
            limits = f"{1.0 / _FARTHEST:g} .. {_FARTHEST:g}"
            faults.append(f"{what} is {shown(value)}; give it in a unit of which it is {limits}")
        return float(both[0]), float(both[1])
    faults.append(
        f"{what} must be a positive number, or two of them for x and y, not {shown(value)}"
    )
    return 1.0, 1.0


def period_or_not(periodic: object) -> list[str]:
    """Return the sentence for what says neither that a field is periodic nor that it is not."""
    if isinstance(periodic, (bool, np.bool_)):
        return []
    return [f"periodic must be True or False, not {shown(periodic)}"]


def cells_of(cells: Any, faults: list[str]) -> tuple[int, int]:
    """Return how many cells there are along x and y, of one number or of a pair.

    Examples
    --------
    >>> cells_of((640, 320), [])
    (640, 320)
    """
    numbers = _both(cells)
    if len(numbers) == 2 and all(is_whole(number, 2) for number in numbers):
        return int(numbers[0]), int(numbers[1])
    faults.append(
        f"cells must be a whole number of 2 or more, or two of them for x and y, not {shown(cells)}"
    )
    return 2, 2


def seed_of(seed: Any, faults: list[str]) -> np.random.SeedSequence:
    """Return the sequence of seeds that a number stands for, or one that is given.

    Examples
    --------
    >>> seed_of(3, []).entropy
    3
    """
    if isinstance(seed, np.random.SeedSequence):
        return seed
    if is_whole(seed, 0):
        return np.random.SeedSequence(int(seed))
    faults.append(
        f"seed must be a whole number of 0 or more, or a numpy.random.SeedSequence, not "
        f"{shown(seed)}"
    )
    return np.random.SeedSequence(0)


def period_faults(alpha: Pair, size: Pair) -> list[str]:
    """Return the sentences for periods too short for random waves; none for long ones.

    Examples
    --------
    >>> period_faults((0.1, 0.1), (400.0, 400.0))
    []
    """
    lengths = correlation_lengths(alpha, size)
    # A size of 20 / alpha may be less by a rounding.
    if min(lengths) * (1.0 + 1e-12) >= FEWEST_LENGTHS:
        return []
    enough = tuple(_rounded_up(min(2.0 * FEWEST_LENGTHS / each, 1e300)) for each in alpha)
    why = (
        f"a periodic surface of {size[0]:.6g} x {size[1]:.6g} and alpha {alpha} has "
        f"{lengths[0]:.3g} x {lengths[1]:.3g} correlation lengths 2/alpha, too few for its waves, "
        f"of which it needs {FEWEST_LENGTHS} x {FEWEST_LENGTHS}; write size={enough} or more, or "
        f"periodic=False"
    )
    return [why]


def heights_of(heights: Any, faults: list[str], *, periodic: bool) -> Array:
    """Return heights as a read-only copy in float64.

    Shape: heights (rows, columns).
    """
    try:
        given = as_given("the array of heights", heights, SurfaceError)
    except SurfaceError as fault:
        faults += fault.faults
        return np.zeros((2, 2))
    if given.dtype.kind not in "iuf":
        faults.append(f"heights must be real numbers, not an array of {given.dtype}")
        return np.zeros((2, 2))
    if given.ndim != 2:
        faults.append(
            f"heights must have two dimensions, rows along y and columns along x, not the shape "
            f"{given.shape}"
        )
        return np.zeros((2, 2))
    kept = np.array(as_doubles(given), order="C")
    least = 2 if periodic else 3
    if min(kept.shape) < least:
        faults.append(
            f"heights of shape {kept.shape} are too few; give {least} x {least} or more, for "
            f"2 x 2 cells"
        )
    if (bad := np.argwhere(~np.isfinite(kept))).size:
        row, column = map(int, bad[0])
        faults.append(
            f"{len(bad)} of {kept.size} heights {'is' if len(bad) == 1 else 'are'} not finite, "
            f"the first {kept[row, column]} at heights[{row}, {column}]; cut these out, or fill "
            f"them with heights around them"
        )
    elif (steepest := np.abs(kept).max(initial=0.0)) > _FARTHEST:
        faults.append(
            f"heights reach {steepest:.3g}; give them in a unit in which they are numbers "
            f"of {_FARTHEST:g} at most"
        )
    kept.setflags(write=False)
    return kept


def _rounded_up(number: float) -> float:
    """Return the next larger number of five digits."""
    step = 10.0 ** (math.floor(math.log10(number)) - 4)
    return float(f"{math.ceil(number / step) * step:.6g}")


def _both(value: Any) -> tuple[Any, ...]:
    """Return the entries of a pair, or a number twice."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        return tuple(value)
    return value, value
