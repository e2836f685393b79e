"""Reciprocity: what a system does to light that goes through it the other way."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.values.arrays.jax_values import known

_MIRRORED = np.array([1, 1, -1, 1], np.int8)
_SIGNS = np.outer(_MIRRORED, _MIRRORED)
"""Those of Q M Q, entry by entry, for Q = diag(1, 1, -1, 1)."""


def reciprocal(matrix: Any) -> Any:
    """Return Q M^T Q, Q = diag(1, 1, -1, 1): M backwards, between mirrored frames (x, -y, -z).

    De Hoop, Appl. Sci. Res. B 8, 135 (1960); Sekera, J. Opt. Soc. Am. 56, 1732 (1966).

    Shapes: matrix (..., 4, 4); returns (..., 4, 4).

    Examples
    --------
    >>> matrix = np.arange(16.0).reshape(4, 4)
    >>> print(reciprocal(matrix)[2])
    [ -2.  -6.  10. -14.]
    >>> bool(np.all(reciprocal(reciprocal(matrix)) == matrix))
    True
    """
    # Adding 0 turns -0 into 0.
    return known(matrix).swapaxes(-1, -2) * _SIGNS + 0
