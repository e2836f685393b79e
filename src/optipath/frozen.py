"""Values that do not change: read-only copies of arrays, and equality that knows arrays."""

from __future__ import annotations

from typing import Any

import numpy as np


def array_of(value: Any) -> np.ndarray[Any, Any]:
    """Return an array of a value, of float64 at least; words beside numbers stay words.

    Examples
    --------
    >>> array_of([0.5, "none"]).tolist()
    [0.5, 'none']
    """
    array = np.asarray(value)
    if array.dtype.kind == "U" and not isinstance(value, (str, np.ndarray)):
        return np.asarray(value, dtype=object)
    if array.dtype in (np.float16, np.float32):
        # The precision of a plan is the composer's to choose, not that of what it is given.
        return array.astype(np.float64)
    return array.astype(np.complex128) if array.dtype == np.complex64 else array


def frozen(value: Any) -> Any:
    """Return a value that nobody can change: arrays and lists become read-only copies.

    What is a read-only array of its own already stays what it is.

    Examples
    --------
    >>> frozen([1.0, 2.0]).flags.writeable
    False
    """
    if isinstance(value, (list, tuple, np.ndarray)):
        try:
            array = array_of(value)
        except ValueError:
            # Rows of unequal lengths: kept as given, for validation to name.
            return tuple(value)
        if array is value and array.ndim and array.flags.owndata and not array.flags.writeable:
            return array
        array = array.copy()
        if array.ndim == 0:
            return array.item()
        array.flags.writeable = False
        return array
    if isinstance(value, np.generic):
        return value.item()
    return value


def same(first: Any, second: Any) -> bool:
    """Tell whether two values are equal, arrays by shape and elements.

    Examples
    --------
    >>> same(np.array([1.0, 2.0]), np.array([1.0, 2.0]))
    True
    """
    if first is second:
        return True
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
        return np.array_equal(np.asarray(first), np.asarray(second))
    return bool(first == second)
