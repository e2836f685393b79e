"""Cloude's coherency matrix of a Mueller matrix, which tells whether it can exist.

S. R. Cloude, Optik 75, 26 (1986); Proc. SPIE 1166, 177 (1989).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.kernels.carriers.coherency import FROM_MUELLER, TO_MUELLER
from optipath.light.mueller.normalised import rounding_of, scaled, unscaled
from optipath.values.arrays.array_likes import array_of
from optipath.values.arrays.jax_values import check_known

if TYPE_CHECKING:
    from optipath.values.roundings import Array

# Of double precision.
_TOLERANCE = 1e-9


def coherency(matrix: Array) -> Array:
    """Return the coherency matrices, shape (..., 4, 4), complex; NaN all over where an entry is.

    Examples
    --------
    >>> coherency(np.diag([1.0, 1.0, -1.0, -1.0])).real.diagonal()
    array([0., 1., 0., 0.])
    """
    parts, power = scaled(matrix)
    found = gathered(parts)
    real, imaginary = (unscaled(matrix, part, power) for part in (found.real, found.imag))
    return real + 1j * imaginary


def eigenvalues(matrix: Array) -> Array:
    """Return the eigenvalues of the coherency matrices, shape (..., 4), the largest first."""
    parts, power = scaled(matrix)
    found = np.linalg.eigvalsh(gathered(parts))[..., ::-1]
    return unscaled(matrix, found[..., np.newaxis], power)[..., 0]


def is_physical(matrix: Array, tolerance: float | None = None) -> Array:
    """Tell where no eigenvalue is below minus the tolerance times the largest; NaN is not.

    Shapes: matrix (..., 4, 4); returns (...).

    Examples
    --------
    >>> print(is_physical(np.eye(4), 0.0))
    True
    """
    return np.asarray(lack(matrix) <= _tolerance(tolerance, matrix))


def lack(matrix: Array) -> Array:
    """Return by which share of the largest eigenvalue the least one is below 0; NaN of NaN.

    Infinite where no eigenvalue is above 0, and one below.

    Examples
    --------
    >>> print(lack(np.eye(4)), lack(np.diag([1.0, 1.0, 1.0, -1.0])))
    0.0 1.0
    """
    # Near 1, where the largest neither runs over nor fades.
    parts, _ = scaled(matrix)
    values = eigenvalues(unscaled(matrix, parts, 0))
    largest, below = values[..., 0], np.maximum(-values[..., 3], 0.0)
    share = below / np.where(largest > 0.0, largest, 1.0)
    return np.asarray(np.where((below > 0.0) & (largest <= 0.0), np.inf, share))


def tolerance_for(matrix: Array) -> float:
    """Return what a matrix may lack, having been rounded in the precision of its numbers."""
    return tolerance_of(rounding_of(matrix))


def tolerance_of(rounding: float) -> float:
    """Return what a matrix may lack whose numbers have been rounded so, those near 1."""
    return max(_TOLERANCE, 100.0 * rounding)


def nearest_physical(matrix: Array) -> Array:
    """Return the matrices without what has negative eigenvalues.

    Examples
    --------
    >>> nearest_physical(np.diag([1.0, 1.0, 1.0, -1.0])).diagonal().round(12)
    array([ 1.5,  0.5,  0.5, -0.5])
    """
    parts, power = scaled(matrix)
    values, vectors = np.linalg.eigh(gathered(parts))
    kept = vectors * np.maximum(values, 0.0)[..., np.newaxis, :]
    positive = kept @ np.swapaxes(vectors.conj(), -1, -2)
    found = (positive.reshape(*parts.shape[:-2], 16) @ TO_MUELLER).real
    return unscaled(matrix, found.reshape(parts.shape), power)


def _tolerance(given: Any, matrix: Array) -> float:
    """Return the tolerance of `is_physical`, by the precision of the matrix if none is given."""
    if given is None:
        return tolerance_for(matrix)
    check_known("the tolerance of is_physical", given)
    number = array_of("the tolerance of is_physical", given)
    if number.shape == () and number.dtype.kind in "iuf" and 0.0 <= number < np.inf:
        return float(number)
    raise ValueFault(
        f"the tolerance of is_physical must be a finite number >= 0, not {shown(given)}; leave it "
        f"out to allow for rounding"
    )


def gathered(parts: Array) -> Array:
    """Return the coherency matrices of matrices whose entries are numbers near 1."""
    flat = parts.reshape(*parts.shape[:-2], 16) @ FROM_MUELLER
    return np.asarray(flat.reshape(parts.shape))
