import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op

PROJECTIONS = ["equidistant", "equal-area"]


def density(projection, radius):
    """The solid angle over the area of the disc, from theta = pi r / 2, or 1 - cos theta = r^2."""
    if projection == "equal-area":
        return np.full_like(radius, 2.0)
    return np.pi / 2.0 * np.sin(np.pi * radius / 2.0) / radius


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize("pixels", [4, 5])
def test_solid_angles_are_those_of_many_small_cells(projection, pixels):
    parts = 400
    middle = (2.0 * np.arange(parts * pixels) + 1.0) / (parts * pixels) - 1.0
    radius = np.hypot(middle, middle[:, None])
    inside = np.where(radius < 1.0, density(projection, radius), 0.0)
    expected = inside.reshape(pixels, parts, pixels, parts).sum(axis=(1, 3))
    found = op.surfaces.Sensor(pixels, projection).solid_angle
    # Cells on the rim count as a whole or not at all.
    assert np.allclose(found, expected * (2.0 / (parts * pixels)) ** 2, rtol=2e-3)


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize("pixels", [1, 2, 7, 16, 128])
def test_solid_angles_are_those_of_a_hemisphere(projection, pixels):
    found = op.surfaces.Sensor(pixels, projection).solid_angle
    assert found.sum() == pytest.approx(2.0 * np.pi, rel=1e-12)
    assert found.min() >= -1e-15
    for image in (found[::-1], found[:, ::-1], found.T):
        assert np.allclose(image, found, rtol=1e-9, atol=1e-14)


def test_pixels_of_equal_area_within_the_hemisphere_are_equal():
    sensor = op.surfaces.Sensor(32, "equal-area")
    corner = np.abs(sensor.coordinates) + 1.0 / 32
    within = np.hypot(corner, corner[:, None]) <= 1.0
    assert np.allclose(sensor.solid_angle[within], 2.0 * (2.0 / 32) ** 2, rtol=1e-12)


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize("pixels", [1, 6, 7, 128])
def test_the_direction_of_a_centre_falls_on_its_pixel(projection, pixels):
    sensor = op.surfaces.Sensor(pixels, projection)
    there = ~np.isnan(sensor.theta)
    places = np.arange(pixels**2).reshape(pixels, pixels)
    for side in (1.0, -1.0):
        found = sensor.place(sensor.directions[there] * [1.0, 1.0, side])
        assert np.array_equal(found, places[there])


@pytest.mark.parametrize("projection", PROJECTIONS)
def test_centres_beyond_the_horizon_have_no_direction(projection):
    sensor = op.surfaces.Sensor(16, projection)
    beyond = np.hypot(sensor.coordinates, sensor.coordinates[:, None]) > 1.0
    assert np.array_equal(np.isnan(sensor.theta), beyond)
    assert np.array_equal(np.isnan(sensor.phi), beyond)
    assert np.array_equal(np.isnan(sensor.directions).all(axis=-1), beyond)
    assert np.nanmax(sensor.theta) < np.pi / 2.0


@given(
    cos=st.floats(0.0, 1.0),
    azimuth=st.floats(-np.pi, np.pi),
    pixels=st.integers(1, 300),
    projection=st.sampled_from(PROJECTIONS),
)
def test_every_direction_falls_within_half_a_pixel_of_a_centre(cos, azimuth, pixels, projection):
    sensor = op.surfaces.Sensor(pixels, projection)
    sin = np.sqrt(1.0 - cos * cos)
    place = sensor.place([sin * np.cos(azimuth), sin * np.sin(azimuth), cos])
    theta = np.arctan2(sin, cos)
    radius = (
        2.0 * theta / np.pi if projection == "equidistant" else np.sqrt(2.0) * np.sin(theta / 2)
    )
    row, column = divmod(int(place), pixels)
    off = [
        sensor.coordinates[column] - radius * np.cos(azimuth),
        sensor.coordinates[row] - radius * np.sin(azimuth),
    ]
    assert np.max(np.abs(off)) <= (1.0 + 1e-9) / pixels + 1e-9


def test_light_that_goes_on_is_on_the_right_and_y_goes_with_rows():
    sensor = op.surfaces.Sensor(5)
    assert sensor.place([[0.6, 0, 0.8], [0, 0.6, 0.8], [0, 0, 1]]).tolist() == [13, 17, 12]
    assert sensor.phi[2, 4] == 0.0
    assert sensor.phi[4, 2] == pytest.approx(np.pi / 2.0)


def test_all_faults_of_a_sensor_are_told_at_once():
    with pytest.raises(op.SurfaceError) as caught:
        op.surfaces.Sensor(0, "equi-area", 1)
    assert [*caught.value.faults] == [
        "pixels must be a whole number of 1 or more, not 0",
        "parts must be a whole number of 2 or more, not 1",
        "projection is 'equi-area'; did you mean 'equal-area'?",
    ]
