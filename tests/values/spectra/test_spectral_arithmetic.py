"""Sums, products and quotients of spectra."""

from __future__ import annotations

import numpy as np
import pytest

import optipath as op
from tables import rows

PLACES = op.wavelengths("400 nm", "700 nm", "50 nm")
LAMP = op.Spectrum.sampled(PLACES, np.linspace(1.0, 4.0, 7))
FINE = LAMP.resample(op.wavelengths("400 nm", "700 nm", "5 nm"))
BINS = op.Spectrum.histogram(PLACES, np.arange(6.0))
LASER = op.Spectrum.line("633 nm", 2.0)
LED = op.Spectrum.led("530 nm", "30 nm")
KINDS = [LAMP, BINS, LED, op.Spectrum.black_body(3000.0), op.Spectrum.illuminant("A")]
BETWEEN = np.linspace(405e-9, 695e-9, 17)


@rows("first", KINDS)
@rows("second", KINDS)
def test_sums_are_sums_at_each_wavelength(first, second):
    expected = first.at(BETWEEN) + second.at(BETWEEN)
    np.testing.assert_allclose((first + second).at(BETWEEN), expected, rtol=1e-14)


@rows("spectrum", [*KINDS, LASER, LAMP + LASER, op.Spectrum.constant(3.0)])
def test_multiples_have_as_much_more_power(spectrum):
    whole = spectrum.power("400 nm", "700 nm")
    for multiple in (2.5 * spectrum, spectrum * 2.5, spectrum / 0.4):
        assert multiple.power("400 nm", "700 nm") == pytest.approx(2.5 * whole, rel=1e-13)


def test_bins_that_are_added_stay_bins():
    np.testing.assert_array_equal((BINS + BINS).powers, 2.0 * BINS.powers)


def test_lines_beside_a_lamp_keep_their_power():
    both = LAMP + LASER
    assert both.power() == pytest.approx(LAMP.power() + 2.0, rel=1e-14)
    assert both.rebin(PLACES).powers.sum() == pytest.approx(both.power(), rel=1e-14)


def test_samples_are_multiplied_and_divided_one_by_one():
    np.testing.assert_array_equal((LAMP * LAMP).values, LAMP.values**2)
    at_fine = LED.at(FINE.wavelengths)
    np.testing.assert_allclose((FINE * LED).values, FINE.values * at_fine, rtol=1e-15)
    np.testing.assert_allclose((FINE * LED / FINE).values, at_fine, rtol=1e-14)
    np.testing.assert_allclose((1.0 / LAMP).values, 1.0 / LAMP.values, rtol=1e-15)


def test_a_line_behind_a_filter_has_its_power_times_the_value_there():
    seen = LASER * LAMP
    assert seen.power() == pytest.approx(2.0 * float(LAMP.at("633 nm")), rel=1e-14)
    assert (FINE * (LASER + LED)).power() == pytest.approx(
        seen.power() + (FINE * LED).power(), rel=1e-13
    )


@rows(
    "make, sentence",
    [
        (lambda: BINS * LASER, "a histogram is power in bins"),
        (lambda: LASER * LASER, "the line at 633 nm is power at single wavelengths"),
        (lambda: LASER / LAMP, r"spectrum.rebin\(edges\)"),
        (lambda: LAMP / LASER, "cannot be divided"),
        (lambda: BINS * LAMP, r"spectrum.resample\(op.wavelengths"),
        (lambda: LED * LED, "have no samples"),
        (lambda: LAMP / (0.0 * LAMP), "is 0 at 400 nm, where nothing can be divided"),
        (lambda: LAMP * -1.0, "give a real number of 0 or more"),
        (lambda: LAMP / 0.0, "a divisor of"),
        (lambda: np.ones(2) * LAMP, "must be one number"),
        (lambda: LAMP * 1e308 * 10.0, "inf at"),
        (
            lambda: LAMP + op.Spectrum.sampled([2e-7, 3e-7], [1.0, 1.0]),
            "no wavelength in common; give outside=0.0",
        ),
    ],
)
def test_what_does_not_fit_is_refused_with_the_cure(make, sentence):
    with pytest.raises(op.ValueFault, match=sentence):
        make()


def test_the_sum_of_a_list_of_spectra_is_their_sum():
    assert sum([LAMP, LED, LASER]) == LAMP + LED + LASER


@rows(
    "make, sentence",
    [
        (lambda: LASER - LED, r"power of the line at 633 nm is no spectrum.*\.at\("),
        (lambda: 1.0 - LED, r"power of the diode at 530 nm is no spectrum"),
        (lambda: np.ones(2) - LED, r"is no spectrum"),
        (lambda: -LED, r"difference .* of the diode at 530 nm is no spectrum, .* below 0"),
        (lambda: LED**2, r"power of the diode at 530 nm is no spectrum, .*; compute with its numb"),
        (lambda: 2**LED, r"power of the diode at 530 nm is no spectrum"),
        (lambda: LED + 1.5, r"add a spectrum, such as Spectrum.constant\(1.5\)"),
        (lambda: 1 + LED, r"add a spectrum, such as Spectrum.constant\(1.0\)"),
        (lambda: LED + "a lamp", r"'a lamp' is no spectrum; add a spectrum"),
        (lambda: np.ones(2) + LED, "is no spectrum; add a spectrum"),
    ],
)
def test_what_is_no_spectrum_is_refused_with_what_is_one(make, sentence):
    with pytest.raises(op.ValueFault, match=sentence):
        make()


def test_equal_spectra_are_equal():
    assert op.Spectrum.line("633 nm") == op.Spectrum.line(633e-9)
    assert op.Spectrum.illuminant("A") != op.Spectrum.illuminant("E")
