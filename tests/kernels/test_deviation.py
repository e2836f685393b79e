"""What light does at vertices by points alone, refraction beside Snell's law in 50 digits."""

import math

import numpy as np
import pytest

import optipath as op
from chains import random_rotation
from histories import exact_coherency, exact_stokes_in
from optipath.kernels.catalog import (
    ARRIVING,
    EVENT_AT_VERTEX,
    INCIDENCE,
    REFLECTED,
    REFRACTION,
    TURN_BETWEEN_PLANES,
)
from optipath.kernels.primitives import FLOAT, NUMPY
from optipath.kernels.vertex_chain import Event, PointsByAngles
from tables import rows

ANGLES = [1e-9, 1e-6, 1e-3, 0.1, 0.7, np.arctan(1.5), np.arctan(1.5) + 1e-8, 1.3, 1.5]


def around(angle, n1, n2, rng, legs=(1.0, 1.0), offset=0.0):
    """Three points around a vertex that light meets at an angle."""
    s, behind = np.sin(angle), n1 * np.sin(angle) / n2
    before = np.array([-s, 0.0, np.cos(angle)])
    after = np.array([behind, 0.0, -np.sqrt((1.0 - behind) * (1.0 + behind))])
    points = np.array([legs[0] * before, np.zeros(3), legs[1] * after])
    return points @ random_rotation(rng).T + offset * rng.normal(size=3)


def off(points, n1, n2):
    """How far light is from that in 50 digits, over its intensity."""
    light = op.path_from_vertices(points, [n2], events="T", outside=n1).trace()
    exact = exact_stokes_in(exact_coherency(points, "T", [n2], n1), light.frame)
    return np.max(np.abs(light.stokes - exact)) / exact[0]


@rows("n2", [1.0, 1.5 * (1.0 + 1e-13), 1.5 * (1.0 + 1e-7), 1.5001, 1.6, 3.0])
def test_light_has_its_digits_next_to_the_normal_at_brewsters_angle_and_in_nearly_one_medium(n2):
    rng = np.random.default_rng(1)
    below = [angle for angle in ANGLES if np.sin(angle) < 0.99 * n2 / 1.5]
    found = [off(around(angle, 1.5, n2, rng), 1.5, n2) for angle in below for _ in range(3)]
    assert max(found) <= 1e-14


@rows("legs", [(1e-60, 1e60), (1e60, 1e-60), (1e-60, 1e-60)])
def test_long_and_short_legs_lose_nothing(legs):
    points = around(1.0, 1.0, 1.5, np.random.default_rng(2), legs)
    assert off(points, 1.0, 1.5) <= 2e-15


@rows("left", [1e-1, 1e-3, 1e-5])
@rows("out", [False, True])
def test_next_to_grazing_light_is_known_as_well_as_the_angle_that_is_left(left, out):
    rng, grazing = np.random.default_rng(3), np.pi / 2 - left
    angle = np.arcsin(np.sin(grazing) / 1.5) if out else grazing
    media = (1.5, 1.0) if out else (1.0, 1.5)
    worst = max(off(around(angle, *media, rng), *media) for _ in range(20))
    assert worst <= 1e-15 / left


def test_the_angle_is_that_in_the_rarer_medium_whichever_way_light_goes():
    points = around(0.7, 1.0, 1.5, np.random.default_rng(4))
    there = REFRACTION.made_for(FLOAT)(1.0, 1.5, *points.ravel())
    back = REFRACTION.made_for(FLOAT)(1.5, 1.0, *points[::-1].ravel())
    np.testing.assert_allclose(there, (1.0, 1.5, np.cos(0.7), np.sin(0.7)), rtol=1e-15)
    np.testing.assert_allclose(back, there, rtol=1e-15)


@rows(
    "n1, n2, turned, fits",
    [
        (1.0, 1.5, np.arccos(1 / 1.5) - 1e-9, True),
        (1.0, 1.5, np.arccos(1 / 1.5) + 1e-9, False),
        (1.5, 1.0, np.arccos(1 / 1.5) + 1e-9, False),
        (1.5, 1.5, 0.9e-6, True),
        (1.5, 1.5, 1.1e-6, False),
        (1.0, 1.5, np.pi, False),
    ],
)
def test_what_no_surface_refracts_is_no_number(n1, n2, turned, fits):
    points = np.array([0, 0, -1, 0, 0, 0, np.sin(turned), 0, np.cos(turned)])
    *_, cos, sin = REFRACTION.made_for(NUMPY)(n1, n2, *points)
    assert np.isfinite(cos) == fits
    assert not fits or abs(cos * cos + sin * sin - 1.0) <= 4e-16


def test_slopes_are_finite_everywhere_and_those_of_finite_differences(jax):
    path = op.path_from_vertices(op.Parameter("p"), [op.Parameter("n")], events="T")
    plan = op.Composer(engine="jax").compose(path)

    def intensity(n, points):
        return plan.run(n=n, p=points).stokes[0]

    down = jax.numpy.array([[0.0, 0, 1], [0, 0, 0], [0, 0, -1]])
    # T = 4 n / (n + 1)^2, and all of it is level there.
    for n, expected in ((1.5, 4.0 * (1.0 - 1.5) / 2.5**3), (1.0, 0.0)):
        slope, of_points = jax.grad(intensity, argnums=(0, 1))(n, down)
        assert abs(slope - expected) <= (1e-15 if expected else 0.0)
        np.testing.assert_array_equal(of_points, np.zeros((3, 3)))
    assert np.isnan(jax.jit(intensity)(1.5, down.at[2, 0].set(3.0)))

    def polarized(p, n):
        return plan.run(p=p, n=n).stokes[1]

    points, step = around(0.7, 1.0, 1.5, np.random.default_rng(5)), 1e-5
    slope, of_index = jax.grad(polarized, argnums=(0, 1))(points, 1.5)
    way = np.random.default_rng(6).normal(size=(3, 3))
    for found, moved, turned in ((np.sum(slope * way), way, 0.0), (of_index, 0.0 * way, 1.0)):
        ahead, back = (polarized(points + d * moved, 1.5 + d * turned) for d in (step, -step))
        np.testing.assert_allclose(found, (ahead - back) / (2.0 * step), rtol=1e-7)


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


def test_the_incidence_goes_by_directions_x_along_normal_cross_direction_and_planes_turn_s1():
    near = incidence(0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    far = incidence(0.0, 0.0, -1e60, 0.0, 0.0, 0.0, 1e-60, 0.0, 0.0)
    assert near == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)), rel=1e-15)
    assert far == pytest.approx(near, rel=1e-15)
    # Down along -z onto a mirror whose normal is (y + z): n cross k = -x.
    points = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    assert ARRIVING.made_for(FLOAT)(*points) == (-1.0, 0.0, 0.0, 0.0, 0.0, -1.0)
    assert REFLECTED.made_for(FLOAT)(*points) == (-1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
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
