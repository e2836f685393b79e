import numpy as np

from optipath.surfaces.decisions.largest_of import LargestOf


def test_three_standard_errors_to_either_side_of_one_are_within():
    found = LargestOf.of([-0.2], [0.02])
    np.testing.assert_allclose([found.value, found.least, found.most], [0.2, 0.14, 0.26])


def test_one_of_many_that_chance_has_made_large_is_not_above():
    noise = np.random.default_rng(0).normal(0.0, 0.01, (200, 2000))
    assert not any(LargestOf.of(each, np.full(2000, 0.01)).is_above(0.0) for each in noise)
    assert LargestOf.of([*noise[0], 0.06], np.full(2001, 0.01)).is_above(0.0)


def test_a_number_that_is_none_leaves_the_largest_open():
    found = LargestOf.of([np.nan, 0.3, 0.1], [0.0, 0.01, 0.01])
    assert (found.value, found.error, found.most) == (0.3, 0.01, np.inf)
    assert found.is_above(0.26)


def test_the_noise_of_another_number_may_reach_further():
    found = LargestOf.of([0.1, 0.2], [0.1, 0.001])
    assert found.value == 0.2
    assert not found.is_below(0.3)
    assert found.is_above(0.19)


def test_an_error_that_is_not_known_leaves_the_largest_open():
    found = LargestOf.of([0.01, 0.02], [np.nan, 0.001])
    assert not found.is_below(1e6)
    assert str(found) == "1.7 % or more"


def test_of_no_numbers_nothing_is_known():
    assert not LargestOf.of([], []).is_below(1.0)
    assert not LargestOf.of([], []).is_above(0.0)
