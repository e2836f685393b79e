"""Where a sweep is cut into blocks."""

import pytest

import optipath as op
from optipath.sweeps.chunked.chunk_sizes import BLOCK, chunk_sizes
from tables import rows

SIZES = {"delta": 3000, "rho": 1000, "phi": 500}


def test_blocks_of_a_size_of_their_own_are_of_about_a_million_and_whole_inside():
    assert chunk_sizes("auto", SIZES) == {"delta": 2, "rho": 1000, "phi": 500}


def test_a_long_axis_is_cut_evenly():
    (size,) = chunk_sizes("auto", {"delta": BLOCK + 2}).values()
    assert size == BLOCK // 2 + 1


def test_several_detectors_share_the_room():
    assert chunk_sizes("auto", {"delta": 10, "rho": BLOCK}, 4)["rho"] == BLOCK // 4


def test_a_number_is_of_values_along_each_dimension_and_at_most_all():
    assert chunk_sizes(700, SIZES) == {"delta": 700, "rho": 700, "phi": 500}


def test_dimensions_that_are_not_named_are_cut_in_the_room_that_is_left():
    assert chunk_sizes({"delta": 3000}, SIZES) == {"delta": 3000, "rho": 1, "phi": 250}


def test_a_dimension_is_kept_whole_by_minus_one():
    assert chunk_sizes({"rho": -1, "phi": 10}, SIZES)["rho"] == 1000
    assert chunk_sizes(-1, SIZES) == SIZES


def test_a_dimension_may_be_auto_itself():
    assert chunk_sizes({"rho": "auto", "phi": 10}, SIZES) == chunk_sizes({"phi": 10}, SIZES)


@rows("chunks", [0, -2, 1.5, True, "big", None, [10]])
def test_what_is_no_size_is_refused_with_what_would_be(chunks):
    with pytest.raises(op.ParameterError, match=r"give 'auto', a number .* or {'delta': 10}"):
        chunk_sizes(chunks, SIZES)


def test_all_faults_of_a_mapping_are_told_at_once():
    with pytest.raises(op.ParameterError) as caught:
        chunk_sizes({"dleta": 10, "rho": "x", "phi": 0, 3: 1}, SIZES)
    assert len(caught.value.faults) == 4
    assert "did you mean 'delta'?" in caught.value.faults[0]


def test_without_an_axis_nothing_can_be_cut():
    with pytest.raises(op.ParameterError, match="there is no axis"):
        chunk_sizes("auto", {})
