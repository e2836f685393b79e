import numpy as np

from optipath.lab.accuracy.error_measures import errors


def test_an_error_is_counted_in_ulp_of_the_exact_value_over_its_condition():
    found = np.array([[1.0 + 2.0**-51, 0.5, 0.0, 0.0]])
    exact = [((1.0, 0.5, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))]
    off = errors(found, exact, "float64")
    np.testing.assert_array_equal(off.componentwise, [[1.0, 0.0, 0.0, 0.0]])
    np.testing.assert_array_equal(off.normwise, [1.0])


def test_what_should_be_nothing_has_no_ulp_to_hide_in():
    off = errors(np.array([[1.0, 1e-17, 0.0, 0.0]]), [((1, 0, 0, 0), (0, 0, 0, 0))], "float64")
    assert off.componentwise.max() > 1e300
    assert off.normwise[0] < 0.1


def test_what_is_not_finite_is_infinitely_wrong():
    off = errors(np.array([[np.nan, 0, 0, 0]]), [((1, 0, 0, 0), (0, 0, 0, 0))], "float64")
    assert np.isinf(off.componentwise[0, 0])
    assert np.isinf(off.normwise[0])


def test_the_unit_is_that_of_the_precision():
    found = np.array([[1.0 + 2.0**-23, 0, 0, 0]], "float32")
    exact = [((1, 0, 0, 0), (0, 0, 0, 0))]
    assert errors(found, exact, "float32").componentwise[0, 0] == 1.0
    assert errors(found.astype(float), exact, "float64").componentwise[0, 0] == 2.0**29
