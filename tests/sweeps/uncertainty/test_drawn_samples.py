import tracemalloc

import numpy as np
import pytest

import optipath as op
from optipath.sweeps.uncertainty.drawn_samples import DrawnSamples
from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

ALL = np.inf


def value(name, low=-ALL, high=ALL, at=0.0, sigma=1.0):
    return UncertainValue(name, np.array(at), np.array(sigma), low, high, "")


def drawn(values, places, correlation=None, count=5_000, block=None):
    correlation = np.eye(len(values)) if correlation is None else np.asarray(correlation)
    samples = DrawnSamples(values, correlation, places, count, 1, 0)
    return samples.within(block or slice(0, count), [each.name for each in values])


def test_another_value_leaves_the_samples_of_the_others_as_they_were():
    a, b, c = value("a"), value("b", low=0.0), value("c", high=0.0)
    alone = drawn([b], [1])["b"]
    for values, places in ([[a, b, c], [0, 1, 2]], [[c, b], [2, 1]]):
        np.testing.assert_array_equal(drawn(values, places)["b"], alone)


def test_correlated_values_have_one_set_of_samples_in_whatever_order():
    a, b, c = value("a"), value("b", low=0.0), value("c")
    matrix = np.array([[1.0, 0.5, 0.0], [0.5, 1.0, 0.3], [0.0, 0.3, 1.0]])
    found, again = (
        drawn([a, b, c], [4, 2, 7], matrix),
        drawn([c, b, a], [7, 2, 4], matrix[::-1, ::-1]),
    )
    for name in "abc":
        np.testing.assert_array_equal(found[name], again[name])
    assert found["b"].min() >= 0.0


def test_a_block_is_a_part_of_the_whole():
    values = [value("a", low=0.0), value("b")]
    whole = drawn(values, [0, 1], count=10_000)
    part = drawn(values, [0, 1], count=10_000, block=slice(4_000, 9_000))
    for name in "ab":
        np.testing.assert_array_equal(part[name], whole[name][4_000:9_000])


def test_values_at_the_ends_of_their_ranges_are_drawn_each_by_itself():
    # Of 30 half-normals 1e-9 of all samples were inside at once.
    values = [value(f"a{number}", low=0.0) for number in range(30)]
    for samples in drawn(values, range(30)).values():
        np.testing.assert_allclose(samples.mean(), np.sqrt(2.0 / np.pi), rtol=0.06)


def test_a_wide_normal_is_cut_off_to_what_is_inside():
    # A tenth of the sigma to both sides: nearly uniform, 8 % inside.
    (samples,) = drawn([value("a", low=-0.1, high=0.1)], [0]).values()
    assert np.abs(samples).max() <= 0.1
    np.testing.assert_allclose(samples.std(), 0.2 / np.sqrt(12.0), rtol=0.03)


def test_next_to_nothing_inside_is_refused():
    with pytest.raises(op.ParameterError, match="hardly any sample of a is within the range"):
        drawn([value("b"), value("a", low=-1e-5, high=1e-5)], [0, 1])


def test_correlated_values_that_are_never_inside_together_are_refused():
    values = [value("a", low=0.0), value("b", low=0.0)]
    with pytest.raises(op.ParameterError, match="hardly any sample of a and b"):
        drawn(values, [0, 1], [[1.0, -1.0], [-1.0, 1.0]])


def test_memory_is_that_of_the_block():
    tracemalloc.start()
    try:
        drawn([value("a", low=0.0)], [0], count=10_000_000, block=slice(5_000_000, 5_000_010))
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()
