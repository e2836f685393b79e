"""One photon over a stack of meshes, from above until it is gone."""

from __future__ import annotations

from typing import Any

import numba as nb

from optipath.surfaces.walk.facet_event import facet_event, facet_normal
from optipath.surfaces.walk.facet_hit import NO_FACET
from optipath.surfaces.walk.mesh_entry import mesh_entry
from optipath.surfaces.walk.mesh_hit import LEFT, LOST, MET, mesh_hit
from optipath.surfaces.walk.packed_meshes import (
    CELL_X,
    CELL_Y,
    CELLS_X,
    CELLS_Y,
    HIGH,
    NUMBERS,
    WHOLES,
)
from optipath.surfaces.walk.walk_layout import (
    COLUMN,
    COS,
    DIRECTION,
    DOWN,
    FACET,
    LAYER,
    LINE,
    N1,
    N2,
    NEVER,
    NORMAL,
    POINT,
    RECORD,
    REFLECTED,
    SIDE,
    SIDEWAYS,
    STUCK,
    UP,
)


@nb.njit(error_model="numpy")
def photon_walk(
    meshes: Any,
    media: Any,
    base: Any,
    layers: int,
    k: Any,
    x: Any,
    starts: Any,
    lights: Any,
    count: int,
    state: Any,
    most: int,
    record: Any,
) -> Any:
    """Follow a photon: the nine steps of M. Wang et al., Optics Express 25(19), 2017.

    Light above a mesh stays above it where it is reflected, and gets below it where it is
    refracted. It meets the mesh again, but for the facet that it comes from, or goes on
    to the next one on its side.
    """
    wholes, numbers = meshes[0], meshes[1]
    layer, side, events = 0, 1.0, 0
    facet, column, line = NO_FACET, 0, 0
    point = 0.0, 0.0, numbers[HIGH]
    inside, point, u, v = mesh_entry(meshes, 0, side, point, k, starts)
    while inside:
        about, sizes = layer * WHOLES, layer * NUMBERS
        if facet == NO_FACET:
            column = min(int(u), wholes[about + CELLS_X] - 1)
            line = min(int(v), wholes[about + CELLS_Y] - 1)
        dx, dy = k[0] / numbers[sizes + CELL_X], k[1] / numbers[sizes + CELL_Y]
        outcome, t, column, line, facet, u, v = mesh_hit(
            meshes, layer, u, v, (point[2], dx, dy, k[2]), side, column, line, facet
        )
        if outcome == MET:
            if events == most:
                return STUCK, events, k, x
            point = point[0] + t * k[0], point[1] + t * k[1], point[2] + t * k[2]
            u, v = u + t * dx, v + t * dy
            normal = facet_normal(meshes, layer, column, line, facet, side)
            above = side > 0.0
            n1, n2 = media[layer + (not above)], media[layer + above]
            before = k
            reflected, k, x, plane = facet_event(k, x, normal, n1, n2, base, lights, count, state)
            events += 1
            if record[0] != 0.0:
                at = RECORD * events
                record[at + LAYER], record[at + COLUMN], record[at + LINE] = layer, column, line
                record[at + FACET], record[at + SIDE], record[at + REFLECTED] = (
                    facet,
                    side,
                    reflected,
                )
                for place in range(5):
                    record[at + COS + place] = plane[place]
                record[at + N1], record[at + N2] = n1, n2
                put(record, at + POINT, point)
                put(record, at + NORMAL, normal)
                put(record, at + DIRECTION, before)
            side = side if reflected else -side
            continue
        if outcome == LOST:
            return STUCK, events, k, x
        if events == 0:
            return NEVER, events, k, x
        if outcome == LEFT and side * k[2] <= 0.0:
            return SIDEWAYS, events, k, x
        if layer == (0 if side > 0.0 else layers - 1):
            return UP if side > 0.0 else DOWN, events, k, x
        layer, side, facet = layer - int(side), -side, NO_FACET
        inside, point, u, v = mesh_entry(meshes, layer, side, point, k, starts)
    return SIDEWAYS if events else NEVER, events, k, x


@nb.njit(error_model="numpy")
def put(record: Any, at: int, vector: Any) -> None:
    """Write three numbers."""
    record[at], record[at + 1], record[at + 2] = vector
