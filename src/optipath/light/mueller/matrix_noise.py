"""Noise of products of Mueller matrices: which entries of them are no more than rounding."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.values.arrays.jax_values import known, namespace

_SUMS = 4.0
"""How many roundings a sum of four products has, and the turn of frames before it."""


def noise_of_product(behind: tuple[Any, Any], before: tuple[Any, Any]) -> Any:
    """Return the noise in what two matrices make together, shape (...), by running error analysis.

    The noise of each times the other, and the roundings of sums of products of both.

    Parameters
    ----------
    behind, before : tuple of ndarray
        The matrices, of which light meets the second first, each with its noise.

    Returns
    -------
    ndarray

    Examples
    --------
    >>> one = np.eye(4), 2.0**-52
    >>> print(noise_of_product(one, one) * 2.0**52)
    6.0
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        one, two = _size(*behind), _size(*before)
        both = one * two
        eps = float(namespace(both).finfo(both.dtype).eps)
        return one * before[1] + behind[1] * two + _SUMS * eps * both


def _size(matrix: Any, noise: Any) -> Any:
    """Return M00, which no entry exceeds, or the noise where that is more."""
    return namespace(matrix).maximum(abs(known(matrix)[..., 0, 0]), noise)
