"""Quantities as they are displayed, without the noise of units."""

import math

import optipath as op
from optipath.values.displayed import format_range
from tables import rows


def test_the_default_of_a_parameter_is_displayed_without_noise():
    assert op.Parameter("p", "3 deg", unit="arcmin").default_text() == "180 arcmin"


@rows(
    "low, high, unit, written",
    [
        (0.0, math.radians(3.0), "arcmin", "0 arcmin .. 180 arcmin"),
        (-2.0 * math.pi, math.inf, "rad", "-6.283185307179586 rad or more"),
        (math.radians(-90.0), math.radians(90.0), "deg", "-90 deg .. 90 deg"),
    ],
)
def test_the_ends_of_a_range_are_inside_as_they_are_written(low, high, unit, written):
    assert format_range(low, high, unit) == written
    ends = written.removesuffix(" or more").split(" .. ")
    parameter = op.Parameter("p", unit=unit, minimum=low, maximum=high)
    for end in ends:
        parameter.resolve(end)
