"""What variables are called beside parameters with names like theirs."""

import pytest

import optipath as op
from tables import rows

pytest.importorskip("xarray")


def path_of(name, detectors=1):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    lamp >> path.add("splitter", op.BeamSplitter(op.Parameter(name)))
    for way in ["reflected", "transmitted"][:detectors]:
        path.add(way, op.Detector())
        path.connect(f"splitter.{way}", f"{way}.in")
    return path


@rows("name", ["psi", "delta"])
def test_both_ellipsometric_angles_have_capitals_beside_a_parameter_of_either_name(name):
    found = path_of(name).sweep(**{name: [0.2, 0.4]})
    assert {"Psi", "Delta"} <= {*found.data_vars}
    assert not {"psi", "delta"} & {*found.data_vars}


def test_otherwise_they_have_small_letters():
    assert {"psi", "delta"} <= {*path_of("share").sweep(share=[0.2, 0.4]).data_vars}


@rows("name", ["S0", "DoP", "log10_intensity"])
def test_a_parameter_called_as_a_variable_is_refused(name):
    with pytest.raises(op.ParameterError, match=f"'{name}' is what a sweep calls a variable"):
        path_of(name).sweep(**{name: [0.2, 0.4]})


def test_a_parameter_called_detector_is_refused_where_there_are_several():
    assert path_of("detector").sweep(detector=[0.2, 0.4]).S0.dims == ("detector",)
    with pytest.raises(op.ParameterError, match="calls a dimension of its own"):
        path_of("detector", 2).sweep(detector=[0.2, 0.4])
