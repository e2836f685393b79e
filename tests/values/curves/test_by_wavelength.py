"""Quantities by wavelength, and the cures of their coefficients."""

import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import optipath as op
from dispersive import line, on_line
from tables import rows

P = op.Parameter


def path_of(material):
    return op.Source() >> op.Interface(material, 0.3) >> op.Detector()


def told(path, **given):
    with pytest.raises(op.ParameterError) as fault:
        path.trace(wavelength="500 nm", **given)
    return str(fault.value)


def test_tables_have_their_unit_from_texts_or_beside_them():
    places = ["500 nm", "600 nm"]
    texts = op.tabulated(places, ["25 deg/mm", "20 deg/mm"])
    for made in (texts, op.tabulated(places, [25, 20], "deg/mm")):
        assert made.at("550 nm") == pytest.approx(math.radians(22.5) * 1e3, rel=1e-15)
    in_degrees = op.tabulated(places, ["95 deg", "100 deg"])
    assert in_degrees == op.tabulated(places, np.radians([95.0, 100.0]))
    assert in_degrees != op.tabulated(places, ["95 deg", "101 deg"])


TWO = ["500 nm", "600 nm"]
LATE = op.tabulated(["800 nm", "900 nm"], [1.0, 2.0])
ROTATION = op.tabulated(TWO, [25, 20], "deg/mm")
GLASS = op.Material.cauchy([1.5, 0.004], name="glass")
drude = op.drude_rotation
OF_TABLES = [
    ({"values": np.zeros(0)}, "must be a row of real numbers, not of shape"),
    ({"values": [1.0, 2.0j]}, "must be a row of real numbers, not"),
    ({"wavelengths": np.array([5e-7, 6e-7], complex)}, "must be a row of real numbers"),
    ({"values": [[1.0], [1.0, 2.0]]}, "has rows of unequal lengths"),
    ({"values": [1, 10**400]}, "must be a row of real numbers, not"),
    ({"values": [1, 10**400], "unit": "deg"}, "must be real numbers, not"),
    ({"values": [True, False]}, "must be a row of real numbers, not"),
    ({"unit": np.eye(3)}, "unit '.*' is unknown"),
    ({"label": 5}, "the name of a table is 5; give a text"),
]
OF_ROTATIONS = [
    ({"strengths": 1.0}, "strengths of the rotation must be a row of one coefficient or more"),
    ({"strengths": [1.0, 2.0]}, "has 2 strengths and 1 poles"),
    ({"strengths": [math.inf]}, "give finite real numbers"),
    ({"poles": 1.0}, "poles of the rotation must be a row of one coefficient or more"),
    ({"poles": [0.1, 0.2]}, "the rotation has 1 strengths and 2 poles"),
    ({"poles": ["x"]}, "the rotation has the coefficient 'x'; give finite real numbers"),
    ({"constant": math.inf}, "the rotation has the coefficient inf"),
    ({"span": "X1"}, "span of the rotation"),
    ({"span": (1.0,)}, "span of the rotation"),
    ({"label": None}, "the name of a rotation is None; give a text"),
]
OF_PLACES = [
    (lambda: op.Rotator(ROTATION), "is in deg/mm, but Rotator angle takes"),
    (lambda: op.Interface((GLASS.n, GLASS.n), 0.3), "such as n of glass, n of glass; give op"),
]
OF_SUMS = [
    (lambda: line(1.0, 2.0) - line(1.0, 2.0, op.Wavelength("x")), "follow from two wavelengths"),
    (lambda: line(1.0, 2.0) + ROTATION, "add up what is of one kind"),
    (lambda: line(1.0, 2.0) + LATE, "at no common wavelength"),
    (lambda: GLASS.n**2, r"n of glass cannot be raised .* 2 \* n of glass"),
]


def test_what_makes_no_value_by_wavelength_is_named():
    table, rotation = (
        {"wavelengths": TWO, "values": [1.0, 2.0]},
        {"strengths": [1.0], "poles": [0.1]},
    )
    calls = [(partial(op.tabulated, **table | given), told) for given, told in OF_TABLES]
    calls += [(partial(drude, **rotation | given), told) for given, told in OF_ROTATIONS]
    kinds = (op.OptipathError, calls), (op.ValueFault, OF_PLACES), (op.ParameterError, OF_SUMS)
    for kind, (call, sentence) in ((kind, row) for kind, table in kinds for row in table):
        with pytest.raises(kind, match=sentence):
            call()


@rows("values", [[1.0, math.nan], [1.0, "x"], [1.0], [1.0, 2.0, 3.0], None])
@rows("unit", ["", "deg/mm"])
def test_what_is_no_table_is_refused_in_words(values, unit):
    with pytest.raises(op.OptipathError):
        op.tabulated(["500 nm", "600 nm"], values, unit)


def test_coefficients_and_wavelengths_that_do_not_broadcast_are_named():
    glass = op.Material.cauchy([P("A"), 0.004])
    given = {"A": [1.5, 1.6, 1.7], "wavelength": [5e-7, 6e-7]}
    for bound in ((), ("A",), ("wavelength",)):
        path = path_of(glass).bind(**{name: given[name] for name in bound})
        with pytest.raises(op.ParameterError, match="arrays do not broadcast together") as caught:
            path.trace(**{name: value for name, value in given.items() if name not in bound})
        assert "A (3,)" in str(caught.value)
        assert "wavelength (2,)" in str(caught.value)
    several = replace(P("A", default=1.5, bound=True), default=np.array([1.5, 1.6, 1.7]))
    with pytest.raises(op.ShapeError, match="arrays do not broadcast together"):
        op.Material.cauchy([several, 0.004]).at([5e-7, 6e-7])
    with pytest.raises(op.ParameterError, match="wavelength has 40 axes, and a batch has 30 at m"):
        path_of(GLASS).trace(wavelength=np.full((1,) * 40, 5e-7))


def test_sums_and_differences_are_those_of_the_numbers():
    one, other = line(1.5, 1.4), line(1.3, 1.35)
    grid = np.linspace(4e-7, 7e-7, 7)
    expected = 2 * on_line(1.5, 1.4, grid) - 3 * on_line(1.3, 1.35, grid) + 0.5
    np.testing.assert_allclose((2 * one - 3 * other + 0.5).at(grid), expected, rtol=1e-15)
    np.testing.assert_allclose((one + other).at(grid), (other + one).at(grid), rtol=1e-15)
    assert one - other == one - other
    assert one - other != other - one


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


KNOWN = [
    lambda when: op.tabulated(["400 nm", "500 nm"], [1.0, 2.0], wavelength=when),
    lambda when: op.drude_rotation([1.0], [0.01], span=("400 nm", "500 nm"), wavelength=when),
    lambda when: op.Crystal.named("calcite", when).birefringence,
]


@rows("made", KNOWN)
def test_a_wavelength_that_is_known_may_be_a_text_and_is_within_the_range(made):
    assert made("450 nm") == made(450e-9) == pytest.approx(made(None).at("450 nm"), rel=1e-13)
    several = np.array([4.2e-7, 4.5e-7])
    np.testing.assert_allclose(made(several), made(None).at(several), rtol=1e-13)
    for when in ("5 um", 5e-6, [4.5e-7, 5e-6], 450, -4.5e-7, 0.0, np.nan, "red"):
        with pytest.raises(op.OptipathError, match="wavelength"):
            made(when)


def test_plain_samples_beyond_a_whole_turn_are_told_where_they_are_angles():
    for place in (op.Rotator, op.Retarder):
        with pytest.warns(op.AngleWarning, match="angle|retardance is a plain number"):
            place(op.tabulated(TWO, [95, 78]))
        for unit in ("deg", "rad"):
            place(op.tabulated(TWO, [95, 78], unit))


def test_a_broadening_above_its_limit_is_told_once_with_both_parameters_and_its_path():
    film = op.Material.tauc_lorentz([[90, 3.4, 2.0, 1.2], [100, P("E0"), P("C"), 1.2]])
    assert told(path_of(film), E0=3.0, C=6.5) == (
        "oscillators[1] of a Tauc-Lorentz model has the broadening 6.5 (parameter 'C') and the "
        "energy 3 (parameter 'E0'); the formula holds for a broadening below twice the energy, "
        "which is 6 (in a fit, give the optimiser bounds=)"
    )
    film = op.Material.tauc_lorentz([[100, 3.0, P("C"), 1.2]])
    words = told(path_of(film), C=np.array([1.0, 2.0, 6.5, 7.0]))
    assert "the broadening 6.5 (parameter 'C') and the energy 3;" in words
    assert words.endswith("which is 6 (at 2, of 4 paths)")
    film = op.Material.tauc_lorentz([[100, P("E0"), P("C"), 1.2]])
    for path in (path_of(film), path_of(op.Material(film.n - 0.1 * film.k, 0.0))):
        words = told(path.bind(E0=3.0, C=7.0))
        assert words.startswith("oscillators[0] of a Tauc-Lorentz model has the broadening 7")
        assert "bounds=" not in words


def test_a_formula_below_0_names_its_coefficients_besides_the_wavelength():
    path = path_of(op.Material.cauchy([P("a"), 2 * P("b")]))
    assert told(path, a=-3.0, b=0.005) == (
        "n of a Cauchy formula at 500 nm is -2.96, and interface.index.n takes a real index of "
        "refraction above 0 where k is 0; give other coefficients (a is -3, 2 * b is 0.01), or "
        "another wavelength (in a fit, give the optimiser bounds=)"
    )
    words = told(path, a=np.array([1.5, -3.0]), b=0.005)
    assert "is -2.96 (at 1, of 2 paths), and" in words
    assert "bounds=" not in words
    words = told(path_of(op.Material.cauchy([1.5], k=P("k"))), k=1j)
    assert words.endswith("; n is that of a Cauchy formula; give k alone, a real number")


def test_a_complex_coefficient_is_refused_before_anything_is_made_of_it():
    path = path_of(op.Material.cauchy([P("a"), 0.004]))
    wanted = "parameter 'a' (at interface.index.n.coefficients[0]) is complex; give a real"
    for a in (1.5 + 1j, np.array([1.5 + 1j, 1.5]), "1.5+1j"):
        assert told(path, a=a).startswith(wanted)
        with pytest.raises(op.ParameterError, match="is complex; give a real coefficient"):
            path.bind(a=a, wavelength="500 nm")
    with pytest.raises(op.ValueFault) as fault:
        op.Material.drude_lorentz(P("wp", default=1j), P("g", default=-1.0))
    wanted = "'wp' (at plasma of a Drude-Lorentz model) is complex; give a real coefficient of 0 or"
    assert fault.value.faults[0] == f"parameter {wanted} more"
    assert "'g' (at damping of a Drude-Lorentz model) is -1" in fault.value.faults[1]
