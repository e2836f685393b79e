"""Figures read off the entries of a Mueller matrix, shape (..., 4, 4), each over M00.

They are 0 where M00 is 0, NaN where it is infinite or an entry they need is not known, and exact
in scale.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.polarization_state import direction, length, ratio

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    Array = npt.NDArray[Any]

_BCS = (0, 1), (2, 2), (2, 3)


def diattenuation_vector(matrix: Array) -> Array:
    """Return (M01, M02, M03) / M00."""
    return _over_m00(matrix, matrix[..., 0, 1:])


def polarizance_vector(matrix: Array) -> Array:
    """Return (M10, M20, M30) / M00."""
    return _over_m00(matrix, matrix[..., 1:, 0])


def depolarization_index(matrix: Array) -> Array:
    """Return the length of all entries but M00, over sqrt(3) M00."""
    flat = matrix.reshape(*matrix.shape[:-2], 16)
    return norm(_over_m00(matrix, flat[..., 1:])) / sqrt(3.0)


def sample_psi(matrix: Array) -> Array:
    """Return psi of an isotropic sample, from B = M01, C = M22 and S = M23."""
    B, C, S = _bcs(matrix)
    return 0.5 * direction(length(C, S), B)  # type: ignore[no-any-return]


def sample_delta(matrix: Array) -> Array:
    """Return Delta of an isotropic sample in ellipsometry's exp(+i w t), from C and S."""
    _, C, S = _bcs(matrix)
    return direction(S, C)  # type: ignore[no-any-return]


def norm(vector: Array) -> Array:
    """Return the length along the last axis, however small; at 0 its slope is 0."""
    return length(*(vector[..., i] for i in range(vector.shape[-1])))  # type: ignore[no-any-return]


def _bcs(matrix: Array) -> Iterator[Array]:
    return (_over_m00(matrix, matrix[..., i, j, np.newaxis])[..., 0] for i, j in _BCS)


def _over_m00(matrix: Array, entries: Array) -> Array:
    return ratio(entries, matrix[..., 0, 0, np.newaxis])  # type: ignore[no-any-return]
