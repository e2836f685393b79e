"""Where a ray meets a mesh: over a pyramid of its lowest and highest points."""

from __future__ import annotations

from typing import Any

import numba as nb
import numpy as np

from optipath.surfaces.walk.facet_hit import NO_FACET, corners_of, facet_hit
from optipath.surfaces.walk.mesh_pyramid import SHIFT
from optipath.surfaces.walk.packed_meshes import (
    CELLS_X,
    CELLS_Y,
    HIGH,
    HEIGHTS,
    LEVELS,
    LOW,
    NUMBERS,
    PERIODIC,
    PYRAMID,
    WHOLES,
)

MET, MISSED, LEFT, LOST = 0, 1, 2, 3
"""A facet is met; none is; the ray has left the field at its side; it goes on for too long."""

_MOST_STEPS = 1_000_000


@nb.njit(error_model="numpy")
def mesh_hit(
    meshes: Any, layer: int, x: float, y: float, ray: Any, side: float, column: int, line: int, own: int
) -> Any:
    """Return what a ray meets of a mesh.

    Parameters
    ----------
    meshes : tuple
        Whole numbers, numbers, heights and extremes, as `packed_meshes` has them.
    layer : int
        Which mesh.
    x, y : float
        Where the ray starts, in cells.
    ray : tuple of float
        The height where it starts, and its direction: in cells along x and y, and upwards.
    side : float
        1 for light above the mesh, -1 for light below it.
    column, line : int
        The cell in which it starts.
    own : int
        The facet of that cell that it starts from, or `NO_FACET`.

    Returns
    -------
    outcome : int
        `MET`, `MISSED`, `LEFT` or `LOST`.
    t : float
        Where along the ray.
    column, line, facet : int
        What is met.
    x, y : float
        The start of the ray, moved by as many periods as it has gone through.
    """
    wholes, numbers, heights, extremes = meshes
    z, dx, dy, dz = ray
    about = layer * WHOLES
    across, down, top = wholes[about + CELLS_X], wholes[about + CELLS_Y], wholes[about + LEVELS]
    first, row = wholes[about + HEIGHTS], wholes[about + CELLS_X] + 1
    inverse_x, inverse_y = 1.0 / dx, 1.0 / dy
    # Beyond this, nothing of the mesh is as high, or as low.
    leaves = np.inf
    if side * dz > 0.0:
        edge = numbers[layer * NUMBERS + (HIGH if side > 0.0 else LOW)]
        leaves = (edge - z) / dz
    t, level = 0.0, 0
    for _ in range(_MOST_STEPS):
        shift = SHIFT * level
        block_x, block_y = column >> shift, line >> shift
        left, front = block_x << shift, block_y << shift
        right, back = min(left + (1 << shift), across), min(front + (1 << shift), down)
        end_x = (right - x) * inverse_x if dx > 0.0 else ((left - x) * inverse_x if dx < 0.0 else np.inf)
        end_y = (back - y) * inverse_y if dy > 0.0 else ((front - y) * inverse_y if dy < 0.0 else np.inf)
        end = max(min(end_x, end_y), t)
        here, there = z + t * dz, z + end * dz
        if level > 0:
            start = wholes[about + PYRAMID + level] + 2 * (block_y * (((across - 1) >> shift) + 1) + block_x)
            if not (min(here, there) > extremes[start + 1] if side > 0.0 else max(here, there) < extremes[start]):
                level -= 1
                continue
        else:
            corners = corners_of(heights, first + line * row + column, row)
            low, right_, back_, high = corners
            if side > 0.0:
                close = min(here, there) <= max(max(low, right_), max(back_, high))
            else:
                close = max(here, there) >= min(min(low, right_), min(back_, high))
            if close:
                facet, at = facet_hit(
                    corners, x - column, y - line, ray, (t, min(end, 1e300)), side, own
                )
                if facet != NO_FACET:
                    return MET, at, column, line, facet, x, y
        own = NO_FACET
        if end >= leaves:
            return MISSED, leaves, column, line, NO_FACET, x, y
        t = end
        if end_x <= end_y:
            column = right if dx > 0.0 else left - 1
            line = min(max(int(np.floor(y + t * dy)), front), back - 1)
            if column < 0 or column >= across:
                if wholes[about + PERIODIC] == 0:
                    return LEFT, t, column, line, NO_FACET, x, y
                x, column = (x - across, 0) if dx > 0.0 else (x + across, across - 1)
            outside = (column >> (shift + SHIFT)) != (block_x >> SHIFT)
        else:
            line = back if dy > 0.0 else front - 1
            column = min(max(int(np.floor(x + t * dx)), left), right - 1)
            if line < 0 or line >= down:
                if wholes[about + PERIODIC] == 0:
                    return LEFT, t, column, line, NO_FACET, x, y
                y, line = (y - down, 0) if dy > 0.0 else (y + down, down - 1)
            outside = (line >> (shift + SHIFT)) != (block_y >> SHIFT)
        if outside and level < top:
            level += 1
    return LOST, t, column, line, NO_FACET, x, y
