import numpy as np
import pytest

from optipath.surfaces.energies.energy_shares import mean_and_error


def sums(values):
    """The sums that a walk would give of values by surface."""
    return (
        np.array([float(len(each)) for each in values]),
        np.array([np.sum(each) for each in values]),
        np.array([np.sum(np.square(each)) for each in values]),
    )


def test_on_one_surface_the_error_is_that_of_a_mean():
    values = np.random.default_rng(0).random(1000)
    mean, error = mean_and_error(*sums([values]))
    assert float(mean) == pytest.approx(values.mean(), rel=1e-12)
    assert float(error) == pytest.approx(values.std(ddof=1) / np.sqrt(1000), rel=1e-9)


def test_surfaces_that_differ_enlarge_the_error_to_that_of_their_means():
    rng = np.random.default_rng(1)
    values = [level + 0.1 * rng.standard_normal(5000) for level in (0.0, 1.0, 2.0, 3.0)]
    means = [each.mean() for each in values]
    _, error = mean_and_error(*sums(values))
    assert float(error) == pytest.approx(np.std(means, ddof=1) / 2.0, rel=1e-9)


def test_surfaces_without_photons_do_not_count():
    values = np.random.default_rng(2).random(100)
    alone = mean_and_error(*sums([values]))
    assert mean_and_error(*sums([values, np.zeros(0)])) == alone


def test_errors_cover_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(3)
    off = []
    for _ in range(500):
        levels = 0.02 * rng.standard_normal(8)
        mean, error = mean_and_error(*sums([level + rng.standard_normal(200) for level in levels]))
        off.append(float(mean / error))
    # Of Student's t of 7 degrees of freedom, 500 times: the variance is 1.4 at most.
    assert 0.8 < np.var(off) < 1.9
