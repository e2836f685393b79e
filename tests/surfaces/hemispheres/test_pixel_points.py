import numpy as np
import pytest

import optipath as op
from optipath.surfaces.hemispheres.pixel_points import pixel_points


@pytest.mark.parametrize("projection", ["equidistant", "equal-area"])
def test_points_lie_within_their_pixels(projection):
    sensor = op.surfaces.Sensor(9, projection)
    places = np.arange(81).reshape(9, 9)
    for directions, areas in pixel_points(sensor, 3):
        lit = areas > 0.0
        assert np.array_equal(sensor.place(directions[lit]), places[lit])
        assert np.all(directions[..., 2] > 0.0)
        assert np.allclose(np.linalg.norm(directions, axis=-1), 1.0, atol=1e-14)


@pytest.mark.parametrize("projection", ["equidistant", "equal-area"])
def test_polynomials_of_directions_are_averaged_as_over_the_hemisphere(projection):
    sensor, found = op.surfaces.Sensor(32, projection), np.zeros(4)
    for directions, areas in pixel_points(sensor, 4):
        x, y, z = np.moveaxis(directions, -1, 0)
        found += [np.sum(areas * each) for each in (z, z * z, x * x * z, x * y)]
    expected = np.pi * np.array([1.0, 2.0 / 3.0, 1.0 / 4.0, 0.0])
    assert np.allclose(found, expected, atol=2e-5)
