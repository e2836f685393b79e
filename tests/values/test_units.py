"""Units, and angles in degrees."""

import math
import re
import warnings
from contextlib import suppress
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.cli.command import main
from optipath.errors import UnitError
from optipath.values.units import UNITS, format_quantity, in_unit, parse_quantity
from paths import chain
from tables import rows

READ = {
    "angle": {"90 deg": math.pi / 2, "-1.5rad": -1.5, "60 arcmin": math.pi / 180},
    "length": {"516 nm": 516e-9, "1e-3 mm": 1e-6, "2 dm": 0.2},
    "inverse length": {"0.5 1/cm": 50.0, "3 1/um": 3e6},
    "angle per length": {"66.5 deg/dm": math.radians(665), "2 rad/mm": 2000.0},
    "magnetic field": {"30 mT": 0.03, "2.5 kG": 0.25},
    "Verdet constant": {"-134 rad/(T m)": -134.0, "1 deg/(T cm)": math.radians(100)}
    | {"0.12 arcmin/(G cm)": math.radians(0.12 / 60) * 1e6},
    "": {" 2.5 ": 2.5},
}


@rows("dimension, quantities", READ.items())
def test_quantities_are_read_in_their_units(dimension, quantities):
    for text, value in quantities.items():
        assert parse_quantity(text, dimension) == pytest.approx(value, rel=1e-15)


@rows(
    "text, dimension, message",
    [
        ("30 dgr", "angle", "unit 'dgr' of '30 dgr' is unknown; did you mean 'deg'"),
        ("500 Nanometres", "length", "of '500 Nanometres' is unknown; there are: nm, um"),
        ("5 cm^-1", "inverse length", r"of '5 cm\^-1' is unknown; there are"),
        ("5 deg/km", "angle per length", "'deg/km' of '5 deg/km' is unknown; did you mean 'deg/m'"),
        ("5 min/(Oe cm)", "Verdet constant", r"did you mean 'arcmin/\(G cm\)'"),
        ("5 rad/T/m", "Verdet constant", r"did you mean 'rad/\(T m\)'"),
        ("30 furlongs", "angle", "unknown; there are: deg, rad, mrad, arcmin, arcsec$"),
        ("30,5 deg", "angle", "'30,5 deg' is not a quantity; write a number"),
        (
            "-5 / cm",
            "inverse length",
            r"'-5 / cm' is not a quantity; write a number such as '30 1/cm'",
        ),
        ("1.5+2i", "", r"^'1.5\+2i' is not a quantity; write a number such as '1.5' or"),
        ("0:90:10", "angle", "^'0:90:10' is not a quantity; write a number such as '30 deg'$"),
        ("1, 2", "length", "^'1, 2' is not a quantity; write a number such as '30 nm'$"),
        *((text, "", "not a quantity") for text in ("", "1_000", "0.3+0.4", "0.30.4j")),
        *((text, "", "not a quantity") for text in ("(0.3+0.4j", "1_0+2j", "0.3+0.4j deg")),
        *((text, "angle", "not a quantity") for text in ("thirty deg", "nan deg")),
        *(("30", "angle", "'30' has no unit"), ("30 deg", "", "pure number")),
        ("30", "length", "a length is asked for; add one of nm, um"),
        ("30 nm", "angle", "no angle"),
        ("5 mm", "inverse length", "no inverse length; use one of 1/um, 1/mm, 1/cm, 1/dm, 1/m"),
        ("5 rad", "Verdet constant", "'5 rad' is no Verdet constant; use one of rad/"),
    ],
)
def test_what_is_no_quantity_is_refused(text, dimension, message):
    with pytest.raises(UnitError, match=message):
        parse_quantity(text, dimension)


@given(
    value=st.floats(allow_nan=False, allow_infinity=False),
    unit=st.sampled_from(["", *UNITS]),
    places=st.integers(0, 6),
    number=st.integers(-(10**9), 10**9),
)
def test_writing_and_reading_gives_the_very_same_number_and_text(value, unit, places, number):
    dimension = UNITS[unit].dimension if unit else ""
    assert parse_quantity(format_quantity(value, unit), dimension) == value
    if unit:
        text = f"{repr(number / 10**places).removesuffix('.0')} {unit}"
        assert format_quantity(parse_quantity(text, dimension), unit) == text


@rows(
    "text, dimension, unit, written",
    [
        *(("20 um", "length", "mm", "0.02 mm"), ("30 cm", "length", "dm", "3 dm")),
        ("-500 nm", "length", "nm", "-500 nm"),
        ("4.5 deg/um", "angle per length", "deg/mm", "4500 deg/mm"),
        ("0.7 1/um", "inverse length", "1/cm", "7000 1/cm"),
        *(("90 deg", "angle", "deg", "90 deg"), ("5 mT", "magnetic field", "G", "50 G")),
        ("-45 deg/(T cm)", "Verdet constant", "deg/(T cm)", "-45 deg/(T cm)"),
    ],
)
def test_units_are_changed_without_noise(text, dimension, unit, written):
    value = parse_quantity(text, dimension)
    assert format_quantity(value, unit) == written
    assert in_unit(value, unit) == float(written.split()[0])


ONES, TWOS = "1" * 300, "2" * 300
DIGITS = "0." + "0" * 300 + "1" * 700
LONG = ["1" * 1000 + "+" + "1" * 999, "1." * 900, "1" * 1999, "1 " + " " * 1990 + "x"]
LONG += ["(" + "1" * 1000 + "+" + "1" * 900 + ")", "1e" + "1" * 1900, "+" * 1990]
LONG += ["1" * 10**6, " " * 10**6 + "x", "1+" * 10**6 + "j"]


def test_numbers_may_be_complex_and_of_any_length():
    texts = ["0.3+0.4j", "0.4j", "(-0.9+0.1j)", " -0.3 - 2e-1j ", "1e-3j", f"{ONES}+{TWOS}j"]
    numbers = [0.3 + 0.4j, 0.4j, -0.9 + 0.1j, -0.3 - 0.2j, 1e-3j, complex(float(ONES), float(TWOS))]
    for text, value in zip(texts, numbers, strict=True):
        assert parse_quantity(text, "") == value
        assert parse_quantity(format_quantity(value, ""), "") == value
    assert parse_quantity(DIGITS, "") == float(DIGITS)
    for text in ("1e5000 nm", "-1e400 mm", "1e999999999 m", "1e-999999999 m"):
        assert parse_quantity(text, "length") in (math.inf, -math.inf, 0.0)
    with pytest.raises(UnitError, match="has 1000000 characters; no number needs as many") as error:
        parse_quantity("1" * 10**6, "")
    assert len(str(error.value)) < 300
    # Where digits could be read in two ways, the first of these took half a minute.
    for text, dimension in product(LONG, ("", "length")):
        with suppress(UnitError):
            assert parse_quantity(text, dimension) >= 1e300


def test_units_are_those_of_the_documents_and_all_are_listed():
    text = (Path(__file__).parents[2] / "docs" / "conventions.md").read_text("utf-8")
    rows = re.findall(r"^\| (\S[^|]*) \| (`[^|]*`) \|$", text, re.MULTILINE)
    told = {unit: dimension for dimension, units in rows for unit in re.findall("`([^`]+)`", units)}
    assert told == {name: unit.dimension for name, unit in UNITS.items()}
    with pytest.raises(op.OptipathError, match="unit 'furlongs' is unknown") as told:
        op.Parameter("p", unit="furlongs")
    assert set(str(told.value).partition("there are: ")[2].split(", ")) == set(UNITS)


def warned(action):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        action()
    return [str(one.message) for one in told]


WARNED = (
    "is a plain number beyond 2 pi, in radians; write degrees as '48 deg', and radians as '48 rad'"
)
A, T = op.Parameter("a"), op.Parameter("t")
D, HALF = op.Parameter("d", maximum=90), op.Parameter("d", 0.5, maximum=90)
UP, F = (op.Parameter("f", words={"up": angle}) for angle in (90, "400 deg"))
TURN = chain([op.Rotator(T)])


@rows(
    "action, what",
    [
        (lambda: op.Polarizer(45), "Polarizer angle"),
        (lambda: op.Rotator(4.0 * np.pi), "Rotator angle"),
        (lambda: op.Rotator(np.linspace(0, 180, 7)), "Rotator angle"),
        (lambda: op.Rotator([30.0, "1 deg"]), "Rotator angle"),
        (lambda: op.Rotator(np.float32(-45)), "Rotator angle"),
        (lambda: op.Interface(1.5, 0.1, azimuth=30), "Interface azimuth"),
        (lambda: op.VerticesByAngles((0.1, 0.2), (45,)), "turns[0]"),
        (lambda: op.Parameter("t", 45, unit="deg"), "parameter 't'"),
        (lambda: op.Parameter("t", unit="deg", maximum=180), "the maximum of parameter 't'"),
        (lambda: op.Rotator(op.Parameter("t", 45)), "Rotator angle"),
        (lambda: op.Parameter("f", words={"up": 90}, unit="deg"), "the word 'up' of parameter 'f'"),
        (lambda: op.Polarizer(UP), "the word 'up' of parameter 'f'"),
        (lambda: op.Polarizer(D), "the maximum of parameter 'd'"),
        (lambda: op.Interface(1.5, HALF), "the maximum of parameter 'd'"),
        (lambda: op.Frame().turned(90), "the angle of a turn"),
    ],
)
def test_a_plain_number_beyond_a_whole_turn_is_warned_of(action, what):
    (sentence,) = warned(action)
    assert sentence.endswith(f"{what} {WARNED}")


def test_a_warning_is_of_the_line_of_who_wrote_it_and_told_once_of_each_line():
    for action in (lambda: op.Polarizer(45), lambda: TURN.trace(t=45)):
        with pytest.warns(op.errors.AngleWarning) as told:
            action()
        assert told[0].filename == __file__
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("default")
        for angle in np.linspace(10.0, 90.0, 500):
            TURN.trace(t=angle)
    assert len(told) == sum("parameter 't' is" in str(key) for key in __warningregistry__) == 1


@rows(
    "action",
    [
        *(lambda: op.Polarizer("720 deg"), lambda: op.Rotator(["720 deg", "45 rad"])),
        *(lambda: op.Rotator(2.0 * np.pi), lambda: op.Parameter("t", 45.0)),
        lambda: op.Rotator(np.linspace(-2.0 * np.pi, 2.0 * np.pi, 9, dtype=np.float32)),
        lambda: op.Medium(op.Parameter("length"), rotation=500.0),
        lambda: chain([op.Medium(op.Parameter("l"), rotation="500 rad/m")]).bind(l=1.0).trace(),
        lambda: op.Polarizer(op.Parameter("f", words={"up": "400 deg"}, maximum="720 deg")),
        *(lambda: chain([op.Polarizer(F)]).bind(f="up"), lambda: op.Parameter("t", "720 deg")),
        lambda: [TURN.trace(t=t) for t in ("720 deg", ["720 deg", 0.5], op.CosSin(0.6, 0.8))],
        lambda: op.load_preset("malus", angle="340 deg").trace(),
        lambda: op.Polarizer(azimuth="45 rad") @ op.Light([1.0, 1.0, 0.0, 0.0]),
    ],
)
def test_what_is_said_to_be_in_degrees_or_is_in_radians_is_no_reason_to_warn(action):
    assert warned(action) == []


ASKS = {
    "every link": lambda **given: TURN.trace(keep="all", **given),
    "stream": lambda **given: list(TURN.compose().stream(10, **given)),
    "certificate": lambda **given: TURN.compose().certificate(**given),
    "run": lambda **given: op.Composer(engine="numpy").compose(TURN).run(**given),
}


@rows("ask", ["trace", "trace_all", "mueller", "paths", "bind", *ASKS])
def test_what_is_given_to_a_run_is_warned_of_once_however_often_and_however_many(ask):
    use = ASKS.get(ask, getattr(TURN, ask, None))
    for angle in (45, 60.0, [0.1, 45.0], np.linspace(0.0, 180.0, 4)):
        for _ in range(2):
            (sentence,) = warned(lambda: use(t=angle))  # noqa: B023
            assert sentence.startswith("parameter 't' ")
    for first in (0.1, np.linspace(0.0, 1.0, 5)):
        path = chain([op.Rotator(T)])
        for _ in range(10):
            path.trace(t=first)
        assert len(warned(lambda: path.trace(t=first * 100.0 + 50.0))) == 1  # noqa: B023
    large = np.zeros(10**6)
    large[300_000:700_000] = 90.0
    assert ask != "trace" or len(warned(lambda: path.trace(t=large))) == 1


IN_RADIANS = A * (np.pi / 180)
WITHIN = [
    *((IN_RADIANS, [10.0, 45.0, 360.0]), (A / 100, 270.0), (10 * A, 4.5), (10 * A, "30 deg")),
    (op.Parameter("a", 45, maximum=360) * (np.pi / 180), 90),
    (2 * A, np.linspace(0.0, 2.0 * np.pi, 50, endpoint=False).astype("f4")),
]


def test_a_multiple_is_warned_of_where_the_number_is_beyond_a_turn_and_not_within_it():
    for angle, value in product((10 * A, 2 * A - "10 deg", -A), (45, [0.5, -40.0])):
        path = chain([op.Rotator(angle)])
        for give in (path.trace, path.bind):
            assert warned(lambda: give(a=value)) == [f"parameter 'a' {WARNED}"]  # noqa: B023
    for angle, value in WITHIN:
        path = chain([op.Rotator(angle)])
        assert warned(lambda: path.trace(a=value)) == [], (angle, value)  # noqa: B023
    path = chain([op.Rotator(op.Parameter("a", 45) * (np.pi / 180))])
    assert warned(path.trace) == []


NPGR026 = op.load_preset("npgr026")
FACE = chain([op.Interface(1.5, T)])
TWICE, ACROSS = (chain([op.Interface(1.5, a)]) for a in (2 * A - "20 deg", "90 deg" - A))


@rows(
    "action",
    [
        *(lambda: NPGR026.trace(delta=[0.1, 48.0]), lambda: op.load_preset("npgr026", delta=48)),
        *(lambda: op.Interface(1.5, 48), lambda: op.Interface(1.5, op.Parameter("t", 48))),
        *(lambda: FACE.trace(t=48), lambda: FACE.bind(t=48), lambda: op.refraction_angle(1.5, 48)),
        *(lambda: op.Parameter("t", 48, "deg", 0.0, 1.5), lambda: TWICE.trace(a=[0.3, 48.0])),
        *(lambda: TWICE.bind(a=48), lambda: ACROSS.trace(a=48)),
    ],
)
def test_degrees_that_are_refused_are_offered_with_their_unit(action):
    with pytest.raises(op.OptipathError) as error:
        action()
    assert str(error.value).endswith("plain numbers are in radians, write degrees as '48 deg'")
    assert "'a'" in str(error.value) or "48 rad" in str(error.value)
    for path in (TWICE, ACROSS):
        path.trace(a="48 deg")


def test_what_are_no_plain_degrees_or_become_radians_in_the_path_is_offered_no_unit(capsys):
    path = chain([op.Interface(1.5, "90 deg" - IN_RADIANS)])
    refused = [(give, {"a": 100}) for give in (path.trace, path.bind)]
    refused += [(NPGR026.trace, {"delta": delta}) for delta in ("100 deg", np.radians(100.0), 1.6)]
    path = chain([op.Rotator(op.Parameter("d", maximum=80) * (np.pi / 180))])
    for give, values in [*refused, (path.trace, {"d": 85}), (path.bind, {"d": 85})]:
        with pytest.raises(op.errors.ParameterError) as error:
            give(**values)
        assert "plain numbers" not in str(error.value)
        assert "d" not in values or str(error.value).endswith("range; give 80 or less")
    # The command line reads degrees, and speaks of no radians.
    for delta in ("100", "48 rad", "100 deg"):
        assert main(["run", "npgr026", "--delta", delta]) == 2
        said = capsys.readouterr().err
        assert "outside its range; give 0 deg .. 90 deg" in said
        assert "did you mean" not in said
        assert "np." not in said
