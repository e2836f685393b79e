import math

import numpy as np
import pytest

from optipath.kernels.facets.half_vector import facet_between
from optipath.kernels.numbers.primitives import FLOAT
from tables import rows

ACROSS = (0.0, 1.0, 0.0)


def down(theta):
    return math.sin(theta), 0.0, -math.cos(theta)


def up(theta):
    return math.sin(theta), 0.0, math.cos(theta)


def test_the_normal_is_halfway_between_in_grazing_and_returning_light_too():
    met = facet_between(FLOAT)(down(0.3), ACROSS, up(1.1), ACROSS)
    np.testing.assert_allclose((met.cos, met.sin), (math.cos(0.7), math.sin(0.7)), rtol=1e-15)
    assert met.tilt == pytest.approx(math.cos(0.4), rel=1e-15)
    assert met.slopes == pytest.approx((-math.tan(0.4), 0.0), rel=1e-15)
    small, azimuth = 1e-8, 3e-8
    c, s = math.cos(small), math.sin(small)
    k_in, k_out = (c, 0.0, -s), (c * math.cos(azimuth), c * math.sin(azimuth), s)
    met = facet_between(FLOAT)(k_in, ACROSS, k_out, (-math.sin(azimuth), math.cos(azimuth), 0.0))
    slope_x = c * math.sin(azimuth / 2) ** 2 / s
    assert met.slopes == pytest.approx((slope_x, -0.5 * c * math.sin(azimuth) / s), rel=1e-14)
    k = down(0.7)
    met = facet_between(FLOAT)(k, ACROSS, tuple(-x for x in k), (0.0, -1.0, 0.0))
    assert (met.cos, met.sin) == (pytest.approx(1.0, rel=1e-15), 0.0)
    assert met.turn_in == met.turn_out == (1.0, 0.0)


@rows("small", [1e-3, 1e-7, 1e-11])
def test_next_to_the_normal_the_sine_keeps_its_digits(small):
    met = facet_between(FLOAT)(down(small), ACROSS, up(0.5 * small), ACROSS)
    assert met.sin == pytest.approx(math.sin(0.75 * small), rel=4e-16)


@rows("small", [1e-3, 1e-7, 1e-11])
def test_next_to_grazing_incidence_the_cosine_keeps_its_digits(small):
    k_in, k_out = (math.cos(small), 0.0, -math.sin(small)), (math.cos(small), 0.0, math.sin(small))
    met = facet_between(FLOAT)(k_in, ACROSS, k_out, ACROSS)
    assert met.cos == pytest.approx(math.sin(small), rel=4e-16)
    assert (met.slopes, met.tilt) == ((0.0, 0.0), 1.0)


@rows("apart", [1e-4, 1e-9, 1e-14, 1e-17, 1e-200])
def test_light_that_nearly_goes_back_is_turned_as_if_it_did(apart):
    # Light down along y's side of the normal, and up along the normal: from x to y.
    met = facet_between(FLOAT)((0.0, apart, -1.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0), ACROSS)
    (c1, s1), (c2, s2) = met.turn_in, met.turn_out
    assert c1 * c2 - s1 * s2 == pytest.approx(-1.0, rel=1e-15)
    assert s1 * c2 + c1 * s2 == pytest.approx(0.0, abs=1e-15)
