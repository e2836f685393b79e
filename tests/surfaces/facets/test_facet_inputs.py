"""What the analytic facet model is given, and what is said where that is wrong."""

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import single_scattering


def direction(theta):
    return np.array([np.sin(theta), 0.0, np.cos(theta)])


def down(theta):
    return direction(theta) * (1.0, 1.0, -1.0)


def test_a_material_is_asked_for_its_index_at_the_wavelength():
    glass = op.Material.cauchy([1.5, 0.004])
    found = single_scattering(glass, 0.3, down(0.5), direction(0.5), wavelength="500 nm")
    same = single_scattering(1.516, 0.3, down(0.5), direction(0.5))
    np.testing.assert_allclose(found.matrix, same.matrix, rtol=1e-13)


WRONG = [
    (
        {"alpha": 0.0},
        "alpha is 0; give one above 0, or for a flat surface, whose slopes have no density",
    ),
    ({"alpha_y": [0.3, -1.0, 2.0]}, "alpha_y is -1 at 1; give one above 0"),
    ({"alpha": np.nan}, "alpha is nan; give a finite alpha"),
    ({"alpha": (0.1, 0.2)}, "may be along x and y, or of two surfaces"),
    ({"alpha": op.Parameter("a")}, "alpha follows from the parameter 'a'"),
    ({"index": -1.5}, "index is -1.5; give an index of refraction n + ik"),
    ({"index": op.Material(op.Parameter("n"))}, "index follows from the parameter 'n'"),
    ({"index": op.Material.cauchy([1.5, 0.004])}, "index depends on the wavelength; give one"),
    ({"outside": 1.5 + 0.1j}, "outside is complex; give a real index of refraction above 0"),
    ({"wavelength": "500 nm"}, "wavelength is given, but no medium depends on it; leave it out"),
    ({"masking": "smiht"}, "masking 'smiht' is unknown; did you mean 'smith'?"),
    ({"incoming": direction(0.5)}, "incoming has z = 0.877583; it is the direction in which"),
    ({"outgoing": [direction(0.5), down(0.5)]}, "outgoing at 1 has z = -0.877583"),
    ({"outgoing": (0.0, 0.0, 2.0)}, "outgoing is no unit vector; divide it by its length"),
    ({"incoming": (0.0, 0.0, -1e308)}, "incoming is no unit vector"),
    ({"incoming": down(np.pi / 2)}, "incoming is along the surface"),
    ({"incoming": (0.0, 1.0)}, "incoming must have shape"),
    ({"outgoing": (0.0, np.nan, 1.0)}, "outgoing must be finite"),
    ({"alpha": np.ones(3), "outgoing": [direction(0.5)] * 2}, "arrays do not broadcast"),
]


@pytest.mark.parametrize(("wrong", "sentence"), WRONG)
def test_what_is_wrong_is_told(wrong, sentence):
    right = {"index": 1.5, "alpha": 0.3, "incoming": down(0.5), "outgoing": direction(0.5)}
    with pytest.raises(op.SurfaceError) as told:
        single_scattering(**right | wrong)
    assert len(told.value.faults) == 1
    assert sentence in str(told.value)


def test_all_that_is_wrong_is_told_at_once():
    with pytest.raises(op.SurfaceError) as told:
        single_scattering(-1.0, 0.0, direction(0.5), down(0.5), masking="no")
    assert len(told.value.faults) == 5
