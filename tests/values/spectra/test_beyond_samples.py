"""Sampled spectra beyond their samples, and products of those of other samples."""

import numpy as np
import pytest

import optipath as op
from optipath.paths.format.spectrum_tables import spectrum_of, spectrum_table

GRID = np.array([400e-9, 500e-9, 600e-9])


def test_a_spectrum_is_made_of_wavelengths_and_values():
    lamp = op.Spectrum(["400 nm", "600 nm"], [1.0, 3.0], outside=0.0, name="lamp")
    assert lamp == op.Spectrum.sampled(["400 nm", "600 nm"], [1.0, 3.0], outside=0.0, name="lamp")
    assert lamp.at("500 nm") == pytest.approx(2.0, rel=1e-14)


def test_a_spectrum_of_something_else_is_refused():
    rows = [
        (lambda: op.Spectrum([1, 2]), "is not made of"),
        (lambda: op.Spectrum(GRID, [1.0, 2.0]), "3 wavelengths and 2"),
        (lambda: op.Spectrum(GRID, [1.0, -2.0, 0.0]), "0 or more"),
        (lambda: op.Spectrum(GRID, GRID, outside="near"), "'nearest' and 'linear'"),
        (lambda: op.Spectrum.sampled(GRID, None), "value"),
        (lambda: op.Spectrum.histogram(GRID, [1, 2], outside="linear"), "leave it out"),
    ]
    for make, told in rows:
        with pytest.raises(op.OptipathError, match=told):
            make()


def test_what_a_sampled_spectrum_is_beyond_its_samples():
    far = np.array([300e-9, 380e-9, 450e-9, 700e-9])
    rows = [
        (0.0, [2.0, 1.0, 3.0], [0.0, 0.0, 1.5, 0.0]),
        ("nearest", [2.0, 1.0, 3.0], [2.0, 2.0, 1.5, 3.0]),
        ("linear", [2.0, 1.0, 3.0], [3.0, 2.2, 1.5, 5.0]),
        ("linear", [0.5, 1.0, 0.2], [0.0, 0.4, 0.75, 0.0]),
    ]
    for outside, values, expected in rows:
        lamp = op.Spectrum(GRID, values, outside=outside)
        np.testing.assert_allclose(lamp.at(far), expected, rtol=1e-12, atol=1e-12)
        again = spectrum_of(spectrum_table(lamp))
        assert again == lamp
        np.testing.assert_allclose(again.at(far), expected, rtol=1e-12, atol=1e-12)
    with pytest.raises(op.OptipathError, match="outside='nearest'"):
        op.Spectrum(GRID, [2.0, 1.0, 3.0]).at(far)


def test_the_power_of_a_line_that_goes_on_ends_where_it_is_0():
    lamp = op.Spectrum(GRID, [0.5, 1.0, 0.2], outside="linear")
    # It is 0 from 625 nm on.
    assert lamp.power("600 nm", "900 nm") == pytest.approx(0.5 * 25 * 0.2, rel=1e-9)
    with pytest.raises(op.ValueFault, match="does not end"):
        lamp.power()


def test_sums_and_multiples_are_right_beyond_samples():
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


def test_a_product_is_known_beyond_samples_where_both_say_so():
    short, long = ["400 nm", "500 nm"], ["450 nm", "600 nm"]
    rows = [
        (0.0, 0.0, [0.0, 2.0 * 4.0, 0.0]),
        ("nearest", "nearest", [1.0 * 3.0, 1.5 * 3.0, 2.0 * 6.0]),
        ("nearest", 0.0, [0.0, 2.0 * 4.0, 0.0]),
        (None, "nearest", None),
        ("linear", "nearest", None),
    ]
    for one, other, expected in rows:
        first = op.Spectrum(short, [1.0, 2.0], outside=one)
        second = op.Spectrum(long, [3.0, 6.0], outside=other)
        for seen in (first * second, second * first):
            if expected is None:
                with pytest.raises(op.OptipathError, match="is known"):
                    seen.at("700 nm")
            else:
                places = [["350 nm", "500 nm", "700 nm"], ["350 nm", "450 nm", "700 nm"]]
                at = places[one == other == "nearest"]
                np.testing.assert_allclose(seen.at(at), expected, rtol=1e-12)


def test_spectra_with_nothing_in_common():
    first, second = ([f"{low} nm", f"{low + 50} nm"] for low in (400, 500))
    with pytest.raises(op.ValueFault, match="no wavelength in common"):
        op.Spectrum(first, [1, 1]) * op.Spectrum(second, [1, 1])
    dark = op.Spectrum(first, [1, 1], outside=0.0) * op.Spectrum(second, [1, 1], outside=0.0)
    assert dark.at("520 nm") == 0.0


def test_a_preset_keeps_what_is_beyond_samples(tmp_path):
    lamp = op.Spectrum(GRID, [2.0, 1.0, 3.0], outside="linear", name="lamp")
    path = op.Source(spectrum=lamp) >> op.Detector()
    file = tmp_path / "lamp.toml"
    file.write_text(path.to_toml())
    again = op.load_preset(file)
    assert again.trace(wavelength="700 nm").intensity == pytest.approx(5.0, rel=1e-12)


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
