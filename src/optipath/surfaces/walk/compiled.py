"""Compiled photon walk: where a ray meets a mesh, many photons in a row, and sums over them."""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import numba as nb
import numpy as np

from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.carriers.structures import ROTATION
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.facets import (
    NO_FACET,
    compiled_kernel,
    corners_of,
    facet_event,
    facet_hit,
    facet_normal,
    uniform,
)

if TYPE_CHECKING:
    from optipath.kernels.primitives import KernelFunction, Primitives


MET, MISSED, LEFT, LOST = 0, 1, 2, 3
"""A facet is met; none is; the ray has left the field at its side; it goes on for too long."""

_MOST_STEPS = 1_000_000
_FAR = 1e300
"""In place of an infinite way, which times 0 is no number."""

_FIRST_LEVEL = 3
"""Where light from outside begins, which is high above most of the mesh."""


@nb.njit(error_model="numpy")
def mesh_hit(
    meshes: Any, layer: int, start: Any, ray: Any, side: float, cell: Any, own: int
) -> Any:
    """Return what a ray meets of a mesh."""
    wholes, numbers, heights, extremes = meshes
    (z, dx, dy, dz), (x, y), (column, line) = ray, start, cell
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
    meshes, stack = (wholes, numbers, heights, extremes), (media, base, layers)
    riding = lights, count, state
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
            meshes, stack, k, x, starts, riding, most, record
        )
        misses += 1
        if outcome != layout.NEVER:
            misses = 0
            place = outcome * layout.MOST_COUNTED + min(max(events, 1), layout.MOST_COUNTED) - 1
            _add_up(lights, sums, count, layout.SUMS * count * place)
            if number == wanted:
                record[layout.OUTCOME], record[layout.EVENTS] = outcome, events
                put(record, layout.FIRST_K, k + x + last_k + last_x)
            if keeps != 0:
                at = (layout.ENDS + layout.CARRIED * count) * number
                ends[at + layout.OUTCOME], ends[at + layout.EVENTS] = outcome, events
                ends[at + layout.AZIMUTH] = angle
                put(ends, at + layout.END_K, last_k + last_x)
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
    meshes: Any, stack: Any, k: Any, x: Any, starts: Any, riding: Any, most: int, record: Any
) -> Any:
    """Follow a photon: the nine steps of M. Wang et al., Optics Express 25(19), 2017.

    After a reflection it meets the mesh again, but for the facet it comes from, or the next mesh.
    """
    (wholes, numbers, _, _), (media, base, layers), (lights, count, state) = meshes, stack, riding
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
            meshes, layer, (u, v), (point[2], dx, dy, k[2]), side, (column, line), facet
        )
        if outcome == MET:
            if events == most:
                return layout.STUCK, events, k, x
            point = point[0] + t * k[0], point[1] + t * k[1], point[2] + t * k[2]
            u, v = u + t * dx, v + t * dy
            normal = facet_normal(meshes, layer, column, line, facet, side)
            above = side > 0.0
            before, indices = k, (media[layer + (not above)], media[layer + above])
            reflected, k, x, plane = facet_event(k, x, normal, indices, base, lights, count, state)
            events += 1
            if record[0] != 0.0:
                at = layout.RECORD * events
                record[at + layout.LAYER] = layer
                record[at + layout.COLUMN], record[at + layout.LINE] = column, line
                record[at + layout.FACET], record[at + layout.SIDE] = facet, side
                record[at + layout.REFLECTED] = reflected
                put(record, at + layout.COS, plane + indices + point + normal + before)
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
def put(record: Any, at: int, numbers: Any) -> None:
    """Write numbers, one after the other."""
    for place in range(len(numbers)):
        record[at + place] = numbers[place]


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
