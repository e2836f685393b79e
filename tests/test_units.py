import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from optipath.errors import UnitError
from optipath.units import UNITS, format_quantity, parse_quantity


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("90 deg", "angle", math.pi / 2),
        ("-1.5rad", "angle", -1.5),
        ("60 arcmin", "angle", math.pi / 180),
        ("516 nm", "length", 516e-9),
        ("1e-3 mm", "length", 1e-6),
        (" 2.5 ", "", 2.5),
    ],
)
def test_quantities_are_read_in_their_units(text, dimension, value):
    assert parse_quantity(text, dimension) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "dimension", "message"),
    [
        ("30 dgr", "angle", "'dgr' is unknown; did you mean 'deg'"),
        ("30", "angle", "'30' has no unit"),
        ("30 nm", "angle", "no angle"),
        ("30 deg", "", "pure number"),
        ("thirty deg", "angle", "not a quantity"),
        ("", "", "not a quantity"),
        ("nan deg", "angle", "not a quantity"),
        ("1_000", "", "unknown"),
    ],
)
def test_what_is_no_quantity_is_refused(text, dimension, message):
    with pytest.raises(UnitError, match=message):
        parse_quantity(text, dimension)


@given(value=st.floats(allow_nan=False, allow_infinity=False), unit=st.sampled_from(["", *UNITS]))
def test_writing_and_reading_gives_the_very_same_number(value, unit):
    dimension = UNITS[unit][0] if unit else ""
    assert parse_quantity(format_quantity(value, unit), dimension) == value
