"""Rays over meshes meet what they meet in exact arithmetic, and slip through nowhere."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rays_over_meshes import first_meeting, height_above
from uncompiled import uncompiled

pytest.importorskip("numba")

from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.walk import mesh_hit as walk
from optipath.surfaces.walk.facet_hit import LOWER, NO_FACET, UPPER
from optipath.surfaces.walk.packed_meshes import packed_meshes

mesh_hit = uncompiled(walk.mesh_hit)
SEEDS = st.integers(0, 10**6)
SIDES = st.sampled_from([1.0, -1.0])
QUARTERS = st.integers(-8, 8).map(lambda number: number / 4)
SLOPES = st.tuples(QUARTERS, QUARTERS, st.sampled_from([0.25, 0.5, 1.0, 2.0]))


@st.composite
def plateaus(draw):
    """Fields with many equal heights: numbers of which nothing is rounded."""
    return _field(draw, lambda numbers, shape: numbers.integers(-2, 3, shape).astype(float))


@st.composite
def hills(draw):
    """Fields of any heights, from nearly flat ones to cliffs."""
    scale = 10.0 ** draw(st.integers(-6, 6))
    return _field(draw, lambda numbers, shape: scale * numbers.normal(size=shape))


def _field(draw, heights):
    periodic, numbers = draw(st.booleans()), np.random.default_rng(draw(SEEDS))
    cells = draw(st.tuples(st.integers(2, 6), st.integers(2, 6)))
    shape = [each + (not periodic) for each in cells[::-1]]
    return HeightField(heights(numbers, shape), cells, periodic)


def outcome_of(field, start, direction, side, cell=None, own=NO_FACET):
    """How a ray ends that starts somewhere in cells, and where."""
    (x, y, z), (dx, dy, dz) = np.float64(start), np.float64(direction)
    column, line = cell or (min(int(x), field.cells[0] - 1), min(int(y), field.cells[1] - 1))
    with np.errstate(all="ignore"):
        outcome, t, *_ = mesh_hit(
            tuple(packed_meshes([field])), 0, x, y, (z, dx, dy, dz), side, column, line, own
        )
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


@given(field=plateaus(), place=st.tuples(*2 * [st.integers(0, 23)]), slopes=SLOPES, side=SIDES)
def test_rays_from_outside_through_vertices_and_along_edges(field, place, slopes, side):
    x, y = (number / 4 % cells for number, cells in zip(place, field.cells, strict=True))
    start = x, y, side * np.max(side * field.heights)
    direction = *slopes[:2], -side * slopes[2]
    expect_meeting(field, start, direction, side, outcome_of(field, start, direction, side))


@given(field=hills(), seed=SEEDS, side=SIDES)
def test_rays_from_outside_onto_hills_and_cliffs(field, seed, side):
    numbers = np.random.default_rng(seed)
    heights = side * field.heights
    start = *numbers.uniform(0, field.cells), side * heights.max()
    steep = np.ptp(heights) * 10.0 ** numbers.uniform(-1, 3)
    direction = *numbers.normal(size=2), -side * steep
    expect_meeting(field, start, direction, side, outcome_of(field, start, direction, side))


@given(field=hills(), seed=SEEDS, side=SIDES, facet=st.sampled_from([LOWER, UPPER]))
def test_rays_from_facets_leave_these_and_meet_others(field, seed, side, facet):
    numbers = np.random.default_rng(seed)
    vertices, cell = field.vertices(), [int(numbers.integers(most)) for most in field.cells]
    u, v = sorted(numbers.uniform(0.05, 0.95, 2), reverse=facet == LOWER)
    column, line = cell
    low, right, back, high = vertices[line : line + 2, column : column + 2].ravel()
    rise = (right - low, high - right) if facet == LOWER else (high - back, back - low)
    start = column + u, line + v, low + u * rise[0] + v * rise[1]
    flat = numbers.normal(size=2)
    away = side * np.ptp(vertices) * 10.0 ** numbers.uniform(-3, 1)
    direction = *flat, float(flat @ rise) + away
    assume(abs(direction[2]) > 1e-2 * np.ptp(vertices))
    found = outcome_of(field, start, direction, side, (column, line), facet)
    if found[0] == walk.MET:
        # The start is on its facet but for a rounding, and met there by exact arithmetic.
        assert found[1] * abs(away) > 1e-9 * np.ptp(vertices)
    expect_meeting(field, nearly(start, side), direction, side, found)


def nearly(start, side):
    """A start that is not below its facet by a rounding."""
    x, y, z = start
    return x, y, z + side * 1e-12 * (abs(z) + 1e-9)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("x", [0.0, 0.25, 1.0])
def test_vertical_rays(side, x):
    field = HeightField([[0.0, 1.0, 3.0], [2.0, 5.0, 0.0], [1.0, 1.0, 1.0]], 3.0, periodic=True)
    edge = 5.0 if side > 0.0 else 0.0
    start, direction = (x, 0.5, edge), (0.0, 0.0, -side)
    outcome, t = outcome_of(field, start, direction, side)
    assert outcome == walk.MET
    assert t == first_meeting(field, start, direction, side)


def test_light_along_a_periodic_mesh_above_all_is_given_up(monkeypatch):
    monkeypatch.setitem(mesh_hit.__globals__, "_MOST_STEPS", 100)
    field = HeightField([[0.0, 1.0], [2.0, 0.0]], 2.0, periodic=True)
    assert outcome_of(field, (0.0, 0.5, 3.0), (1.0, 0.0, 0.0), 1.0)[0] == walk.LOST


def test_light_leaves_a_finite_mesh_at_its_side():
    field = HeightField(np.zeros((3, 3)), 2.0)
    outcome, t = outcome_of(field, (0.5, 0.5, 1.0), (1.0, 0.25, -0.1), 1.0)
    assert (outcome, t) == (walk.LEFT, 1.5)
