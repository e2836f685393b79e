"""Light from outside gets to the highest point of a mesh, or to its lowest."""

import numpy as np
import pytest

from uncompiled import uncompiled

pytest.importorskip("numba")

from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.walk import mesh_entry as walk
from optipath.surfaces.walk.packed_meshes import packed_meshes

mesh_entry = uncompiled(walk.mesh_entry)
HEIGHTS = [[0.0, 1.0, 0.5], [0.0, 0.5, 0.0], [0.0, 0.0, -1.0]]


def entered(field, point, k, side=1.0, start=(0.0, 0.0)):
    with np.errstate(all="ignore"):
        return mesh_entry(tuple(packed_meshes([field])), 0, side, point, np.float64(k), start)


@pytest.mark.parametrize(("side", "height"), [(1.0, 1.0), (-1.0, -1.0)])
def test_light_gets_to_the_edge_of_a_mesh_along_its_direction(side, height):
    field = HeightField(HEIGHTS, (4.0, 2.0))
    inside, point, x, y = entered(field, (0.0, 0.0, 5 * side), (0.6, 0.0, -0.8 * side), side)
    assert inside
    assert point == (pytest.approx(3.0, rel=1e-15), 0.0, height)
    assert (x, y) == (pytest.approx(1.5, rel=1e-15), 0.0)


def test_light_beside_a_finite_mesh_is_not_inside():
    field = HeightField(HEIGHTS, 2.0)
    assert not entered(field, (0.0, 0.0, 5.0), (0.6, 0.0, -0.8))[0]
    assert not entered(field, (0.0, 0.0, 5.0), (-0.6, 0.0, -0.8))[0]


def test_a_periodic_mesh_is_met_where_its_period_says():
    field = HeightField(HEIGHTS, 3.0, periodic=True)
    _, _, x, y = entered(field, (0.0, 0.0, 5.0), (-0.6, 0.0, -0.8), start=(1.0, 2.5))
    assert (x, y) == (pytest.approx(1.0, rel=1e-15), 2.5)


@pytest.mark.parametrize("upwards", [0.0, -1e-300, -1e-30])
@pytest.mark.parametrize("height", [1.0, 5.0])
@pytest.mark.parametrize("along", [-1.0, 0.0, 1.0])
def test_light_along_a_periodic_mesh_comes_to_one_of_its_cells(along, height, upwards):
    field = HeightField(HEIGHTS, 3.0, periodic=True)
    inside, point, x, y = entered(field, (0.0, 0.0, height), (along, 1.0, upwards))
    assert inside
    assert point[2] == 1.0
    assert 0.0 <= x < 3.0
    assert 0.0 <= y < 3.0
