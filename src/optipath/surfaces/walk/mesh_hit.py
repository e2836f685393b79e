"""Compiled meshes: where a ray enters and meets one."""

from __future__ import annotations

from typing import Any

import numba as nb
import numpy as np

from optipath.surfaces.walk import layout
from optipath.surfaces.walk.facets import NO_FACET, corners_of, facet_hit

MET, MISSED, LEFT, LOST = 0, 1, 2, 3
"""A facet is met; none is; the ray has left the field at its side; it goes on for too long."""

_MOST_STEPS = 1_000_000
_FAR = 1e300
"""In place of an infinite way, which times 0 is no number."""

_FIRST_LEVEL = 3
"""Where light from outside begins, which is high above most of the mesh."""


@nb.njit(error_model="numpy")
def mesh_hit(
    meshes: Any,
    layer: int,
    x: float,
    y: float,
    ray: Any,
    side: float,
    column: int,
    line: int,
    own: int,
) -> Any:
    """Return what a ray meets of a mesh."""
    wholes, numbers, heights, extremes = meshes
    z, dx, dy, dz = ray
    about = layer * layout.WHOLES
    across, down = wholes[about + layout.CELLS_X], wholes[about + layout.CELLS_Y]
    top = wholes[about + layout.LEVELS]
    first, periodic = wholes[about + layout.HEIGHTS], wholes[about + layout.PERIODIC] != 0
    inverse_x, inverse_y = 1.0 / dx, 1.0 / dy
    edge = numbers[layer * layout.NUMBERS + (layout.HIGH if side > 0.0 else layout.LOW)]
    # Beyond this, nothing of the mesh is as high, or as low.
    leaves = (edge - z) / dz if side * dz > 0.0 else np.inf
    t, facet = 0.0, NO_FACET
    level = 0 if own != NO_FACET else min(_FIRST_LEVEL, top)
    for _ in range(_MOST_STEPS):
        shift = layout.SHIFT * level
        block_x, block_y = column >> shift, line >> shift
        left, right = block_x << shift, min((block_x + 1) << shift, across)
        front, back = block_y << shift, min((block_y + 1) << shift, down)
        end_x = _reached(x, dx, inverse_x, left, right)
        end_y = _reached(y, dy, inverse_y, front, back)
        end = min(max(min(end_x, end_y), t), _FAR)
        here, there = z + t * dz, z + end * dz
        if level > 0:
            row = ((across - 1) >> shift) + 1
            place = wholes[about + layout.PYRAMID + level] + 2 * (block_y * row + block_x)
            if _is_close(here, there, extremes[place], extremes[place + 1], side):
                level -= 1
                continue
        else:
            corners = corners_of(heights, first + line * (across + 1) + column, across + 1)
            if _is_close(here, there, min(*corners), max(*corners), side):
                span = t, end
                facet, at = facet_hit(corners, x - column, y - line, ray, span, side, own)
                if facet != NO_FACET:
                    return MET, at, column, line, facet, x, y
        own = NO_FACET
        if end >= leaves:
            return MISSED, leaves, column, line, NO_FACET, x, y
        t = end
        if end_x <= end_y:
            column = right if dx > 0.0 else left - 1
            line = min(max(int(np.floor(y + t * dy)), front), back - 1)
        else:
            line = back if dy > 0.0 else front - 1
            column = min(max(int(np.floor(x + t * dx)), left), right - 1)
        if column < 0 or column >= across or line < 0 or line >= down:
            if not periodic:
                return LEFT, t, column, line, NO_FACET, x, y
            x, column = _wrapped(x, column, across)
            y, line = _wrapped(y, line, down)
        above = shift + layout.SHIFT
        across_left = column >> above != block_x >> layout.SHIFT
        if level < top and (across_left or line >> above != block_y >> layout.SHIFT):
            level += 1
    return LOST, t, column, line, NO_FACET, x, y


@nb.njit(error_model="numpy")
def _reached(start: float, rate: float, inverse: float, low: int, high: int) -> Any:
    """Return where along one axis a ray leaves a block."""
    if rate == 0.0:
        return np.inf
    return ((high if rate > 0.0 else low) - start) * inverse


@nb.njit(error_model="numpy")
def _is_close(here: float, there: float, low: float, high: float, side: float) -> Any:
    """Return whether a ray between two heights may meet what is between two others."""
    return min(here, there) <= high if side > 0.0 else max(here, there) >= low


@nb.njit(error_model="numpy")
def _wrapped(start: float, cell: int, cells: int) -> Any:
    """Return the start of a ray, and its cell, moved by a period where the cell is beyond."""
    if cell < 0:
        return start + cells, cell + cells
    if cell >= cells:
        return start - cells, cell - cells
    return start, cell


@nb.njit(error_model="numpy")
def mesh_entry(meshes: Any, layer: int, side: float, point: Any, k: Any, starts: Any) -> Any:
    """Return where light gets to the height of a mesh's highest, or lowest, point."""
    wholes, numbers = meshes[0], meshes[1]
    about, sizes = layer * layout.WHOLES, layer * layout.NUMBERS
    height = numbers[sizes + (layout.HIGH if side > 0.0 else layout.LOW)]
    t = (height - point[2]) / k[2]
    point = (point[0] + t * k[0], point[1] + t * k[1], height)
    x = (point[0] + starts[2 * layer]) / numbers[sizes + layout.CELL_X]
    y = (point[1] + starts[2 * layer + 1]) / numbers[sizes + layout.CELL_Y]
    across, down = wholes[about + layout.CELLS_X], wholes[about + layout.CELLS_Y]
    if wholes[about + layout.PERIODIC] != 0:
        return True, point, _in_period(x, across), _in_period(y, down)
    inside = (x >= 0.0) & (x < across) & (y >= 0.0) & (y < down)
    return inside, point, x, y


@nb.njit(error_model="numpy")
def _in_period(x: float, cells: int) -> float:
    x -= np.floor(x / cells) * cells
    # Light that goes along the mesh comes from too far away to say, even from infinity.
    return x if 0.0 <= x < cells else 0.0
