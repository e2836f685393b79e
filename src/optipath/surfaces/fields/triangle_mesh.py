"""The mesh of a height field: two flat triangles for each cell."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


class TriangleMesh:
    """What is known of the triangles between heights, each cell cut from (0, 0) to (1, 1)."""

    heights: Array
    size: tuple[float, float]
    periodic: bool

    @property
    def cells(self) -> tuple[int, int]:
        """How many cells there are, along x and along y."""
        rows, columns = self.heights.shape
        open_end = not self.periodic
        return columns - open_end, rows - open_end

    @property
    def spacing(self) -> tuple[float, float]:
        """How far vertices are apart, along x and along y: dx and dy."""
        return self.size[0] / self.cells[0], self.size[1] / self.cells[1]

    @cached_property
    def deviation(self) -> float:
        """The standard deviation of the heights."""
        return float(np.std(self.heights))

    @cached_property
    def mean_square_slopes(self) -> tuple[float, float]:
        """The means over all triangles of the squares of slopes, along x and along y."""
        vertices = self.vertices()
        along_x, along_y = (
            (np.diff(vertices, axis=axis) / step) ** 2
            for axis, step in zip((1, 0), self.spacing, strict=True)
        )
        # An edge inside the mesh belongs to two triangles, one at a border to one.
        slopes_x = along_x[:-1].mean() + along_x[1:].mean()
        slopes_y = along_y[:, :-1].mean() + along_y[:, 1:].mean()
        return float(slopes_x) / 2.0, float(slopes_y) / 2.0

    def vertices(self) -> Array:
        """Return the heights at all corners of cells, the border once more where it is periodic.

        Returns
        -------
        ndarray, shape (cells_y + 1, cells_x + 1)
            Of float64, its rows one after the other in memory.

        Examples
        --------
        >>> from optipath.surfaces import HeightField
        >>> HeightField.from_heights([[0.0, 1.0], [2.0, 3.0]], 2.0, periodic=True).vertices()
        array([[0., 1., 0.],
               [2., 3., 2.],
               [0., 1., 0.]])
        """
        return np.pad(self.heights, (0, 1), mode="wrap") if self.periodic else self.heights
