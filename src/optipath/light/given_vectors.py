"""Vectors in space as they are given: three finite numbers each, and how far they are rounded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import FrameError, shown
from optipath.values.arrays.array_likes import array_of, as_given
from optipath.values.roundings import as_doubles, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt


def vectors(what: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return vectors of three finite components.

    Shape: value (..., 3).

    Examples
    --------
    >>> vectors("a normal", [0, 0, 1])
    array([0., 0., 1.])
    """
    array = floats(what, value)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise FrameError(f"{what} must have shape (..., 3), not {array.shape}")
    return array


def rounding_in(*given: npt.ArrayLike) -> float:
    """Return the rounding of vectors of which any has less precision than double; else 0.

    Examples
    --------
    >>> rounding_in([0, 0, 1], np.ones(3, np.float32)) == 2.0**-23
    True
    """
    return max(rounding_of(as_given("a vector", value, FrameError)) for value in given)


def floats(what: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return finite numbers as doubles.

    Examples
    --------
    >>> floats("a rotation", [[0, 1], [1, 0]]).dtype
    dtype('float64')
    """
    array = array_of(what, value, FrameError)
    if array.dtype.kind not in "iufb":
        raise FrameError(f"{what} must be numbers, not {shown(value)}")
    array = as_doubles(array)
    if not np.all(np.isfinite(array)):
        raise FrameError(f"{what} must be finite; check for NaN and infinity")
    return array
