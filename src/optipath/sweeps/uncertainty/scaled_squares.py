"""Squares of what is very small or large: by powers of two, which cost no bit."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

LEAST = -1100
"""The exponent of 0: less than that of any float."""


def exponent_of(
    numbers: npt.NDArray[np.float64], axis: int | tuple[int, ...]
) -> npt.NDArray[np.int32]:
    """Return the power of two that the largest number along an axis is less than.

    Parameters
    ----------
    numbers : ndarray
        What is no finite number counts as 0.
    axis : int or tuple of int
        Along which.

    Returns
    -------
    ndarray of int
        `LEAST` where all are 0.

    Examples
    --------
    >>> print(exponent_of(np.array([[3.0, -5.0], [0.0, 0.0]]), -1))
    [    3 -1100]
    """
    size = np.max(np.abs(numbers), axis=axis, where=np.isfinite(numbers), initial=0.0)
    return np.where(size > 0.0, np.frexp(size)[1], LEAST).astype(np.int32)


def covariance_of(scaled: Any, exponent: Any) -> npt.NDArray[np.float64]:
    """Return a covariance, of that of numbers that were divided by powers of two.

    Parameters
    ----------
    scaled : ndarray, shape (..., n, n)
        That of the quotients.
    exponent : ndarray of int, shape (..., n)
        The powers.

    Returns
    -------
    ndarray, shape (..., n, n)
        NaN for what no float holds.

    Examples
    --------
    >>> print(covariance_of(np.ones((1, 1)), np.array([2])), covariance_of(np.ones((1, 1)), [-600]))
    [[16.]] [[nan]]
    """
    exponent = np.asarray(exponent)
    with np.errstate(all="ignore"):
        powers = exponent[..., :, np.newaxis] + exponent[..., np.newaxis, :]
        found = np.ldexp(scaled, powers)
        held = (np.abs(found) >= np.finfo(np.float64).tiny) & np.isfinite(found)
    return np.where(held | (scaled == 0.0), found, np.nan)
