"""Wavelengths: the parameter of a run, and its units of energy, wave number and frequency."""

import numpy as np
import pytest

import optipath as op
from optipath.errors import UnitError
from optipath.values.spectral_units import wavelength_of
from tables import rows


def test_wavelengths_and_their_limits_are_lengths_or_energies_by_any_name():
    given = op.Wavelength().resolve(["516 nm", "2.4 eV", "20000 1/cm", "0.5 um"]).value
    assert given == pytest.approx([516e-9, 516.600827e-9, 500e-9, 500e-9])
    known = op.Wavelength(default="2 eV", minimum="3 eV", maximum="1 eV")
    assert known.default == pytest.approx(619.92e-9, rel=1e-5)
    assert known.minimum == pytest.approx(413.28e-9, rel=1e-5)
    path = op.Source() >> op.Waveplate(1e-5, 0.009, op.Wavelength("probe")) >> op.Detector()
    assert path.trace(probe="516 nm").stokes[0] == 1.0


def test_a_number_of_nanometres_is_refused_with_the_cure():
    with pytest.raises(op.ParameterError, match="write '516 nm', or 516e-9"):
        op.Wavelength().resolve(516)


@rows(
    "given, said",
    [
        ("516", "has no unit"),
        (np.nan, "finite"),
        (-5e-7, "outside its range"),
        (5e6, "outside"),
        (np.float16(48), "48 metres, which is no wavelength"),
        (np.zeros(0, complex), "range of reals"),
    ],
)
def test_what_is_no_wavelength_is_refused(given, said):
    with pytest.raises(op.OptipathError, match=said):
        op.Wavelength().resolve(given)


@rows("most, written", [("700 nm", "700 nm"), ("20 um", "20 um"), ("1 mm", "1 mm")])
def test_the_ends_of_a_range_are_told_in_units_of_their_size(most, written):
    wavelength = op.Wavelength(minimum="380 nm", maximum=most)
    with pytest.raises(op.ParameterError, match=f"light goes from 380 nm to {written}$"):
        wavelength.resolve(400)


def test_energies_wave_numbers_and_frequencies_are_wavelengths_by_codata():
    # h c / e = 1.239 841 984... e-6 eV m (CODATA 2018, exact).
    assert wavelength_of("1 eV") == pytest.approx(1.239841984332002e-06, rel=1e-15)
    assert wavelength_of("20000 1/cm") == wavelength_of("20000 cm^-1") == pytest.approx(5e-7)
    assert wavelength_of("299.792458 THz") == pytest.approx(1e-6, rel=1e-15)


@rows("text", ["516 nm", "gold", "", "2 eV 3"])
def test_what_has_another_unit_is_left_to_others(text):
    assert wavelength_of(text) is None


@rows("text", ["0 eV", "-2 eV", "1e999 THz"])
def test_what_is_not_above_0_is_refused(text):
    with pytest.raises(UnitError, match="above 0"):
        wavelength_of(text)


@rows("text", ["516", "516 deg"])
def test_all_units_of_a_wavelength_are_named_where_one_is_missing(text):
    for read in (op.Wavelength().resolve, op.Material.cauchy([1.5, 0.004]).at, op.Spectrum.line):
        with pytest.raises(
            op.OptipathError, match=r"nm, um, mm, cm, dm, m, angstrom, or eV, 1/cm, THz$"
        ):
            read(text)
