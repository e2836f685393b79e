"""Cloude's coherency matrix of a Mueller matrix, and his criterion, elementwise.

S. R. Cloude, Optik 75, 26 (1986): a Mueller matrix is physical if no eigenvalue of its
coherency matrix is negative.
"""

from __future__ import annotations

from functools import reduce
from operator import sub
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from optipath.kernels.carriers.structures import Numbers
    from optipath.kernels.primitives import Primitives


PAULI = np.array(
    [[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]], np.complex128
)
"""The matrices s_i for which S_i = <E| s_i |E>, in the order and with the signs of `Light`."""

# M_ij = 1/2 tr(s_i T s_j T*) with T = sum_k c_k s_k, and c_k conj(c_l) gathered into C_kl.
TO_MUELLER = 0.5 * np.einsum("iab,kbc,jcd,lda->klij", *[PAULI] * 4).reshape(16, 16)
"""What sixteen entries of a coherency matrix are multiplied by, from the right."""
FROM_MUELLER = 0.25 * TO_MUELLER.conj().T
"""What sixteen entries of a Mueller matrix are multiplied by, from the right."""


def is_physical(xp: Primitives, numbers: Numbers, spare: float) -> Any:
    """Tell whether no eigenvalue of the coherency matrix is below minus `spare` times M00.

    By elimination without pivots, which a positive matrix needs none of (Higham, Accuracy and
    Stability of Numerical Algorithms, sec. 10.1): right but for a few roundings of M00.

    >>> from optipath.kernels.primitives import FLOAT
    >>> mirror, turned_over = np.diag([1.0, 1.0, -1.0, -1.0]), np.diag([1.0, 1.0, 1.0, -1.0])
    >>> [bool(is_physical(FLOAT, m.ravel().tolist(), 1e-14)) for m in (mirror, turned_over)]
    [True, False]
    """
    real, imaginary = (
        [[_sum(numbers, *places) for places in row] for row in part] for part in _FOUR_TIMES
    )
    shift = 4.0 * spare * numbers[0]
    result: Any = np.True_
    for k in range(4):
        pivot = real[k][k] + shift
        result = result & (pivot >= 0.0)
        divisor = xp.where(pivot > 0.0, pivot, 1.0)
        for i in range(k + 1, 4):
            a, b = real[i][k] / divisor, imaginary[i][k] / divisor
            real[i][i] = real[i][i] - (a * real[i][k] + b * imaginary[i][k])
            for j in range(k + 1, i):
                c, d = real[j][k], imaginary[j][k]
                real[i][j] = real[i][j] - (a * c + b * d)
                imaginary[i][j] = imaginary[i][j] - (b * c - a * d)
    return result


def _places(part: Any) -> list[list[tuple[list[int], list[int]]]]:
    """Return which numbers of a matrix are added and subtracted for four times each entry."""
    weights = [[part[:, 4 * row + column] for column in range(row + 1)] for row in range(4)]
    return [
        [(np.flatnonzero(w > 0.0).tolist(), np.flatnonzero(w < 0.0).tolist()) for w in row]
        for row in weights
    ]


_FOUR_TIMES = _places(FROM_MUELLER.real), _places(FROM_MUELLER.imag)
"""The lower half of a coherency matrix, its real and its imaginary part."""


def _sum(numbers: Numbers, added: list[int], subtracted: list[int]) -> Any:
    if not added:
        return 0.0
    first, *others = [numbers[place] for place in added]
    return reduce(sub, [numbers[place] for place in subtracted], sum(others, first))
