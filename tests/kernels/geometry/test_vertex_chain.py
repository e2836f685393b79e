import math

import numpy as np
import pytest

from optipath.kernels.catalogue import ARRIVING, INCIDENCE, REFLECTED, TURN_BETWEEN_PLANES
from optipath.kernels.geometry.points_by_angles import PointsByAngles
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from tables import rows


def at_angle(theta):
    """Three points at which light meets a surface at an angle, on legs along the axes or 1 long."""
    return (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, math.sin(2 * theta), 1.0 - math.cos(2 * theta))


@rows("theta", [1e-12, 1e-6, 0.3, 1.0, math.pi / 2 - 1e-6, math.pi / 2 - 1e-12])
def test_cosine_and_sine_of_the_incidence_keep_their_digits_where_they_are_small(theta):
    cos, sin = INCIDENCE.made_for(FLOAT)(*at_angle(theta))
    assert cos == pytest.approx(math.cos(theta), rel=1e-15 if theta < 1 else 1e-4 * theta)
    assert sin == pytest.approx(math.sin(theta), rel=1e-15)


def test_the_incidence_goes_by_directions_alone_and_x_along_normal_cross_direction():
    near = INCIDENCE.made_for(FLOAT)(0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    far = INCIDENCE.made_for(FLOAT)(0.0, 0.0, -1e60, 0.0, 0.0, 0.0, 1e-60, 0.0, 0.0)
    assert near == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)), rel=1e-15)
    assert far == pytest.approx(near, rel=1e-15)
    # Down along -z onto a mirror whose normal is (y + z): n cross k = -x.
    points = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    assert ARRIVING.made_for(FLOAT)(*points) == (-1.0, 0.0, 0.0, 0.0, 0.0, -1.0)
    assert REFLECTED.made_for(FLOAT)(*points) == (-1.0, 0.0, 0.0, 0.0, 1.0, 0.0)


def test_planes_turn_s1_and_vertices_without_a_plane_nothing():
    # A periscope: up, sideways along x, and then on along y.
    points = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0)
    assert TURN_BETWEEN_PLANES.made_for(FLOAT)(*points) == pytest.approx((-1.0, 0.0))
    straight = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 3.0, 1.0)
    assert TURN_BETWEEN_PLANES.made_for(FLOAT)(*straight) == (1.0, 0.0)


def test_points_by_angles_have_these_angles():
    incidences, turns = (0.2, 1.1, 0.7, 1.5), (0.4, -2.0, 3.0)
    pairs = [f(angle) for angle in (*incidences, *turns) for f in (math.cos, math.sin)]
    points = PointsByAngles(4, 0, 5)(NUMPY)(*pairs)
    for vertex, theta in enumerate(incidences):
        around = points[3 * vertex : 3 * vertex + 9]
        assert INCIDENCE.made_for(FLOAT)(*around) == pytest.approx(
            (math.cos(theta), math.sin(theta))
        )
    for vertex, turn in enumerate(turns):
        found = TURN_BETWEEN_PLANES.made_for(FLOAT)(*points[: 3 * vertex + 12])
        assert found == pytest.approx((math.cos(2 * turn), math.sin(2 * turn)))


@rows("count", [1, 2, 3, 4])
def test_some_of_the_points_by_angles_are_those_of_all(count):
    rng = np.random.default_rng(count)
    numbers = [float(f(a)) for a in rng.uniform(0, 1.5, 2 * count - 1) for f in (np.cos, np.sin)]
    whole = PointsByAngles(count, 0, count + 1)(FLOAT)(*numbers)
    for first in range(count):
        some = PointsByAngles(count, first, first + 2)(FLOAT)(*numbers)
        assert some == whole[3 * first : 3 * first + 9]


@rows("length", [1e-200, 1e-75, 1e75, 1e155, 1e200])
@rows("kind", [np.float32, np.float64])
def test_legs_that_keep_no_digits_are_not_finite(length, kind):
    with np.errstate(all="ignore"):
        points = map(kind, (0.0, 0.0, 0.0, 0.0, 0.0, length, 0.0, 2.0, length))
        found = INCIDENCE.made_for(NUMPY)(*points)
    assert all(math.isnan(number) and number.dtype == kind for number in found)


@rows("count", [1, 2, 3, 4, 5])
def test_the_axes_of_angles_are_across_the_planes_of_their_points(count):
    rng = np.random.default_rng(count)
    angles = [*rng.uniform(0.1, 1.4, count), *rng.uniform(-3.0, 3.0, count - 1)]
    numbers = [float(f(a)) for a in angles for f in (np.cos, np.sin)]
    found = PointsByAngles(count, 0, count + 1, axes=True)(FLOAT)(*numbers)
    points, across = found[: 3 * count + 6], found[3 * count + 6 :]
    for vertex in range(count):
        x = ARRIVING.made_for(FLOAT)(*points[: 3 * vertex + 9])[:3]
        assert across[3 * vertex : 3 * vertex + 3] == pytest.approx(x, abs=1e-13)


@rows("count", [1, 2, 3, 4])
def test_points_by_angles_are_the_same_in_the_other_order_backwards(count):
    rng = np.random.default_rng(count)
    numbers = [float(f(a)) for a in rng.uniform(0, 1.5, 2 * count - 1) for f in (np.cos, np.sin)]
    whole = np.reshape(PointsByAngles(count, 0, count + 1)(FLOAT)(*numbers), (-1, 3))[::-1]
    for first in range(count):
        some = PointsByAngles(count, first, first + 2, backwards=True)(FLOAT)(*numbers)
        np.testing.assert_array_equal(np.reshape(some, (-1, 3)), whole[first : first + 3])
