"""Texts that stand for quantities, and quantities as texts."""

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.values.text import several_texts, texts_of_range
from optipath.values.units import format_range, parse_quantity
from paths import chain
from tables import rows
from wired import read, read_back, wired

THIRTY = 30.0 * (np.pi / 180.0)
MALUS = op.load_preset("malus")


def extincting(length, k, wavelength):
    return op.Medium.from_extinction(length, k=k, wavelength=wavelength)


def turning(length, turn):
    return op.Medium(length, rotation=turn)


def turned(azimuth):
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1, 1, 0, 0]))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "eye.in", azimuth=azimuth)
    return path.trace()


@rows(
    "make, texts, numbers",
    [
        (op.Polarizer, ("30 deg", "100 mrad", "0.5"), (THIRTY, 0.1, 0.5)),
        (op.Retarder, ("180 deg", "1 rad"), (np.pi, 1.0)),
        (op.Rotator, (["30 deg", 0.5, "0.1 rad"],), ([THIRTY, 0.5, 0.1],)),
        (op.Rotator, (np.array([["30 deg"], ["0 deg"]]),), ([[THIRTY], [0.0]],)),
        (op.Interface, ("1.5", "30 deg", "1.33"), (1.5, THIRTY, 1.33)),
        (op.Interface, ("0.3+0.4j", "30 deg"), (0.3 + 0.4j, THIRTY)),
        (op.Interface, (op.Material("0.3", "0.4"), 0.1), (0.3 + 0.4j, 0.1)),
        (op.LayerStack, (["1", 1.5, "0.2+3j"], 0.1), ([1, 1.5, 0.2 + 3j], 0.1)),
        (op.Medium, ("5 mm", "1 1/cm"), (5e-3, 100.0)),
        (turning, ("1 dm", "1 rad/cm"), (0.1, "100 rad/m")),
        (extincting, ("1 um", "0.05", "500 nm"), (1e-6, 0.05, 500e-9)),
        (op.Mirror, ("-0.9+0.1j",), (-0.9 + 0.1j,)),
        (op.Source, ("100", ["1", "1", 0, 0]), (100.0, [1.0, 1.0, 0.0, 0.0])),
        (op.MuellerElement, (np.eye(4).astype(str),), (np.eye(4),)),
        (op.VerticesByAngles, (("30 deg", 0.2), ("1 rad",)), ((THIRTY, 0.2), (1.0,))),
        *((op.CosSin, ("0.6", ["0.8"]), (0.6, [0.8])), (turned, ("45 deg",), (np.pi / 4,))),
        (op.Frame().turned, ("90 deg",), (np.pi / 2,)),
        (op.refraction_angle, ("1.5", "40 deg"), (1.5, np.radians(40.0))),
        (op.fresnel_reflection, ("1.5", "0.6", "0.8"), (1.5, 0.6, 0.8)),
    ],
)
def test_a_text_is_the_number_that_it_stands_for(make, texts, numbers):
    assert make(*texts) == make(*numbers)
    points = op.vertices_from_angles(["45 deg"])
    np.testing.assert_array_equal(points, op.vertices_from_angles([np.pi / 4]))
    by_texts = op.Parameter("t", "30 deg", "", "0 deg", "1 rad", words={"up": "0.5 rad"})
    assert by_texts == op.Parameter("t", THIRTY, "deg", 0.0, 1.0, words={"up": 0.5})


def test_axes_have_names(tmp_path):
    axes = {"horizontal": 0, "vertical": 90, "diagonal": 45, "antidiagonal": -45}
    takers = [op.Polarizer, lambda angle: op.Diattenuator(angle=angle)]
    takers += [lambda angle: op.Retarder(1.0, angle), lambda angle: op.Medium(1.0, angle=angle)]
    for (word, degrees), make in product(axes.items(), takers):
        assert make(word) == make(np.radians(degrees))
    text = chain([op.Polarizer("30 deg")]).to_toml()
    vertical = read(text.replace('"30 deg"', '"vertical"'), tmp_path)
    assert vertical == chain([op.Polarizer("vertical")])
    with pytest.raises(
        op.errors.PathError, match="axis 'vertikal' is unknown; did you mean 'vertical'"
    ):
        read(text.replace('"30 deg"', '"vertikal"'), tmp_path)


NO_NUMBERS = [
    (lambda: op.Polarizer("30"), "angle: '30' has no unit, but an angle is asked for; add one"),
    (lambda: op.Polarizer("30 nm"), "Polarizer angle: '30 nm' is no angle; use one of deg"),
    (lambda: op.Polarizer("horizontl"), "'horizontl' is unknown; did you mean 'horizontal'"),
    (lambda: op.Rotator(["30 deg", "4 nm", "5 nm"]), "2 faults:\n.*'4 nm'.*\n.*'5 nm' is no a"),
    (lambda: op.Interface("1.5 deg", 0.1), "has the unit 'deg', but a pure number is asked"),
    (lambda: op.CosSin("30 deg", "0.5"), "cos: '30 deg' has a unit.*; give the angle itself"),
    (lambda: op.Parameter("t", "30 dge"), "unit 'dge' is unknown; did you mean 'deg'"),
    (lambda: op.Parameter("t", "0.1/mm"), "'0.1/mm' is not a quantity; write a number"),
    (lambda: op.Parameter("t", minimum="0 nm", maximum="9 deg"), "maximum.*'9 deg' is no leng"),
    (lambda: op.Frame().turned("30"), "the angle of a turn: '30' has no unit"),
    (lambda: op.refraction_angle(1.5, "40"), "incidence: '40' has no unit"),
    (lambda: op.VerticesByAngles(("40",)), r"incidences\[0\]: '40' has no unit"),
    (lambda: turned("45"), r"link 'lamp.out -> eye.in' azimuth: '45' has no"),
]


@rows("give, sentence", NO_NUMBERS)
def test_what_stands_for_no_number_is_refused_by_its_field(give, sentence):
    with pytest.raises(op.OptipathError, match=sentence):
        give()


def test_texts_are_given_to_runs_in_every_way_and_go_to_files_and_back(tmp_path):
    angle = np.radians(40.0)
    expected = MALUS.trace(angle=angle)
    assert MALUS.trace(angle="40 deg") == MALUS.bind(angle="40 deg").trace() == expected
    assert op.load_preset("malus", angle="40 deg").trace() == expected
    assert MALUS.mueller(angle="40 deg") == MALUS.mueller(angle=angle)
    several = MALUS.trace(angle=["40 deg", 0.5, "30 arcmin"])
    numbers = MALUS.trace(angle=[angle, 0.5, np.radians(0.5)])
    np.testing.assert_array_equal(several.stokes, numbers.stokes)
    (part,) = MALUS.compose().stream(10, angle=["40 deg"])
    assert part[1].stokes.tolist() == [expected.stokes.tolist()]
    cased = op.PathGraph("texts", {"forty": op.Case({"angle": "40 deg"})})
    assert cased.cases["forty"].values == {"angle": "40 deg"}
    text = MALUS.to_toml() + '\n[cases.forty]\nvalues = { angle = "40 deg" }\n'
    assert read(text, tmp_path, case="forty").trace() == expected
    path = chain([op.Polarizer("30 deg"), op.Medium("5 mm", "1 1/cm"), op.Rotator(["1 deg", 0.5])])
    assert read_back(path, tmp_path) == path
    assert 'angle = "30 deg"' in path.to_toml()


DELTA = op.Parameter("delta", unit="deg")
NUMBER = op.Parameter("n")


WHOLE, FLOATS = st.integers(-(10**9), 10**9), st.floats(allow_nan=False, allow_infinity=False)


@given(WHOLE, st.integers(0, 10**6), FLOATS, st.floats(-1e9, 1e9), st.integers(2, 200))
def test_whole_steps_are_whole_and_a_range_never_turns(first, step, start, stop, count):
    texts = texts_of_range(f"{first}:{first + step * (count - 1)}:{count}")
    assert [float(text) for text in texts] == [first + step * at for at in range(count)]
    values = [float(text) for text in texts_of_range(f"{start!r}:{stop!r}:{count}")]
    assert (len(values), values[0], values[-1]) == (count, start, stop)
    assert values == sorted(values, reverse=start > stop)


def test_a_list_has_its_texts_one_by_one_a_range_those_between_and_a_single_value_is_none():
    texts = several_texts(DELTA, "0:90:91")
    found = [parse_quantity(text, "angle", "deg") for text in texts]
    assert found == [parse_quantity(f"{whole} deg", "angle") for whole in range(91)]
    found = [float(text) for text in several_texts(NUMBER, "0:1:101")]
    assert found == [float(f"{part // 100}.{part % 100:02}") for part in range(101)]
    texts = several_texts(op.Wavelength(), "400 nm:700 nm:61")
    found = [parse_quantity(text, "length") for text in texts]
    assert found == [parse_quantity(f"{400 + 5 * step} nm", "length") for step in range(61)]
    assert several_texts(DELTA, "90.0 deg:-1e1 deg:3") == ["90.0 deg", "40.0 deg", "-1e1 deg"]
    assert several_texts(DELTA, "5 deg:5 deg:1") == ["5 deg"]
    assert several_texts(DELTA, "10 deg,0.5 rad, horizontal") == ["10 deg", "0.5 rad", "horizontal"]
    assert several_texts(DELTA, "10,20,30") == ["10", "20", "30"]
    for text in ("30 deg", "horizontal", "0.5", "-1e-3 rad", "30 degs"):
        assert several_texts(DELTA, text) is None
    for text in ("1000:1", "1:50", "inf"):  # Ratios to one are single numbers.
        assert several_texts(NUMBER, text) is None
    with pytest.raises(
        op.errors.ParameterError, match=r"may be the ratio 0\.75, or a range"
    ) as caught:
        several_texts(NUMBER, "1.2:1.6")
    assert "write '0.75', or '1.2:1.6:11' for eleven" in str(caught.value)
    # With decimal commas, a range is a list of ratios.
    with pytest.raises(op.errors.ParameterError, match=r"'5:3' may be the ratio"):
        several_texts(NUMBER, "0,5:1,5:3")
    assert several_texts(NUMBER, "1:100, 1:50") == ["1:100", "1:50"]
    assert len(several_texts(NUMBER, "1.2:1.6:11")) == 11


@rows(
    "text, told",
    [
        *((text, "is no range; write start:stop:count") for text in ("0 deg:90 deg", "1:2:3:4")),
        *(
            (f"0:90:{count}", f"'{count}' of '0:90:{count}' is no count")
            for count in (-1, 0.5, 0, 1)
        ),
        ("400:700:61 nm", "'61 nm' of '400:700:61 nm' is no count of values; write start:stop"),
        *((f"0 deg:{end}:3", "differ in their units") for end in ("1 rad", "90")),
        *((f"{end}:1:3", "is no number with a unit") for end in ("", "a", "1e-999999999")),
        ("0:1:1000001", "a text stands for 1000000 at most"),
        ("0,170", "a number with a comma, or two; write '0.170' for one, and '0, 170' for two"),
        ("10,20 deg", "write '10.20 deg' for one, and '10 deg, 20 deg' for two"),
    ],
)
def test_what_is_wrong_with_a_range_or_list_is_told(text, told):
    with pytest.raises(op.errors.ParameterError, match=r"^parameter 'delta': ") as caught:
        several_texts(DELTA, text)
    assert told in str(caught.value)


POLARIZER = op.Parameter("filter", unit="deg", words={"horizontal": 0.0}, optional=True)


def written(folder, text):
    (folder / "angles.csv").write_text(text, "utf-8")
    return f"@{folder / 'angles.csv'}"


def test_a_file_gives_the_cells_of_the_column_of_the_parameter_with_its_unit(tmp_path):
    text = "rho [rad]; delta (deg)\n# measured\n0.1; 10\n0.2; 20.5\n"
    assert several_texts(DELTA, written(tmp_path, text)) == ["10 deg", "20.5 deg"]
    assert several_texts(DELTA, written(tmp_path, "angle_mrad\n10\n")) == ["10 mrad"]
    text = written(tmp_path, "filter\nnone\nhorizontal\n30 deg\n")
    assert several_texts(POLARIZER, text) == ["none", "horizontal", "30 deg"]
    with pytest.raises(op.errors.ParameterError, match="begin with the line 'filter'"):
        several_texts(POLARIZER, written(tmp_path, "horizontal\nvertical\n"))
    with pytest.raises(
        op.errors.ParameterError, match=r"^nowhere\.csv: it cannot be read: No such file"
    ):
        several_texts(DELTA, "@nowhere.csv")


@rows(
    "text, told",
    [
        *(("", "it is empty"), ("10\n20\n", "line 1 has no names of columns, or is the only one")),
        ("delta\n", "line 1 has no names of columns, or is the only one"),
        ("rho,phi\n1,2\n", "none of the columns rho and phi is 'delta'"),
        ("detla,phi\n1,2\n", "; did you mean 'detla'?"),
        ("delta,delta\n1,2\n", "line 1 names 'delta' twice"),
        ("delta\n1,2\n", "line 2 has 2 values, and line 1 has 1 names"),
        ("delta,rho\n1,\n", "line 2 has an empty cell"),
        ("delta (deg)\n1 rad\n", "line 2: '1 rad' is not in deg"),
    ],
)
def test_what_is_wrong_in_a_file_is_told_with_its_name(tmp_path, text, told):
    with pytest.raises(op.OptipathError, match=r"angles\.csv: ") as caught:
        several_texts(DELTA, written(tmp_path, text))
    assert told in str(caught.value)


@rows(
    "low, high, unit, written",
    [
        (0.0, math.radians(3.0), "arcmin", "0 arcmin .. 180 arcmin"),
        (-2.0 * math.pi, math.inf, "rad", "-6.283185307179586 rad or more"),
        (math.radians(-90.0), math.radians(90.0), "deg", "-90 deg .. 90 deg"),
    ],
)
def test_defaults_and_ends_of_a_range_are_displayed_without_noise(low, high, unit, written):
    assert op.Parameter("p", "3 deg", unit="arcmin").default_text() == "180 arcmin"
    assert format_range(low, high, unit) == written
    parameter = op.Parameter("p", unit=unit, minimum=low, maximum=high)
    for end in written.removesuffix(" or more").split(" .. "):
        parameter.resolve(end)


NPGR026 = op.load_preset("npgr026")


def fault(call, *arguments, **values):
    with pytest.raises(op.OptipathError) as error:
        call(*arguments, **values)
    return str(error.value)


def test_a_number_that_is_wrong_in_several_places_and_arrays_of_other_shapes_are_told_once():
    n = op.Parameter("n")
    faces = {"front": op.Interface(n, 0.3)}
    faces["back"] = op.Interface(1.0, 0.3, outside=n, incidence_in=1.0)
    links = "lamp -> front, front.transmitted -> back, back.transmitted -> eye"
    path = wired(faces | {"lamp": op.Source(), "eye": op.Detector()}, links)
    for give in (path.trace, path.bind):
        with pytest.raises(
            op.errors.ParameterError, match=r"^parameter 'n' \(at front.index\)"
        ) as error:
            give(n=-0.2)
        assert len(error.value.faults) == 1
    text = fault(NPGR026.bind(delta=np.zeros(3)).trace, rho=np.zeros(4))
    assert "delta (3,), rho (4,); make their axes equal or 1, as x[:, None] does" in text
    # What is said does it.
    assert NPGR026.trace(delta=np.zeros(3)[:, None], rho=np.zeros(4)).shape == (3, 4)
    many = chain([op.Rotator(np.zeros(count)) for count in range(2, 12)])
    assert "make their axes equal or 1" in fault(many.trace)
