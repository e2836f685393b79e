"""The lowest and highest points over blocks of cells, over blocks of blocks, and so on."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

SHIFT = 2
"""Blocks are 2^SHIFT blocks of the level below wide."""


def levels_of(cells_x: int, cells_y: int) -> int:
    """Return how many levels a mesh has above its cells, the last of them of one block.

    Examples
    --------
    >>> levels_of(640, 640), levels_of(1, 1)
    (5, 0)
    """
    most, levels = max(cells_x, cells_y) - 1, 0
    while most >> (SHIFT * levels):
        levels += 1
    return levels


def pyramid_of(vertices: npt.NDArray[np.float64]) -> list[npt.NDArray[np.float64]]:
    """Return the extremes of a mesh by level, each of shape (rows, columns, 2).

    Shape: vertices (cells_y + 1, cells_x + 1).

    Examples
    --------
    >>> cells, whole = pyramid_of(np.array([[0.0, 1.0, 0.0], [2.0, 0.0, 3.0]]))
    >>> print(cells[0, 1], whole[0, 0])
    [0. 3.] [0. 3.]
    """
    corners = np.stack([vertices[:-1, :-1], vertices[1:, :-1], vertices[:-1, 1:], vertices[1:, 1:]])
    found = [np.stack([corners.min(axis=0), corners.max(axis=0)], axis=-1)]
    for _ in range(levels_of(vertices.shape[1] - 1, vertices.shape[0] - 1)):
        low, high = found[-1][..., 0], found[-1][..., 1]
        found.append(
            np.stack(
                [_blocks(low, np.minimum, np.inf), _blocks(high, np.maximum, -np.inf)], axis=-1
            )
        )
    return found


def _blocks(
    values: npt.NDArray[np.float64], better: np.ufunc, worst: float
) -> npt.NDArray[np.float64]:
    width = 1 << SHIFT
    for axis in (0, 1):
        missing = -values.shape[axis] % width
        values = np.pad(
            values, [(0, missing * (axis == each)) for each in (0, 1)], constant_values=worst
        )
        shape = [*values.shape]
        shape[axis : axis + 1] = [shape[axis] // width, width]
        values = better.reduce(values.reshape(shape), axis=axis + 1)
    return values
