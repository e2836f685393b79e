"""Mueller matrices brought near 1 for linear algebra, which knows no NaN and no faintness."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.underflow import normalise_exponent, times_two_to
from optipath.values.arrays.jax_values import check_known

if TYPE_CHECKING:
    from optipath.values.roundings import Array


def scaled(matrix: Any) -> tuple[Array, Array]:
    """Return matrices over a power of two, in double precision, and its exponent.

    A matrix of which an entry is not known becomes 0, for `unscaled` to give back.

    Examples
    --------
    >>> [part.tolist() for part in scaled(np.diag([6.0, 3.0, 3.0, 3.0]))][1]
    3
    """
    check_known("what a Mueller matrix is made of (by its coherency, or Lu and Chipman)", matrix)
    with np.errstate(over="ignore"):
        flat = np.asarray(matrix, np.float64).reshape(*matrix.shape[:-2], 16)
    parts, power = normalise_exponent(np.where(_known(flat), flat, 0.0), 0)
    return parts.reshape(matrix.shape), power


def unscaled(matrix: Any, parts: Array, power: Any) -> Array:
    """Return what was found for scaled matrices in the matrices' own scale.

    Shapes: matrix (..., 4, 4); parts (..., 4, n); power (...); returns (..., 4, n).
    """
    *batch, rows, columns = parts.shape
    found = times_two_to(parts.reshape(*batch, rows * columns), power)
    flat = np.asarray(matrix).reshape(*matrix.shape[:-2], 16)
    return np.where(_known(flat), found, np.nan).reshape(parts.shape)


def rounding_of(matrix: Any) -> float:
    """Return the spacing of a matrix's numbers at 1, or that of double precision if it is less.

    Examples
    --------
    >>> rounding_of(np.eye(4, dtype=np.float32)) == 2.0**-23
    True
    """
    dtype = matrix.dtype if matrix.dtype.kind == "f" else np.dtype(np.float64)
    return max(float(np.finfo(dtype).eps), 2.0**-52)


def _known(flat: Array) -> Array:
    return np.asarray(np.isfinite(flat).all(axis=-1, keepdims=True))
