"""Standard errors are as large as what results of other seeds differ by.

Statistical tests have fixed seeds, and would fail by chance once in a million of other seeds.
"""

import numpy as np
import pytest

import optipath as op

pytest.importorskip("numba")
pytest.importorskip("xarray")

SEEDS, PHOTONS, SOURCE = 30, 4096, [1.0, -0.4, 0.5, 0.3]


def measured(surfaces):
    """Hemispheres of other photons, and of other surfaces."""
    for seed in range(SEEDS):
        sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200, seed=seed, surfaces=surfaces)
        yield op.measure(sample, "40 deg", PHOTONS, sensor=6, seed=seed)


@pytest.fixture(scope="module")
def hemispheres():
    return [*measured(4)]


def ratio(values, errors):
    """The variance among seeds over the mean square of errors, the mean of all numbers."""
    values, errors = np.array(values), np.array(errors)
    return np.mean(values.var(axis=0, ddof=1) / np.mean(errors**2, axis=0))


def of_bright(hemispheres, pairs):
    """Values and errors of the pixels into which many photons have gone each time."""
    counts = np.array([each.dataset["count"].values[..., np.newaxis] for each in hemispheres])
    lit = (counts > 60).all(axis=0)
    assert lit.sum() >= 5
    return ([each[lit] for each in some] for some in zip(*pairs, strict=True))


def test_mueller_matrices_of_other_seeds_differ_by_their_errors(hemispheres):
    values, errors = of_bright(hemispheres, [each.mueller for each in hemispheres])
    for row, column in ((0, 0), (0, 1), (1, 0), (1, 1), (2, 2), (3, 3), (1, 2), (3, 2)):
        place = ..., row, column
        assert 0.6 < ratio([each[place] for each in values], [each[place] for each in errors]) < 1.7


def test_differences_from_light_without_polarisation_differ_by_their_errors(hemispheres):
    values, errors = of_bright(hemispheres, [each.difference for each in hemispheres])
    assert 0.6 < ratio(values, errors) < 1.7


@pytest.mark.parametrize("quantity", ["dop", "dolp", "aop"])
def test_degrees_and_angles_of_other_seeds_differ_by_their_errors(hemispheres, quantity):
    arrays = [getattr(each, quantity)(SOURCE) for each in hemispheres]
    values, errors = of_bright(hemispheres, [(each.values, each.se.values) for each in arrays])
    if quantity == "aop":
        values = [np.remainder(each - values[0] + np.pi / 2.0, np.pi) for each in values]
    assert 0.6 < ratio(values, errors) < 1.7


def test_where_two_surfaces_are_all_they_differ_by_their_errors():
    # Each surface is a part by itself, so that the error is how far the two are apart.
    hemispheres = [*measured(2)]
    assert all(np.count_nonzero(each.parts.photons) == 2 for each in hemispheres)
    values, errors = of_bright(hemispheres, [each.mueller for each in hemispheres])
    found = ratio([each[..., 0, 0] for each in values], [each[..., 0, 0] for each in errors])
    assert 0.5 < found < 2.0
