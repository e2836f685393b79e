"""Meshes, rays over them, and the ways of photons from facet to facet."""

import gc
import itertools
import weakref
from fractions import Fraction
from itertools import pairwise
from math import ceil, floor

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import optipath as op
from optipath import surfaces
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.meshes import meshes_of, packed_meshes, pyramid_of
from tables import rows
from uncompiled import uncompiled

pytest.importorskip("numba")

from optipath.surfaces.walk import compiled as walk
from optipath.surfaces.walk.beam import beam_of
from optipath.surfaces.walk.facets import LOWER, NO_FACET, UPPER, uniform


def test_meshes_are_found_by_their_places_and_apart_by_two_deviations_of_the_rougher(rng):
    shapes = [((5, 9), True), ((33, 3), False), ((2, 2), True)]
    given = [HeightField(rng.normal(size=shape), (3.0, 7.0), whole) for shape, whole in shapes]
    meshes = packed_meshes(given)
    for place, field in enumerate(given):
        wholes = meshes.wholes[layout.WHOLES * place :][: layout.WHOLES]
        across, down = field.cells
        assert wholes[: layout.PYRAMID].tolist()[1:3] == [across, down]
        assert wholes[layout.PERIODIC] == field.periodic
        first = wholes[layout.HEIGHTS]
        vertices = meshes.heights[first:][: (across + 1) * (down + 1)].reshape(down + 1, across + 1)
        assert np.ptp(vertices - field.vertices()) < 1e-14
        levels = pyramid_of(vertices)
        assert wholes[layout.LEVELS] == len(levels) - 1
        for level, values in enumerate(levels[1:], 1):
            at = wholes[layout.PYRAMID + level]
            assert meshes.extremes[at:][: values.size].tolist() == values.ravel().tolist()
    numbers = meshes.numbers.reshape(-1, layout.NUMBERS)
    gaps = numbers[:-1, layout.LOW] - numbers[1:, layout.HIGH]
    deviations = [field.deviation for field in given]
    assert gaps == pytest.approx(2.0 * np.maximum(deviations[:-1], deviations[1:]), rel=1e-12)
    assert np.all(numbers[:, layout.HIGH] >= numbers[:, layout.LOW])
    # Flat ones are apart too.
    numbers = packed_meshes([HeightField.flat()] * 2).numbers.reshape(-1, layout.NUMBERS)
    assert numbers[0, layout.LOW] > numbers[1, layout.HIGH]


@rows(
    "across, down",
    [(1, 1), (1, 2), (1, 17), (33, 1), (4, 4), (5, 4), (16, 64), (17, 65), (63, 3)],
)
def test_extremes_are_those_of_all_corners_of_blocks_from_cells_to_one_of_all(across, down, rng):
    vertices = rng.normal(size=(down + 1, across + 1))
    levels = pyramid_of(vertices)
    assert (levels[0].shape, levels[-1].shape) == ((down, across, 2), (1, 1, 2))
    assert all(len(each) * each.shape[1] > 1 for each in levels[:-1])
    for level, found in enumerate(levels):
        width = 1 << (layout.SHIFT * level)
        assert found.shape[:2] == (-(-down // width), -(-across // width))
        for line, column in np.ndindex(found.shape[:2]):
            part = vertices[line * width :, column * width :][: width + 1, : width + 1]
            assert found[line, column].tolist() == [part.min(), part.max()]


def test_meshes_go_at_once_with_their_sample():
    gc.disable()  # Nothing goes but what nobody refers to.
    try:
        sample = op.Sample([(1.5, 0.3)], cells=200)
        meshes = weakref.ref(meshes_of(sample, 0).heights)
        assert meshes() is not None
        del sample
        assert meshes() is None
    finally:
        gc.enable()


@rows("seed", [0, 1, 2**63, 12345678901234567890])
def test_the_numbers_are_those_of_numpy(seed):
    stream = np.random.SFC64(seed)
    state = np.array(stream.state["state"]["state"], np.uint64)
    draw = uncompiled(uniform)
    with np.errstate(over="ignore"):
        found = [draw(state) for _ in range(1000)]
    assert found == np.random.Generator(stream).random(1000).tolist()
    assert state.tolist() == stream.state["state"]["state"].tolist()


mesh_entry = uncompiled(walk.mesh_entry)
TENT = [[0.0, 1.0, 0.5], [0.0, 0.5, 0.0], [0.0, 0.0, -1.0]]


def entered(field, point, k, side=1.0, start=(0.0, 0.0)):
    with np.errstate(all="ignore"):
        return mesh_entry(tuple(packed_meshes([field])), 0, side, point, np.float64(k), start)


def test_light_gets_to_the_edge_of_a_mesh_along_its_direction():
    for side in (1.0, -1.0):
        field = HeightField(TENT, (4.0, 2.0))
        inside, point, x, y = entered(field, (0.0, 0.0, 5 * side), (0.6, 0.0, -0.8 * side), side)
        assert (inside, point) == (True, (pytest.approx(3.0, rel=1e-15), 0.0, side))
        assert (x, y) == (pytest.approx(1.5, rel=1e-15), 0.0)
    # Beside a smaller one it is not inside.
    for along in (0.6, -0.6):
        assert not entered(HeightField(TENT, 2.0), (0.0, 0.0, 5.0), (along, 0.0, -0.8))[0]
    # A periodic one is met where its period says.
    field = HeightField(TENT, 3.0, periodic=True)
    _, _, x, y = entered(field, (0.0, 0.0, 5.0), (-0.6, 0.0, -0.8), start=(1.0, 2.5))
    assert (x, y) == (pytest.approx(1.0, rel=1e-15), 2.5)
    # Light along it comes to one of its cells.
    level = itertools.product((-1.0, 0.0, 1.0), (1.0, 5.0), (0.0, -1e-300, -1e-30))
    for along, height, upwards in level:
        inside, point, x, y = entered(field, (0.0, 0.0, height), (along, 1.0, upwards))
        assert (inside, point[2]) == (True, 1.0)
        assert 0.0 <= min(x, y) <= max(x, y) < 3.0


# Where rays meet meshes, in exact fractions: where the height above the surface comes to 0.


def surface_height(vertices, x, y):
    """The height over a point in cells; flat over each half of a cell."""
    rows, columns = vertices.shape
    column, line = min(floor(x), columns - 2), min(floor(y), rows - 2)
    u, v = x - column, y - line
    low, right, back, high = (
        Fraction(vertices[line + i, column + j].item()) for i in (0, 1) for j in (0, 1)
    )
    if u >= v:
        return low + u * (right - low) + v * (high - right)
    return low + v * (back - low) + u * (high - back)


def first_meeting(field, start, direction, side):
    """Where a ray meets a field; None where it does not.

    The ray is straight between its crossings of the lines of the mesh, where the surface is flat:
    it meets the surface in the first piece in which it comes nearer and gets below. To touch is not
    to meet.
    """
    above = height_above(field, start, direction)
    times = crossings(field, start, direction)
    for begin, end in pairwise(times):
        first, last = side * above(begin), side * above(end)
        if last < min(first, 0):
            return float(begin + (end - begin) * max(first, 0) / (max(first, 0) - last))
    return None


def height_above(field, start, direction):
    """How high a ray is above the surface, of the place along the ray."""
    vertices = field.vertices()

    def above(t):
        x, y, z = (one + Fraction(t) * step for one, step in exactly(start, direction))
        if field.periodic:
            x, y = x % field.cells[0], y % field.cells[1]
        return z - surface_height(vertices, x, y)

    return above


def crossings(field, start, direction):
    """Where a ray crosses lines of the mesh, from its start until it is gone from the mesh."""
    (x, along), (y, across), (z, up) = exactly(start, direction)
    edge = Fraction(float(np.max(field.heights) if up > 0 else np.min(field.heights)))
    last = max((edge - z) / up, Fraction(0))
    if not field.periodic:
        for one, step, cells in ((x, along, field.cells[0]), (y, across, field.cells[1])):
            if step:
                last = min(last, ((cells if step > 0 else 0) - one) / step)
    times = {Fraction(0), last}
    for one, step in ((x, along), (y, across), (x - y, along - across)):
        ends = sorted((one, one + last * step))
        if step:
            times |= {(line - one) / step for line in range(ceil(ends[0]), floor(ends[1]) + 1)}
    return sorted(times)


def exactly(start, direction):
    """Both as fractions, by axis."""
    return [
        (Fraction(float(one)), Fraction(float(step)))
        for one, step in zip(start, direction, strict=True)
    ]


mesh_hit = uncompiled(walk.mesh_hit)
SEEDS = st.integers(0, 10**6)
SIDES = st.sampled_from([1.0, -1.0])
QUARTERS = st.integers(-8, 8).map(lambda number: number / 4)
SLOPES = st.tuples(QUARTERS, QUARTERS, st.sampled_from([0.25, 0.5, 1.0, 2.0]))


def _hills(periodic, seed, cells, power):
    numbers, shape = np.random.default_rng(seed), [each + (not periodic) for each in cells[::-1]]
    if power is None:
        heights = numbers.integers(-2, 3, shape).astype(float)
    else:
        heights = 10.0**power * numbers.normal(size=shape)
    return HeightField(heights, cells, periodic)


MESHES = st.booleans(), SEEDS, st.tuples(st.integers(2, 6), st.integers(2, 6))
# Many equal heights, numbers of which nothing is rounded; and from nearly flat ones to cliffs.
PLATEAUS = st.builds(_hills, *MESHES, st.none())
HILLS = st.builds(_hills, *MESHES, st.integers(-6, 6))


def outcome_of(field, start, direction, side, cell=None, own=NO_FACET):
    """How a ray ends that starts somewhere in cells, and where."""
    (x, y, z), (dx, dy, dz) = np.float64(start), np.float64(direction)
    column, line = cell or (min(int(x), field.cells[0] - 1), min(int(y), field.cells[1] - 1))
    meshes, ray = tuple(packed_meshes([field])), (z, dx, dy, dz)
    with np.errstate(all="ignore"):
        outcome, t, *_ = mesh_hit(meshes, 0, (x, y), ray, side, (column, line), own)
    return outcome, float(t)


def expect_meeting(field, start, direction, side, found):
    """Met where exact arithmetic meets it; or before, where the ray touches the mesh."""
    outcome, t = found
    expected = first_meeting(field, start, direction, side)
    if outcome != walk.MET:
        assert expected is None
    elif expected is None or t != pytest.approx(expected, rel=1e-9, abs=1e-9):
        assert expected is None or t < expected
        rounding = 1e-9 * (np.ptp(field.heights) + abs(direction[2]))
        assert abs(height_above(field, start, direction)(t)) <= rounding


@given(PLATEAUS, st.tuples(*2 * [st.integers(0, 23)]), SLOPES, SIDES)
def test_rays_from_outside_through_vertices_and_along_edges(field, place, slopes, side):
    x, y = (number / 4 % cells for number, cells in zip(place, field.cells, strict=True))
    start = x, y, side * np.max(side * field.heights)
    direction = *slopes[:2], -side * slopes[2]
    expect_meeting(field, start, direction, side, outcome_of(field, start, direction, side))


@given(HILLS, SEEDS, SIDES)
def test_rays_from_outside_onto_hills_and_cliffs(field, seed, side):
    numbers = np.random.default_rng(seed)
    heights = side * field.heights
    start = *numbers.uniform(0, field.cells), side * heights.max()
    steep = np.ptp(heights) * 10.0 ** numbers.uniform(-1, 3)
    direction = *numbers.normal(size=2), -side * steep
    expect_meeting(field, start, direction, side, outcome_of(field, start, direction, side))


@given(HILLS, SEEDS, SIDES, st.sampled_from([LOWER, UPPER]))
def test_rays_from_facets_leave_these_and_meet_others(field, seed, side, facet):
    numbers = np.random.default_rng(seed)
    vertices, cell = field.vertices(), [int(numbers.integers(most)) for most in field.cells]
    u, v = sorted(numbers.uniform(0.05, 0.95, 2), reverse=facet == LOWER)
    column, line = cell
    low, right, back, high = vertices[line : line + 2, column : column + 2].ravel()
    rise = (right - low, high - right) if facet == LOWER else (high - back, back - low)
    x, y, z = start = column + u, line + v, low + u * rise[0] + v * rise[1]
    flat = numbers.normal(size=2)
    away = side * np.ptp(vertices) * 10.0 ** numbers.uniform(-3, 1)
    direction = *flat, float(flat @ rise) + away
    assume(abs(direction[2]) > 1e-2 * np.ptp(vertices))
    found = outcome_of(field, start, direction, side, (column, line), facet)
    if found[0] == walk.MET:
        # The start is on its facet but for a rounding, and met there by exact arithmetic.
        assert found[1] * abs(away) > 1e-9 * np.ptp(vertices)
    # Not below its facet by a rounding.
    start = x, y, z + side * 1e-12 * (abs(z) + 1e-9)
    expect_meeting(field, start, direction, side, found)


def test_vertical_rays_and_such_along_a_mesh_that_are_given_up_or_leave_at_its_side(monkeypatch):
    heights = [[0.0, 1.0, 3.0], [2.0, 5.0, 0.0], [1.0, 1.0, 1.0]]
    field = HeightField(heights, 3.0, periodic=True)
    for side, x in itertools.product((1.0, -1.0), (0.0, 0.25, 1.0)):
        start, direction = (x, 0.5, 5.0 if side > 0.0 else 0.0), (0.0, 0.0, -side)
        expected = first_meeting(field, start, direction, side)
        assert outcome_of(field, start, direction, side) == (walk.MET, expected)
    monkeypatch.setitem(mesh_hit.__globals__, "_MOST_STEPS", 100)
    field = HeightField([[0.0, 1.0], [2.0, 0.0]], 2.0, periodic=True)
    assert outcome_of(field, (0.0, 0.5, 3.0), (1.0, 0.0, 0.0), 1.0)[0] == walk.LOST
    field = HeightField(np.zeros((3, 3)), 2.0)
    assert outcome_of(field, (0.5, 0.5, 1.0), (1.0, 0.25, -0.1), 1.0) == (walk.LEFT, 1.5)


SPACING = np.array([0.5, 0.8])


def steep_field(seed, *, periodic):
    heights = np.random.default_rng(seed).normal(size=(8, 6))
    cells = np.array([6, 8]) - (not periodic)
    return HeightField(heights, tuple(SPACING * cells), periodic)


def first_photon(field, index, seed):
    """Events of the first photon of a seed, and where on the mesh it starts, in cells."""
    record = beam_of(op.Sample([(index, field)]), 0.8, 0.4, seed=seed).block(0, wanted=0).record
    stream = np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(0,)))
    start = np.random.Generator(stream).random(2) * field.cells
    return record[0], record[1 : 1 + int(record[0, layout.EVENTS])], start


def in_cells(vector):
    return vector / [*SPACING, 1.0]


@rows("periodic, index", [(True, 1.5), (False, 1j)])
def test_photons_stay_on_their_side_of_the_surface_from_event_to_event(periodic, index):
    met = 0
    for seed in range(80):
        field = steep_field(seed, periodic=periodic)
        end, events, start = first_photon(field, index, seed)
        place = np.array([*start, field.heights.max()])
        along = in_cells(end[layout.FIRST_K : layout.FIRST_K + 3])
        if first_meeting(field, place, along, 1.0) is None:
            continue  # No photon: another start was drawn.
        for event in events:
            there = in_cells(event[layout.POINT : layout.POINT + 3]) + np.array([*start, 0.0])
            above = height_above(field, place, there - place)
            inside = [t for t in crossings(field, place, there - place) if t < 1]
            assert all(event[layout.SIDE] * above(t) > -1e-12 for t in inside)
            assert abs(float(above(1))) < 1e-12
            place, met = there, met + 1
    assert met > 20


def test_photons_get_stuck_or_lost_and_leave_finite_fields_sideways():
    mirror = op.Sample([(1j, steep_field(0, periodic=True))])
    found = surfaces.photon_ends(mirror, 0.8, 1000, most_events=2)
    assert set(found.ends) == {"up", "stuck"}
    assert np.all(found.events[found.ends == "stuck"] == 2)
    found = surfaces.photon_ends(op.Sample([(1.5, steep_field(0, periodic=False))]), 0.8, 1000)
    assert set(found.ends) == {"up", "down", "sideways"}
    # Light that never comes down is lost, and counted as stuck.
    heights = np.outer([0.0, 0.0, 1.0, 0.0], [1.0, 1.0])
    ridges = op.Sample([(1.5, HeightField(heights, 4.0, periodic=True))])
    found = surfaces.energy(ridges, np.pi / 2 - 1e-11, photons=3, threads=1, seed=1)
    assert found.stuck + found.sideways == found.stuck > 0
    assert found.lost == pytest.approx(found.stuck / 3, rel=1e-12)
    # Normals of cliffs are of length 1.
    cliffs = HeightField(1e6 * (np.indices((8, 8)).sum(axis=0) % 2), 8.0, periodic=True)
    record = beam_of(op.Sample([(1j, cliffs)]), 0.1).block(0, wanted=50).record
    normals = record[1 : 1 + int(record[0, layout.EVENTS]), layout.NORMAL : layout.NORMAL + 3]
    assert np.linalg.norm(normals, axis=-1) == pytest.approx(1.0, abs=1e-15)
