"""Texts with units stand wherever a number does, and are read in one place."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

THIRTY = 30.0 * (np.pi / 180.0)


@rows(
    "by_texts, by_numbers",
    [
        (lambda: op.Polarizer("30 deg", "100 mrad", "0.5"), op.Polarizer(THIRTY, 0.1, 0.5)),
        (lambda: op.Retarder("180 deg", angle="1 rad"), op.Retarder(np.pi, 1.0)),
        (lambda: op.Rotator(["30 deg", 0.5, "0.1 rad"]), op.Rotator([THIRTY, 0.5, 0.1])),
        (lambda: op.Rotator(np.array(["30 deg", "0 deg"])), op.Rotator([THIRTY, 0.0])),
        (lambda: op.Rotator([["30 deg"], ["0 deg"]]), op.Rotator([[THIRTY], [0.0]])),
        (lambda: op.Interface("1.5", "30 deg", "1.33"), op.Interface(1.5, THIRTY, 1.33)),
        (lambda: op.Interface("0.3+0.4j", "30 deg"), op.Interface(0.3 + 0.4j, THIRTY)),
        (lambda: op.Interface(op.Material("0.3", "0.4"), 0.1), op.Interface(0.3 + 0.4j, 0.1)),
        (lambda: op.LayerStack(["1", 1.5, "0.2+3j"], 0.1), op.LayerStack([1, 1.5, 0.2 + 3j], 0.1)),
        (lambda: op.Medium("5 mm", "1 1/cm"), op.Medium(5e-3, 100.0)),
        (lambda: op.Medium("1 dm", rotation="1 rad/cm"), op.Medium(0.1, rotation="100 rad/m")),
        (
            lambda: op.Medium.from_extinction("1 um", k="0.05", wavelength="500 nm"),
            op.Medium.from_extinction(1e-6, k=0.05, wavelength=500e-9),
        ),
        (lambda: op.Mirror("-0.9+0.1j"), op.Mirror(-0.9 + 0.1j)),
        (lambda: op.Source("100", ["1", "1", 0, 0]), op.Source(100.0, [1.0, 1.0, 0.0, 0.0])),
        (lambda: op.MuellerElement(np.eye(4).astype(str)), op.MuellerElement(np.eye(4))),
        (
            lambda: op.VerticesByAngles(("30 deg", 0.2), ("1 rad",)),
            op.VerticesByAngles((THIRTY, 0.2), (1.0,)),
        ),
        (lambda: op.CosSin("0.6", ["0.8"]), op.CosSin(0.6, [0.8])),
        (
            lambda: op.Parameter("t", "30 deg", "", "0 deg", "1 rad", words={"up": "0.5 rad"}),
            op.Parameter("t", THIRTY, "deg", 0.0, 1.0, words={"up": 0.5}),
        ),
    ],
)
def test_a_text_is_the_number_that_it_stands_for(by_texts, by_numbers):
    assert by_texts() == by_numbers


@rows(
    "word, degrees",
    [("horizontal", 0), ("vertical", 90), ("diagonal", 45), ("antidiagonal", -45)],
)
def test_axes_have_names(word, degrees):
    for of_word, of_angle in (
        (op.Polarizer(word), op.Polarizer(np.radians(degrees))),
        (op.Diattenuator(angle=word), op.Diattenuator(angle=np.radians(degrees))),
        (op.Retarder(1.0, word), op.Retarder(1.0, np.radians(degrees))),
        (op.Medium(1.0, angle=word), op.Medium(1.0, angle=np.radians(degrees))),
    ):
        assert of_word == of_angle


def test_a_horizontal_polariser_lets_light_along_x_through_and_a_diagonal_one_that_along_x_plus_y():
    assert chain([op.Polarizer("horizontal")]).trace().stokes.tolist() == [0.5, 0.5, 0.0, 0.0]
    diagonal = chain([op.Polarizer("diagonal")]).trace().stokes
    np.testing.assert_allclose(diagonal, [0.5, 0.0, 0.5, 0.0], rtol=0, atol=1e-16)


def test_a_file_knows_the_names_of_axes(tmp_path):
    file = tmp_path / "named.toml"
    text = chain([op.Polarizer("30 deg")]).to_toml()
    file.write_text(text.replace('"30 deg"', '"vertical"'), "utf-8")
    assert op.load_preset(file) == chain([op.Polarizer("vertical")])
    file.write_text(text.replace('"30 deg"', '"vertikal"'), "utf-8")
    with pytest.raises(op.PathError, match="axis 'vertikal' is unknown; did you mean 'vertical'"):
        op.load_preset(file)


@rows(
    "give, sentence",
    [
        (lambda: op.Polarizer("30"), "angle: '30' has no unit, but an angle is asked for; add one"),
        (lambda: op.Polarizer("30 nm"), "Polarizer angle: '30 nm' is no angle; use one of deg"),
        (lambda: op.Polarizer("30 dgr"), "unit 'dgr' of '30 dgr' is unknown; did you mean 'deg'"),
        (lambda: op.Polarizer("horizontl"), "'horizontl' is unknown; did you mean 'horizontal'"),
        (lambda: op.Rotator(["30 deg", "4 nm", "5 nm"]), "2 faults:\n.*'4 nm'.*\n.*'5 nm' is no a"),
        (lambda: op.Medium("5 deg"), "Medium length: '5 deg' is no length; use one of nm"),
        (lambda: op.Interface("1.5 deg", 0.1), "has the unit 'deg', but a pure number is asked"),
        (lambda: op.CosSin("30 deg", "0.5"), "cos: '30 deg' has a unit.*; give the angle itself"),
        (lambda: op.Parameter("t", "30 dge"), "unit 'dge' is unknown; did you mean 'deg'"),
        (
            lambda: op.Parameter("t", "0.1/mm"),
            "'0.1/mm' is not a quantity; did you mean '0.1 1/mm'",
        ),
        (lambda: op.Parameter("t", minimum="0 nm", maximum="9 deg"), "maximum.*'9 deg' is no leng"),
        (lambda: op.Frame().turned("30"), "the angle of a turn: '30' has no unit"),
        (lambda: op.refraction_angle(1.5, "40"), "incidence: '40' has no unit"),
        (lambda: op.VerticesByAngles(("40",)), r"incidences\[0\]: '40' has no unit"),
    ],
)
def test_what_stands_for_no_number_is_refused_by_its_field(give, sentence):
    with pytest.raises(op.OptipathError, match=sentence):
        give()


def test_the_angle_of_a_link_may_be_a_text():
    def turned(azimuth):
        path = op.PathGraph()
        path.add("lamp", op.Source(stokes=[1, 1, 0, 0]))
        path.add("eye", op.Detector())
        path.connect("lamp.out", "eye.in", azimuth=azimuth)
        return path.trace()

    assert turned("45 deg") == turned(np.pi / 4)
    with pytest.raises(op.OptipathError, match=r"link 'lamp.out -> eye.in' azimuth: '45' has no"):
        turned("45")


def test_functions_take_texts_as_well():
    assert op.Frame().turned("90 deg") == op.Frame().turned(np.pi / 2)
    assert op.refraction_angle("1.5", "40 deg") == op.refraction_angle(1.5, np.radians(40.0))
    assert op.fresnel_reflection("1.5", "0.6", "0.8") == op.fresnel_reflection(1.5, 0.6, 0.8)
    points = op.vertices_from_angles(["45 deg"])
    np.testing.assert_array_equal(points, op.vertices_from_angles([np.pi / 4]))


def test_texts_are_given_to_runs_in_every_way():
    path = op.load_preset("malus")
    angle = np.radians(40.0)
    expected = path.trace(angle=angle)
    assert path.trace(angle="40 deg") == path.bind(angle="40 deg").trace() == expected
    assert op.load_preset("malus", angle="40 deg").trace() == expected
    assert path.mueller(angle="40 deg") == path.mueller(angle=angle)
    several = path.trace(angle=["40 deg", 0.5, "30 arcmin"])
    np.testing.assert_array_equal(
        several.stokes, path.trace(angle=[angle, 0.5, np.radians(0.5)]).stokes
    )
    (part,) = path.compose().stream(10, angle=["40 deg"])
    assert part[1].stokes.tolist() == [expected.stokes.tolist()]


def test_a_case_may_have_texts(tmp_path):
    path = op.load_preset("malus")
    case = op.Case({"angle": "40 deg"})
    cased = op.PathGraph("texts", {"forty": case})
    assert cased.cases["forty"].values == {"angle": "40 deg"}
    file = tmp_path / "cased.toml"
    text = path.to_toml() + '\n[cases.forty]\nvalues = { angle = "40 deg" }\n'
    file.write_text(text, "utf-8")
    assert op.load_preset(file, case="forty").trace() == path.trace(angle="40 deg")


def test_elements_of_texts_go_to_toml_and_back(tmp_path):
    path = chain([op.Polarizer("30 deg"), op.Medium("5 mm", "1 1/cm"), op.Rotator(["1 deg", 0.5])])
    file = tmp_path / "texts.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert op.load_preset(file) == path
    assert 'angle = "30 deg"' in path.to_toml()
