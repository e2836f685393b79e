"""Height fields: what they are made of, their mesh, how fine it is to be, and random waves."""

import ast
import copy
import math
import os
import pickle
import re
import subprocess
import sys
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.surfaces import HeightField
from optipath.surfaces.random_field import RandomWaves, converged_cells, period_faults
from tables import rows, slow

MAP = np.array([[0.0, 1.0, 4.0], [2.0, 7.0, 1.0], [5.0, 3.0, 8.0], [1.0, 1.0, 2.0]])


def triangles_of(field):
    """The slopes along x and y of both triangles of every cell, from planes through corners."""
    z = field.vertices()
    dx, dy = (side / number for side, number in zip(field.size, field.cells, strict=True))
    for i in range(field.cells[1]):
        for j in range(field.cells[0]):
            for third in ((0, 1), (1, 0)):  # Beside the diagonal from (0, 0) to (1, 1).
                corners = np.array([(0, 0), (1, 1), third])
                x, y = corners[:, 1] * dx, corners[:, 0] * dy
                plane = np.column_stack([x, y, np.ones(3)])
                heights = z[i + corners[:, 0], j + corners[:, 1]]
                yield np.linalg.solve(plane, heights)[:2]


def faults_of(make, *values, **named):
    with pytest.raises(op.errors.SurfaceError) as caught:
        make(*values, **named)
    return caught.value.faults


@pytest.mark.parametrize("seed", [0, 1, slow(2)])
@rows("alpha, alpha_y", [(1.0, None), (0.1, 0.1), (0.4, 0.1)])
def test_a_periodic_mesh_has_the_variances(alpha, alpha_y, seed):
    alphas = np.array([alpha, alpha_y or alpha])
    field = HeightField.beckmann(alpha, alpha_y, size=tuple(40.0 / alphas), seed=seed)
    assert field.cells == (320, 320)
    assert abs(field.heights.mean()) < 1e-13
    assert field.heights.var() == pytest.approx(1.0, rel=1e-12)
    # A chord of a cosine is less steep, by (f dx)^2 / 12; the mean of f^4 is 3 alpha^4 / 4.
    chords = 1.0 - 1.5 * (1.0 / 8.0) ** 2 / 12.0
    expected = chords * alphas**2 / 2.0
    assert field.mean_square_slopes == pytest.approx(tuple(expected), rel=2e-4)


def test_the_border_of_a_periodic_surface_is_no_steeper_and_a_finite_one_ends_at_its_vertices():
    field = HeightField.beckmann(0.3, size=100.0, seed=1)
    z, step = field.vertices(), field.spacing[0]
    assert np.array_equal(z[0], z[-1])
    assert np.array_equal(z[:, 0], z[:, -1])
    # The second difference is that of a smooth surface, over the border as elsewhere.
    bent = np.abs(np.diff(np.diff(z, axis=1, append=z[:, 1:2]), axis=1)) / step**2
    assert bent[:, -1].max() <= bent[:, :-1].max()
    field = HeightField.beckmann(0.3, size=(30.0, 20.0), cells=(90, 60), seed=2, periodic=False)
    assert field.heights.shape == (61, 91)
    assert field.cells == (90, 60)
    assert field.vertices() is field.heights
    longer = HeightField.beckmann(0.3, size=(60.0, 20.0), cells=(180, 60), seed=2, periodic=False)
    assert field.heights == pytest.approx(longer.heights[:, :91], abs=1e-12)


@rows("periodic", [True, False])
def test_each_cell_is_two_triangles_beside_the_diagonal_from_its_first_corner(periodic):
    field = HeightField.from_heights(MAP, (3.0, 7.0), periodic=periodic)
    expected = np.mean(np.square(list(triangles_of(field))), axis=0)
    assert field.mean_square_slopes == pytest.approx(tuple(expected), rel=1e-13)
    # Rows are along y and columns along x.
    plane = HeightField.from_heights(np.multiply.outer([0.0, 3.0, 6.0], np.ones(5)), (8.0, 2.0))
    known = plane.cells, plane.spacing, plane.mean_square_slopes
    assert known == ((4, 2), (2.0, 1.0), (0.0, 9.0))


def test_the_same_seed_gives_the_same_bits_and_a_sequence_is_not_used_up():
    sequence = np.random.SeedSequence(5)
    first = HeightField.beckmann(0.3, size=100.0, seed=5)
    for seed in (np.int64(5), sequence, sequence):
        assert HeightField.beckmann(0.3, size=100.0, seed=seed) == first
    for seed in (6, np.random.SeedSequence(5, spawn_key=(0,))):
        assert HeightField.beckmann(0.3, size=100.0, seed=seed) != first


def test_a_field_knows_whether_it_has_a_direction_and_says_what_it_is():
    assert HeightField.beckmann(0.3, 0.3, size=(100.0, 120.0)).isotropic
    assert not HeightField.from_heights(MAP, 1.0).isotropic
    assert HeightField.from_heights(np.full((3, 3), 2.0), 1.0).isotropic
    field = HeightField.beckmann(0.3, 0.2, size=(100.0, 120.5), cells=(240, 200), seed=1)
    assert not field.isotropic
    assert repr(field) == (
        "HeightField.beckmann of alpha (0.3, 0.2), 240 x 200 cells, 100 x 120.5, periodic"
    )
    flat = HeightField.flat()
    assert (flat.deviation, flat.mean_square_slopes, flat.alpha) == (0.0, (0.0, 0.0), None)
    assert (flat.periodic, flat.isotropic) == (True, True)


def test_heights_of_any_real_type_become_float64_that_do_not_change_nor_do_their_copies():
    for dtype in (np.uint16, np.int64, np.float32, np.longdouble):
        field = HeightField.from_heights(MAP.astype(dtype), 2.0)
        assert field.heights.dtype == np.float64
        assert np.array_equal(field.heights, MAP)
    for periodic in (False, True):
        field = HeightField(MAP.T, 1.0, periodic)
        vertices = field.vertices()
        assert (vertices.flags.c_contiguous, vertices.dtype) == (True, np.float64)
        assert vertices.shape == (field.cells[1] + 1, field.cells[0] + 1)
    measured = MAP.copy()
    field = HeightField.from_heights(measured, 2.0)
    measured[0, 0] = 100.0
    assert field.heights[0, 0] == 0.0
    assert field.deviation == pytest.approx(np.std(MAP))
    with pytest.raises(ValueError, match="read-only"):
        field.heights[0, 0] = 1.0
    with pytest.raises(AttributeError, match="cannot"):
        field.size = (1.0, 1.0)
    for found in (copy.copy(field), copy.deepcopy(field), pickle.loads(pickle.dumps(field))):
        assert (found, hash(found)) == (field, hash(field))
        assert not found.heights.flags.writeable


PAIR = "or two for x and y, not "
ALPHA = f"alpha must be a number of 1e-30 .. 1e+30, {PAIR}"
SIZE = f"size must be a number of 1e-30 .. 1e+30, {PAIR}"
CELLS = f"cells must be a whole number from 2, {PAIR}"
SEED = "seed must be a whole number of 0 or more, not "
MESH = "and this machine has"


@rows(
    "wrong, said",
    [
        *(({"alpha": each}, ALPHA) for each in (0, np.inf, True, (0.1, 0.2, 0.3))),
        *(({"cells": each}, CELLS) for each in (1, 2.5, (640,), (640, 1))),
        *(({"seed": each}, SEED) for each in (-1, None)),
        *(({"alpha": 1.0} | each, MESH) for each in ({"size": 1e20}, {"cells": 10**7})),
        *(({"size": each}, SIZE) for each in (0, "400 um", (1, 2, 3), (400.0, 0.0), [])),
        *(({"size": each}, SIZE) for each in (9e-31, 1.1e30)),
        ({"alpha": 1e-310}, ALPHA),
        ({"waves": 10**13}, "a sum of 1e+13 waves"),
        ({"periodic": 1}, "periodic is 1; give True or False"),
    ],
)
def test_a_random_field_is_refused_that_cannot_be(wrong, said):
    (fault,) = faults_of(HeightField.beckmann, **{"alpha": 0.3} | wrong)
    assert said in fault
    assert said != MESH or fault.endswith("take fewer cells, or a smaller field")


@rows(
    "heights, periodic, said",
    [
        ([[1.0, 2.0]] * 2, False, "of shape (2, 2); give real numbers, rows along y and"),
        (MAP[:1], True, "columns along x, 2 x 2 or more"),
        (np.zeros((3, 4, 3)), False, "an array of float64 of shape (3, 4, 3); give real"),
        ([[0.0, np.nan, 1.0]] * 3, False, "3 of 9 heights are not finite, the first nan at heigh"),
        (np.where(MAP == 8.0, -np.inf, MAP), False, "1 of 12 heights are not finite, the first -i"),
        *((each, False, "; give real numbers, rows along y") for each in (MAP + 1j, MAP > 2)),
        (np.ma.masked_greater(MAP, 4.0), False, "the array of heights has masked entries"),
        (1e300 * MAP, False, "give them in a unit of at most 1e+30"),
    ],
)
def test_a_map_of_heights_is_refused_that_cannot_be(heights, periodic, said):
    (fault,) = faults_of(HeightField.from_heights, heights, 1.0, periodic=periodic)
    assert said in fault
    assert HeightField.from_heights(MAP[:2], 1.0, periodic=True).cells == (3, 2)


def test_all_faults_of_a_field_are_told_at_once():
    wrong = {"size": -1, "cells": 1, "waves": 0, "seed": -1, "periodic": "no"}
    faults = faults_of(HeightField.beckmann, 0, np.nan, **wrong)
    places = ["alpha", "size", "periodic", "cells", "seed", "waves"]
    assert [fault.split(" ")[0] for fault in faults] == places
    assert len(faults_of(HeightField, [[np.nan]], -1, periodic=1, alpha=0.0)) == 4


def test_a_period_of_too_few_correlation_lengths_is_refused_and_the_cures_work():
    (fault,) = faults_of(HeightField.beckmann, 0.3, 0.07, size=100.0)
    assert "has 15 x 3.5 correlation lengths 2/alpha" in fault
    assert "write size=(67, 286) or more, or periodic=False" in fault
    HeightField.beckmann(0.3, 0.07, size=(67, 286))
    assert HeightField.beckmann(0.3, 0.07, size=100.0, periodic=False).cells == (240, 56)
    # In spite of roundings.
    assert period_faults((0.1545, 0.1545), (20.0 / 0.1545, 20.0 / 0.1545)) == []


@given(st.floats(1e-3, 10.0), st.floats(1e-3, 10.0))
def test_the_size_that_is_offered_is_taken_and_little_larger_than_needed(alpha_x, alpha_y):
    (fault,) = period_faults((alpha_x, alpha_y), (1.0, 1.0))
    offered = ast.literal_eval(re.search(r"size=(\(.*?\))", fault)[1])
    assert period_faults((alpha_x, alpha_y), offered) == []
    assert offered == (math.ceil(20.0 / alpha_x), math.ceil(20.0 / alpha_y))


@rows(
    "alpha, size, cells, said",
    [
        (1.0, 40.0, 10, "slopes are lost, and light of several events"),
        (1.0, 40.0, 319, r"cells=\(320, 320\) are enough"),
        (1.0, 40.0, 80, r"80 x 80 cells has 4 a .* 16 at alpha 1: .*=\(320, 320\) are"),
        # Five cells are enough for smoother surfaces.
        (0.3, 100.0, 74, r"cells=\(75, 75\) are enough"),
        (0.31, 100.0, 247, r"cells=\(248, 248\) are enough"),
        (0.5, 80.0, (320, 160), "has 8 a correlation length"),
        # The rougher axis tells how many cells both need.
        ((0.5, 0.2), 200.0, (400, 160), r"cells=\(800, 320\) are enough"),
    ],
)
def test_a_coarse_mesh_is_warned_of_with_what_is_lost_and_what_would_do(alpha, size, cells, said):
    alphas = alpha if isinstance(alpha, tuple) else (alpha,)
    with pytest.warns(op.errors.MeshWarning, match=said) as caught:
        HeightField.beckmann(*alphas, size=size, cells=cells)
    assert caught[0].filename == __file__
    if cells in (319, 74, 247):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            HeightField.beckmann(alpha, size=size, cells=cells + 1)
    # Sixteen cells a correlation length are enough, and taken where nobody says.
    assert converged_cells((1.0, 1.0), (80.0, 80.0)) == (640, 640)
    assert converged_cells((0.1, 0.3), (400.0, 400.0)) == (320, 960)
    assert HeightField.beckmann(0.25, size=160.0).cells == (320, 320)


# Random waves: their variances, the distribution of their slopes, and their sum.
LIMIT = np.sqrt(np.log(2.0 / 1e-6) / 2.0)
"""What the distance of Kolmogorov and Smirnov exceeds once in a million: 2 exp(-2 d^2)."""
alphas, lengths, seeds = st.floats(0.01, 3.0), st.floats(10.0, 60.0), st.integers(0, 1 << 40)


def angles_of(waves, x, y):
    """The phase of each wave at each point."""
    at = waves.phase + np.multiply.outer(x, waves.x_number)
    return at + np.multiply.outer(y, waves.y_number)


def distance(sample, cumulative):
    """The largest distance of Kolmogorov and Smirnov, times the root of how many there are."""
    expected = cumulative(np.sort(sample))
    steps = np.arange(sample.size + 1) / sample.size
    found = max(np.max(steps[1:] - expected), np.max(expected - steps[:-1]))
    return found * np.sqrt(sample.size)


def far_apart_slopes(alpha, rng, *, periodic=True):
    """Slopes at points 2.5 correlation lengths apart, of 16 surfaces."""
    period = tuple(80.0 / a for a in alpha)
    grid = np.arange(16) * 5.0
    x, y = (each.ravel() / a for each, a in zip(np.meshgrid(grid, grid), alpha, strict=True))
    found = []
    for seed in range(16):
        waves = RandomWaves.drawn(alpha, 1000, seed, period if periodic else None)
        start = rng.random(2) * period
        rise = -waves.amplitude * np.sin(angles_of(waves, x + start[0], y + start[1]))
        found.append([np.sum(rise * each, -1) for each in (waves.x_number, waves.y_number)])
    return np.concatenate(found, axis=1) / np.reshape(alpha, (2, 1))


@given(alphas, alphas, lengths, lengths, st.integers(10, 2000), seeds)
def test_every_surface_has_the_variances(alpha_x, alpha_y, long, wide, number, seed):
    for period in ((2.0 * long / alpha_x, 2.0 * wide / alpha_y), None):
        waves = RandomWaves.drawn((alpha_x, alpha_y), number, seed, period)
        power = waves.amplitude**2 / 2.0
        assert period or waves.phase.size == number
        numbers = np.array([np.ones_like(power), waves.x_number, waves.y_number])
        expected = [1.0, alpha_x**2 / 2.0, alpha_y**2 / 2.0]
        np.testing.assert_allclose(numbers**2 @ power, expected, rtol=1e-12)


@given(lengths, lengths, st.integers(1, 2000), seeds)
def test_periodic_waves_are_whole_and_none_interferes_with_another(long, wide, number, seed):
    period = np.array([2.0 * long, 2.0 * wide])
    waves = RandomWaves.drawn((1.0, 1.0), number, seed, tuple(period))
    counts = np.array([waves.x_number, waves.y_number]).T * period / (2.0 * np.pi)
    whole = np.rint(counts)
    assert np.allclose(counts, whole, rtol=0.0, atol=1e-9)
    both = np.concatenate([whole, -whole])
    assert len(np.unique(both, axis=0)) == len(both)


@given(seeds, st.floats(0.0, math.pi), st.sampled_from([None, (80.0, 40.0)]))
def test_heights_are_correlated_over_two_by_alpha(seed, turn, period):
    # The transform of the density of wave vectors, exp(-f^2 / alpha^2) / (pi alpha^2).
    waves = RandomWaves.drawn((1.0, 2.0), 1000, seed, period)
    apart = np.linspace(0.0, 8.0, 33)
    along = waves.x_number * np.cos(turn) + waves.y_number * np.sin(turn) / 2.0
    found = np.cos(np.multiply.outer(apart, along)) @ (waves.amplitude**2 / 2.0)
    assert np.max(np.abs(found - np.exp(-(apart**2) / 4.0))) < 0.02


@rows("number", [1, 2, 3, 5])
def test_a_few_waves_have_powers_all_the_same(number):
    for seed in range(20):
        amplitude = RandomWaves.drawn((1.0, 1.0), number, seed).amplitude
        assert np.all(np.isfinite(amplitude))
        assert 0.0 <= amplitude.min() <= amplitude.max() > 0.0


@rows("alpha", [(1.0, 1.0), (0.1, 0.1), (0.4, 0.1)])
@rows("periodic", [True, False])
def test_slopes_have_the_density_of_beckmann_and_rougher_ones_would_be_told(alpha, periodic, rng):
    # exp(-tan^2 / alpha^2) / (pi alpha^2): squares of scaled slopes are exponential, directions
    # uniform. Those of a surface that is rougher by a tenth are not.
    x, y = far_apart_slopes(alpha, rng, periodic=periodic)
    right, rougher = (
        distance(scale * (x**2 + y**2), lambda square: -np.expm1(-square)) for scale in (1.0, 1.21)
    )
    assert right < LIMIT < rougher
    turned = np.arctan2(y, x) % (2.0 * np.pi)
    assert distance(turned, lambda turn: turn / (2.0 * np.pi)) < LIMIT


@rows("period", [None, (20.0, 30.0)])
def test_heights_are_the_sum_of_cosines(period, rng):
    waves = RandomWaves.drawn((1.0, 0.7), 1000, 3, period)
    x, y = rng.uniform(-20.0, 20.0, 7), rng.uniform(-20.0, 20.0, 5)
    angles = angles_of(waves, *np.meshgrid(x, y))
    expected = np.sum(waves.amplitude * np.cos(angles), -1)
    assert waves.heights(x, y) == pytest.approx(expected, abs=1e-12)


def test_heights_in_parts_of_rows_and_with_any_number_of_threads_are_the_same_bits():
    waves = RandomWaves.drawn((1.0, 1.0), 1000, 0)
    x, y = np.linspace(0.0, 20.0, 5), np.linspace(0.0, 200.0, 2500)
    parts = [waves.heights(x, part) for part in (y[:7], y[7:])]
    assert np.array_equal(np.concatenate(parts), waves.heights(x, y))
    code = (
        "from optipath.surfaces.random_field import RandomWaves as R; import hashlib as h;"
        "import numpy as n; x = n.linspace(0, 60, 300); w = R.drawn((1., 1.), 1000, 0);"
        "print(h.sha256(w.heights(x, x).tobytes()).hexdigest())"
    )
    found = set()
    for threads in "12":
        own = os.environ | {"OPENBLAS_NUM_THREADS": threads, "MKL_NUM_THREADS": threads}
        run = [sys.executable, "-c", code]
        found.add(subprocess.run(run, env=own, capture_output=True, check=True).stdout)
    assert len(found) == 1


def test_heights_of_many_surfaces_are_normal(rng):
    points, several = np.arange(8) * 10.0, []
    for seed in range(30):
        waves = RandomWaves.drawn((1.0, 1.0), 1000, seed, (80.0, 80.0))
        x, y = rng.uniform(0.0, 80.0, 2)
        several.append(waves.heights(points + x, points + y))
    erf = np.vectorize(math.erf)
    assert distance(np.ravel(several), lambda z: (1.0 + erf(z / np.sqrt(2.0))) / 2.0) < LIMIT


def test_the_mesh_loses_the_slopes_that_the_warning_speaks_of():
    with pytest.warns(op.errors.MeshWarning):
        coarse = HeightField.beckmann(1.0, size=80.0, cells=120, seed=1)
    # A chord of cos(f x) over dx has sin(f dx / 2) / (f dx / 2) of its slope; over a normal
    # spectrum of variance 1/2 for f, the mean of its square is (1 - exp(-dx^2 / 4)) 2 / dx^2.
    step = coarse.spacing[0]
    kept = (1.0 - np.exp(-(step**2) / 4.0)) * 2.0 / step**2
    assert coarse.mean_square_slopes == pytest.approx((kept, kept), rel=2e-3)
