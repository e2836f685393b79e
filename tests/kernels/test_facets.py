"""Facets: the normal halfway between two directions, and what the others hide."""

import math

import mpmath as mp
import numpy as np
import pytest

from exact_facets import exact_lambda
from optipath.kernels.facets import MASKINGS, facet_between, masked_cosines, smith_cosine
from optipath.kernels.primitives import FLOAT, NUMPY
from tables import rows, slow_except

ACROSS = (0.0, 1.0, 0.0)
ANGLES = [0.0, 1e-9, 0.2, 0.7, 1.2, 1.5, 1.5707]
ALPHAS = [1e-3, 0.1, 0.5, 2.0, 30.0]


def up(theta, azimuth=0.0):
    s = math.sin(theta)
    return s * math.cos(azimuth), s * math.sin(azimuth), math.cos(theta)


def down(theta):
    return math.sin(theta), 0.0, -math.cos(theta)


def between(k_in, k_out, x_out=ACROSS):
    return facet_between(FLOAT)(k_in, ACROSS, k_out, x_out)


def test_the_normal_is_halfway_between_in_grazing_and_returning_light_too():
    met = between(down(0.3), up(1.1))
    np.testing.assert_allclose((met.cos, met.sin), (math.cos(0.7), math.sin(0.7)), rtol=1e-15)
    assert (met.tilt, *met.slopes) == pytest.approx((math.cos(0.4), -math.tan(0.4), 0.0), rel=1e-15)
    small, azimuth = 1e-8, 3e-8
    c, s = math.cos(small), math.sin(small)
    k_in, k_out = (c, 0.0, -s), (c * math.cos(azimuth), c * math.sin(azimuth), s)
    met = between(k_in, k_out, (-math.sin(azimuth), math.cos(azimuth), 0.0))
    slope_x = c * math.sin(azimuth / 2) ** 2 / s
    assert met.slopes == pytest.approx((slope_x, -0.5 * c * math.sin(azimuth) / s), rel=1e-14)
    met = between(down(0.7), tuple(-x for x in down(0.7)), (0.0, -1.0, 0.0))
    assert (met.cos, met.sin) == (pytest.approx(1.0, rel=1e-15), 0.0)
    assert met.turn_in == met.turn_out == (1.0, 0.0)


@rows("small", [1e-3, 1e-7, 1e-11])
def test_next_to_the_normal_the_sine_and_next_to_grazing_the_cosine_keeps_its_digits(small):
    met = between(down(small), up(0.5 * small))
    assert met.sin == pytest.approx(math.sin(0.75 * small), rel=4e-16)
    c, s = math.cos(small), math.sin(small)
    met = between((c, 0.0, -s), (c, 0.0, s))
    assert met.cos == pytest.approx(s, rel=4e-16)
    assert (met.slopes, met.tilt) == ((0.0, 0.0), 1.0)


@rows("apart", [1e-4, 1e-9, 1e-14, 1e-17, 1e-200])
def test_light_that_nearly_goes_back_is_turned_as_if_it_did(apart):
    # Light down along y's side of the normal, and up along the normal: from x to y.
    met = facet_between(FLOAT)((0.0, apart, -1.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0), ACROSS)
    (c1, s1), (c2, s2) = met.turn_in, met.turn_out
    assert c1 * c2 - s1 * s2 == pytest.approx(-1.0, rel=1e-15)
    assert s1 * c2 + c1 * s2 == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("alpha", slow_except([0.1, 2.0], ALPHAS))
@rows("theta", ANGLES)
def test_the_cosine_is_the_projected_area_of_all_facets_that_face_the_direction(theta, alpha):
    k = up(theta)
    with mp.workdps(50):
        c, s, a = mp.mpf(k[2]), mp.mpf(k[0]), mp.mpf(alpha)
        end = min(c / s, 12 * a) if s else 12 * a
        nodes = [-12 * a, *(a * i for i in range(-11, 12) if a * i < end), end]
        area = mp.quad(lambda x: (c - s * x) * mp.exp(-((x / a) ** 2)), nodes)
        area = float(area / (a * mp.sqrt(mp.pi)))
        found = smith_cosine(FLOAT)(k, alpha, alpha)
        assert found == pytest.approx(area, rel=1e-15)
        if theta >= 0.2:
            exact = float(exact_lambda(c / (a * s)))
            assert found / k[2] - 1.0 == pytest.approx(exact, rel=1e-15, abs=1e-15 * (1.0 + exact))


def test_what_is_seen_goes_by_height_roughness_along_and_the_cosine_at_grazing():
    cosine, k = smith_cosine(FLOAT), up(1.1, 0.4)
    alpha = math.hypot(0.2 * k[0], 0.9 * k[1]) / math.sin(1.1)
    assert cosine(k, 0.2, 0.9) == pytest.approx(cosine(k, alpha, alpha), rel=1e-15)
    into, out = up(2.2), up(1.1)
    seen = {
        masking: into[2] * -out[2] / masked_cosines(FLOAT, masking)(into, out, 0.5, 0.5)
        for masking in MASKINGS
    }
    assert seen["none"] == 1.0
    assert seen["separate"] < seen["smith"] < math.sqrt(seen["separate"]) < 1.0
    for masking in MASKINGS:
        normal = (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)
        assert masked_cosines(FLOAT, masking)(*normal, 0.5, 0.5) == 1.0
    for angle in (1e-6, 1e-12):
        k = (math.cos(angle), 0.0, math.sin(angle))
        assert cosine(k, 0.5, 0.5) == pytest.approx(0.25 / math.sqrt(math.pi), rel=8.0 * angle)
    several = [up(theta, 0.3) for theta in ANGLES]
    found = smith_cosine(NUMPY)(tuple(np.transpose(several)), 0.3, 0.6)
    np.testing.assert_allclose(found, [cosine(k, 0.3, 0.6) for k in several], rtol=1e-15)
