"""Triples of numbers, such as X, Y and Z, times a matrix, in one order."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.values.arrays.jax_values import namespace


def times(matrix: Any, vectors: Any) -> Any:
    """Return products in an order that does not depend on how many there are.

    Shapes: matrix (3, 3); vectors (..., 3); returns (..., 3).

    Examples
    --------
    >>> times(np.eye(3), np.array([1.0, 2.0, 3.0]))
    array([1., 2., 3.])
    """
    xp = namespace(vectors)
    parts = [vectors[..., place, np.newaxis] * matrix[:, place] for place in range(3)]
    return xp.asarray(parts[0] + parts[1] + parts[2])
