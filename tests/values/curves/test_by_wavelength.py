"""Numbers of one's own by wavelength, and their sums."""

import math

import numpy as np
import pytest

import optipath as op
from dispersive import line, on_line


def test_a_table_has_its_unit_from_texts_or_beside_it():
    axis = ["500 nm", "600 nm"]
    texts = op.tabulated(axis, ["25 deg/mm", "20 deg/mm"])
    numbers = op.tabulated(axis, [25, 20], "deg/mm")
    exact = math.radians(22.5) * 1e3
    assert texts.at("550 nm") == pytest.approx(exact, rel=1e-15)
    assert numbers.at("550 nm") == pytest.approx(exact, rel=1e-15)


def test_a_table_of_another_dimension_is_refused_where_it_stands():
    with pytest.raises(op.ValueFault, match="is in deg/mm, but Rotator angle takes"):
        op.Rotator(op.tabulated(["500 nm", "600 nm"], [25, 20], "deg/mm"))


@pytest.mark.parametrize("values", [[1.0, math.nan], [1.0, "x"], [1.0], [1.0, 2.0, 3.0], None])
@pytest.mark.parametrize("unit", ["", "deg/mm"])
def test_what_is_no_table_is_refused_in_words(values, unit):
    with pytest.raises(op.OptipathError):
        op.tabulated(["500 nm", "600 nm"], values, unit)


def test_sums_and_differences_are_those_of_the_numbers():
    one, other = line(1.5, 1.4), line(1.3, 1.35)
    grid = np.linspace(4e-7, 7e-7, 7)
    expected = 2 * on_line(1.5, 1.4, grid) - 3 * on_line(1.3, 1.35, grid) + 0.5
    np.testing.assert_allclose((2 * one - 3 * other + 0.5).at(grid), expected, rtol=1e-15)
    np.testing.assert_allclose((one + other).at(grid), (other + one).at(grid), rtol=1e-15)
    assert one - other == one - other
    assert one - other != other - one


def test_numbers_of_two_wavelengths_or_kinds_are_not_added():
    with pytest.raises(op.ParameterError, match="follow from two wavelengths"):
        line(1.0, 2.0) - line(1.0, 2.0, op.Wavelength("other"))
    rotation = op.tabulated(["400 nm", "700 nm"], [25, 20], "deg/mm")
    with pytest.raises(op.ParameterError, match="add up what is of one kind"):
        line(1.0, 2.0) + rotation
    late = op.tabulated(["800 nm", "900 nm"], [1.0, 2.0])
    with pytest.raises(op.ParameterError, match="at no common wavelength"):
        line(1.0, 2.0) + late


def test_a_verdet_constant_by_drudes_formula_turns_light():
    # The two figures of the data sheet of terbium gallium garnet fix K and the resonance.
    garnet = op.drude_rotation([-41.72], [0.08909], unit="rad/(T m)")
    assert garnet.at("632.8 nm") == pytest.approx(-134.0, rel=1e-3)
    assert garnet.at("1064 nm") == pytest.approx(-40.0, rel=1e-3)
    path = op.Source(stokes=[1, 1, 0, 0]) >> op.FaradayRotator(
        verdet=garnet, field="-0.2 T", length="20 mm"
    )
    light = (path >> op.Detector()).trace(wavelength=["632.8 nm", "1064 nm"])
    np.testing.assert_allclose(light.aop, [0.536, 0.16], rtol=1e-3)


def test_coefficients_that_do_not_fit_are_refused():
    with pytest.raises(op.ValueFault, match="has 2 strengths and 1 poles"):
        op.drude_rotation([1.0, 2.0], [0.1])
    with pytest.raises(op.ValueFault, match="give finite real numbers"):
        op.drude_rotation([math.inf], [0.1])


def test_degrees_and_radians_make_the_same_curve():
    places = ["500 nm", "600 nm"]
    in_degrees = op.tabulated(places, ["95 deg", "100 deg"])
    assert in_degrees == op.tabulated(places, np.radians([95.0, 100.0]))
    assert in_degrees != op.tabulated(places, ["95 deg", "101 deg"])
