"""Grids of wavelengths: their steps, and their bins."""

from __future__ import annotations

import numpy as np
import pytest

import optipath as op
from optipath.values.spectra.grid_bins import grid_edges, grid_fault, grid_widths
from tables import rows


def test_a_grid_has_the_numbers_that_its_texts_stand_for():
    found = op.wavelengths("380 nm", "700 nm", "40 nm")
    expected = [op.Wavelength().resolve(f"{place} nm").value for place in range(380, 701, 40)]
    assert found.tolist() == [float(place) for place in expected]
    assert op.wavelengths(4e-7, 5e-7, 5e-8).tolist() == [4e-7, 4.5e-7, 5e-7]


@rows(
    "given, sentence",
    [
        (("380 nm", "700 nm", "45 nm"), "7.11111 steps of 45 nm; .* as up to 695 nm"),
        (("700 nm", "380 nm", "40 nm"), "do not rise"),
        (("380 nm", "700 nm", "0 nm"), "step"),
        ((380, 700, 40), "metres"),
        (("380 nm", "700 nm", "400 nm"), "up to 780 nm"),
    ],
)
def test_steps_that_do_not_fit_are_refused(given, sentence):
    with pytest.raises(op.ValueFault, match=sentence):
        op.wavelengths(*given)


UNEVEN = np.array([380.0, 395.0, 500.0, 512.5, 700.0]) * 1e-9


@rows("grid", [UNEVEN, UNEVEN[::-1]])
def test_widths_are_the_weights_of_the_trapezoidal_rule(grid):
    density = np.random.default_rng(7).uniform(0.0, 3.0, grid.size)
    steps = np.abs(np.diff(grid * 1e9))
    expected = np.sum(0.5 * (density[1:] + density[:-1]) * steps)
    assert np.dot(density, grid_widths(grid)) == pytest.approx(expected, rel=1e-14)


def test_bins_reach_halfway_to_neighbours_and_end_with_the_grid():
    expected = [380.0, 387.5, 447.5, 506.25, 606.25, 700.0]
    np.testing.assert_allclose(grid_edges(UNEVEN), expected, rtol=1e-15)


@rows(
    "wavelengths, fault",
    [
        (5e-7, "one wavelength alone"),
        ([], "none at all"),
        ([5e-7], "one wavelength alone"),
        ([5e-7, 5e-7], "repeated"),
        ([5e-7, 6e-7, 5.5e-7], "neither rise nor fall"),
        (np.ones((2, 2)), "one axis"),
    ],
)
def test_what_is_no_grid_is_said(wavelengths, fault):
    assert fault in grid_fault(wavelengths)
