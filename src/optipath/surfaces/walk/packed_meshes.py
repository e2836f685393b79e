"""The meshes of a stack as compiled code takes them: a few arrays of numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from optipath.surfaces.walk.mesh_pyramid import pyramid_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.surfaces.fields.height_field import HeightField

WHOLES, NUMBERS = 24, 4
"""How many whole numbers, and how many others, there are of a mesh."""

HEIGHTS, CELLS_X, CELLS_Y, LEVELS, PERIODIC, PYRAMID = range(6)
"""The places of the whole numbers: where heights begin, and from the last, where levels do."""

CELL_X, CELL_Y, LOW, HIGH = range(NUMBERS)
"""The places of the others."""

ENDED, SHIFTED, IN_REGISTER = range(3)
"""How a mesh stands: it ends at its border; or is periodic, and shifted at random for every photon;
or periodic, and stays as it is against others of its kind."""

GAP = 2.0
"""The empty space between two meshes, in standard deviations of the rougher one's heights."""


class PackedMeshes(NamedTuple):
    """Meshes one below the other, from the top."""

    wholes: npt.NDArray[np.int64]
    numbers: npt.NDArray[np.float64]
    heights: npt.NDArray[np.float64]
    extremes: npt.NDArray[np.float64]


def packed_meshes(fields: Sequence[HeightField], given: Sequence[bool] = ()) -> PackedMeshes:
    """Return meshes as compiled code takes them, far enough from each other not to touch."""
    standing = _standing(fields, given)
    wholes = np.zeros((len(fields), WHOLES), np.int64)
    numbers = np.zeros((len(fields), NUMBERS))
    heights: list[npt.NDArray[np.float64]] = []
    extremes: list[npt.NDArray[np.float64]] = []
    lowest, taken, told = 0.0, 0, 0
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
            wholes[place, PYRAMID + level] = told
            told += values.size
        numbers[place] = *np.divide(field.size, field.cells), lowest, vertices.max()
        taken += vertices.size
        heights.append(vertices.ravel())
        extremes += [values.ravel() for values in levels[1:]]
    extremes.append(np.zeros(1))
    return PackedMeshes(
        wholes.ravel(), numbers.ravel(), np.concatenate(heights), np.concatenate(extremes)
    )


def _standing(fields: Sequence[HeightField], given: Sequence[bool]) -> list[int]:
    """Return how each mesh stands; those that are given stay in register with the first of them."""
    found = [SHIFTED if field.periodic else ENDED for field in fields]
    places = [place for place, is_given in enumerate(given) if is_given and found[place] == SHIFTED]
    for place in places:
        if fields[place].size == fields[places[0]].size:
            found[place] = IN_REGISTER
    return found
