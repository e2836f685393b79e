"""Trails over the sphere with one parameter of a path."""

import numpy as np
import pytest

import optipath as op
from optipath.errors import ParameterError
from optipath.plots.states.parameter_trail import parameter_trail
from pictures import faults_of


def steps(ax):
    """How long the lines between neighbours are, as angles at the centre of the sphere."""
    lines = [each for each in ax.collections if hasattr(each, "_segments3d")]
    ends = np.concatenate([np.asarray(line._segments3d) for line in lines])
    return 2.0 * np.arcsin(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / 2.0)


def trail(preset, name, values=None):
    path = op.load_preset(preset)
    (detector,) = path.compose().program.detectors
    return parameter_trail(path, name, detector, values)


def test_fast_trails_keep_outside_the_sphere_and_too_fast_ones_are_told():
    ax = trail("lyot-depolarizer", "wavelength")
    assert np.degrees(steps(ax).max()) < 20.0
    assert ax.get_title() == ""
    assert faults_of(ax.figure) == []
    # A tenth of a metre of quartz turns by some thousand turns over the visible light.
    path = op.load_preset("lyot-depolarizer", thickness="100 mm")
    ax = parameter_trail(path, "wavelength", *path.compose().program.detectors)
    assert "faster with wavelength than 23041 points tell" in ax.get_title().replace("\n", " ")
    assert faults_of(ax.figure) == []
    ax = trail("lyot-depolarizer", "wavelength", "500 nm:600 nm:9")
    assert len(steps(ax)) == 8
    with pytest.raises(ParameterError, match="did you mean 'wavelength'"):
        trail("lyot-depolarizer", "wavelenth")
