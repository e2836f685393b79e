"""Compiled photon walk: many photons in a row, and sums over them."""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import numba as nb

from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.carriers.structures import ROTATION
from optipath.surfaces.walk.facets import (
    NO_FACET,
    compiled_kernel,
    facet_event,
    facet_normal,
    uniform,
)
from optipath.surfaces.walk.layout import (
    AZIMUTH,
    CARRIED,
    COLUMN,
    COS,
    COUNT,
    DIRECTION,
    DOWN,
    END_K,
    END_LIGHTS,
    END_X,
    ENDS,
    EVENTS,
    FACET,
    FIRST_K,
    FIRST_X,
    INTENSITY,
    INTENSITY_SQUARED,
    LAST_K,
    LAST_X,
    LAYER,
    LINE,
    MOST_COUNTED,
    N1,
    N2,
    NEVER,
    NORMAL,
    OUTCOME,
    POINT,
    PRODUCT,
    RECORD,
    REFLECTED,
    SCALAR,
    SCALAR_SQUARED,
    SIDE,
    SIDEWAYS,
    STUCK,
    SUMS,
    UP,
)
from optipath.surfaces.walk.mesh_hit import LEFT, LOST, MET, mesh_entry, mesh_hit
from optipath.surfaces.walk.meshes import (
    CELL_X,
    CELL_Y,
    CELLS_X,
    CELLS_Y,
    ENDED,
    HIGH,
    IN_REGISTER,
    NUMBERS,
    PERIODIC,
    WHOLES,
)

if TYPE_CHECKING:
    from optipath.kernels.primitives import KernelFunction, Primitives


_MOST_MISSES = 100_000
"""How many starts in a row may meet nothing before no photon is thought to get there."""


@nb.njit(error_model="numpy")
def photon_block(
    meshes: Any,
    media: Any,
    base: Any,
    layers: int,
    beam: Any,
    source: Any,
    count: int,
    photons: int,
    most: int,
    wanted: int,
    state: Any,
    starts: Any,
    lights: Any,
    sums: Any,
    record: Any,
    ends: Any,
    keeps: int,
) -> int:
    """Follow photons into sums (OUTCOMES, MOST_COUNTED, count, SUMS), and their ends."""
    cos_i, sin_i, azimuth = beam
    number, misses = 0, 0
    while number < photons and misses < _MOST_MISSES:
        angle = azimuth if azimuth == azimuth else 2.0 * pi * uniform(state)  # noqa: PLR0124 - NaN
        across, along = sin(angle), cos(angle)
        _start(meshes, layers, starts, state)
        for place in range(CARRIED * count):
            lights[place] = source[place]
        k, x = (sin_i * along, sin_i * across, -cos_i), (-across, along, 0.0)
        record[0] = number == wanted
        outcome, events, last_k, last_x = photon_walk(
            meshes, media, base, layers, k, x, starts, lights, count, state, most, record
        )
        misses += 1
        if outcome != NEVER:
            misses = 0
            place = outcome * MOST_COUNTED + min(max(events, 1), MOST_COUNTED) - 1
            _add_up(lights, sums, count, SUMS * count * place)
            if number == wanted:
                record[OUTCOME], record[EVENTS] = outcome, events
                put(record, FIRST_K, k)
                put(record, FIRST_X, x)
                put(record, LAST_K, last_k)
                put(record, LAST_X, last_x)
            if keeps != 0:
                at = (ENDS + CARRIED * count) * number
                ends[at + OUTCOME], ends[at + EVENTS], ends[at + AZIMUTH] = outcome, events, angle
                put(ends, at + END_K, last_k)
                put(ends, at + END_X, last_x)
                for place in range(CARRIED * count):
                    ends[at + END_LIGHTS + place] = lights[place]
            number += 1
    return number if misses < _MOST_MISSES else 0


@nb.njit(error_model="numpy")
def _start(meshes: Any, layers: int, starts: Any, state: Any) -> None:
    """Draw where on each mesh a photon starts; one place for all that end, or are in register."""
    wholes, numbers = meshes[0], meshes[1]
    ended = in_register = -1
    for layer in range(layers):
        about, sizes = layer * WHOLES, layer * NUMBERS
        standing, other = wholes[about + PERIODIC], -1
        if standing == ENDED:
            ended, other = (layer, -1) if ended < 0 else (ended, ended)
        elif standing == IN_REGISTER:
            in_register, other = (layer, -1) if in_register < 0 else (in_register, in_register)
        if other >= 0:
            starts[2 * layer], starts[2 * layer + 1] = starts[2 * other], starts[2 * other + 1]
            continue
        width = wholes[about + CELLS_X] * numbers[sizes + CELL_X]
        depth = wholes[about + CELLS_Y] * numbers[sizes + CELL_Y]
        starts[2 * layer], starts[2 * layer + 1] = width * uniform(state), depth * uniform(state)


@nb.njit(error_model="numpy")
def _add_up(lights: Any, sums: Any, count: int, place: int) -> None:
    for each in range(count):
        at, to = CARRIED * each, place + SUMS * each
        intensity, scalar = 2.0 * lights[at] + abs(lights[at + 1]), lights[at + 4]
        sums[to + COUNT] += 1.0
        sums[to + INTENSITY] += intensity
        sums[to + INTENSITY_SQUARED] += intensity * intensity
        sums[to + SCALAR] += scalar
        sums[to + SCALAR_SQUARED] += scalar * scalar
        sums[to + PRODUCT] += intensity * scalar


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

    After a reflection it meets the mesh again, but for the facet it comes from, or the next mesh.
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
                record[at + FACET], record[at + SIDE] = facet, side
                record[at + REFLECTED] = reflected
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


def _turned(xp: Primitives) -> KernelFunction:
    """Make ``(carried, cos 2a, sin 2a) -> Stokes vector``."""

    def turned(*numbers: Any) -> tuple[Any, ...]:
        return tuple(stokes_of(xp, ROTATION.action(xp, numbers[4:], numbers[:4], 4)))

    return turned


_stokes = compiled_kernel("turned_stokes", _turned, 6)


@nb.njit(error_model="numpy")
def pixel_sums(
    places: Any,
    turns: Any,
    ends: Any,
    photons: int,
    lights: int,
    states: int,
    has_matrix: int,
    has_scalar: int,
    sums: Any,
) -> int:
    """Add what each photon carries to its pixel, one by one; sums (pixels, lights, numbers)."""
    numbers = 16 * has_matrix + has_scalar
    for photon in range(photons):
        if places[photon] < 0:
            continue
        at = (ENDS + CARRIED * lights * states) * photon + END_LIGHTS
        to = numbers * lights * places[photon]
        cos2, sin2 = turns[2 * photon], turns[2 * photon + 1]
        for _ in range(lights):
            if has_scalar != 0:
                sums[to + numbers - 1] += ends[at + 4]
            if has_matrix != 0:
                first = _stokes(ends[at], ends[at + 1], ends[at + 2], ends[at + 3], cos2, sin2)
                for row in range(4):
                    sums[to + 4 * row] += first[row]
                for state in range(1, 4):
                    of = at + CARRIED * state
                    light = _stokes(ends[of], ends[of + 1], ends[of + 2], ends[of + 3], cos2, sin2)
                    for row in range(4):
                        sums[to + 4 * row + state] += light[row] - first[row]
            at += CARRIED * states
            to += numbers
    return photons
