"""Meshes of a stack as compiled code takes them, with pyramids of heights."""

from __future__ import annotations

from threading import Lock
from typing import TYPE_CHECKING, NamedTuple
from weakref import proxy

import numpy as np
import numpy.typing as npt

from optipath.surfaces.height_field import HeightField

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.surfaces.sample import Sample


WHOLES, NUMBERS = 24, 4
"""How many whole numbers, and how many others, there are of a mesh."""

HEIGHTS, CELLS_X, CELLS_Y, LEVELS, PERIODIC, PYRAMID = range(6)
"""The places of the whole numbers: where heights begin, and from the last, where levels do."""

CELL_X, CELL_Y, LOW, HIGH = range(NUMBERS)
"""The places of the others."""

ENDED, SHIFTED, IN_REGISTER = range(3)
"""How a mesh ends: at its border; periodic, shifted at random by photon; or periodic and fixed."""

GAP = 2.0
"""The empty space between two meshes, in standard deviations of the rougher one's heights."""


class PackedMeshes(NamedTuple):
    """Meshes one below the other, from the top."""

    wholes: npt.NDArray[np.int64]
    numbers: npt.NDArray[np.float64]
    heights: npt.NDArray[np.float64]
    extremes: npt.NDArray[np.float64]


def packed_meshes(fields: Sequence[HeightField], arguments: Sequence[bool] = ()) -> PackedMeshes:
    """Return meshes as compiled code takes them, far enough from each other not to touch."""
    standing = _standing(fields, arguments)
    wholes = np.zeros((len(fields), WHOLES), np.int64)
    numbers = np.zeros((len(fields), NUMBERS))
    heights: list[npt.NDArray[np.float64]] = []
    extremes: list[npt.NDArray[np.float64]] = []
    lowest, taken, message = 0.0, 0, 0
    for place, field in enumerate(fields):
        vertices = field.vertices()
        if place:
            gap = GAP * max(field.deviation, fields[place - 1].deviation) or GAP
            vertices = vertices + (lowest - gap - vertices.max())
        lowest = float(vertices.min())
        across, down = field.cells
        levels = pyramid_of(vertices)
        wholes[place, :PYRAMID] = taken, across, down, len(levels) - 1, standing[place]
        for level, values in enumerate(levels[1:], 1):
            wholes[place, PYRAMID + level] = message
            message += values.size
        numbers[place] = *np.divide(field.size, field.cells), lowest, vertices.max()
        taken += vertices.size
        heights.append(vertices.ravel())
        extremes += [values.ravel() for values in levels[1:]]
    extremes.append(np.zeros(1))
    return PackedMeshes(
        wholes.ravel(), numbers.ravel(), np.concatenate(heights), np.concatenate(extremes)
    )


def _standing(fields: Sequence[HeightField], arguments: Sequence[bool]) -> list[int]:
    """Return how each mesh stands; those that are given stay in register with the first of them."""
    results = [SHIFTED if field.periodic else ENDED for field in fields]
    places = [
        place for place, is_given in enumerate(arguments) if is_given and results[place] == SHIFTED
    ]
    for place in places:
        if fields[place].size == fields[places[0]].size:
            results[place] = IN_REGISTER
    return results


_MORE = 8
"""How many are kept besides those in turn, for blocks that are walked a little earlier or later."""


class CachedMeshes:
    """Packs what a sample draws, once for all threads, and drops what was packed first."""

    def __init__(self, sample: Sample) -> None:
        # It keeps these meshes itself, and both are to go as soon as nobody needs it.
        self._sample: Sample = proxy(sample)
        self._known: dict[int, PackedMeshes] = {}
        self._lock = Lock()

    def of(self, surface: int) -> PackedMeshes:
        """Return a realisation."""
        with self._lock:
            if surface not in self._known:
                if len(self._known) >= self._sample.surfaces + _MORE:
                    self._known.pop(next(iter(self._known)))
                arguments = [
                    isinstance(each.roughness, HeightField) for each in self._sample.layers
                ]
                self._known[surface] = packed_meshes(self._sample.fields(surface), arguments)
            return self._known[surface]


def cached_meshes(sample: Sample) -> CachedMeshes:
    """Return those that are kept with a sample."""
    result: CachedMeshes = vars(sample).setdefault("_packed", CachedMeshes(sample))
    return result


SHIFT = 2
"""Blocks are 2^SHIFT blocks of the level below wide."""


def levels_of(cells_x: int, cells_y: int) -> int:
    """Return how many levels a mesh has above its cells, the last of them of one block.

    >>> levels_of(640, 640), levels_of(1, 1)
    (5, 0)
    """
    most, levels = max(cells_x, cells_y) - 1, 0
    while most >> (SHIFT * levels):
        levels += 1
    return levels


def pyramid_of(vertices: npt.NDArray[np.float64]) -> list[npt.NDArray[np.float64]]:
    """Return the extremes by level, (rows, columns, 2), of vertices (cells_y + 1, cells_x + 1).

    >>> cells, whole = pyramid_of(np.array([[0.0, 1.0, 0.0], [2.0, 0.0, 3.0]]))
    >>> print(cells[0, 1], whole[0, 0])
    [0. 3.] [0. 3.]
    """
    corners = np.stack([vertices[:-1, :-1], vertices[1:, :-1], vertices[:-1, 1:], vertices[1:, 1:]])
    results = [np.stack([corners.min(axis=0), corners.max(axis=0)], axis=-1)]
    for _ in range(levels_of(vertices.shape[1] - 1, vertices.shape[0] - 1)):
        low, high = results[-1][..., 0], results[-1][..., 1]
        results.append(
            np.stack(
                [_blocks(low, np.minimum, np.inf), _blocks(high, np.maximum, -np.inf)], axis=-1
            )
        )
    return results


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
