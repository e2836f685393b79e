"""Blocks of a mesh are bounded by their lowest and highest points."""

import numpy as np
import pytest

from optipath.surfaces.walk.mesh_pyramid import SHIFT, levels_of, pyramid_of

CELLS = [(1, 1), (1, 2), (1, 17), (33, 1), (4, 4), (5, 4), (16, 64), (17, 65), (63, 3)]


@pytest.mark.parametrize("cells", CELLS)
def test_extremes_are_those_of_all_corners_of_a_block(cells, rng):
    across, down = cells
    vertices = rng.normal(size=(down + 1, across + 1))
    for level, found in enumerate(pyramid_of(vertices)):
        width = 1 << (SHIFT * level)
        for line, column in np.ndindex(found.shape[:2]):
            part = vertices[line * width :, column * width :][: width + 1, : width + 1]
            assert found[line, column].tolist() == [part.min(), part.max()]


@pytest.mark.parametrize("cells", CELLS)
def test_the_last_level_is_one_block_and_the_first_are_the_cells(cells):
    across, down = cells
    levels = pyramid_of(np.zeros((down + 1, across + 1)))
    assert len(levels) == levels_of(across, down) + 1
    assert levels[0].shape == (down, across, 2)
    assert levels[-1].shape == (1, 1, 2)
    assert all(len(each) * each.shape[1] > 1 for each in levels[:-1])


@pytest.mark.parametrize("cells", CELLS)
def test_blocks_cover_all_cells(cells):
    across, down = cells
    for level, found in enumerate(pyramid_of(np.zeros((down + 1, across + 1)))):
        width = 1 << (SHIFT * level)
        assert found.shape[:2] == (-(-down // width), -(-across // width))
