"""Height fields: what they are made of, their mesh, how fine it is to be, and what is refused."""

import ast
import copy
import pickle
import re
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.surfaces import HeightField
from optipath.surfaces.fields.given_fields import period_faults
from optipath.surfaces.fields.mesh_resolution import converged_cells
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
    with pytest.raises(op.SurfaceError) as caught:
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


def test_the_border_of_a_periodic_surface_is_no_steeper_than_the_rest():
    field = HeightField.beckmann(0.3, size=100.0, seed=1)
    z, step = field.vertices(), field.spacing[0]
    assert np.array_equal(z[0], z[-1])
    assert np.array_equal(z[:, 0], z[:, -1])
    # The second difference is that of a smooth surface, over the border as elsewhere.
    bent = np.abs(np.diff(np.diff(z, axis=1, append=z[:, 1:2]), axis=1)) / step**2
    assert bent[:, -1].max() <= bent[:, :-1].max()


def test_a_finite_surface_has_its_last_vertices_at_its_ends():
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


def test_rows_are_along_y_and_columns_along_x():
    plane = np.multiply.outer([0.0, 3.0, 6.0], [1.0, 1.0, 1.0, 1.0, 1.0])
    field = HeightField.from_heights(plane, (8.0, 2.0))
    assert (field.cells, field.spacing) == ((4, 2), (2.0, 1.0))
    assert field.mean_square_slopes == (0.0, 9.0)


def test_heights_of_any_real_type_become_float64_one_after_the_other_in_memory():
    for dtype in (np.uint16, np.int64, np.float32, np.longdouble):
        field = HeightField.from_heights(MAP.astype(dtype), 2.0)
        assert field.heights.dtype == np.float64
        assert np.array_equal(field.heights, MAP)
    for field in (HeightField(MAP.T, 1.0), HeightField(MAP.T, 1.0, periodic=True)):
        assert field.vertices().flags.c_contiguous
        assert field.vertices().dtype == np.float64
        assert field.vertices().shape == (field.cells[1] + 1, field.cells[0] + 1)


def test_the_same_seed_gives_the_same_bits_and_a_sequence_is_not_used_up():
    sequence = np.random.SeedSequence(5)
    first = HeightField.beckmann(0.3, size=100.0, seed=5)
    for seed in (5, np.int64(5), sequence, sequence):
        assert HeightField.beckmann(0.3, size=100.0, seed=seed) == first
    for seed in (6, np.random.SeedSequence(5, spawn_key=(0,))):
        assert HeightField.beckmann(0.3, size=100.0, seed=seed) != first


def test_a_field_knows_whether_it_has_a_direction_and_says_what_it_is():
    assert HeightField.beckmann(0.3, size=100.0).isotropic
    assert HeightField.beckmann(0.3, 0.3, size=(100.0, 120.0)).isotropic
    assert not HeightField.beckmann(0.3, 0.2, size=100.0).isotropic
    assert not HeightField.from_heights(MAP, 1.0).isotropic
    assert HeightField.from_heights(np.full((3, 3), 2.0), 1.0).isotropic
    field = HeightField.beckmann(0.3, 0.2, size=(100.0, 120.5), cells=(240, 200), seed=1)
    assert repr(field) == (
        "HeightField.beckmann of alpha (0.3, 0.2), 240 x 200 cells, 100 x 120.5, periodic"
    )


def test_a_flat_field_has_neither_heights_nor_slopes():
    field = HeightField.flat()
    assert (field.deviation, field.mean_square_slopes, field.alpha) == (0.0, (0.0, 0.0), None)
    assert field.periodic
    assert field.isotropic


def test_a_field_does_not_change_nor_do_its_copies():
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
        assert found == field
        assert hash(found) == hash(field)
        assert not found.heights.flags.writeable


PAIR = "or two of them"
WRONG = [
    *(
        ({"alpha": each}, "alpha must be a positive number (HeightField.flat() is a flat surface)")
        for each in (0, -0.1, np.inf, np.nan, True, "0.1", None, 1j, (0.1, 0.2))
    ),
    *(
        ({"cells": each}, f"cells must be a whole number of 2 or more, {PAIR}")
        for each in (0, 1, -4, 2.5, (640,), (640, 1), "many", True)
    ),
    *(
        ({"seed": each}, "seed must be a whole number of 0 or more, or a numpy.random.Seed")
        for each in (-1, 0.5, None, "3", [1, 2])
    ),
    ({"waves": 10**13}, "a sum of 1e+13 waves"),
]


@rows("wrong, start", WRONG)
def test_a_random_field_is_refused_that_cannot_be(wrong, start):
    (fault,) = faults_of(HeightField.beckmann, **{"alpha": 0.3} | wrong)
    assert fault.startswith(start)


@rows("asked", [{"size": 1e9}, {"size": 1e20}, {"cells": 10**7}])
def test_a_mesh_larger_than_the_memory_is_refused(asked):
    (fault,) = faults_of(HeightField.beckmann, 1.0, **{"size": 400.0} | asked)
    said = "^a mesh of .*and this machine has.*take fewer cells, or a smaller field$"
    assert re.search(said, fault)


NO_SIZE = f"size must be a positive number, {PAIR} for x and y, not "
SIZES = [0, -1.0, np.inf, "400 um", (1, 2, 3), (400.0, 0.0), [], None]
WRONG_HEIGHTS = [
    ([[1.0]], "heights of shape (1, 1) are too few; give 3 x 3 or more, for 2 x 2 cells"),
    ([[1.0, 2.0]] * 2, "heights of shape (2, 2) are too few"),
    ([1.0, 2.0, 3.0], "heights must have two dimensions, rows along y and columns along x"),
    (np.zeros((3, 4, 3)), "not the shape (3, 4, 3)"),
    (3.0, "heights must have two dimensions"),
    ([[0.0, np.nan, 1.0]] * 3, "3 of 9 heights are not finite, the first nan at heights[0, 1]"),
    (np.where(MAP == 8.0, -np.inf, MAP), "1 of 12 heights is not finite, the first -inf at"),
    (MAP + 1j, "heights must be real numbers, not an array of complex128"),
    (MAP > 2.0, "heights must be real numbers, not an array of bool"),
    ([["a"] * 3] * 3, "heights must be real numbers"),
    ([[1.0, 2.0], [3.0]], "the array of heights has rows of unequal lengths"),
    (np.ma.masked_greater(MAP, 4.0), "the array of heights has masked entries"),
    (1e300 * MAP, "give them in a unit in which they are numbers of 1e+30 at most"),
]


@rows(
    "given, said",
    [
        *(({"heights": heights}, said) for heights, said in WRONG_HEIGHTS),
        *(
            ({"size": size}, f"size must be a positive number, {PAIR} for x and y")
            for size in SIZES
        ),
        ({"size": 1e-300}, "size is 1e-300; give it in a unit of which it is 1e-30 .. 1e+30"),
        *(
            ({"periodic": each}, "periodic must be True or False, not ")
            for each in (1, "no", None, np.array([True, False]))
        ),
        ({"heights": MAP[:1], "periodic": True}, "give 2 x 2 or more"),
    ],
)
def test_a_map_of_heights_is_refused_that_cannot_be(given, said):
    (fault,) = faults_of(HeightField.from_heights, **{"heights": MAP, "size": 1.0} | given)
    assert fault.startswith(said) or ("heights" in given and said in fault)
    assert HeightField.from_heights(MAP[:2], 1.0, periodic=True).cells == (3, 2)


def test_all_faults_of_a_field_are_told_at_once():
    wrong = {"size": -1, "cells": 1, "waves": 0, "seed": -1, "periodic": "no"}
    faults = faults_of(HeightField.beckmann, 0, np.nan, **wrong)
    assert [fault.split(" must")[0] for fault in faults] == [
        *("alpha", "alpha_y", "size", "periodic", "cells", "seed", "waves")
    ]
    assert len(faults_of(HeightField, [[np.nan]], -1, periodic=1, alpha=0.0)) == 5


def test_a_period_of_too_few_correlation_lengths_is_refused_and_the_cures_work():
    (fault,) = faults_of(HeightField.beckmann, 0.3, 0.07, size=100.0)
    assert "has 15 x 3.5 correlation lengths 2/alpha" in fault
    assert "write size=(66.667, 285.72) or more, or periodic=False" in fault
    HeightField.beckmann(0.3, 0.07, size=(66.667, 285.72))
    assert HeightField.beckmann(0.3, 0.07, size=100.0, periodic=False).cells == (240, 56)
    # In spite of roundings.
    assert period_faults((0.1545, 0.1545), (20.0 / 0.1545, 20.0 / 0.1545)) == []


@given(st.floats(1e-3, 10.0), st.floats(1e-3, 10.0))
def test_the_size_that_is_offered_is_taken_and_little_larger_than_needed(alpha_x, alpha_y):
    (fault,) = period_faults((alpha_x, alpha_y), (1.0, 1.0))
    offered = ast.literal_eval(re.search(r"size=(\(.*?\))", fault)[1])
    assert period_faults((alpha_x, alpha_y), offered) == []
    assert offered == pytest.approx((20.0 / alpha_x, 20.0 / alpha_y), rel=2e-4)


@rows(
    "alpha, size, cells",
    [((1.0, 1.0), (80.0, 80.0), (640, 640)), ((0.1, 0.3), (400.0, 400.0), (320, 960))],
)
def test_sixteen_cells_a_correlation_length_are_enough(alpha, size, cells):
    assert converged_cells(alpha, size) == cells
    for length, side, number in zip(alpha, size, cells, strict=True):
        assert number == pytest.approx(16.0 * side / (2.0 / length))
    assert HeightField.beckmann(0.25, size=160.0).cells == (320, 320), "where nobody says"


def test_a_coarse_mesh_is_warned_of_with_what_it_costs_and_what_would_do():
    with pytest.warns(op.MeshWarning, match="about 4.7 % of the light") as caught:
        HeightField.beckmann(1.0, size=40.0, cells=80)
    said = str(caught[0].message)
    assert "80 x 80 cells has 4 a correlation length 2/alpha, and needs 16 at alpha 1" in said
    assert said.endswith("cells=(320, 320) are enough")
    assert caught[0].filename == __file__
    # The rougher axis tells how many cells both need.
    with pytest.warns(op.MeshWarning, match=r"cells=\(800, 320\) are enough"):
        HeightField.beckmann(0.5, 0.2, size=200.0, cells=(400, 160))


@rows(
    "alpha, size, cells, said",
    [
        (1.0, 40.0, 10, "slopes are lost, and more than 12 % of the light that is"),
        (1.0, 40.0, 40, "slopes are lost, and about 12 % of the light that is"),
        (1.0, 40.0, 319, "slopes are lost, and about 0.2 % of the light that is"),
        # Five cells are enough for smoother surfaces.
        (0.3, 100.0, 74, r"cells=\(75, 75\) are enough"),
        (0.31, 100.0, 247, r"cells=\(248, 248\) are enough"),
        (0.5, 80.0, (320, 160), "has 8 a correlation length"),
    ],
)
def test_the_warning_says_what_is_lost_and_how_many_cells_are_enough(alpha, size, cells, said):
    with pytest.warns(op.MeshWarning, match=said):
        HeightField.beckmann(alpha, size=size, cells=cells)
    if cells in (319, 74, 247):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            HeightField.beckmann(alpha, size=size, cells=cells + 1)


def test_the_mesh_loses_the_slopes_that_the_warning_speaks_of():
    with pytest.warns(op.MeshWarning):
        coarse = HeightField.beckmann(1.0, size=80.0, cells=120, seed=1)
    # A chord of cos(f x) over dx has sin(f dx / 2) / (f dx / 2) of its slope; over a normal
    # spectrum of variance 1/2 for f, the mean of its square is (1 - exp(-dx^2 / 4)) 2 / dx^2.
    step = coarse.spacing[0]
    kept = (1.0 - np.exp(-(step**2) / 4.0)) * 2.0 / step**2
    assert coarse.mean_square_slopes == pytest.approx((kept, kept), rel=2e-3)
