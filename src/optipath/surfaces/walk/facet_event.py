"""What happens to a photon at a facet: reflection or refraction, drawn by their mean shares."""

from __future__ import annotations

from typing import Any

import numba as nb
import numpy as np

from optipath.surfaces.walk.facet_hit import corners_of, facet_gradient
from optipath.surfaces.walk.interaction import acted, boundary, opaque_reflection, plane
from optipath.surfaces.walk.packed_meshes import (
    CELL_X,
    CELL_Y,
    CELLS_X,
    HEIGHTS,
    NUMBERS,
    WHOLES,
)
from optipath.surfaces.walk.random_stream import uniform
from optipath.surfaces.walk.walk_layout import CARRIED, OPAQUE


@nb.njit(error_model="numpy")
def facet_normal(meshes: Any, layer: int, column: int, line: int, facet: int, side: float) -> Any:
    """Return the normal of a facet, on one side of it."""
    wholes, numbers, heights = meshes[0], meshes[1], meshes[2]
    about, sizes = layer * WHOLES, layer * NUMBERS
    row = wholes[about + CELLS_X] + 1
    corner = wholes[about + HEIGHTS] + line * row + column
    rise_x, rise_y = facet_gradient(corners_of(heights, corner, row), facet)
    x, y = -rise_x / numbers[sizes + CELL_X], -rise_y / numbers[sizes + CELL_Y]
    size = side / np.sqrt(x * x + y * y + 1.0)
    return x * size, y * size, size


@nb.njit(error_model="numpy")
def facet_event(
    k: Any,
    x: Any,
    normal: Any,
    n1: float,
    n2: float,
    base: Any,
    lights: Any,
    count: int,
    state: Any,
) -> Any:
    """Reflect a photon at a facet, or refract it, and all of the lights that ride on it.

    Which of the two is drawn by the mean of the shares of s and p, whatever the polarisation;
    what is drawn is divided by its probability. An opaque medium reflects always.
    """
    c, s, sx, sy, sz, cos2, sin2, rx, ry, rz = plane(*k, *x, *normal)
    if n2 == OPAQUE:
        numbers = opaque_reflection(n1, base[0], base[1], c, s)
        for each in range(count):
            at = 2 * each
            # Several states of one light share an index.
            if each > 0 and (base[at] != base[at - 2] or base[at + 1] != base[at - 1]):
                numbers = opaque_reflection(n1, base[at], base[at + 1], c, s)
            _act(lights, CARRIED * each, cos2, sin2, numbers)
            lights[CARRIED * each + 4] *= 0.5 * (numbers[0] + numbers[1])
        return True, (rx, ry, rz), (sx, sy, sz), (c, s, cos2, sin2, 1.0)
    Fs, Fp, B, C, S, Ts, Tp, Bt, Ct, tx, ty, tz = boundary(n1, n2, c, s, *k, *normal)
    reflected = uniform(state) < 0.5 * (Fs + Fp)
    if not reflected:
        Fs, Fp, B, C, S = Ts, Tp, Bt, Ct, 0.0
        rx, ry, rz = tx, ty, tz
    share = 0.5 * (Fs + Fp)
    weight = 1.0 / share
    numbers = weight * Fs, weight * Fp, weight * B, weight * C, weight * S
    for each in range(count):
        _act(lights, CARRIED * each, cos2, sin2, numbers)
    return reflected, (rx, ry, rz), (sx, sy, sz), (c, s, cos2, sin2, share)


@nb.njit(error_model="numpy")
def _act(lights: Any, at: int, cos2: float, sin2: float, numbers: Any) -> None:
    """Turn one light into the plane of incidence, and let a Mueller matrix act on it."""
    found = acted(lights[at], lights[at + 1], lights[at + 2], lights[at + 3], cos2, sin2, *numbers)
    lights[at], lights[at + 1], lights[at + 2], lights[at + 3] = found
