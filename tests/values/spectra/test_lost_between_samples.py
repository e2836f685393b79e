"""A diode does not get lost between the samples by which it is multiplied."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op

COARSE = op.Spectrum.sampled(["380 nm", "550 nm", "700 nm"], [0.1, 0.9, 0.3])


def cured(spectrum, error):
    """Return a spectrum as the sentence has it."""
    code = re.search(r"spectrum\.resample\(.*\)$", error.faults[0])[0]
    return eval(code, {"spectrum": spectrum, "np": np, "op": op})  # noqa: S307 - it is our own


def refusal(make):
    with pytest.raises(op.ValueFault, match="is lost between the samples of a sampled") as caught:
        make()
    return caught.value


def test_a_diode_between_coarse_samples_is_refused_with_a_cure_that_works():
    led = op.Spectrum.led("450 nm", "20 nm")
    fine = cured(COARSE, refusal(lambda: COARSE * led))
    # A straight line from 0.1 at 380 nm to 0.9 at 550 nm, by what is even around 450 nm.
    expected = 0.1 + 0.8 * 70.0 / 170.0
    assert (fine * led).power() == pytest.approx(expected, rel=1e-7)
    assert (led * fine).power() == (fine * led).power()


def test_a_diode_is_lost_as_well_where_it_is_divided_or_one_of_several():
    led = op.Spectrum.led("450 nm", "20 nm")
    warm = op.Spectrum.black_body(2856.0)
    for make in (lambda: led / COARSE, lambda: COARSE / led, lambda: COARSE * (warm + led)):
        refusal(make)


def test_what_is_0_outside_stays_so():
    led = op.Spectrum.led("450 nm", "20 nm")
    ends = op.Spectrum.sampled(["380 nm", "550 nm"], [0.5, 0.5], outside=0.0)
    assert (cured(ends, refusal(lambda: ends * led)) * led).power() == pytest.approx(0.5, rel=1e-7)


def test_smooth_wide_spectra_and_far_diodes_are_multiplied_at_coarse_samples():
    for smooth in (
        op.Spectrum.black_body(2856.0),
        op.Spectrum.illuminant("A"),
        op.Spectrum.led("550 nm", "800 nm"),
        op.Spectrum.led("900 nm", "20 nm"),
    ):
        expected = COARSE.values * smooth.at(COARSE.wavelengths)
        np.testing.assert_array_equal((COARSE * smooth).values, expected)


@given(
    low=st.floats(200.0, 500.0),
    gaps=st.lists(st.floats(0.01, 300.0), min_size=1, max_size=4),
    share=st.floats(-0.1, 1.1),
    width=st.floats(1e-3, 100.0),
)
def test_the_cure_works_for_any_samples(low, gaps, share, width):
    places = 1e-9 * np.cumsum([low, *gaps])
    led = op.Spectrum.led(float(places[0] + share * (places[-1] - places[0])), 1e-9 * width)
    table = op.Spectrum.sampled(places, np.arange(1.0, len(places) + 1))
    try:
        table * led
    except op.ValueFault as error:
        fine = cured(table, error)
        assert set(table.wavelengths) <= set(fine.wavelengths)
        fine * led
