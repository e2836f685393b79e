"""Spectra between their samples and beyond them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.paths.format.spectrum_tables import spectrum_of, spectrum_table
from tables import rows

GRID = np.array([400e-9, 500e-9, 600e-9])
BOTH_ENDS = [(np.maximum, slice(None, -1)), (np.minimum, slice(1, None))]


@st.composite
def edges(draw, least=350.0, most=800.0):
    inner = draw(st.lists(st.floats(least + 1e-3, most - 1e-3), max_size=30, unique=True))
    places = np.unique([least, *np.round(inner, 6), most])
    return places * 1e-9


@given(edges(), edges(), st.integers(0, 2**32 - 1), st.floats(350.0, 800.0))
def test_other_bins_get_what_overlaps_and_keep_all_power(old, new, seed, place):
    powers = np.random.default_rng(seed).uniform(0.0, 10.0, old.size - 1)
    found = op.Spectrum.histogram(old, powers).rebin(new).powers
    assert found.sum() == pytest.approx(powers.sum(), rel=1e-14)
    low, high = (pick(old[part, None], new[None, part]) for pick, part in BOTH_ENDS)
    expected = powers @ (np.maximum(high - low, 0.0) / np.diff(old)[:, None])
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)
    of_line = op.Spectrum.line(place * 1e-9, power=3.0).rebin(new).powers
    assert sorted(of_line)[-1] == of_line.sum() == 3.0


def test_bins_have_the_integrals_of_lines_and_of_error_functions_and_samples_keep_values():
    lamp = op.Spectrum.sampled([4e-7, 5e-7, 6e-7], [0.0, 2.0, 0.0])
    found = lamp.rebin([4e-7, 4.5e-7, 5.5e-7, 6e-7]).powers
    np.testing.assert_allclose(found, [25.0, 150.0, 25.0], rtol=1e-12)
    led = op.Spectrum.led("530 nm", "30 nm")
    places = op.wavelengths("480 nm", "580 nm", "10 nm")
    np.testing.assert_array_equal(led.resample(places).values, led.at(places))
    special = pytest.importorskip("scipy.special")
    places = np.array([500.0, 520.0, 530.0, 600.0])
    sigma = 30.0 / (2.0 * np.sqrt(2.0 * np.log(2.0)))
    expected = np.diff(special.ndtr((places - 530.0) / sigma))
    found = op.Spectrum.led("530 nm", "30 nm").rebin(places * 1e-9).powers
    np.testing.assert_allclose(found, expected, rtol=1e-12)


BINS = op.Spectrum.histogram([4e-7, 5e-7, 6e-7], [1.0, 4.0])
LASER = op.Spectrum.line("633 nm", 2.0)
SAMPLES = op.Spectrum.sampled([4e-7, 5e-7], [1.0, 3.0])


@rows(
    "make, told",
    [
        (lambda: BINS.rebin([4e-7, 5e-7]), "a power of 4 beyond the bins.*outside='drop'"),
        (lambda: LASER.rebin([4e-7, 5e-7]), "a power of 2 beyond"),
        (lambda: BINS.rebin([4e-7, 7e-7]), r"400 nm .. 600 nm"),
        (lambda: LASER.resample([5e-7, 6e-7]), r"spectrum.rebin\(edges\)"),
        (
            lambda: SAMPLES.resample([3e-7, 5e-7], outside=0.0),
            r"outside=0.0 where the spectrum is made.*new samples",
        ),
    ],
)
def test_what_cannot_be_resampled_is_refused(make, told):
    with pytest.raises(op.ValueFault, match=told):
        make()


def test_what_is_beyond_new_bins_may_be_dropped_and_what_is_beyond_old_ones_be_0():
    assert BINS.rebin([4e-7, 5e-7], outside="drop").powers == pytest.approx([1.0])
    assert LASER.rebin([4e-7, 5e-7], outside="drop").powers == [0.0]
    wider = op.Spectrum.histogram([4e-7, 5e-7], [1.0], outside=0.0).rebin([3e-7, 5e-7, 6e-7])
    assert wider.powers == pytest.approx([1.0, 0.0])
    # Now it is known that nothing else is there.
    assert wider.at("700 nm") == 0.0
    known = op.Spectrum.sampled([4e-7, 5e-7], [1.0, 3.0], outside=0.0)
    assert known.resample([3e-7, 5e-7], outside=0.0).values.tolist() == [0.0, 3.0]


def test_a_spectrum_is_made_of_wavelengths_and_values_and_kept_by_presets(tmp_path):
    places, values = ["400 nm", "600 nm"], [1.0, 3.0]
    lamp = op.Spectrum(places, values, outside=0.0, name="lamp")
    assert lamp == op.Spectrum.sampled(places, values, outside=0.0, name="lamp")
    assert lamp.at("500 nm") == pytest.approx(2.0, rel=1e-14)
    lamp = op.Spectrum(GRID, [2.0, 1.0, 3.0], outside="linear", name="lamp")
    file = tmp_path / "lamp.toml"
    file.write_text((op.Source(spectrum=lamp) >> op.Detector()).to_toml())
    found = op.load_preset(file).trace(wavelength="700 nm").intensity
    assert found == pytest.approx(5.0, rel=1e-12)


@rows(
    "make, told",
    [
        (lambda: op.Spectrum([1, 2]), "is not made of"),
        (lambda: op.Spectrum(GRID, [1.0, 2.0]), "3 wavelengths and 2"),
        (lambda: op.Spectrum(GRID, [1.0, -2.0, 0.0]), "0 or more"),
        (lambda: op.Spectrum(GRID, GRID, outside="near"), "'nearest' and 'linear'"),
        (lambda: op.Spectrum.sampled(GRID, None), "value"),
        (lambda: op.Spectrum.histogram(GRID, [1, 2], outside="linear"), "leave it out"),
    ],
)
def test_a_spectrum_of_something_else_is_refused(make, told):
    with pytest.raises(op.OptipathError, match=told):
        make()


FAR = np.array([300e-9, 380e-9, 450e-9, 700e-9])


@rows(
    "outside, values, expected",
    [
        (0.0, [2.0, 1.0, 3.0], [0.0, 0.0, 1.5, 0.0]),
        ("nearest", [2.0, 1.0, 3.0], [2.0, 2.0, 1.5, 3.0]),
        ("linear", [2.0, 1.0, 3.0], [3.0, 2.2, 1.5, 5.0]),
        ("linear", [0.5, 1.0, 0.2], [0.0, 0.4, 0.75, 0.0]),
    ],
)
def test_what_a_sampled_spectrum_is_beyond_its_samples(outside, values, expected):
    lamp = op.Spectrum(GRID, values, outside=outside)
    again = spectrum_of(spectrum_table(lamp))
    assert again == lamp
    for spectrum in (lamp, again):
        np.testing.assert_allclose(spectrum.at(FAR), expected, rtol=1e-12, atol=1e-12)
    with pytest.raises(op.OptipathError, match="outside='nearest'"):
        op.Spectrum(GRID, values).at(FAR)


def test_what_goes_on_beyond_samples_is_counted_and_computed_with_there():
    lamp = op.Spectrum(GRID, [0.5, 1.0, 0.2], outside="linear")
    # It is 0 from 625 nm on.
    assert lamp.power("600 nm", "900 nm") == pytest.approx(0.5 * 25 * 0.2, rel=1e-9)
    with pytest.raises(op.ValueFault, match="does not end"):
        lamp.power()
    far = np.array([300e-9, 700e-9, 900e-9])
    first = op.Spectrum(GRID, [0.5, 1.0, 0.2], outside="linear")
    second = op.Spectrum(GRID, [1.0, 1.0, 1.5], outside="linear")
    np.testing.assert_allclose((first + second).at(far), first.at(far) + second.at(far))
    np.testing.assert_allclose((2 * first).at(far), 2 * first.at(far))
    np.testing.assert_allclose((first * op.Spectrum.constant(3)).at(far), 3 * first.at(far))


def test_a_product_has_the_samples_of_both():
    lamp = op.Spectrum(["400 nm", "500 nm", "700 nm"], [1.0, 2.0, 0.0])
    glass = op.Spectrum(["450 nm", "600 nm", "800 nm"], [0.2, 0.8, 0.4])
    seen = lamp * glass
    np.testing.assert_allclose(seen.wavelengths * 1e9, [450, 500, 600, 700])
    np.testing.assert_allclose(seen.values, [0.3, 0.8, 0.8, 0.0], rtol=1e-12, atol=1e-12)
    # Trapezoids.
    assert seen.power() == pytest.approx(50 * 0.55 + 100 * 0.8 + 100 * 0.4, rel=1e-12)
    ratio = glass / op.Spectrum(["400 nm", "700 nm"], [1.0, 4.0])
    np.testing.assert_allclose(ratio.at("600 nm"), 0.8 / 3.0, rtol=1e-12)
    first, second = ([f"{low} nm", f"{low + 50} nm"] for low in (400, 500))
    with pytest.raises(op.ValueFault, match="no wavelength in common"):
        op.Spectrum(first, [1, 1]) * op.Spectrum(second, [1, 1])
    dark = op.Spectrum(first, [1, 1], outside=0.0) * op.Spectrum(second, [1, 1], outside=0.0)
    assert dark.at("520 nm") == 0.0


@rows(
    "one, other, at, expected",
    [
        (0.0, 0.0, "500 nm", [0.0, 2.0 * 4.0, 0.0]),
        ("nearest", "nearest", "450 nm", [1.0 * 3.0, 1.5 * 3.0, 2.0 * 6.0]),
        ("nearest", 0.0, "500 nm", [0.0, 2.0 * 4.0, 0.0]),
        (None, "nearest", "", []),
        ("linear", "nearest", "", []),
    ],
)
def test_a_product_is_known_beyond_samples_where_both_say_so(one, other, at, expected):
    first = op.Spectrum(["400 nm", "500 nm"], [1.0, 2.0], outside=one)
    second = op.Spectrum(["450 nm", "600 nm"], [3.0, 6.0], outside=other)
    for seen in (first * second, second * first):
        if at:
            np.testing.assert_allclose(seen.at(["350 nm", at, "700 nm"]), expected, rtol=1e-12)
        else:
            with pytest.raises(op.OptipathError, match="is known"):
                seen.at("700 nm")


def test_a_diode_between_coarse_samples_keeps_its_power():
    coarse = op.Spectrum(["380 nm", "550 nm", "700 nm"], [0.1, 0.9, 0.3])
    # A straight line from 0.1 at 380 nm to 0.9 at 550 nm, by what is even around 450 nm.
    expected = 0.1 + 0.8 * 70.0 / 170.0
    for width in ("20 nm", "1 nm", "0.001 nm"):
        led = op.Spectrum.led("450 nm", width)
        for seen in (coarse * led, led * coarse, (led + op.Spectrum.constant(0.0)) * coarse):
            assert seen.power() == pytest.approx(expected, rel=1e-5)
    far = coarse * op.Spectrum.led("900 nm", "20 nm")
    np.testing.assert_array_equal(far.wavelengths, coarse.wavelengths)
