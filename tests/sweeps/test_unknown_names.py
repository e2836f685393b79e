"""Options of a composer among the values of a sweep, and of what is uncertain."""

import pytest

import optipath as op


def test_options_of_a_composer_are_given_in_one():
    pytest.importorskip("xarray")
    with pytest.raises(op.ParameterError) as told:
        op.load_preset("malus").sweep(angle=[0.1], engine="numpy", dtype="float32", angel=1)
    assert told.value.faults[1] == (
        "'engine' and 'dtype' are no parameters of the path; give "
        "composer=op.Composer(engine='numpy', dtype='float32')"
    )
    assert "angel" in told.value.faults[0]
    composer = op.Composer(engine="numpy", dtype="float32")
    assert op.load_preset("malus").sweep(angle=[0.1], composer=composer).S0.dtype == "float32"


def test_uncertainty_takes_a_composer_as_well():
    with pytest.raises(op.ParameterError, match=r"composer=op\.Composer\(engine='numpy'\)$"):
        op.load_preset("malus").propagate(angle=(0.1, 0.01), engine="numpy")


def test_a_choice_of_a_path_is_no_option():
    with pytest.raises(op.ParameterError, match=r"parameter 'agle' is unknown; did you mean"):
        op.load_preset("malus").propagate(angle=(0.1, 0.01), agle=1.0)
