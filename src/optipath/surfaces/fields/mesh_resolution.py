"""How fine a mesh is to be for its roughness, and what a coarser one costs."""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

from optipath.errors import MeshWarning
from optipath.values.calls_up import calls_up
from optipath.values.cures import cure

CONVERGED = 16
"""How many cells a correlation length needs where light is scattered several times."""

_SMOOTH = 0.3
_OF_SMOOTH = 5
"""The largest alpha at which little light is scattered twice, and how many cells do there."""


class MeshCost(NamedTuple):
    """What light was found on meshes of too few cells, and on fine ones; alpha 1, index 1.5.

    Attributes
    ----------
    cells : tuple of int
        From how many to how many a correlation length the coarse meshes had.
    coarse, fine : float
        The share of light that is transmitted after several events, at an incidence of 1 rad.
    """

    cells: tuple[int, int]
    coarse: float
    fine: float


COST = MeshCost(cells=(2, 5), coarse=0.052, fine=0.060)
"""M. Wang et al., Optics Express 25(19) (2017), Table 1, beside meshes of 16 cells."""


def correlation_lengths(
    alpha: tuple[float, float], size: tuple[float, float]
) -> tuple[float, float]:
    """Return how many correlation lengths, 2 / alpha, a surface of random waves has.

    Parameters
    ----------
    alpha, size : tuple of float
        The roughness, and the lengths of the sides, along x and along y.

    Returns
    -------
    tuple of float
        Along x and along y.

    Examples
    --------
    >>> correlation_lengths((1.0, 0.5), (80.0, 80.0))
    (40.0, 20.0)
    """
    return size[0] * alpha[0] / 2.0, size[1] * alpha[1] / 2.0


def converged_cells(alpha: tuple[float, float], size: tuple[float, float]) -> tuple[int, int]:
    """Return how many cells are enough for light of any number of events.

    Parameters
    ----------
    alpha, size : tuple of float
        The roughness, and the lengths of the sides, along x and along y.

    Returns
    -------
    tuple of int
        Along x and along y.

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
    """Warn of a mesh that is too coarse for its roughness.

    Parameters
    ----------
    alpha, size : tuple of float
        The roughness, and the lengths of the sides, along x and along y.
    cells : tuple of int
        Along x and along y.

    Warns
    -----
    MeshWarning
        With what it costs, and how many cells do.
    """
    needed = CONVERGED if max(alpha) > _SMOOTH else _OF_SMOOTH
    lengths = correlation_lengths(alpha, size)
    enough = tuple(_cells(needed, length) for length in lengths)
    if all(have >= need for have, need in zip(cells, enough, strict=True)):
        return
    had = min(have / length for have, length in zip(cells, lengths, strict=True))
    warnings.warn(
        f"a mesh of {cells[0]} x {cells[1]} cells has {had:.4g} a correlation length 2/alpha, and "
        f"needs {needed} at alpha {max(alpha):.4g}: slopes are lost, and light is scattered too "
        f"little, most of all light of several events (at alpha 1, {_off():.0%} less of it with "
        f"{COST.cells[0]} to {COST.cells[1]} cells a length); {_cure(enough)} are enough",
        MeshWarning,
        stacklevel=calls_up(),
    )


def _cells(each: int, lengths: float) -> int:
    # The rounding of a product is no cell more; what no machine has memory for is told as such.
    return max(2, math.ceil(min(each * lengths * (1.0 - 1e-12), 1e18)))


def _cure(cells: tuple[int, ...]) -> str:
    return cure(f"cells={cells}", f"--cells {','.join(map(str, cells))}")


def _off() -> float:
    return 1.0 - COST.coarse / COST.fine
