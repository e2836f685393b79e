"""How fine a mesh is to be, and the warning of one that is not."""

import warnings

import pytest

import optipath as op
from optipath.surfaces.fields.mesh_resolution import converged_cells

HeightField = op.surfaces.HeightField


@pytest.mark.parametrize(
    ("alpha", "size", "cells"),
    [((1.0, 1.0), (80.0, 80.0), (640, 640)), ((0.1, 0.3), (400.0, 400.0), (320, 960))],
)
def test_sixteen_cells_a_correlation_length_are_enough(alpha, size, cells):
    assert converged_cells(alpha, size) == cells
    for length, side, number in zip(alpha, size, cells, strict=True):
        assert number == pytest.approx(16.0 * side / (2.0 / length))


def test_the_cells_of_a_field_are_these_where_nobody_says_how_many():
    assert HeightField.beckmann(0.25, size=160.0).cells == (320, 320)


def test_a_coarse_mesh_is_warned_of_with_what_it_costs_and_what_would_do():
    with pytest.warns(op.MeshWarning, match="about 4.7 % of the light") as caught:
        HeightField.beckmann(1.0, size=40.0, cells=80)
    said = str(caught[0].message)
    assert "80 x 80 cells has 4 a correlation length 2/alpha, and needs 16 at alpha 1" in said
    assert said.endswith("cells=(320, 320) are enough")
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    ("cells", "share"),
    [(10, "more than 12 %"), (40, "about 12 %"), (319, "about 0.2 %")],
)
def test_the_warning_says_what_share_of_light_is_missing(cells, share):
    with pytest.warns(op.MeshWarning, match=f"slopes are lost, and {share} of the light that is"):
        HeightField.beckmann(1.0, size=40.0, cells=cells)


def test_the_cells_of_the_warning_are_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        HeightField.beckmann(1.0, size=40.0, cells=(320, 320))


@pytest.mark.parametrize(("alpha", "cells"), [(0.3, 75), (0.31, 248)])
def test_five_cells_are_enough_for_smoother_surfaces(alpha, cells):
    size = 100.0
    HeightField.beckmann(alpha, size=size, cells=cells)
    with pytest.warns(op.MeshWarning, match=rf"cells=\({cells}, {cells}\) are enough"):
        HeightField.beckmann(alpha, size=size, cells=cells - 1)


def test_the_axis_that_is_too_coarse_is_looked_at():
    with pytest.warns(op.MeshWarning, match="has 8 a correlation length"):
        HeightField.beckmann(0.5, size=80.0, cells=(320, 160))


def test_the_mesh_loses_the_slopes_that_the_warning_speaks_of():
    with pytest.warns(op.MeshWarning):
        coarse = HeightField.beckmann(1.0, size=80.0, cells=120, seed=1)
    # A chord of cos(f x) over dx has sin(f dx / 2) / (f dx / 2) of its slope; over a normal
    # spectrum of variance 1/2 for f, the mean of its square is (1 - exp(-dx^2 / 4)) 2 / dx^2.
    step = coarse.spacing[0]
    kept = (1.0 - 2.718281828459045 ** (-(step**2) / 4.0)) * 2.0 / step**2
    assert coarse.mean_square_slopes == pytest.approx((kept, kept), rel=2e-3)
