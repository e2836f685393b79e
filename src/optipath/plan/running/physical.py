"""Physical: Mueller matrices on a path that no element can have are refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.light.mueller.cloude import lack, tolerance_for

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.engines.program.program import Program
    from optipath.kernels.carriers.structures import Numbers

_GIVEN_AWAY = 10.0
"""What bounds may be wrong by, over the share by which an eigenvalue is below 0.

M + 4 l diag(1, 0, 0, 0) is physical where M has the eigenvalue -l, and l is at most that share of
M00: what it adds is counted once for the intensity without polarisation, once for the true one.
"""


def what_matrices_lack(program: Program, matrices: Mapping[int, Numbers]) -> Any:
    """Return what bounds must give away, since some matrices have been rounded."""
    total: Any = 0.0
    for index, numbers in matrices.items():
        elements = program.matrices[index]
        matrix = _stacked(numbers)
        share = lack(matrix)
        if np.any(share > tolerance_for(matrix)):
            raise ParameterError(
                f"the Mueller matrix of '{elements[0]}' is unphysical, having a coherency "
                f"eigenvalue of {-np.nanmax(share):.3g} times the largest, so nothing bounds its "
                f"light; give it Mueller(matrix).nearest_physical().matrix"
            )
        total = total + _GIVEN_AWAY * len(elements) * share
    return total


def _stacked(numbers: Sequence[Any]) -> np.ndarray[Any, Any]:
    """Return matrices (..., 4, 4), in single precision where that holds all their digits."""
    flat = np.stack(np.broadcast_arrays(*numbers), axis=-1)
    with np.errstate(over="ignore"):
        single = flat.astype(np.float32)
    matrix = single if np.array_equal(single, flat) else flat
    return matrix.reshape(*flat.shape[:-1], 4, 4)
