"""The precisions that there are: float64, float32, and longdouble where it is more."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from optipath.errors import ComposerError, shown

DTYPES = ("float64", "float32", "longdouble")
_BY_CHARACTER = {"d": "float64", "f": "float32", "g": "longdouble"}


def precision(given: Any) -> np.dtype[Any]:
    """Return the dtype of a name, or of what NumPy takes for one.

    Examples
    --------
    >>> precision("float32"), precision("f4"), precision(float)
    (dtype('float32'), dtype('float32'), dtype('float64'))
    """
    return np.dtype(precision_name(given))


def precision_name(given: Any) -> str:
    """Return which of the `DTYPES` a name, a dtype or a type of NumPy or Python is.

    Examples
    --------
    >>> precision_name(np.float32), precision_name("double")
    ('float32', 'float64')
    """
    known = type(given) is str and given in DTYPES
    name = given if known else _BY_CHARACTER.get(_character(given))
    if name is None:
        first, second, last = DTYPES
        cure = f"give '{first}', '{second}' or '{last}'"
        raise ComposerError(f"dtype {shown(given)} is unknown; {cure}")
    if name == "longdouble" and np.finfo(np.longdouble).eps == np.finfo(np.float64).eps:
        raise ComposerError("dtype 'longdouble' is no more than float64 here; use 'float64'")
    return name


def _character(given: Any) -> str:
    """Return NumPy's character for a dtype in the order of bytes of the machine, or nothing."""
    if given is None:  # NumPy takes it for float64.
        return ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # Some aliases go, as that of np.floating.
            found = np.dtype(given)
    except Exception:  # noqa: BLE001 - it may have a dtype of its own, which may do anything
        return ""
    return found.char if found.isnative else ""


def wide(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """Return the precision in which angles are turned into cosines: float64 at least.

    Examples
    --------
    >>> wide(np.dtype("float32"))
    dtype('float64')
    """
    return np.result_type(dtype, np.float64)


def coarser(*numbers: Any) -> Any:
    """Return the dtype of that array which has the least precision, float32 at least.

    It is the precision that what is made of all of them has.

    Examples
    --------
    >>> coarser(np.ones(2), np.ones(2, np.float32))
    dtype('float32')
    """
    return max(np.dtype("f4"), min((n.dtype for n in numbers), key=_size), key=_size)


def at_least_single(numbers: Any) -> Any:
    """Return numbers as arithmetic takes them: half precision, which ends at 65504, as float32.

    Examples
    --------
    >>> at_least_single(np.ones(2, np.float16)).dtype, at_least_single(np.ones(2)).dtype
    (dtype('float32'), dtype('float64'))
    """
    return numbers.astype(np.float32) if numbers.dtype == np.float16 else numbers


def _size(dtype: Any) -> int:
    return int(dtype.itemsize)
