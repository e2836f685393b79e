"""Coordinates, units and names of a sweep's Dataset."""

import numpy as np
import pytest

import optipath as op
from tables import rows

pytest.importorskip("xarray")


def test_axes_have_the_unit_in_which_they_were_given():
    found = op.load_preset("glass-slab").sweep(
        theta=["10 deg", "20 deg"], length=[0.001, 0.002], n=np.array([1.4, 1.5])
    )
    units = {name: found[name].attrs["units"] for name in found.dims}
    assert units == {"theta": "deg", "length": "m", "n": "1"}
    assert found.theta.values.tolist() == [10.0, 20.0]


def test_long_names_are_the_help_of_parameters():
    path = op.load_preset("npgr026")
    found = path.sweep(delta=[0.1, 0.2])
    told = {name: found[name].attrs["long_name"] for name in found.coords}
    assert told == {name: parameter.help for name, parameter in path.parameters.items()}


def test_what_is_fixed_is_a_coordinate_as_it_was_given_or_is_by_default():
    found = op.load_preset("npgr026").sweep(delta=[0.1, 0.2], phi="30 deg", rho=0.5)
    assert found.phi.shape == ()
    assert found.phi == 30.0
    assert {name: found[name].units for name in ("phi", "rho")} == {"phi": "deg", "rho": "rad"}
    assert found.n2 == 1.5
    assert found["filter"] == "none"


@rows("word", ["horizontal", "none", "30 deg", 0.3])
def test_a_single_value_is_labelled_as_an_axis_of_that_value(word):
    path, given = op.load_preset("npgr026"), {"delta": ["10 deg", "20 deg"], "n1": 1}
    fixed, axis = path.sweep(**given, filter=word), path.sweep(**given, filter=[word])
    assert axis.isel(filter=0).identical(fixed)
    assert path.sweep(coords=fixed).identical(fixed)


def test_one_value_in_two_units_is_one_in_two_datasets():
    path = op.load_preset("malus")
    found = path.sweep(angle="30 deg"), path.sweep(angle=np.radians(30.0))
    assert [each.angle.units for each in found] == ["deg", "rad"]
    assert found[0].S0.values == found[1].S0.values


def test_a_fixed_complex_value_is_a_text_that_files_take():
    path = op.Source() >> op.Interface(op.Parameter("m"), op.Parameter("theta")) >> op.Detector()
    found = path.sweep(theta=[0.1, 0.2], m=0.2 + 3.4j)
    assert found.m.item() == "(0.2+3.4j)"


def test_variables_have_units_but_those_of_the_source():
    found = op.load_preset("npgr026").sweep(rho=[0.1, 0.2])
    units = {name: each.attrs.get("units") for name, each in found.data_vars.items()}
    assert units == {
        **dict.fromkeys(["S0", "S1", "S2", "S3"]),
        **dict.fromkeys(["DoP", "DoLP", "ellipticity"], "1"),
        **dict.fromkeys(["AoP", "Psi", "Delta"], "rad"),
    }
    assert all(each.attrs["long_name"] for each in found.data_vars.values())
