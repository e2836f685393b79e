"""The parameter by which light of a run has its colour."""

import numpy as np
import pytest

import optipath as op
from tables import rows


def test_texts_of_all_kinds_stand_for_metres():
    given = op.Wavelength().resolve(["516 nm", "2.4 eV", "20000 1/cm", "0.5 um"]).value
    assert given == pytest.approx([516e-9, 516.600827e-9, 500e-9, 500e-9])


def test_default_and_limits_may_be_photon_energies():
    known = op.Wavelength(default="2 eV", minimum="3 eV", maximum="1 eV")
    assert known.default == pytest.approx(619.92e-9, rel=1e-5)
    assert known.minimum == pytest.approx(413.28e-9, rel=1e-5)


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


def test_one_by_another_name_is_given_by_that():
    path = op.Source() >> op.Waveplate(1e-5, 0.009, op.Wavelength("probe")) >> op.Detector()
    assert path.trace(probe="516 nm").stokes[0] == 1.0


@rows("most, written", [("700 nm", "700 nm"), ("20 um", "20 um"), ("1 mm", "1 mm")])
def test_the_ends_of_a_range_are_told_in_units_of_their_size(most, written):
    wavelength = op.Wavelength(minimum="380 nm", maximum=most)
    with pytest.raises(op.ParameterError, match=f"light goes from 380 nm to {written}$"):
        wavelength.resolve(400)
