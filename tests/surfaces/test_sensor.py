"""Pixels of a hemisphere, what is summed in them, and what tells measurements from each other."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath import surfaces
from optipath.surfaces.hemisphere.beam import STATES, PartSums, PixelMask, SensedBeam
from optipath.surfaces.hemisphere.sensor import pixel_points
from optipath.surfaces.walk.beam import beam_of
from tables import rows

PROJECTIONS = ["equidistant", "equal-area"]


def density(projection, radius):
    """The solid angle over the area of the disc, from theta = pi r / 2, or 1 - cos theta = r^2."""
    if projection == "equal-area":
        return np.full_like(radius, 2.0)
    return np.pi / 2.0 * np.sin(np.pi * radius / 2.0) / radius


@rows("projection", PROJECTIONS)
@rows("pixels", [4, 5])
def test_solid_angles_are_those_of_many_small_cells(projection, pixels):
    parts = 400
    middle = (2.0 * np.arange(parts * pixels) + 1.0) / (parts * pixels) - 1.0
    radius = np.hypot(middle, middle[:, None])
    inside = np.where(radius < 1.0, density(projection, radius), 0.0)
    expected = inside.reshape(pixels, parts, pixels, parts).sum(axis=(1, 3))
    found = surfaces.Sensor(pixels, projection).solid_angle
    # Cells on the rim count as a whole or not at all.
    assert np.allclose(found, expected * (2.0 / (parts * pixels)) ** 2, rtol=2e-3)


@rows("projection", PROJECTIONS)
@rows("pixels", [1, 2, 6, 7, 16, 32, 128])
def test_pixels_have_the_solid_angles_of_a_hemisphere_and_directions_that_fall_on_them(
    projection, pixels
):
    sensor = surfaces.Sensor(pixels, projection)
    found, along = sensor.solid_angle, sensor.coordinates
    assert found.sum() == pytest.approx(2.0 * np.pi, rel=1e-12)
    assert found.min() >= -1e-15
    for image in (found[::-1], found[:, ::-1], found.T):
        assert np.allclose(image, found, rtol=1e-9, atol=1e-14)
    if projection == "equal-area":
        corner = np.abs(along) + 1.0 / pixels
        within = np.hypot(corner, corner[:, None]) <= 1.0
        assert np.allclose(found[within], 2.0 * (2.0 / pixels) ** 2, rtol=1e-12)
    # The direction of a centre falls on its pixel, unless it is beyond the horizon.
    beyond = np.hypot(along, along[:, None]) > 1.0
    for each in (sensor.theta, sensor.phi, sensor.directions.sum(axis=-1)):
        assert np.array_equal(np.isnan(each), beyond)
    assert np.nanmax(sensor.theta) < np.pi / 2.0
    places = np.arange(pixels**2).reshape(pixels, pixels)
    for side in (1.0, -1.0):
        found = sensor.place(sensor.directions[~beyond] * [1.0, 1.0, side])
        assert np.array_equal(found, places[~beyond])


TURNS, KINDS = st.floats(-np.pi, np.pi), st.sampled_from(PROJECTIONS)


@given(st.floats(0.0, 1.0), TURNS, st.integers(1, 300), KINDS)
def test_every_direction_falls_within_half_a_pixel_of_a_centre(cos, azimuth, pixels, projection):
    sensor, sin = surfaces.Sensor(pixels, projection), np.sqrt(1.0 - cos * cos)
    place = sensor.place([sin * np.cos(azimuth), sin * np.sin(azimuth), cos])
    theta = np.arctan2(sin, cos)
    radius = 2.0 * theta / np.pi
    if projection == "equal-area":
        radius = np.sqrt(2.0) * np.sin(theta / 2)
    row, column = divmod(int(place), pixels)
    centre = sensor.coordinates[[column, row]]
    off = centre - radius * np.array([np.cos(azimuth), np.sin(azimuth)])
    assert np.max(np.abs(off)) <= (1.0 + 1e-9) / pixels + 1e-9


def test_light_that_goes_on_is_on_the_right_and_y_goes_with_rows():
    sensor = surfaces.Sensor(5)
    assert sensor.place([[0.6, 0, 0.8], [0, 0.6, 0.8], [0, 0, 1]]).tolist() == [13, 17, 12]
    assert (sensor.phi[2, 4], sensor.phi[4, 2]) == (0.0, pytest.approx(np.pi / 2.0))
    with pytest.raises(op.errors.SurfaceError) as caught:
        surfaces.Sensor(0, "equi-area", 1)
    assert [*caught.value.faults] == [
        "pixels must be a whole number of 1 or more, not 0",
        "parts must be a whole number of 2 or more, not 1",
        "projection 'equi-area' is unknown; did you mean 'equal-area'?",
    ]


@rows("projection", PROJECTIONS)
def test_points_lie_within_their_pixels_and_average_polynomials_as_over_the_hemisphere(projection):
    sensor, places = surfaces.Sensor(9, projection), np.arange(81).reshape(9, 9)
    for directions, areas in pixel_points(sensor, 3):
        lit = areas > 0.0
        assert np.array_equal(sensor.place(directions[lit]), places[lit])
        assert np.all(directions[..., 2] > 0.0)
        assert np.allclose(np.linalg.norm(directions, axis=-1), 1.0, atol=1e-14)
    found = np.zeros(4)
    for directions, areas in pixel_points(surfaces.Sensor(32, projection), 4):
        x, y, z = np.moveaxis(directions, -1, 0)
        found += [np.sum(areas * each) for each in (z, z * z, x * x * z, x * y)]
    assert np.allclose(found, np.pi * np.array([1.0, 2.0 / 3.0, 0.25, 0.0]), atol=2e-5)


def test_pixels_count_that_are_bright_and_known_by_a_share_or_by_themselves():
    light = np.array([[np.nan, 1.0], [2.0, 9.0]])  # The mean is 4.
    bright = PixelMask(brighter_than=0.5).bright(light)
    np.testing.assert_array_equal(bright, [[False, False], [False, True]])
    assert PixelMask(brighter_than=0.3).bright(light).sum() == 2
    mask = PixelMask(noise=0.2, known_to=0.001)
    known = mask.known(np.array([-0.1, 0.1, 0.0, 0.1]), np.array([0.019, 0.021, 0.001, np.nan]))
    np.testing.assert_array_equal(known, [True, False, True, False])
    # Any noise leaves out what is no number only.
    known = PixelMask(noise=None).known(np.array([np.nan, 0.1]), np.array([0.0, np.nan]))
    np.testing.assert_array_equal(known, [False, True])
    with pytest.raises(op.errors.SurfaceError) as caught:
        PixelMask(-1.0, noise=True, known_to=np.inf)
    faults = [fault.split()[0] for fault in caught.value.faults]
    assert faults == ["brighter_than", "noise", "known_to"]


SHAPE = (6, 1, 4, 4, 2, 17)
MIRROR = np.diag([1.0, 1.0, -1.0, -1.0])


def drawn(seed=1, shape=SHAPE):
    random = np.random.default_rng(seed)
    photons = random.integers(50, 90, shape[0])
    return PartSums(random.normal(size=shape), np.ones(shape[1:4], int), photons)


def test_a_mean_of_equal_parts_has_the_error_of_a_mean():
    parts = drawn()._replace(photons=np.full(6, 70))
    value, error = parts.estimate(lambda light: light)
    each = parts.sums / 70
    assert np.allclose(value, each.mean(axis=0), rtol=1e-12)
    assert np.allclose(error, each.std(axis=0, ddof=1) / np.sqrt(6), rtol=1e-9)
    # One part says nothing of it, and those without photons do not count.
    _, error = drawn(shape=(1, *SHAPE[1:])).estimate(lambda light: light)
    assert np.all(np.isnan(error))
    parts = drawn()
    sums = np.concatenate([parts.sums, np.zeros((3, *SHAPE[1:]))])
    more = PartSums(sums, parts.counts, np.append(parts.photons, [0, 0, 0]))
    for found, expected in zip(more.estimate(np.exp), parts.estimate(np.exp), strict=True):
        assert np.allclose(found, expected, rtol=1e-13)

    # That of a ratio is that of its linear part.
    sums = 1000.0 + np.random.default_rng(3).normal(size=SHAPE)
    parts = PartSums(sums, np.ones(SHAPE[1:4], int), np.full(6, 100))
    _, error = parts.estimate(lambda light: light[..., 1] / light[..., 0])
    a, b = sums[..., 0], sums[..., 1]
    linear = (b - b.mean(axis=0) / a.mean(axis=0) * a) / a.mean(axis=0)
    assert np.allclose(error, linear.std(axis=0, ddof=1) / np.sqrt(6), rtol=1e-2)


def test_mirror_images_are_those_of_mueller_matrices_and_sums_are_added_in_place():
    parts = drawn()
    found = parts.mirrored().sums
    matrices = parts.sums[..., :16].reshape(*SHAPE[:-1], 4, 4)
    images = MIRROR @ matrices[:, :, ::-1] @ MIRROR
    assert np.allclose(found[..., :16], (0.5 * (matrices + images)).reshape(*SHAPE[:-1], 16))
    scalar = parts.sums[..., 16]
    assert np.allclose(found[..., 16], 0.5 * (scalar + scalar[:, :, ::-1]))
    for numbers in (1, 16, 17):
        once = drawn(shape=(*SHAPE[:-1], numbers)).mirrored()
        assert np.allclose(once.mirrored().sums, once.sums, rtol=1e-15), "of an image, itself"
    one, other = drawn(1), drawn(2)
    expected = [here + there for here, there in zip(one, other, strict=True)]
    one.add(other)
    assert all(np.array_equal(*pair) for pair in zip(one, expected, strict=True))


SAMPLE = op.Sample([(1.5, 0.3), (0.5 + 2.1j, (0.1, 0.2))])
UPPER, BASE = SAMPLE.layers


def identity(sample=SAMPLE, incidence="50 deg", photons=100, when=(np.nan,), code="1", **options):
    sensor = options.pop("sensor", surfaces.Sensor(16))
    kinds = options.pop("polarized", "both"), options.pop("events", None)
    beam = replace(beam_of(sample, incidence, **options), states=STATES)
    chunks = pytest.importorskip("optipath.surfaces.hemisphere.chunks")
    seen = SensedBeam(beam, sensor, *kinds)
    return chunks.ChunkJob(seen, np.array(when), photons, code=code).identity


def test_whatever_changes_the_bits_is_another_identity():
    layers = [[(1.5, np.nextafter(0.3, 1.0)), BASE], [(1.4, 0.3), BASE]]
    layers += [[UPPER, (0.5 + 2.1j, (0.2, 0.1))], [UPPER, (0.5 + 2.2j, (0.1, 0.2))]]
    options = {"outside": 1.1, "cells": 700, "surfaces": 3, "seed": 1, "periodic": False}
    samples = [op.Sample(each) for each in layers]
    samples += [op.Sample(SAMPLE.layers, **{name: value}) for name, value in options.items()]
    others = [{"sample": each} for each in samples]
    changed = {"incidence": np.nextafter(np.radians(50.0), 1.0), "azimuth": 0.1, "photons": 101}
    changed |= {"seed": 1, "most_events": 7, "polarized": "polarized", "events": 1}
    changed |= {"when": (5e-7,), "code": "2"}
    others += [{name: value} for name, value in changed.items()]
    sensors = surfaces.Sensor(17), surfaces.Sensor(16, "equal-area"), surfaces.Sensor(16, parts=8)
    for other in (*others, *({"sensor": each} for each in sensors)):
        assert identity(**other) != identity(), other


def test_heights_are_told_apart_by_all_that_they_are():
    heights = np.zeros((4, 4))
    higher = heights.copy()
    higher[2, 1] = 1e-300
    given = [(each, 3.0, False) for each in (heights, higher, np.zeros((4, 5)))]
    given += [(heights, np.nextafter(3.0, 4.0), False), (heights, (3.0, 2.0), False)]
    fields = [surfaces.HeightField(*each) for each in (*given, (heights, 3.0, True))]
    assert len({identity(op.Sample([(1.5, field)])) for field in fields}) == 6


def test_what_makes_no_difference_is_none_nor_is_an_index_by_name():
    there = identity(op.Sample([(op.Material.cauchy([1.5]), 0.3)]), wavelength="500 nm")
    assert there == identity(op.Sample([(1.5, 0.3)]))
    assert identity(op.Sample(SAMPLE.layers, description="glass over metal")) == identity()
    assert identity(seed=np.int64(3)) == identity(seed=3)
    assert identity(sensor=surfaces.Sensor(np.int64(16))) == identity()
