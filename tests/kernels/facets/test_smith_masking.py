import math

import mpmath as mp
import numpy as np
import pytest

from exact_facets import exact_lambda
from optipath.kernels.facets.smith_masking import MASKINGS, masked_cosines, smith_cosine
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from tables import rows

ANGLES = [0.0, 1e-9, 0.2, 0.7, 1.2, 1.5, 1.5707]
ALPHAS = [1e-3, 0.1, 0.5, 2.0, 30.0]


def direction(theta, azimuth=0.0):
    s = math.sin(theta)
    return s * math.cos(azimuth), s * math.sin(azimuth), math.cos(theta)


@rows("alpha", ALPHAS)
@rows("theta", ANGLES)
def test_the_cosine_is_the_projected_area_of_all_facets_that_face_the_direction(theta, alpha):
    k = direction(theta)
    with mp.workdps(40):
        c, s, a = mp.mpf(k[2]), mp.mpf(k[0]), mp.mpf(alpha)
        ends = [-12 * a, min(c / s, 12 * a)] if s else [-12 * a, 12 * a]
        nodes = [ends[0], *(a * i for i in range(-11, 12) if ends[0] < a * i < ends[1]), ends[1]]
        area = mp.quad(lambda x: (c - s * x) * mp.exp(-((x / a) ** 2)), nodes)
        area = float(area / (a * mp.sqrt(mp.pi)))
    assert smith_cosine(FLOAT)(k, alpha, alpha) == pytest.approx(area, rel=1e-15)


@rows("alpha", ALPHAS)
def test_lambda_is_that_of_fifty_digits(alpha):
    for theta in ANGLES[2:]:
        k = direction(theta)
        with mp.workdps(50):
            exact = float(exact_lambda(mp.mpf(k[2]) / (mp.mpf(alpha) * mp.mpf(k[0]))))
        found = smith_cosine(FLOAT)(k, alpha, alpha) / k[2] - 1.0
        assert found == pytest.approx(exact, rel=1e-15, abs=1e-15 * (1.0 + exact))


def test_what_is_seen_goes_by_height_roughness_along_and_the_cosine_at_grazing():
    k, across = direction(1.1, 0.4), math.sin(1.1)
    alpha = math.hypot(0.2 * k[0], 0.9 * k[1]) / across
    found = smith_cosine(FLOAT)(k, 0.2, 0.9)
    assert found == pytest.approx(smith_cosine(FLOAT)(k, alpha, alpha), rel=1e-15)
    down, up = direction(2.2), direction(1.1)
    seen = {
        masking: down[2] * -up[2] / masked_cosines(FLOAT, masking)(down, up, 0.5, 0.5)
        for masking in MASKINGS
    }
    assert seen["none"] == 1.0
    assert seen["separate"] < seen["smith"] < math.sqrt(seen["separate"]) < 1.0
    cosine = smith_cosine(FLOAT)
    for angle in (1e-6, 1e-12):
        k = (math.cos(angle), 0.0, math.sin(angle))
        assert cosine(k, 0.5, 0.5) == pytest.approx(0.25 / math.sqrt(math.pi), rel=8.0 * angle)
    k = np.array([direction(theta, 0.3) for theta in ANGLES]).T
    found = smith_cosine(NUMPY)(tuple(k), 0.3, 0.6)
    one_by_one = [smith_cosine(FLOAT)(direction(theta, 0.3), 0.3, 0.6) for theta in ANGLES]
    np.testing.assert_allclose(found, one_by_one, rtol=1e-15)


@rows("masking", MASKINGS)
def test_nothing_is_masked_along_the_normal(masking):
    up, down = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
    assert masked_cosines(FLOAT, masking)(down, up, 0.5, 0.5) == 1.0
