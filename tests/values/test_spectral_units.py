"""Wavelengths by photon energy, wave number and frequency."""

import pytest

import optipath as op
from optipath.errors import UnitError
from optipath.values.spectral_units import wavelength_of
from tables import rows


def test_an_energy_stands_for_the_wavelength_of_codata():
    # h c / e = 1.239 841 984... e-6 eV m (CODATA 2018, exact).
    assert wavelength_of("1 eV") == pytest.approx(1.239841984332002e-06, rel=1e-15)


def test_a_wave_number_is_a_reciprocal_and_a_frequency_the_speed_of_light_over_it():
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
