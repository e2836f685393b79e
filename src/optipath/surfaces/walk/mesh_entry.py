"""Where light that comes from outside gets to a mesh."""

from __future__ import annotations

from typing import Any

import numba as nb
import numpy as np

from optipath.surfaces.walk.packed_meshes import (
    CELL_X,
    CELL_Y,
    CELLS_X,
    CELLS_Y,
    HIGH,
    LOW,
    NUMBERS,
    PERIODIC,
    WHOLES,
)


@nb.njit(error_model="numpy")
def mesh_entry(meshes: Any, layer: int, side: float, point: Any, k: Any, starts: Any) -> Any:
    """Return where light gets to the height of a mesh's highest, or lowest, point."""
    wholes, numbers = meshes[0], meshes[1]
    about, sizes = layer * WHOLES, layer * NUMBERS
    height = numbers[sizes + (HIGH if side > 0.0 else LOW)]
    t = (height - point[2]) / k[2]
    point = (point[0] + t * k[0], point[1] + t * k[1], height)
    x = (point[0] + starts[2 * layer]) / numbers[sizes + CELL_X]
    y = (point[1] + starts[2 * layer + 1]) / numbers[sizes + CELL_Y]
    across, down = wholes[about + CELLS_X], wholes[about + CELLS_Y]
    if wholes[about + PERIODIC] != 0:
        return True, point, _in_period(x, across), _in_period(y, down)
    inside = (x >= 0.0) & (x < across) & (y >= 0.0) & (y < down)
    return inside, point, x, y


@nb.njit(error_model="numpy")
def _in_period(x: float, cells: int) -> float:
    x -= np.floor(x / cells) * cells
    # Light that goes along the mesh comes from too far away to say, even from infinity.
    return x if 0.0 <= x < cells else 0.0
