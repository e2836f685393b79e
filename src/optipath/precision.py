"""The precisions that there are: float64, float32, and longdouble where it is more."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.errors import ComposerError, did_you_mean, shown

DTYPES = ("float64", "float32", "longdouble")


def precision(name: str) -> np.dtype[Any]:
    """Return the dtype of a name.

    Raises
    ------
    ComposerError
        If there is no such precision, on any platform or on this one.

    Examples
    --------
    >>> precision("float32")
    dtype('float32')
    """
    if not isinstance(name, str) or name not in DTYPES:
        raise ComposerError(f"dtype {shown(name)} is unknown{did_you_mean(name, DTYPES)}")
    if name == "longdouble" and np.finfo(np.longdouble).eps == np.finfo(np.float64).eps:
        raise ComposerError("dtype 'longdouble' is no more than float64 here; use 'float64'")
    return np.dtype(name)


def wide(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """Return the precision in which angles are turned into cosines: float64 at least.

    Examples
    --------
    >>> wide(np.dtype("float32"))
    dtype('float64')
    """
    return np.result_type(dtype, np.float64)
