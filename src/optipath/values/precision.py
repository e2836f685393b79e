"""The precisions that there are: float64, float32, and longdouble where it is more."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.errors import ComposerError, unknown

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
    if faults := unknown("dtype", name, DTYPES):
        raise ComposerError(*faults)
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
