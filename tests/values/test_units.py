import math
import re
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.errors import UnitError
from optipath.values.units import UNITS, format_quantity, in_unit, parse_quantity
from tables import rows


@rows(
    "text, dimension, value",
    [
        ("90 deg", "angle", math.pi / 2),
        ("-1.5rad", "angle", -1.5),
        ("60 arcmin", "angle", math.pi / 180),
        ("516 nm", "length", 516e-9),
        ("1e-3 mm", "length", 1e-6),
        ("2 dm", "length", 0.2),
        ("0.5 1/cm", "inverse length", 50.0),
        ("3 1/um", "inverse length", 3e6),
        ("66.5 deg/dm", "angle per length", math.radians(665)),
        ("2 rad/mm", "angle per length", 2000.0),
        ("30 mT", "magnetic field", 0.03),
        ("2.5 kG", "magnetic field", 0.25),
        ("-134 rad/(T m)", "Verdet constant", -134.0),
        ("1 deg/(T cm)", "Verdet constant", math.radians(100)),
        ("0.12 arcmin/(G cm)", "Verdet constant", math.radians(0.12 / 60) * 1e6),
        (" 2.5 ", "", 2.5),
    ],
)
def test_quantities_are_read_in_their_units(text, dimension, value):
    assert parse_quantity(text, dimension) == pytest.approx(value, rel=1e-15)


@rows(
    "text, dimension, message",
    [
        ("30 dgr", "angle", "unit 'dgr' of '30 dgr' is unknown; did you mean 'deg'"),
        ("30°", "angle", "'°' of '30°' is unknown; did you mean 'deg'"),
        ("0.2+3.4i", "", r"'0.2\+3.4i' is not a quantity; did you mean '0.2\+3.4j'"),
        ("30,5 deg", "angle", "'30,5 deg' is not a quantity; did you mean '30.5 deg'"),
        ("30,40", "", r"'30.40'\? \(a text is one value; several are an array, in Python\)$"),
        ("45 degrees", "angle", "'degrees' of '45 degrees' is unknown; did you mean 'deg'"),
        ("0.5 µm", "length", "'µm' of '0.5 µm' is unknown; did you mean 'um'"),
        ("5000 Å", "length", "'Å' of '5000 Å' is unknown; did you mean 'angstrom'"),
        ("500 Nanometres", "length", "of '500 Nanometres' is unknown; did you mean 'nm'"),
        ("-5 / cm", "inverse length", r"'-5 / cm' is not a quantity; did you mean '-5 1/cm'"),
        ("5 cm^-1", "inverse length", r"of '5 cm\^-1' is unknown; did you mean '1/cm'"),
        ("30 furlongs", "angle", "unknown; there are: deg, rad, mrad, arcmin, arcsec$"),
        ("0:90:10", "angle", "^'0:90:10' is not a quantity; write a number such as '30 deg'$"),
        ("1, 2", "length", "^'1, 2' is not a quantity; write a number such as '30 nm'$"),
        ("1.5+2i", "", r"^'1.5\+2i' is not a quantity; did you mean '1.5\+2j'\?$"),
        ("30", "angle", "'30' has no unit"),
        ("30 nm", "angle", "no angle"),
        ("30 deg", "", "pure number"),
        ("30", "length", "a length is asked for; add one of nm, um"),
        ("5 mm", "inverse length", "no inverse length; use one of 1/um, 1/mm, 1/cm, 1/dm, 1/m"),
        ("5 deg", "angle per length", "no angle per length; use one of deg/um"),
        ("5 deg/km", "angle per length", "'deg/km' of '5 deg/km' is unknown; did you mean 'deg/m'"),
        ("3 tesla", "magnetic field", "'tesla' of '3 tesla' is unknown; did you mean 'T'"),
        ("3 gauss", "magnetic field", "did you mean 'G'"),
        ("5 min/(Oe cm)", "Verdet constant", r"did you mean 'arcmin/\(G cm\)'"),
        ("5 rad/T/m", "Verdet constant", r"did you mean 'rad/\(T m\)'"),
        ("5 rad", "Verdet constant", "'5 rad' is no Verdet constant; use one of rad/"),
        ("thirty deg", "angle", "not a quantity"),
        ("", "", "not a quantity"),
        ("nan deg", "angle", "not a quantity"),
        ("1_000", "", "not a quantity"),
    ],
)
def test_what_is_no_quantity_is_refused(text, dimension, message):
    with pytest.raises(UnitError, match=message):
        parse_quantity(text, dimension)


@given(value=st.floats(allow_nan=False, allow_infinity=False), unit=st.sampled_from(["", *UNITS]))
def test_writing_and_reading_gives_the_very_same_number(value, unit):
    dimension = UNITS[unit][0] if unit else ""
    assert parse_quantity(format_quantity(value, unit), dimension) == value


@rows(
    "text, dimension, unit, written",
    [
        ("20 um", "length", "mm", "0.02 mm"),
        ("30 cm", "length", "dm", "3 dm"),
        ("-500 nm", "length", "nm", "-500 nm"),
        ("4.5 deg/um", "angle per length", "deg/mm", "4500 deg/mm"),
        ("0.7 1/um", "inverse length", "1/cm", "7000 1/cm"),
        ("90 deg", "angle", "deg", "90 deg"),
        ("5 mT", "magnetic field", "G", "50 G"),
        ("-45 deg/(T cm)", "Verdet constant", "deg/(T cm)", "-45 deg/(T cm)"),
    ],
)
def test_units_are_changed_without_noise(text, dimension, unit, written):
    value = parse_quantity(text, dimension)
    assert format_quantity(value, unit) == written
    assert in_unit(value, unit) == float(written.split()[0])


@given(
    places=st.integers(0, 6), number=st.integers(-(10**9), 10**9), unit=st.sampled_from([*UNITS])
)
def test_reading_and_writing_gives_the_very_same_text(places, number, unit):
    text = f"{repr(number / 10**places).removesuffix('.0')} {unit}"
    assert format_quantity(parse_quantity(text, UNITS[unit].dimension), unit) == text


@rows(
    "text, value",
    [
        ("0.3+0.4j", 0.3 + 0.4j),
        ("0.4j", 0.4j),
        ("(-0.9+0.1j)", -0.9 + 0.1j),
        (" -0.3 - 2e-1j ", -0.3 - 0.2j),
        ("1e-3j", 1e-3j),
    ],
)
def test_numbers_without_dimension_may_be_complex(text, value):
    assert parse_quantity(text, "") == value
    assert parse_quantity(format_quantity(value, ""), "") == value


@rows("text", ["0.3+0.4", "0.30.4j", "(0.3+0.4j", "1_0+2j", "0.3+0.4j deg"])
def test_what_is_no_complex_number_is_refused(text):
    with pytest.raises(UnitError):
        parse_quantity(text, "")


LONG = [
    "1" * 1000 + "+" + "1" * 999,
    "1." * 900,
    "1" * 1999,
    "1 " + " " * 1990 + "x",
    "(" + "1" * 1000 + "+" + "1" * 900 + ")",
    "1e" + "1" * 1900,
    "+" * 1990,
    "1" * 10**6,
    " " * 10**6 + "x",
    "1+" * 10**6 + "j",
]


@rows("text", LONG)
@rows("dimension", ["", "length"])
def test_long_texts_are_read_in_time_that_grows_with_their_length(text, dimension):
    # Where digits could be read in two ways, the first of them took half a minute.
    with suppress(UnitError):
        assert parse_quantity(text, dimension) >= 1e300


def test_a_long_text_is_told_by_its_ends():
    with pytest.raises(UnitError, match="has 1000000 characters; no number needs as many") as error:
        parse_quantity("1" * 10**6, "")
    assert len(str(error.value)) < 300


@rows("text", ["1e5000 nm", "-1e400 mm", "1e999999999 m", "1e-999999999 m"])
def test_numbers_beyond_floats_are_infinite_or_0(text):
    assert parse_quantity(text, "length") in (math.inf, -math.inf, 0.0)


def test_numbers_of_many_digits_are_read_as_the_nearest():
    assert parse_quantity("0." + "0" * 300 + "1" * 700, "") == float("0." + "0" * 300 + "1" * 700)
    assert parse_quantity("1" * 300 + "+" + "2" * 300 + "j", "") == complex(
        float("1" * 300), float("2" * 300)
    )


def test_the_table_of_units_in_the_documents_is_that_of_the_library():
    text = (Path(__file__).parents[2] / "docs" / "conventions.md").read_text("utf-8")
    rows = re.findall(r"^\| (\S[^|]*) \| (`[^|]*`) \|$", text, re.MULTILINE)
    told = {unit: dimension for dimension, units in rows for unit in re.findall("`([^`]+)`", units)}
    assert told == {name: unit.dimension for name, unit in UNITS.items()}


@rows(
    "name, unit",
    [
        ("degrees", "deg"),
        ("Degree", "deg"),
        ("°", "deg"),
        ("radians", "rad"),
        ("meter", "m"),
        ("metres", "m"),
        ("micron", "um"),
        ("µm", "um"),
        ("μm", "um"),
        ("nanometers", "nm"),
        ("degrees per millimetre", "deg/mm"),
    ],
)
def test_a_common_name_of_a_unit_is_told_how_it_is_written(name, unit):
    with pytest.raises(op.OptipathError, match=f"'{name}' is unknown; did you mean '{unit}'"):
        op.Parameter("p", unit=name)


def test_of_an_unknown_unit_all_that_there_are_are_listed():
    with pytest.raises(op.OptipathError, match="unit 'furlongs' is unknown") as told:
        op.Parameter("p", unit="furlongs")
    assert set(str(told.value).partition("there are: ")[2].split(", ")) == set(UNITS)


@rows(
    "text, readings",
    [
        ("30 grad", "a grad is 0.9 deg where it is a gon, and 1 deg in German; write it in deg"),
        ("30 gon", "a gon is 0.9 deg; write it in deg"),
        ("1,000 deg", "a decimal point or part thousands; write '1.000 deg' or '1000 deg'"),
        ("30 grads", "in German; write it in deg"),
    ],
)
def test_a_text_that_may_be_read_in_two_ways_is_told_with_both(text, readings):
    with pytest.raises(op.OptipathError) as told:
        op.Polarizer(text)
    assert str(told.value).endswith(readings)
