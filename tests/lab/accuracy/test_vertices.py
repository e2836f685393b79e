"""Chains of vertices in 50 digits."""

import numpy as np
import pytest

import optipath as op
from chains import MATERIALS, random_chains
from optipath.lab.accuracy.path_reference import exact_lights


@pytest.mark.parametrize("case", ["3", "6", "8"])
def test_points_in_space_give_the_same_light_as_angles_to_50_digits(case):
    space, plane = (op.load_preset(name, case=case) for name in ("npgr026-3d", "npgr026"))
    found, expected = exact_lights(space)["E"], exact_lights(plane)["E"]
    for one, other in zip(found.stokes, expected.stokes, strict=True):
        assert abs(one - other) <= 1e-50
    np.testing.assert_allclose(found.conditions, expected.conditions, rtol=1e-6, atol=1e-20)


@pytest.mark.parametrize("reflections", [1, 3, 5])
def test_light_along_a_chain_is_right_to_its_last_digits(reflections):
    points, materials = random_chains(1, reflections), MATERIALS[:reflections]
    path = op.path_from_vertices(points, materials, events="R" * reflections)
    exact = [float(component) for component in exact_lights(path)["eye"].stokes]
    np.testing.assert_allclose(path.trace().stokes, exact, rtol=0, atol=1e-14 * exact[0])
