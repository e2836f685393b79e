"""Height fields: what they are made of, their mesh, and what is refused."""

import ast
import copy
import pickle
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.surfaces.fields.given_fields import period_faults

HeightField = op.surfaces.HeightField

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


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("alpha", "alpha_y"), [(1.0, None), (0.1, 0.1), (0.4, 0.1)])
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


@pytest.mark.parametrize("periodic", [True, False])
def test_each_cell_is_two_triangles_beside_the_diagonal_from_its_first_corner(periodic):
    field = HeightField.from_heights(MAP, (3.0, 7.0), periodic=periodic)
    expected = np.mean(np.square(list(triangles_of(field))), axis=0)
    assert field.mean_square_slopes == pytest.approx(tuple(expected), rel=1e-13)


def test_rows_are_along_y_and_columns_along_x():
    plane = np.multiply.outer([0.0, 3.0, 6.0], [1.0, 1.0, 1.0, 1.0, 1.0])
    field = HeightField.from_heights(plane, (8.0, 2.0))
    assert field.cells == (4, 2)
    assert field.spacing == (2.0, 1.0)
    assert field.mean_square_slopes == (0.0, 9.0)


def test_vertices_follow_each_other_in_memory():
    for field in (HeightField(MAP.T, 1.0), HeightField(MAP.T, 1.0, periodic=True)):
        assert field.vertices().flags.c_contiguous
        assert field.vertices().dtype == np.float64
        assert field.vertices().shape == (field.cells[1] + 1, field.cells[0] + 1)


@pytest.mark.parametrize("dtype", [np.uint16, np.int64, np.float32, np.longdouble])
def test_heights_of_any_real_type_become_float64(dtype):
    field = HeightField.from_heights(MAP.astype(dtype), 2.0)
    assert field.heights.dtype == np.float64
    assert np.array_equal(field.heights, MAP)


def test_the_same_seed_gives_the_same_bits():
    asked = {"alpha": 0.3, "size": 100.0}
    first = HeightField.beckmann(**asked, seed=5)
    assert HeightField.beckmann(**asked, seed=5) == first
    assert HeightField.beckmann(**asked, seed=np.random.SeedSequence(5)) == first
    assert HeightField.beckmann(**asked, seed=np.int64(5)) == first
    assert HeightField.beckmann(**asked, seed=6) != first
    assert HeightField.beckmann(**asked, seed=np.random.SeedSequence(5, spawn_key=(0,))) != first


def test_a_sequence_of_seeds_is_not_used_up():
    sequence = np.random.SeedSequence(3, spawn_key=(1, 2))
    first = HeightField.beckmann(0.3, size=100.0, seed=sequence)
    assert HeightField.beckmann(0.3, size=100.0, seed=sequence) == first


def test_a_field_knows_whether_it_has_a_direction():
    assert HeightField.beckmann(0.3, size=100.0).isotropic
    assert HeightField.beckmann(0.3, 0.3, size=(100.0, 120.0)).isotropic
    assert not HeightField.beckmann(0.3, 0.2, size=100.0).isotropic
    assert not HeightField.from_heights(MAP, 1.0).isotropic
    assert HeightField.from_heights(np.full((3, 3), 2.0), 1.0).isotropic
    assert HeightField.flat().isotropic


def test_a_flat_field_has_neither_heights_nor_slopes():
    field = HeightField.flat()
    assert field.deviation == 0.0
    assert field.mean_square_slopes == (0.0, 0.0)
    assert field.alpha is None
    assert field.periodic


def test_a_field_does_not_change():
    measured = MAP.copy()
    field = HeightField.from_heights(measured, 1.0)
    measured[0, 0] = 100.0
    assert field.heights[0, 0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        field.heights[0, 0] = 1.0
    with pytest.raises(AttributeError, match="cannot"):
        field.size = (1.0, 1.0)


@pytest.mark.parametrize(
    "again", [copy.copy, copy.deepcopy, lambda made: pickle.loads(pickle.dumps(made))]
)
def test_a_copy_equals_the_field_and_does_not_change_either(again):
    field = HeightField.from_heights(MAP, 2.0)
    assert field.deviation == pytest.approx(np.std(MAP))
    found = again(field)
    assert found == field
    assert hash(found) == hash(field)
    assert not found.heights.flags.writeable


def test_all_faults_of_a_random_field_are_told_at_once():
    faults = faults_of(
        HeightField.beckmann, 0, np.nan, size=-1, cells=1, waves=0, seed=-1, periodic="no"
    )
    assert [fault.split(" must")[0] for fault in faults] == [
        *("alpha", "alpha_y", "size", "periodic", "cells", "seed", "waves")
    ]


@pytest.mark.parametrize("alpha", [0, -0.1, np.inf, np.nan, True, "0.1", None, 1j, (0.1, 0.2)])
def test_what_is_no_roughness_is_refused(alpha):
    (fault,) = faults_of(HeightField.beckmann, alpha)
    assert fault.startswith(
        "alpha must be a positive number (HeightField.flat() is a flat surface)"
    )


@pytest.mark.parametrize("size", [0, -1.0, np.inf, "400 um", (1, 2, 3), (400.0, 0.0), [], None])
def test_what_is_no_size_is_refused(size):
    (fault,) = faults_of(HeightField.from_heights, MAP, size)
    assert fault.startswith("size must be a positive number, or two of them for x and y, not ")


@pytest.mark.parametrize("cells", [0, 1, -4, 2.5, (640,), (640, 1), "many", True])
def test_what_is_no_number_of_cells_is_refused(cells):
    (fault,) = faults_of(HeightField.beckmann, 0.3, cells=cells)
    assert fault.startswith("cells must be a whole number of 2 or more, or two of them")


@pytest.mark.parametrize("seed", [-1, 0.5, None, "3", [1, 2]])
def test_what_is_no_seed_is_refused(seed):
    (fault,) = faults_of(HeightField.beckmann, 0.3, seed=seed)
    assert fault.startswith("seed must be a whole number of 0 or more, or a numpy.random.Seed")


def test_a_period_of_too_few_correlation_lengths_is_refused_and_the_cures_work():
    (fault,) = faults_of(HeightField.beckmann, 0.3, 0.07, size=100.0)
    assert "has 15 x 3.5 correlation lengths 2/alpha" in fault
    assert "write size=(66.667, 285.72) or more, or periodic=False" in fault
    HeightField.beckmann(0.3, 0.07, size=(66.667, 285.72))
    assert HeightField.beckmann(0.3, 0.07, size=100.0, periodic=False).cells == (240, 56)


@given(st.floats(1e-3, 10.0), st.floats(1e-3, 10.0))
def test_the_size_that_is_offered_is_taken_and_little_larger_than_needed(alpha_x, alpha_y):
    (fault,) = period_faults((alpha_x, alpha_y), (1.0, 1.0))
    offered = ast.literal_eval(re.search(r"size=(\(.*?\))", fault)[1])
    assert period_faults((alpha_x, alpha_y), offered) == []
    assert offered == pytest.approx((20.0 / alpha_x, 20.0 / alpha_y), rel=2e-4)


@pytest.mark.parametrize("asked", [{"size": 1e9}, {"size": 1e20}, {"cells": 10**7}])
def test_a_mesh_larger_than_the_memory_is_refused(asked):
    (fault,) = faults_of(HeightField.beckmann, 1.0, **{"size": 400.0} | asked)
    assert fault.startswith("a mesh of ")
    assert "and this machine has" in fault
    assert fault.endswith("take fewer cells, or a smaller field")


def test_more_waves_than_the_memory_holds_are_refused():
    (fault,) = faults_of(HeightField.beckmann, 0.3, waves=10**13)
    assert fault.startswith("a sum of 1e+13 waves")


@pytest.mark.parametrize(
    ("heights", "said"),
    [
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
    ],
)
def test_what_is_no_map_of_heights_is_refused(heights, said):
    (fault,) = faults_of(HeightField.from_heights, heights, 1.0)
    assert said in fault


def test_a_periodic_map_may_have_two_rows_but_not_one():
    assert HeightField.from_heights(MAP[:2], 1.0, periodic=True).cells == (3, 2)
    (fault,) = faults_of(HeightField.from_heights, MAP[:1], 1.0, periodic=True)
    assert "give 2 x 2 or more" in fault


@pytest.mark.parametrize("periodic", [1, "no", None, np.array([True, False])])
def test_what_says_neither_periodic_nor_not_is_refused(periodic):
    (fault,) = faults_of(HeightField.from_heights, MAP, 1.0, periodic=periodic)
    assert fault.startswith("periodic must be True or False, not ")


def test_faults_of_heights_and_of_sizes_are_told_at_once():
    assert len(faults_of(HeightField, [[np.nan]], -1, periodic=1, alpha=0.0)) == 5


def test_a_field_says_what_it_is():
    field = HeightField.beckmann(0.3, 0.2, size=(100.0, 120.5), cells=(240, 200), seed=1)
    assert repr(field) == (
        "HeightField.beckmann of alpha (0.3, 0.2), 240 x 200 cells, 100 x 120.5, periodic"
    )


def test_lengths_whose_ratios_have_no_squares_are_refused():
    (fault,) = faults_of(HeightField.from_heights, MAP, 1e-300)
    assert fault == "size is 1e-300; give it in a unit of which it is 1e-30 .. 1e+30"
    (fault,) = faults_of(HeightField.from_heights, 1e300 * np.array(MAP), 1.0)
    assert "give them in a unit in which they are numbers of 1e+30 at most" in fault


def test_a_field_as_wide_as_it_must_be_is_wide_enough_in_spite_of_roundings():
    assert period_faults((0.1545, 0.1545), (20.0 / 0.1545, 20.0 / 0.1545)) == []
