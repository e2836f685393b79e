"""Meshes of a stack as compiled code takes them, with pyramids of heights."""

from __future__ import annotations

from threading import Lock
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from optipath.surfaces.height_field import HeightField
from optipath.surfaces.walk import layout

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.surfaces.sample import Sample


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
    # Those that are given stay in register with the first of them.
    given = [field for field, is_given in zip(fields, arguments, strict=False) if is_given]
    size = next((field.size for field in given if field.periodic), None)
    wholes = np.zeros((len(fields), layout.WHOLES), np.int64)
    numbers = np.zeros((len(fields), layout.NUMBERS))
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
        standing = layout.SHIFTED if field.periodic else layout.ENDED
        if field.periodic and field.size == size and any(field is each for each in given):
            standing = layout.IN_REGISTER
        wholes[place, : layout.PYRAMID] = taken, across, down, len(levels) - 1, standing
        for level, values in enumerate(levels[1:], 1):
            wholes[place, layout.PYRAMID + level] = message
            message += values.size
        numbers[place] = *np.divide(field.size, field.cells), lowest, vertices.max()
        taken += vertices.size
        heights.append(vertices.ravel())
        extremes += [values.ravel() for values in levels[1:]]
    extremes.append(np.zeros(1))
    return PackedMeshes(
        wholes.ravel(), numbers.ravel(), np.concatenate(heights), np.concatenate(extremes)
    )


_MORE = 8
"""How many are kept besides those in turn, for blocks that are walked a little earlier or later."""


_PACKING = Lock()


def meshes_of(sample: Sample, surface: int) -> PackedMeshes:
    """Return what a sample draws, packed once for all threads; what was packed first is dropped."""
    with _PACKING:
        known: dict[int, PackedMeshes] = vars(sample).setdefault("_packed", {})
        if surface not in known:
            if len(known) >= sample.surfaces + _MORE:
                known.pop(next(iter(known)))
            given = [isinstance(each.roughness, HeightField) for each in sample.layers]
            known[surface] = packed_meshes(sample.fields(surface), given)
        return known[surface]


def pyramid_of(vertices: npt.NDArray[np.float64]) -> list[npt.NDArray[np.float64]]:
    """Return the extremes by level, (rows, columns, 2), of vertices (cells_y + 1, cells_x + 1).

    The first is of the cells, the last of one block.
    """
    corners = np.stack([vertices[:-1, :-1], vertices[1:, :-1], vertices[:-1, 1:], vertices[1:, 1:]])
    results = [np.stack([corners.min(axis=0), corners.max(axis=0)], axis=-1)]
    while max(results[-1].shape[:2]) > 1:
        low, high = results[-1][..., 0], results[-1][..., 1]
        for axis in (0, 1):
            blocks = np.arange(0, low.shape[axis], 1 << layout.SHIFT)
            low = np.minimum.reduceat(low, blocks, axis=axis)
            high = np.maximum.reduceat(high, blocks, axis=axis)
        results.append(np.stack([low, high], axis=-1))
    return results
