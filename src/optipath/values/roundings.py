"""Roundings: numbers of less precision than double, and limits that are rounded to theirs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

ENDLESS = (-math.inf, math.inf)
RIGHT_ANGLES = (-math.pi / 2.0, math.pi / 2.0)
"""Limits of angles, which single precision rounds up."""

NARROW = (np.float16, np.float32)


def held(numbers: Any, limits: tuple[float, float]) -> tuple[float, float]:
    """Return limits as the precision of JAX's numbers holds them, neither as 0 nor as infinite.

    Examples
    --------
    >>> held(np.array([0.5], np.float32), (0.0, 1e60))
    (0.0, 1e+60)
    """
    if isinstance(numbers, (np.ndarray, np.generic)) or numbers.dtype.kind not in "fc":
        return limits
    low, high = limits
    of = np.finfo(numbers.dtype)
    return (max(low, float(of.tiny)) if low > 0.0 else low), min(high, float(of.max))


def doubles(array: Array, limits: tuple[float, float] = ENDLESS) -> Array:
    """Return numbers of less precision than double as doubles, and others as they are.

    What is beyond a limit by its rounding becomes the limit, as `within` has it; so does what is
    beyond a right angle, which limits angles of incidence.

    Examples
    --------
    >>> float(doubles(np.array(np.float32(np.pi / 2.0)))) == np.pi / 2.0
    True
    """
    kind = array.dtype.type
    if kind is np.float64:
        return array
    if kind is np.complex64:
        return array.astype(np.complex128)
    array = within(array, limits)
    return within(array, RIGHT_ANGLES).astype(np.float64) if kind in NARROW else array


def as_doubles(array: Array) -> Array:
    """Return numbers as doubles; what is larger than any of these is infinite.

    Examples
    --------
    >>> as_doubles(np.array([1.0, 2.0], np.longdouble)).dtype
    dtype('float64')
    """
    with np.errstate(over="ignore"):
        return array.astype(np.float64, copy=False)


def within(array: Array, limits: tuple[float, float]) -> Array:
    """Return numbers; those beyond a limit by its rounding to their precision, as that limit.

    Where there are such, they are doubles at least.

    Examples
    --------
    >>> float(within(np.array(np.float32(0.1)), (0.0, 0.1)))
    0.1
    """
    if is_beyond(array, limits):
        return with_limits(array.astype(np.float64), array.dtype.type, limits)
    if array.dtype.type is np.longdouble and limits != ENDLESS:
        beyond = (array < limits[0]) | (array > limits[1])
        near = as_doubles(array)
        return np.where(beyond & np.isin(near, limits), near, array)
    return array


def is_beyond(array: Array, limits: tuple[float, float]) -> bool:
    """Tell whether numbers of less precision than double are beyond a limit, rounded to that.

    Examples
    --------
    >>> is_beyond(np.float32([0.5, np.pi / 2.0]), (0.0, np.pi / 2.0))
    True
    """
    kind = array.dtype.type
    if kind not in NARROW or not array.size:
        return False
    low, high = _rounded(kind, limits)
    return bool(
        (low < limits[0] and array.min() == low) or (high > limits[1] and array.max() == high)
    )


def traced_within(numbers: Any, limits: tuple[float, float]) -> Any:
    """Return numbers that JAX traces as `within` does, with their slopes.

    Examples
    --------
    >>> float(traced_within(np.float32(np.pi / 2.0), (0.0, np.pi / 2.0))) == np.pi / 2.0
    True
    """
    kind = np.dtype(numbers.dtype).type
    if kind in NARROW:
        for limit, rounded in zip(limits, _rounded(kind, limits), strict=True):
            if limit != rounded:
                # The difference is exact, and a sum keeps slopes.
                numbers = numbers - (numbers == kind(rounded)) * np.float64(rounded - limit)
    return numbers


def rounding_of(array: Array) -> float:
    """Return the rounding of numbers of less precision than double; 0 for all others.

    Examples
    --------
    >>> rounding_of(np.ones(3, np.float32)) == 2.0**-23, rounding_of(np.ones(3))
    (True, 0.0)
    """
    return float(np.finfo(array.dtype).eps) if array.dtype.type in NARROW else 0.0


def _rounded(kind: Any, limits: tuple[float, float]) -> tuple[float, float]:
    """Return limits rounded to a precision; what is 0 or infinite in it says nothing."""
    with np.errstate(over="ignore", under="ignore"):
        low, high = (float(kind(limit)) for limit in limits)
    return (
        low if low and low > -math.inf else limits[0],
        high if high and high < math.inf else limits[1],
    )


def with_limits(array: Array, kind: Any, limits: tuple[float, float]) -> Array:
    """Return doubles; those beyond a limit by its rounding to a precision, as the limit.

    Examples
    --------
    >>> float(with_limits(np.array([1.0 + 2.0**-23]), np.float32, (0.0, 1.0 + 1e-7))[0])
    1.0000001
    """
    low, high = _rounded(kind, limits)
    if low < limits[0]:
        array = np.where(array == low, limits[0], array)
    return np.where(array == high, limits[1], array) if high > limits[1] else array
