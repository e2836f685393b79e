"""Precision: float64, float32 and longdouble, limits as float32 rounds them, whole numbers."""

from __future__ import annotations

import math
import warnings
from contextlib import suppress
from numbers import Integral, Real
from operator import index
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from optipath.errors import ComposerError
from optipath.faults import shown
from optipath.values.jax_values import is_jax, is_traced

Precision: TypeAlias = (
    Literal["float64", "float32", "longdouble", "f8", "f4"] | type | np.dtype[Any]
)
DTYPES: tuple[Precision, ...] = ("float64", "float32", "longdouble")
_BY_CHARACTER = {"d": "float64", "f": "float32", "g": "longdouble"}


def precision(argument: Any) -> np.dtype[Any]:
    """Return the dtype of a name, or of what NumPy takes for one."""
    return np.dtype(precision_name(argument))


def precision_name(argument: Any) -> str:
    """Return which of the `DTYPES` a name, a dtype or a type of NumPy or Python is."""
    name = argument if type(argument) is str and argument in DTYPES else None
    if name is None and argument is not None:  # NumPy takes none for float64.
        # A dtype of its own may do anything.
        with suppress(Exception), warnings.catch_warnings():
            warnings.simplefilter("error")  # Some aliases go, as that of np.floating.
            dtype = np.dtype(argument)
            name = _BY_CHARACTER.get(dtype.char) if dtype.isnative else None
    if name is None:
        cure = "give 'float64', 'float32' or 'longdouble'"
        raise ComposerError(f"dtype {shown(argument)} is unknown; {cure}")
    if name == "longdouble" and np.finfo(np.longdouble).eps == np.finfo(np.float64).eps:
        raise ComposerError("dtype 'longdouble' is no more than float64 here; use 'float64'")
    return name


def wide(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """Return the precision in which angles are turned into cosines: float64 at least."""
    return np.result_type(dtype, np.float64)


def coarser(*numbers: Any) -> Any:
    """Return the dtype of the array of least precision."""
    return min((n.dtype for n in numbers), key=lambda dtype: int(dtype.itemsize))


Array = np.ndarray[Any, Any]
Numbers = npt.NDArray[np.float64]

ENDLESS = (-math.inf, math.inf)
_RIGHT_ANGLES = (-math.pi / 2.0, math.pi / 2.0)
"""Limits of angles, which float32 rounds to numbers beyond them."""

_SUMMED = 2.0**-51
"""How many parts of its terms a sum is rounded by, at most."""


def held(numbers: Any, limits: tuple[float, float]) -> tuple[float, float]:
    """Return limits as the precision of JAX's numbers holds them, neither as 0 nor as infinite."""
    if isinstance(numbers, (np.ndarray, np.generic)) or numbers.dtype.kind not in "fc":
        return limits
    low, high = limits
    of = np.finfo(numbers.dtype)
    return (max(low, float(of.tiny)) if low > 0.0 else low), min(high, float(of.max))


def doubles(array: Array, limits: tuple[float, float] = ENDLESS) -> Array:
    """Return numbers as float64 or complex128, and all else as it is.

    Of float32, what equals a limit or a right angle but for its rounding becomes it.
    """
    if array.dtype.type is np.float64:
        return array
    kind = array.dtype.kind
    if kind in "fiu":
        return as_doubles(within(within(array, limits), _RIGHT_ANGLES))
    return array.astype(np.complex128) if kind == "c" else array


def as_doubles(array: Array) -> Array:
    """Return numbers as doubles; what is larger than any of these is infinite."""
    with np.errstate(over="ignore"):
        return array.astype(np.float64, copy=False)


def within(numbers: Any, limits: tuple[float, float]) -> Any:
    """Return numbers; of float32, as float64 if any exceeds a limit by its rounding alone."""
    if numbers.dtype != np.float32:
        return numbers
    for limit, outward in zip(limits, (-1.0, 1.0), strict=True):
        with np.errstate(over="ignore", under="ignore"):
            rounded = np.float32(limit)
        beyond = float(rounded) - limit
        # A limit that is 0 or infinite in float32 says nothing.
        if rounded and math.isfinite(rounded) and beyond * outward > 0.0:
            at_limit = numbers == rounded
            if is_traced(numbers) or np.any(at_limit):
                # The difference is exact, and keeps the slopes of JAX.
                numbers = numbers - at_limit * np.float64(beyond)
    return numbers


def rounding_of(array: Array) -> float:
    """Return the rounding of float32; 0 for all other numbers."""
    return float(np.finfo(np.float32).eps) if array.dtype == np.float32 else 0.0


def affine(scale: float, offset: float, numbers: Any, limits: tuple[float, float] = ENDLESS) -> Any:
    """Return a multiple of numbers plus an offset; at a limit where rounding alone is beyond it."""
    if not offset and scale in (1.0, -1.0):
        return numbers if scale == 1.0 else -numbers
    if isinstance(numbers, np.ndarray):
        numbers = numbers.astype(np.result_type(numbers, np.float64), copy=False)
    with np.errstate(over="ignore"):  # What is not finite is told by who looks at it.
        result = scale * numbers + offset
    if limits == ENDLESS or is_jax(result) or np.iscomplexobj(result):
        return result
    for limit, outward in zip(limits, (-1.0, 1.0), strict=True):
        if not math.isfinite(limit):
            continue
        apart = (result - limit) * outward
        near = (apart > 0.0) & (apart <= _SUMMED * (abs(limit) + abs(offset)))
        if np.any(near):
            summed = np.where(near, limit, result)
            result = summed if np.ndim(result) else type(result)(summed)
    return result


def real_number(number: Any) -> float | None:
    """Return a finite real number as a float; None for what is none."""
    if type(number) is float:
        return number if math.isfinite(number) else None
    if isinstance(number, np.ndarray) and not number.ndim and number.dtype.kind in "iuf":
        number = number[()]
    if not isinstance(number, Real) or isinstance(number, (bool, np.bool_, np.timedelta64)):
        return None
    try:
        result = float(number)
    except (OverflowError, ValueError):
        return None
    return result if math.isfinite(result) else None


def is_whole(number: object, least: int = 1, most: float = math.inf) -> bool:
    """Tell whether something is a whole number of any integer type, but no bool."""
    with suppress(TypeError):  # NumPy's durations are Integral, and index nothing
        return (
            isinstance(number, Integral)
            and not isinstance(number, bool)
            and least <= index(number) <= most
        )
    return False


def whole_number(what: str, number: object, least: int = 1, most: float = math.inf) -> list[str]:
    """Return the sentence for what is no whole number within bounds; none for one that serves.

    >>> whole_number("threads", 1.5), whole_number("threads", 2)
    (['threads must be a whole number of 1 or more, not 1.5'], [])
    >>> whole_number("threads", 5000, 1, 1024)
    ['threads is 5000; give 1,024 at most']
    """
    if is_whole(number, least, most):
        return []
    if is_whole(number, least):
        return [f"{what} is {shown(number)}; give {most:,} at most"]
    return [f"{what} must be a whole number of {least} or more, not {shown(number)}"]
