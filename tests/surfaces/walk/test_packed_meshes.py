"""Meshes below each other do not touch, and stand as compiled code finds them."""

import numpy as np
import pytest

from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.walk import packed_meshes as packed
from optipath.surfaces.walk.mesh_pyramid import pyramid_of


def fields(rng):
    shapes = [((5, 9), True), ((33, 3), False), ((2, 2), True)]
    return [HeightField(rng.normal(size=shape), (3.0, 7.0), periodic) for shape, periodic in shapes]


def test_heights_and_their_extremes_are_found_by_their_places(rng):
    meshes = packed.packed_meshes(given := fields(rng))
    for place, field in enumerate(given):
        wholes = meshes.wholes[packed.WHOLES * place :][: packed.WHOLES]
        across, down = field.cells
        assert wholes[: packed.PYRAMID].tolist()[1:3] == [across, down]
        assert wholes[packed.PERIODIC] == field.periodic
        first = wholes[packed.HEIGHTS]
        vertices = meshes.heights[first:][: (across + 1) * (down + 1)].reshape(down + 1, across + 1)
        assert np.ptp(vertices - field.vertices()) < 1e-14
        levels = pyramid_of(vertices)
        assert wholes[packed.LEVELS] == len(levels) - 1
        for level, values in enumerate(levels[1:], 1):
            at = wholes[packed.PYRAMID + level]
            assert meshes.extremes[at:][: values.size].tolist() == values.ravel().tolist()


def test_meshes_are_apart_by_two_deviations_of_the_rougher(rng):
    given = fields(rng)
    numbers = packed.packed_meshes(given).numbers.reshape(-1, packed.NUMBERS)
    for place in (1, 2):
        gap = numbers[place - 1, packed.LOW] - numbers[place, packed.HIGH]
        deviation = max(given[place - 1].deviation, given[place].deviation)
        assert gap == pytest.approx(2.0 * deviation, rel=1e-12)
    assert np.all(numbers[:, packed.HIGH] >= numbers[:, packed.LOW])


def test_flat_meshes_are_apart():
    numbers = packed.packed_meshes([HeightField.flat()] * 2).numbers.reshape(-1, packed.NUMBERS)
    assert numbers[0, packed.LOW] > numbers[1, packed.HIGH]
