import numpy as np
import pytest

import optipath as op
from optipath.surfaces.decisions.smooth_exit import smooth_exit

GLASS = op.Sample([(1.5, 0.1), (2.4, 0.1)])


def fresnel(first, second, angle):
    """What a boundary reflects of s and p (M. Born, E. Wolf, Principles of Optics, eq. 1.5.21)."""
    cos, behind = np.cos(angle), np.sqrt(1.0 - (first * np.sin(angle) / second) ** 2)
    s = (first * cos - second * behind) / (first * cos + second * behind)
    p = (second * cos - first * behind) / (second * cos + first * behind)
    return np.array([s**2, p**2])


@pytest.mark.parametrize("incidence", [50.0, 65.0])
def test_it_is_the_product_of_three_boundaries_in_one_plane(incidence):
    there, back = np.radians([incidence, 80.0])
    inside = np.arcsin(np.sin([there, back]) / 1.5)
    ways = [1.0 - fresnel(1.0, 1.5, there), fresnel(1.5, 2.4, inside.mean())]
    ways.append(1.0 - fresnel(1.5, 1.0, inside[1]))
    exact = np.prod(ways, axis=0).mean() / np.prod([way.mean() for way in ways])
    assert smooth_exit(GLASS, there, back) == pytest.approx(exact - 1.0, rel=1e-12)


def test_light_of_the_topmost_interface_has_none():
    assert smooth_exit(GLASS, "60 deg", "80 deg", depth=0) == 0.0


def test_a_sample_under_three_interfaces_has_light_of_the_lowest():
    sample = op.Sample([(1.3, 0.1), (1.5, 0.1), (1.8, 0.1)])
    assert -0.2 < smooth_exit(sample, "60 deg", "80 deg", depth=2) < -0.1


def test_no_interface_there_is_told():
    with pytest.raises(op.SurfaceError, match="there is no interface 2; give one from 0 to 1"):
        smooth_exit(GLASS, 0.5, 0.5, depth=2)
