"""Precision: float64, float32 and longdouble, rounding of limits, whole numbers."""

from __future__ import annotations

import math
import operator
import warnings
from contextlib import suppress
from numbers import Integral
from operator import index
from typing import Any

import numpy as np
import numpy.typing as npt

from optipath.errors import ComposerError, shown
from optipath.values.jax_values import is_jax

DTYPES = ("float64", "float32", "longdouble")
_BY_CHARACTER = {"d": "float64", "f": "float32", "g": "longdouble"}


def precision(argument: Any) -> np.dtype[Any]:
    """Return the dtype of a name, or of what NumPy takes for one.

    >>> precision("float32"), precision("f4"), precision(float)
    (dtype('float32'), dtype('float32'), dtype('float64'))
    """
    return np.dtype(precision_name(argument))


def precision_name(argument: Any) -> str:
    """Return which of the `DTYPES` a name, a dtype or a type of NumPy or Python is.

    >>> precision_name(np.float32), precision_name("double")
    ('float32', 'float64')
    """
    known = type(argument) is str and argument in DTYPES
    name = argument if known else _BY_CHARACTER.get(_character(argument))
    if name is None:
        first, second, last = DTYPES
        cure = f"give '{first}', '{second}' or '{last}'"
        raise ComposerError(f"dtype {shown(argument)} is unknown; {cure}")
    if name == "longdouble" and np.finfo(np.longdouble).eps == np.finfo(np.float64).eps:
        raise ComposerError("dtype 'longdouble' is no more than float64 here; use 'float64'")
    return name


def _character(argument: Any) -> str:
    """Return NumPy's character for a dtype in the order of bytes of the machine, or nothing."""
    if argument is None:  # NumPy takes it for float64.
        return ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # Some aliases go, as that of np.floating.
            result = np.dtype(argument)
    except Exception:  # noqa: BLE001 - it may have a dtype of its own, which may do anything
        return ""
    return result.char if result.isnative else ""


def wide(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """Return the precision in which angles are turned into cosines: float64 at least.

    >>> wide(np.dtype("float32"))
    dtype('float64')
    """
    return np.result_type(dtype, np.float64)


def coarser(*numbers: Any) -> Any:
    """Return the dtype of the array of least precision, float32 at least.

    >>> coarser(np.ones(2), np.ones(2, np.float32))
    dtype('float32')
    """
    return max(np.dtype("f4"), min((n.dtype for n in numbers), key=_size), key=_size)


def at_least_single(numbers: Any) -> Any:
    """Return numbers as arithmetic takes them: half precision, which ends at 65504, as float32.

    >>> at_least_single(np.ones(2, np.float16)).dtype, at_least_single(np.ones(2)).dtype
    (dtype('float32'), dtype('float64'))
    """
    return numbers.astype(np.float32) if numbers.dtype == np.float16 else numbers


def _size(dtype: Any) -> int:
    return int(dtype.itemsize)


Array = np.ndarray[Any, Any]
Numbers = npt.NDArray[np.float64]

ENDLESS = (-math.inf, math.inf)
RIGHT_ANGLES = (-math.pi / 2.0, math.pi / 2.0)
"""Limits of angles, which single precision rounds up."""

NARROW = (np.float16, np.float32)


def held(numbers: Any, limits: tuple[float, float]) -> tuple[float, float]:
    """Return limits as the precision of JAX's numbers holds them, neither as 0 nor as infinite.

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

    Numbers beyond a limit or a right angle by their rounding become it, as in `within`.

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

    >>> as_doubles(np.array([1.0, 2.0], np.longdouble)).dtype
    dtype('float64')
    """
    with np.errstate(over="ignore"):
        return array.astype(np.float64, copy=False)


def within(array: Array, limits: tuple[float, float]) -> Array:
    """Return numbers, as doubles if some exceed a limit by rounding, those as that limit.

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

    >>> float(with_limits(np.array([1.0 + 2.0**-23]), np.float32, (0.0, 1.0 + 1e-7))[0])
    1.0000001
    """
    low, high = _rounded(kind, limits)
    if low < limits[0]:
        array = np.where(array == low, limits[0], array)
    return np.where(array == high, limits[1], array) if high > limits[1] else array


_ROUNDINGS = 2.0**-51
"""How many parts of its terms a sum is rounded by, at most."""


def affine(scale: float, offset: float, numbers: Any, limits: tuple[float, float] = ENDLESS) -> Any:
    """Return a multiple of numbers plus an offset.

    >>> affine(2.0, 0.5, np.float32([0.25]))
    array([1.])
    """
    if not offset and scale in (1.0, -1.0):
        return numbers if scale == 1.0 else -numbers
    if isinstance(numbers, np.ndarray):
        numbers = numbers.astype(np.result_type(numbers, np.float64), copy=False)
    with np.errstate(over="ignore"):  # What is not finite is told by who looks at it.
        result = scale * numbers + offset
    return result if is_jax(result) else _resolved(result, limits, offset)


def _resolved(result: Any, limits: tuple[float, float], offset: float) -> Any:
    """Return sums; what is beyond a limit by the rounding of a sum alone, as that limit."""
    if limits == ENDLESS or np.iscomplexobj(result):
        return result
    for limit, beyond in zip(limits, (operator.lt, operator.gt), strict=True):
        outside = beyond(result, limit)
        if np.any(outside) and math.isfinite(limit):
            apart = _ROUNDINGS * (abs(limit) + abs(offset))
            resolved = np.where(outside & (abs(result - limit) <= apart), limit, result)
            result = resolved if np.ndim(result) else type(result)(resolved)
    return result


def is_whole(number: object, least: int = 1, most: float = math.inf) -> bool:
    """Tell whether something is a whole number of any integer type, but no bool."""
    with suppress(TypeError):  # NumPy's durations are Integral, and index nothing
        return (
            isinstance(number, Integral)
            and not isinstance(number, bool)
            and least <= index(number) <= most
        )
    return False


def whole_number(what: str, number: object, least: int = 1) -> list[str]:
    """Return the sentence for what is no whole number, or too small; none for one that serves.

    >>> whole_number("threads", 1.5), whole_number("threads", 2)
    (['threads must be a whole number of 1 or more, not 1.5'], [])
    """
    return (
        []
        if is_whole(number, least)
        else [f"{what} must be a whole number of {least} or more, not {shown(number)}"]
    )
