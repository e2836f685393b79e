"""Curves through samples."""

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optipath.errors import ValueFault
from optipath.values.curves.tabulated import Tabulated
from tables import rows

PLACES = np.array([188e-9, 300e-9, 310e-9, 500e-9, 1.2e-6])
N = np.array([1.3, 1.8, 1.7, 0.9, 0.2])
K = np.array([1.1, 1.9, 1.9, 2.2, 8.0])
FINE = np.linspace(PLACES[0], PLACES[-1], 1001)


def table(interpolation="linear", extrapolate="", n=N, k=K):
    names = {"interpolation": interpolation, "extrapolate": extrapolate}
    return Tabulated("gold", ("n", "k"), PLACES, [n, k], **names)


def rising(count):
    steps = st.lists(st.floats(1e-10, 1e-6), min_size=count, max_size=count)
    return steps.map(lambda each: 1e-7 + np.cumsum(each))


@rows("interpolation", ["linear", "monotone"])
def test_samples_are_exact_and_a_wavelength_comes_to_the_same_bits_alone(interpolation):
    curve = table(interpolation)
    assert np.array_equal(curve.evaluated(PLACES), [N, K])
    alone = [curve.evaluated(wavelength)[1] for wavelength in FINE[::3]]
    assert np.array_equal(curve.evaluated(FINE[::3])[1], alone)


def test_between_samples_it_is_a_straight_line():
    expected = [np.interp(FINE, PLACES, column) for column in (N, K)]
    np.testing.assert_allclose(table().evaluated(FINE), expected, rtol=3e-15)
    assert np.all(table(n=np.full(5, 1.1)).evaluated(FINE)[0] == 1.1)


@pytest.mark.parametrize("extrapolate", ["", "nearest", "linear"])
def test_monotone_curves_are_those_of_scipy(extrapolate):
    oracle = pytest.importorskip("scipy.interpolate").PchipInterpolator
    found = table("monotone", extrapolate).evaluated(FINE)
    np.testing.assert_allclose(found, oracle(PLACES, [N, K], axis=1)(FINE), rtol=1e-13)


@given(rising(7), st.lists(st.floats(-5.0, 5.0), min_size=7, max_size=7))
def test_monotone_curves_stay_between_their_samples(places, values):
    curve = Tabulated("x", ("value",), places, [values], interpolation="monotone")
    for at in range(6):
        between = np.linspace(places[at], places[at + 1], 31)
        (found,) = curve.evaluated(between)
        low, high = sorted(values[at : at + 2])
        assert np.all((found >= low - 1e-13) & (found <= high + 1e-13))


@rows("interpolation", ["linear", "monotone"])
def test_slopes_by_jax_are_those_of_differences(jax, interpolation):
    curve = table(interpolation)
    slope = jax.grad(lambda w: curve.numbers(jax.numpy, w)[1])
    for wavelength in (2e-7, 2.9e-7, 3.02e-7, 3.05e-7, 4.9e-7, 1.1e-6):
        step = 1e-13
        ahead, back = [curve.evaluated(wavelength + s)[1] for s in (step, -step)]
        expected = (ahead - back) / (2.0 * step)
        assert float(slope(wavelength)) == pytest.approx(float(expected), rel=1e-5, abs=10.0)


def test_beyond_its_samples_it_is_the_nearest_one_or_the_line_goes_on():
    beyond = np.array([100e-9, 2e-6])
    assert np.array_equal(table(extrapolate="nearest").evaluated(beyond)[0], N[[0, -1]])
    n, _ = table(extrapolate="linear").evaluated(beyond)
    ends = [1.3 - 88.0 * 0.5 / 112.0, 0.2 - 800.0 * 0.7 / 700.0]
    np.testing.assert_allclose(n, ends, rtol=1e-13)
    assert table().span == (188e-9, 1.2e-6)
    assert table(extrapolate="linear").span == (0.0, np.inf)
    curve = Tabulated("line", ("n",), [633e-9], [[1.5]], extrapolate="nearest")
    assert curve.evaluated([500e-9, 633e-9, 700e-9])[0].tolist() == [1.5] * 3
    oracle = pytest.importorskip("scipy.interpolate").PchipInterpolator(PLACES, K)
    _, k = table("monotone", "linear").evaluated(2e-6)
    assert float(k) == pytest.approx(8.0 + 0.8e-6 * oracle(1.2e-6, 1), rel=1e-12)


def test_equal_samples_are_equal_curves_whether_they_rise_or_fall():
    assert Tabulated("gold", ("n", "k"), PLACES[::-1], [N[::-1], K[::-1]]) == table()
    energies = Tabulated("x", ("n",), ["2 eV", "3 eV"], [[1.0, 2.0]])
    assert energies.evaluated(energies.wavelengths)[0].tolist() == [2.0, 1.0]
    assert (table(), hash(table())) == (table(), hash(table()))
    assert table().digest != table("monotone").digest
    assert pickle.loads(pickle.dumps(table())) == table()


@rows(
    "wavelengths, n, words",
    [
        ([500, 600], [1, 2], "500 metres, which is no wavelength of light"),
        ([5e-7, 5e-7], [1, 2], "has the wavelength 500 nm twice"),
        ([5e-7, 7e-7, 6e-7], [1, 2, 3], "neither rise nor fall throughout: 600 nm stands behind"),
        ([5e-7, np.nan], [1, 2], "wavelengths of gold: nan at 1 is no number"),
        ([5e-7, 6e-7], [1, np.nan], "n of gold: nan at 1 is"),
        ([5e-7, 6e-7], [1, 2, 3], "has 2 wavelengths and 3 of n"),
        ([-1.0, 6e-7], [1, 2], "a wavelength of gold is -1; give lengths above 0"),
        (["5 kg", 6e-7], [1, 2], "unit 'kg' of '5 kg' is unknown"),
        ([], [], "row of real numbers, not of shape (0,)"),
        ([5e-7], ["red"], "n of gold: 'red'"),
        ([5e-7, 6e-7], [1, 2j], "n of gold must be a row of real numbers"),
    ],
)
def test_samples_that_are_wrong_are_refused_in_words_all_at_once(wavelengths, n, words):
    with pytest.raises(ValueFault) as fault:
        Tabulated("gold", ("n",), wavelengths, [n])
    assert words in str(fault.value)
    with pytest.raises(ValueFault) as fault:
        Tabulated("gold", ("n",), [np.nan], [[np.inf]], interpolation="cubic", extrapolate="no")
    assert len(fault.value.faults) == 4
