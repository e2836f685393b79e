"""Wavelengths: the parameter of a run, units of energy and frequency, and grids with bins."""

import numpy as np
import pytest

import optipath as op
from optipath.errors import UnitError
from optipath.values.spectra.grid_bins import grid_edges, grid_fault, grid_widths
from optipath.values.spectral_units import wavelength_of
from tables import rows


def test_wavelengths_and_their_limits_are_lengths_energies_wave_numbers_and_frequencies():
    given = op.Wavelength().resolve(["516 nm", "2.4 eV", "20000 1/cm", "0.5 um"]).value
    assert given == pytest.approx([516e-9, 516.600827e-9, 500e-9, 500e-9])
    known = op.Wavelength(default="2 eV", minimum="3 eV", maximum="1 eV")
    assert known.default == pytest.approx(619.92e-9, rel=1e-5)
    assert known.minimum == pytest.approx(413.28e-9, rel=1e-5)
    path = op.Source() >> op.Waveplate(1e-5, 0.009, op.Wavelength("probe")) >> op.Detector()
    assert path.trace(probe="516 nm").stokes[0] == 1.0
    # h c / e = 1.239 841 984... e-6 eV m (CODATA 2018, exact).
    assert wavelength_of("1 eV") == pytest.approx(1.239841984332002e-06, rel=1e-15)
    assert wavelength_of("20000 1/cm") == wavelength_of("20000 cm^-1") == pytest.approx(5e-7)
    assert wavelength_of("299.792458 THz") == pytest.approx(1e-6, rel=1e-15)


def test_what_is_no_wavelength_is_refused():
    for kind, given, said in (
        (op.ParameterError, 516, "write '516 nm', or 516e-9"),
        (op.OptipathError, "516", "has no unit"),
        (op.OptipathError, np.nan, "finite"),
        (op.OptipathError, -5e-7, "outside its range"),
        (op.OptipathError, 5e6, "outside"),
        (op.OptipathError, np.float16(48), "48 metres, which is no wavelength"),
        (op.OptipathError, np.zeros(0, complex), "range of reals"),
    ):
        with pytest.raises(kind, match=said):
            op.Wavelength().resolve(given)
    for text in ("0 eV", "-2 eV", "1e999 THz"):
        with pytest.raises(UnitError, match="above 0"):
            wavelength_of(text)
    for text in ("516 nm", "gold", "", "2 eV 3"):  # What has another unit is left to others.
        assert wavelength_of(text) is None


@rows("most, written", [("700 nm", "700 nm"), ("20 um", "20 um"), ("1 mm", "1 mm")])
def test_the_ends_of_a_range_are_told_in_units_of_their_size(most, written):
    wavelength = op.Wavelength(minimum="380 nm", maximum=most)
    with pytest.raises(op.ParameterError, match=f"light goes from 380 nm to {written}$"):
        wavelength.resolve(400)


@rows("text", ["516", "516 deg"])
def test_all_units_of_a_wavelength_are_named_where_one_is_missing(text):
    for read in (op.Wavelength().resolve, op.Material.cauchy([1.5, 0.004]).at, op.Spectrum.line):
        with pytest.raises(
            op.OptipathError, match=r"nm, um, mm, cm, dm, m, angstrom, or eV, 1/cm, THz$"
        ):
            read(text)


def test_a_grid_has_the_numbers_that_its_texts_stand_for():
    found = op.wavelengths("380 nm", "700 nm", "40 nm")
    expected = [op.Wavelength().resolve(f"{place} nm").value for place in range(380, 701, 40)]
    assert found.tolist() == [float(place) for place in expected]
    assert op.wavelengths(4e-7, 5e-7, 5e-8).tolist() == [4e-7, 4.5e-7, 5e-7]


@rows(
    "given, sentence",
    [
        (("380 nm", "700 nm", "45 nm"), "7.11111 steps of 45 nm; .* as up to 695 nm"),
        (("700 nm", "380 nm", "40 nm"), "do not rise"),
        (("380 nm", "700 nm", "0 nm"), "step"),
        ((380, 700, 40), "metres"),
        (("380 nm", "700 nm", "400 nm"), "up to 780 nm"),
    ],
)
def test_steps_that_do_not_fit_are_refused(given, sentence):
    with pytest.raises(op.ValueFault, match=sentence):
        op.wavelengths(*given)


UNEVEN = np.array([380.0, 395.0, 500.0, 512.5, 700.0]) * 1e-9


def test_widths_are_the_weights_of_the_trapezoidal_rule_and_bins_reach_halfway_to_neighbours():
    for grid in (UNEVEN, UNEVEN[::-1]):
        density = np.random.default_rng(7).uniform(0.0, 3.0, grid.size)
        steps = np.abs(np.diff(grid * 1e9))
        expected = np.sum(0.5 * (density[1:] + density[:-1]) * steps)
        assert np.dot(density, grid_widths(grid)) == pytest.approx(expected, rel=1e-14)
    edges = [380.0, 387.5, 447.5, 506.25, 606.25, 700.0]
    np.testing.assert_allclose(grid_edges(UNEVEN), edges, rtol=1e-15)


def test_what_is_no_grid_is_said():
    assert "one wavelength alone" in grid_fault(5e-7)
    assert "none at all" in grid_fault([])
    assert "one wavelength alone" in grid_fault([5e-7])
    assert "repeated" in grid_fault([5e-7, 5e-7])
    assert "neither rise nor fall" in grid_fault([5e-7, 6e-7, 5.5e-7])
    assert "one axis" in grid_fault(np.ones((2, 2)))
