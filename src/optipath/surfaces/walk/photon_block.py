"""Many photons in a row, and the sums of what becomes of them."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Any

import numba as nb

from optipath.surfaces.walk.packed_meshes import (
    CELL_X,
    CELL_Y,
    CELLS_X,
    CELLS_Y,
    ENDED,
    IN_REGISTER,
    NUMBERS,
    PERIODIC,
    WHOLES,
)
from optipath.surfaces.walk.photon_walk import photon_walk, put
from optipath.surfaces.walk.random_stream import uniform
from optipath.surfaces.walk.walk_layout import (
    AZIMUTH,
    CARRIED,
    COUNT,
    END_K,
    END_LIGHTS,
    END_X,
    ENDS,
    EVENTS,
    FIRST_K,
    FIRST_X,
    INTENSITY,
    INTENSITY_SQUARED,
    LAST_K,
    LAST_X,
    MOST_COUNTED,
    NEVER,
    OUTCOME,
    PRODUCT,
    SCALAR,
    SCALAR_SQUARED,
    SUMS,
)

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
    """Follow photons, and add up what becomes of them.

    Shapes: sums (OUTCOMES, MOST_COUNTED, count, SUMS); ends (photons, ENDS + CARRIED count).
    """
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
