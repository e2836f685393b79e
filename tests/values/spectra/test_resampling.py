"""Other samples keep values, other bins keep power."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op


@st.composite
def edges(draw, least=350.0, most=800.0):
    inner = draw(st.lists(st.floats(least + 1e-3, most - 1e-3), max_size=30, unique=True))
    places = np.unique([least, *np.round(inner, 6), most])
    return places * 1e-9


@given(edges(), edges(), st.integers(0, 2**32 - 1))
def test_other_bins_keep_the_power_of_a_histogram(old, new, seed):
    powers = np.random.default_rng(seed).uniform(0.0, 10.0, old.size - 1)
    found = op.Spectrum.histogram(old, powers).rebin(new)
    assert found.powers.sum() == pytest.approx(powers.sum(), rel=1e-14)


@given(edges(), edges())
def test_other_bins_get_what_overlaps(old, new):
    powers = np.arange(1.0, old.size)
    found = op.Spectrum.histogram(old, powers).rebin(new).powers
    low = np.maximum(old[:-1, None], new[None, :-1])
    high = np.minimum(old[1:, None], new[None, 1:])
    shares = np.maximum(high - low, 0.0) / np.diff(old)[:, None]
    expected = powers @ shares
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@given(edges(), st.floats(350.0, 800.0))
def test_a_line_is_in_one_bin_with_all_its_power(new, place):
    found = op.Spectrum.line(place * 1e-9, power=3.0).rebin(new).powers
    assert sorted(found)[-1] == 3.0
    assert found.sum() == 3.0


def test_bins_of_samples_have_the_integral_of_straight_lines():
    lamp = op.Spectrum.sampled([4e-7, 5e-7, 6e-7], [0.0, 2.0, 0.0])
    found = lamp.rebin([4e-7, 4.5e-7, 5.5e-7, 6e-7]).powers
    np.testing.assert_allclose(found, [25.0, 150.0, 25.0], rtol=1e-12)


def test_bins_of_a_diode_are_differences_of_its_error_function():
    special = pytest.importorskip("scipy.special")
    places = np.array([500.0, 520.0, 530.0, 600.0])
    sigma = 30.0 / (2.0 * np.sqrt(2.0 * np.log(2.0)))
    expected = np.diff(special.ndtr((places - 530.0) / sigma))
    found = op.Spectrum.led("530 nm", "30 nm").rebin(places * 1e-9).powers
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_samples_keep_values():
    led = op.Spectrum.led("530 nm", "30 nm")
    places = op.wavelengths("480 nm", "580 nm", "10 nm")
    np.testing.assert_array_equal(led.resample(places).values, led.at(places))


def test_power_beyond_new_bins_is_refused_or_dropped():
    lamp = op.Spectrum.histogram([4e-7, 5e-7, 6e-7], [1.0, 4.0])
    with pytest.raises(op.ValueFault, match=r"a power of 4 beyond the bins.*outside='drop'"):
        lamp.rebin([4e-7, 5e-7])
    assert lamp.rebin([4e-7, 5e-7], outside="drop").powers == pytest.approx([1.0])
    laser = op.Spectrum.line("633 nm", 2.0)
    with pytest.raises(op.ValueFault, match="a power of 2 beyond"):
        laser.rebin([4e-7, 5e-7])
    assert laser.rebin([4e-7, 5e-7], outside="drop").powers == [0.0]


def test_bins_beyond_what_is_known_are_refused():
    lamp = op.Spectrum.histogram([4e-7, 5e-7], [1.0])
    with pytest.raises(op.ValueFault, match=r"400 nm .. 500 nm"):
        lamp.rebin([4e-7, 6e-7])
    wider = op.Spectrum.histogram([4e-7, 5e-7], [1.0], outside=0.0).rebin([3e-7, 5e-7, 6e-7])
    assert wider.powers == pytest.approx([1.0, 0.0])
    # Now it is known that nothing else is there.
    assert wider.at("700 nm") == 0.0


def test_lines_are_not_resampled():
    with pytest.raises(op.ValueFault, match=r"spectrum.rebin\(edges\)"):
        op.Spectrum.line("633 nm").resample([5e-7, 6e-7])


def test_outside_of_resample_is_not_taken_for_that_of_the_spectrum():
    lamp = op.Spectrum.sampled([4e-7, 5e-7], [1.0, 3.0])
    with pytest.raises(op.ValueFault, match=r"outside=0.0 where the spectrum is made.*new samples"):
        lamp.resample([3e-7, 5e-7], outside=0.0)
    known = op.Spectrum.sampled([4e-7, 5e-7], [1.0, 3.0], outside=0.0)
    assert known.resample([3e-7, 5e-7], outside=0.0).values.tolist() == [0.0, 3.0]
