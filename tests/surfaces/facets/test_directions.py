"""Frames of light along directions to a surface and from it."""

import numpy as np
import pytest

from optipath.errors import SurfaceError
from optipath.surfaces.facets.directions import frame_along


def test_x_is_the_normal_cross_the_direction():
    z = np.array([[0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [0.48, 0.36, 0.8]])
    frame = frame_along("outgoing", z, up=True)
    x = np.cross((0.0, 0.0, 1.0), z)
    np.testing.assert_allclose(frame.x, x / np.linalg.norm(x, axis=-1, keepdims=True), atol=1e-16)
    np.testing.assert_allclose(frame.y, np.cross(z, frame.x), atol=1e-16)


@pytest.mark.parametrize("beside", [1e-9, 1e-100, 5e-324, 0.0])
@pytest.mark.parametrize(("up", "z"), [(True, 1.0), (False, -1.0)])
def test_along_the_normal_x_is_as_beside_it_towards_x(beside, up, z):
    frame = frame_along("k", (beside, 0.0, z), up=up)
    np.testing.assert_array_equal(frame.x, (0.0, 1.0, 0.0))


def test_a_unit_vector_keeps_its_digits_and_one_of_single_precision_becomes_one():
    k = (0.48, 0.36, 0.8)
    np.testing.assert_array_equal(frame_along("k", k, up=True).z, k)
    single = frame_along("k", np.array([0.1, 0.2, 0.9746794], np.float32), up=True)
    assert np.linalg.norm(single.z) == pytest.approx(1.0, rel=1e-15)
    assert single.rounding == 2.0**-23


@pytest.mark.parametrize(
    ("k", "sentence"),
    [
        ((0.6, 0.0, 0.8000001), "k is no unit vector"),
        ((np.cos(1e-17), 0.0, 1e-17), "k is along the surface"),
        ([(0.6, 0.0, 0.8), (0.6, 0.0, -0.8)], "k at 1 has z = -0.8"),
    ],
)
def test_what_is_no_direction_from_the_surface_is_told(k, sentence):
    with pytest.raises(SurfaceError, match=sentence):
        frame_along("k", k, up=True)
