"""Height fields: rough surfaces as heights over a plane, of which a mesh of triangles is made."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.surfaces.fields.field_faults import (
    as_heights,
    faults_of_heights,
    faults_of_waves,
    pair_of,
    refuse_faults,
)
from optipath.surfaces.fields.height_maps import read_heights
from optipath.surfaces.fields.mesh_resolution import converged_cells, warn_of_coarse
from optipath.surfaces.fields.random_waves import RandomWaves
from optipath.values.arrays.memory import enough_for
from optipath.values.arrays.read_only import Unchanging, same_fields

if TYPE_CHECKING:
    from os import PathLike

Array = np.ndarray[Any, Any]
Pair = tuple[float, float]

_EACH = 32
"""How many bytes a cell takes, with the mesh and the minima and maxima that are made of it."""


@dataclass(frozen=True, eq=False, repr=False)
class HeightField(Unchanging):
    """A rough surface: heights z over x and y, in cells of two flat triangles each.

    ``heights[i, j]`` is that at ``x = j dx``, ``y = i dy``; z points up. The diagonal of each
    cell goes from its corner (0, 0) to (1, 1), and a normal is that of a triangle. Heights and
    sizes are in one unit, whichever that is.

    Parameters
    ----------
    heights : array_like, shape (rows, columns)
        Kept as a read-only copy in float64.
    size : float or pair of float
        The lengths of the sides, along x and along y.
    periodic : bool, optional
        Whether the first row and column follow the last ones again. Then n vertices make n
        cells along an axis, else n - 1.
    alpha : pair of float, optional
        The roughness of a random field along x and y; None for others.

    Raises
    ------
    SurfaceError
        If heights are not finite, not of two dimensions or fewer than those of 2 x 2 cells, or
        if sizes are not positive; with all faults at once.

    Examples
    --------
    >>> field = HeightField.beckmann(0.25, size=160.0, cells=320, seed=1)
    >>> field
    HeightField.beckmann of alpha (0.25, 0.25), 320 x 320 cells, 160 x 160, periodic
    >>> [round(slope, 3) for slope in field.mean_square_slopes], 0.25**2 / 2
    ([0.031, 0.031], 0.03125)
    """

    heights: Array
    size: Pair
    periodic: bool = False
    alpha: Pair | None = None

    def __post_init__(self) -> None:
        faults: list[str] = []
        heights = as_heights(self.heights, faults)
        size = pair_of("size", self.size, faults)
        if heights is not None:
            faults += faults_of_heights(heights, periodic=self.periodic)
        refuse_faults(faults)
        vars(self).update(heights=heights, size=size, periodic=bool(self.periodic))
