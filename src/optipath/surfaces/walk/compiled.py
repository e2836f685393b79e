"""Compiled photon walk: many photons in a row, and sums over them."""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import numba as nb

from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.carriers.structures import ROTATION
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.facets import (
    NO_FACET,
    compiled_kernel,
    facet_event,
    facet_normal,
    uniform,
)
from optipath.surfaces.walk.mesh_hit import LEFT, LOST, MET, mesh_entry, mesh_hit

if TYPE_CHECKING:
    from optipath.kernels.primitives import KernelFunction, Primitives


_MOST_MISSES = 100_000
"""How many starts in a row may meet nothing before no photon is thought to get there."""


@nb.njit(error_model="numpy")
def photon_block(
    wholes: Any,
    numbers: Any,
    heights: Any,
    extremes: Any,
    media: Any,
    base: Any,
    layers: int,
    cos_i: float,
    sin_i: float,
    azimuth: float,
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
    meshes = wholes, numbers, heights, extremes
    number, misses = 0, 0
    while number < photons and misses < _MOST_MISSES:
        angle = azimuth if azimuth == azimuth else 2.0 * pi * uniform(state)  # noqa: PLR0124 - NaN
        across, along = sin(angle), cos(angle)
        _start(meshes, layers, starts, state)
        for place in range(layout.CARRIED * count):
            lights[place] = source[place]
        k, x = (sin_i * along, sin_i * across, -cos_i), (-across, along, 0.0)
        record[0] = number == wanted
        outcome, events, last_k, last_x = photon_walk(
            meshes, media, base, layers, k, x, starts, lights, count, state, most, record
        )
        misses += 1
        if outcome != layout.NEVER:
            misses = 0
            place = outcome * layout.MOST_COUNTED + min(max(events, 1), layout.MOST_COUNTED) - 1
            _add_up(lights, sums, count, layout.SUMS * count * place)
            if number == wanted:
                record[layout.OUTCOME], record[layout.EVENTS] = outcome, events
                put(record, layout.FIRST_K, k)
                put(record, layout.FIRST_X, x)
                put(record, layout.LAST_K, last_k)
                put(record, layout.LAST_X, last_x)
            if keeps != 0:
                at = (layout.ENDS + layout.CARRIED * count) * number
                ends[at + layout.OUTCOME], ends[at + layout.EVENTS] = outcome, events
                ends[at + layout.AZIMUTH] = angle
                put(ends, at + layout.END_K, last_k)
                put(ends, at + layout.END_X, last_x)
                for place in range(layout.CARRIED * count):
                    ends[at + layout.END_LIGHTS + place] = lights[place]
            number += 1
    return number if misses < _MOST_MISSES else 0


@nb.njit(error_model="numpy")
def _start(meshes: Any, layers: int, starts: Any, state: Any) -> None:
    """Draw where on each mesh a photon starts; one place for all that end, or are in register."""
    wholes, numbers = meshes[0], meshes[1]
    ended = in_register = -1
    for layer in range(layers):
        about, sizes = layer * layout.WHOLES, layer * layout.NUMBERS
        standing, other = wholes[about + layout.PERIODIC], -1
        if standing == layout.ENDED:
            ended, other = (layer, -1) if ended < 0 else (ended, ended)
        elif standing == layout.IN_REGISTER:
            in_register, other = (layer, -1) if in_register < 0 else (in_register, in_register)
        if other >= 0:
            starts[2 * layer], starts[2 * layer + 1] = starts[2 * other], starts[2 * other + 1]
            continue
        width = wholes[about + layout.CELLS_X] * numbers[sizes + layout.CELL_X]
        depth = wholes[about + layout.CELLS_Y] * numbers[sizes + layout.CELL_Y]
        starts[2 * layer], starts[2 * layer + 1] = width * uniform(state), depth * uniform(state)


@nb.njit(error_model="numpy")
def _add_up(lights: Any, sums: Any, count: int, place: int) -> None:
    for each in range(count):
        at, to = layout.CARRIED * each, place + layout.SUMS * each
        intensity, scalar = 2.0 * lights[at] + abs(lights[at + 1]), lights[at + 4]
        sums[to + layout.COUNT] += 1.0
        sums[to + layout.INTENSITY] += intensity
        sums[to + layout.INTENSITY_SQUARED] += intensity * intensity
        sums[to + layout.SCALAR] += scalar
        sums[to + layout.SCALAR_SQUARED] += scalar * scalar
        sums[to + layout.PRODUCT] += intensity * scalar


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
    point = 0.0, 0.0, numbers[layout.HIGH]
    inside, point, u, v = mesh_entry(meshes, 0, side, point, k, starts)
    while inside:
        about, sizes = layer * layout.WHOLES, layer * layout.NUMBERS
        if facet == NO_FACET:
            column = min(int(u), wholes[about + layout.CELLS_X] - 1)
            line = min(int(v), wholes[about + layout.CELLS_Y] - 1)
        dx, dy = k[0] / numbers[sizes + layout.CELL_X], k[1] / numbers[sizes + layout.CELL_Y]
        outcome, t, column, line, facet, u, v = mesh_hit(
            meshes, layer, u, v, (point[2], dx, dy, k[2]), side, column, line, facet
        )
        if outcome == MET:
            if events == most:
                return layout.STUCK, events, k, x
            point = point[0] + t * k[0], point[1] + t * k[1], point[2] + t * k[2]
            u, v = u + t * dx, v + t * dy
            normal = facet_normal(meshes, layer, column, line, facet, side)
            above = side > 0.0
            n1, n2 = media[layer + (not above)], media[layer + above]
            before = k
            reflected, k, x, plane = facet_event(k, x, normal, n1, n2, base, lights, count, state)
            events += 1
            if record[0] != 0.0:
                at = layout.RECORD * events
                record[at + layout.LAYER] = layer
                record[at + layout.COLUMN], record[at + layout.LINE] = column, line
                record[at + layout.FACET], record[at + layout.SIDE] = facet, side
                record[at + layout.REFLECTED] = reflected
                for place in range(5):
                    record[at + layout.COS + place] = plane[place]
                record[at + layout.N1], record[at + layout.N2] = n1, n2
                put(record, at + layout.POINT, point)
                put(record, at + layout.NORMAL, normal)
                put(record, at + layout.DIRECTION, before)
            side = side if reflected else -side
            continue
        if outcome == LOST:
            return layout.STUCK, events, k, x
        if events == 0:
            return layout.NEVER, events, k, x
        if outcome == LEFT and side * k[2] <= 0.0:
            return layout.SIDEWAYS, events, k, x
        if layer == (0 if side > 0.0 else layers - 1):
            return layout.UP if side > 0.0 else layout.DOWN, events, k, x
        layer, side, facet = layer - int(side), -side, NO_FACET
        inside, point, u, v = mesh_entry(meshes, layer, side, point, k, starts)
    return layout.SIDEWAYS if events else layout.NEVER, events, k, x


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
        at = (layout.ENDS + layout.CARRIED * lights * states) * photon + layout.END_LIGHTS
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
                    of = at + layout.CARRIED * state
                    light = _stokes(ends[of], ends[of + 1], ends[of + 2], ends[of + 3], cos2, sin2)
                    for row in range(4):
                        sums[to + 4 * row + state] += light[row] - first[row]
            at += layout.CARRIED * states
            to += numbers
    return photons
