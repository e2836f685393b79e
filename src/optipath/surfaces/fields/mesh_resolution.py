"""How fine a mesh is to be for its roughness, and what a coarser one costs."""

from __future__ import annotations

import math
import warnings

import numpy as np

from optipath.errors import MeshWarning
from optipath.values.calls_up import calls_up
from optipath.values.cures import cure

CONVERGED = 16
"""How many cells a correlation length needs where light is scattered several times."""

_SMOOTH = 0.3
_OF_SMOOTH = 5
"""The largest alpha at which little light is scattered twice, and how many cells do there."""


MISSING = {2: 0.12, 3: 0.066, 4: 0.047, 5: 0.031, 8: 0.013, 16: 0.002}
"""By cells a correlation length, what share of the light of several events is not transmitted.

Of alpha 1, index 1.5 and an incidence of 1 rad, beside 32 cells on the same 32 surfaces; at alpha
0.3 it is much the same. docs/surfaces.md has the table, and the command for it.
"""


def correlation_lengths(
    alpha: tuple[float, float], size: tuple[float, float]
) -> tuple[float, float]:
    """Return how many correlation lengths, 2 / alpha, a surface of random waves has.

    Examples
    --------
    >>> correlation_lengths((1.0, 0.5), (80.0, 80.0))
    (40.0, 20.0)
    """
    return size[0] * alpha[0] / 2.0, size[1] * alpha[1] / 2.0


def converged_cells(alpha: tuple[float, float], size: tuple[float, float]) -> tuple[int, int]:
    """Return how many cells are enough for light of any number of events.

    Examples
    --------
    >>> converged_cells((1.0, 0.5), (80.0, 80.0))
    (640, 320)
    """
    along_x, along_y = (_cells(CONVERGED, n) for n in correlation_lengths(alpha, size))
    return along_x, along_y


def warn_of_coarse(
    alpha: tuple[float, float], size: tuple[float, float], cells: tuple[int, int]
) -> None:
    """Warn of a mesh that is too coarse for its roughness."""
    needed = CONVERGED if max(alpha) > _SMOOTH else _OF_SMOOTH
    lengths = correlation_lengths(alpha, size)
    enough = tuple(_cells(needed, length) for length in lengths)
    if all(have >= need for have, need in zip(cells, enough, strict=True)):
        return
    had = min(have / length for have, length in zip(cells, lengths, strict=True))
    warnings.warn(
        f"a mesh of {cells[0]} x {cells[1]} cells has {had:.4g} a correlation length 2/alpha, and "
        f"needs {needed} at alpha {max(alpha):.4g}: slopes are lost, and {_missing(had)} of the "
        f"light that is transmitted after several events; {_cure(enough)} are enough",
        MeshWarning,
        stacklevel=calls_up(),
    )


def _cells(each: int, lengths: float) -> int:
    # The rounding of a product is no cell more; what no machine has memory for is told as such.
    return max(2, math.ceil(min(each * lengths * (1.0 - 1e-12), 1e18)))


def _cure(cells: tuple[int, ...]) -> str:
    return cure(f"cells={cells}", f"--cells {','.join(map(str, cells))}")


def _missing(cells: float) -> str:
    """Return the share of light that is lost with so many cells a correlation length."""
    share = np.interp(math.log(cells), np.log([*MISSING]), [*MISSING.values()])
    return f"{'more than' if cells < min(MISSING) else 'about'} {100.0 * share:.2g} %"
