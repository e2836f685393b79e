"""What agrees with a published number, and which photons measurements share."""

import math

import pytest

import optipath as op
from optipath.lab.published.experiment import Experiment, Measurement, Walks

AT_60, AT_80 = Walks("60 deg", (), None), Walks("80 deg", (), None)


@pytest.mark.parametrize(
    ("value", "error", "agrees"),
    [
        (0.165, 0.0, True),
        (0.151, 0.0, True),
        (0.149, 0.0, False),
        (0.149, 0.001, True),
        (0.195, 0.0, True),
        (0.1951, 0.0, False),
        (math.nan, 0.0, False),
    ],
)
def test_a_value_agrees_within_the_range_what_is_allowed_and_two_errors(value, error, agrees):
    one = Measurement("adm", "16.5 to 18 %", AT_60, (0.165, 0.18), within=0.0150001)
    assert one.agrees(value, error) is agrees


def test_what_has_no_published_number_neither_agrees_nor_not():
    assert Measurement("adm", "larger", AT_60).agrees(0.1, 0.01) is None


def test_measurements_of_one_direction_share_photons_in_the_order_of_the_file():
    several = tuple(
        Measurement(measure, "", walks)
        for measure, walks in [("adm", AT_60), ("adm", AT_80), ("mdm", AT_60), ("mdm", AT_80)]
    )
    found = Experiment("own", "", "", op.Sample([(1.5, 0.1)]), several).by_walks()
    assert [(walks, [one.measure for one in shared]) for walks, shared in found] == [
        (AT_60, ["adm", "mdm"]),
        (AT_80, ["adm", "mdm"]),
    ]
