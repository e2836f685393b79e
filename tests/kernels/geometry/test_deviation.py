"""Refraction by points alone, beside Snell's law with its normal in 50 digits."""

import numpy as np

import optipath as op
from chains import random_rotation
from histories import exact_coherency, exact_stokes_in
from optipath.kernels.catalogue import REFRACTION
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
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
