"""What light does at a vertex by the points around it, and points by angles."""

import math

import numpy as np
import pytest

from optipath.kernels.catalogue import (
    ARRIVING,
    EVENT_AT_VERTEX,
    INCIDENCE,
    REFLECTED,
    REFRACTION,
    TURN_BETWEEN_PLANES,
)
from optipath.kernels.geometry.events import Event
from optipath.kernels.geometry.points_by_angles import PointsByAngles
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from tables import rows

AROUND = (0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, -2.0)
NOWHERE = (math.nan,) * 3
incidence, turn = INCIDENCE.made_for(FLOAT), TURN_BETWEEN_PLANES.made_for(FLOAT)


def test_the_angle_is_that_of_what_happens_and_points_behind_the_end_are_not_looked_at():
    met = EVENT_AT_VERTEX.made_for(FLOAT)
    assert met(1.0, 1.5, 0.0, Event.REFLECTS, *AROUND) == (1.0, 1.5, *incidence(*AROUND))
    refracted = met(1.0, 1.5, 0.0, Event.REFRACTS, *AROUND)
    assert refracted == REFRACTION.made_for(FLOAT)(1.0, 1.5, *AROUND)
    events = Event.REFLECTS, Event.BEHIND, Event.BEHIND
    points = np.float64([*AROUND, *NOWHERE, math.inf, 0.0, 1e200])
    with np.errstate(all="ignore"):
        found = EVENT_AT_VERTEX.made_for(NUMPY)(np.float64(1.0), 1.5, 0.0, *events, *points)
    np.testing.assert_allclose(found, (1.0, 1.5, 0.0, 1.0), rtol=0, atol=1e-15)


@rows(
    "k, event, points",
    [
        (0.0, Event.CANNOT, AROUND),
        (0.5, Event.REFRACTS, AROUND),
        (0.0, Event.REFLECTS, (*AROUND[:6], *AROUND[3:6])),
        (0.0, Event.REFRACTS, (*AROUND[:6], *NOWHERE)),
        (0.0, Event.REFRACTS, (*AROUND[:6], 0.0, 1.0, 2.0)),
    ],
)
def test_what_cannot_be_has_no_angle(k, event, points):
    with np.errstate(all="ignore"):
        *_, c, _ = EVENT_AT_VERTEX.made_for(NUMPY)(*map(np.float64, (1.0, 1.5, k, event, *points)))
    assert np.isnan(c)


@rows("theta", [1e-12, 1e-6, 0.3, 1.0, math.pi / 2 - 1e-6, math.pi / 2 - 1e-12])
def test_cosine_and_sine_of_the_incidence_keep_their_digits_where_they_are_small(theta):
    # On legs along an axis or 1 long.
    cos, sin = incidence(0, 0, 0, 0, 0, 1.0, 0, math.sin(2 * theta), 1.0 - math.cos(2 * theta))
    assert cos == pytest.approx(math.cos(theta), rel=1e-15 if theta < 1 else 1e-4 * theta)
    assert sin == pytest.approx(math.sin(theta), rel=1e-15)


def test_the_incidence_goes_by_directions_alone_and_x_along_normal_cross_direction():
    near = incidence(0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    far = incidence(0.0, 0.0, -1e60, 0.0, 0.0, 0.0, 1e-60, 0.0, 0.0)
    assert near == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)), rel=1e-15)
    assert far == pytest.approx(near, rel=1e-15)
    # Down along -z onto a mirror whose normal is (y + z): n cross k = -x.
    points = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    assert ARRIVING.made_for(FLOAT)(*points) == (-1.0, 0.0, 0.0, 0.0, 0.0, -1.0)
    assert REFLECTED.made_for(FLOAT)(*points) == (-1.0, 0.0, 0.0, 0.0, 1.0, 0.0)


def test_planes_turn_s1_and_vertices_without_a_plane_nothing():
    # A periscope: up, sideways along x, and then on along y.
    points = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0)
    assert turn(*points) == pytest.approx((-1.0, 0.0))
    assert turn(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 3.0, 1.0) == (1.0, 0.0)


def test_points_by_angles_have_these_angles():
    incidences, turns = (0.2, 1.1, 0.7, 1.5), (0.4, -2.0, 3.0)
    pairs = [f(angle) for angle in (*incidences, *turns) for f in (math.cos, math.sin)]
    points = PointsByAngles(4, 0, 5)(NUMPY)(*pairs)
    for kernel, length, angles in ((incidence, 9, incidences), (turn, 12, np.multiply(turns, 2))):
        for vertex, angle in enumerate(angles):
            found = kernel(*points[3 * vertex : 3 * vertex + length])
            assert found == pytest.approx((math.cos(angle), math.sin(angle)))


@rows("count", [1, 2, 3, 4])
def test_some_of_the_points_by_angles_are_those_of_all_and_of_those_backwards(count):
    rng = np.random.default_rng(count)
    numbers = [float(f(a)) for a in rng.uniform(0, 1.5, 2 * count - 1) for f in (np.cos, np.sin)]
    whole = PointsByAngles(count, 0, count + 1)(FLOAT)(*numbers)
    turned = np.reshape(whole, (-1, 3))[::-1]
    for first in range(count):
        some = PointsByAngles(count, first, first + 2)(FLOAT)(*numbers)
        assert some == whole[3 * first : 3 * first + 9]
        some = PointsByAngles(count, first, first + 2, backwards=True)(FLOAT)(*numbers)
        np.testing.assert_array_equal(np.reshape(some, (-1, 3)), turned[first : first + 3])


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
