"""Where each method holds, and where it is known to fail: what the published tables say."""

import numpy as np
import pytest

import optipath as op
from optipath.kernels.catalogue import REFLECTION
from optipath.lab.accuracy.interface_errors import interface_errors, matrix_numbers
from optipath.lab.accuracy.regions import REGIONS

NAMES = {region.name: region for region in REGIONS}
DTYPES = ["float64", "float32"]

# The regions, and the largest error in ulp*, where the two older methods keep some digits.
HOLDS = {
    "amplitude": {
        "exactly 90 deg": 0.0,
        "k = 0, n > 1": 1e4,
        "tiny k, n > 1": 1e5,
        "metals": 1e5,
    },
    "textbook": {"k = 0, total reflection": 1e3, "metals": 1e5},
}
# Normwise against A they fail in fewer.
FAILS_NORMWISE = {
    "amplitude": [
        "n near 1, k = 0",
        "n near 1, k like n - 1",
        "n near 1, grazing",
        "extreme magnitudes",
    ],
    "textbook": [
        "near Brewster's angle",
        "tiny k, n > 1",
        "tiny k, total reflection",
        "tiny k, near the critical angle",
        "n near 1, k = 0",
        "n near 1, k like n - 1",
        "n near 1, grazing",
        "n near 0",
        "extreme magnitudes",
    ],
}


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("name", NAMES)
def test_stable_holds_within_10_ulp_in_each_component(name, dtype):
    off = interface_errors("stable", NAMES[name], dtype)
    assert off.componentwise.max() <= 10.0


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("name", NAMES)
def test_compensated_holds_within_one_and_a_half_ulp_in_each_component(name, dtype):
    off = interface_errors("compensated", NAMES[name], dtype)
    assert off.componentwise.max() <= 1.5


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("method", HOLDS)
def test_the_older_methods_hold_and_fail_where_they_are_known_to(method, name):
    worst = interface_errors(method, NAMES[name]).componentwise.max()
    if name in HOLDS[method]:
        assert worst <= HOLDS[method][name]
    else:
        assert not worst <= 1e5


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("method", FAILS_NORMWISE)
def test_normwise_the_older_methods_fail_in_fewer_regions(method, name):
    worst = interface_errors(method, NAMES[name]).normwise.max()
    if name in FAILS_NORMWISE[method]:
        assert not worst <= 1e5
    else:
        assert worst <= 1e3


@pytest.mark.parametrize(
    ("method", "limit_a", "limit_c"), [("stable", 8, 5), ("compensated", 1.5, 1.5)]
)
@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("name", NAMES)
def test_transmission_holds(name, dtype, method, limit_a, limit_c):
    region = NAMES[name]
    off = interface_errors(method, region, dtype, what="transmission").componentwise
    lossless = region.samples(len(off), dtype).k == 0.0
    assert off[:, :2].max() <= limit_a
    assert off[lossless, 2].max(initial=0.0) <= limit_c
    assert off[lossless, 3].max(initial=0.0) == 0.0


@pytest.mark.skipif(
    np.finfo(np.longdouble).eps == np.finfo(np.float64).eps, reason="longdouble is float64 here"
)
@pytest.mark.parametrize(("method", "limit"), [("stable", 10), ("compensated", 1.5)])
@pytest.mark.parametrize("name", NAMES)
def test_longdouble_has_digits_of_its_own(name, method, limit):
    off = interface_errors(method, NAMES[name], "longdouble", count=50)
    assert off.componentwise.max() <= limit


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("method", ["stable", "compensated"])
@pytest.mark.parametrize("name", NAMES)
def test_no_result_is_one_that_cannot_be(name, method, dtype):
    count = 20_000 if method == "stable" else 2_000
    found = matrix_numbers(REFLECTION.by_method(method), NAMES[name].samples(count, dtype))
    assert found.dtype == dtype
    A, B, C, S = found.T.astype(np.longdouble)
    assert np.all(np.isfinite(found))
    assert np.all((A >= 0.0) & (A <= 1.0))
    assert np.all(np.abs(B) <= A)
    assert not np.any(np.signbit(found[:, [0, 1, 3]]))
    # A reflection does not depolarise.
    rest = (A - B) * (A + B) - C * C - S * S
    least = 1e3 * np.finfo(dtype).tiny
    lit = least < A
    square = np.where(lit, A * A, 1.0)
    assert np.all(np.abs(np.where(lit, rest, 0.0)) <= 10 * np.finfo(dtype).eps * square)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("method", ["stable", "compensated"])
def test_total_reflection_is_total_to_the_last_bit(method, dtype):
    samples = NAMES["k = 0, total reflection"].samples(5000, dtype)
    A, B, _, _ = matrix_numbers(REFLECTION.by_method(method), samples).T
    assert np.all(A == 1.0)
    assert np.all(B == 0.0)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("method", ["stable", "compensated"])
def test_exactly_grazing_light_is_reflected_whole_by_any_medium(method, dtype):
    for name in ("generic", "metals", "index of 1e3 to 1e8", "n near 0", "extreme magnitudes"):
        samples = NAMES[name].samples(500, dtype)
        samples = samples._replace(cos=np.zeros_like(samples.n), sin=np.ones_like(samples.n))
        found = matrix_numbers(REFLECTION.by_method(method), samples)
        np.testing.assert_array_equal(found, np.broadcast_to([1, 0, 1, 0], found.shape))


@pytest.mark.parametrize("method", ["stable", "compensated"])
@pytest.mark.parametrize("least", [-0.0, 5e-324, 1e-310])
def test_a_negative_zero_and_denormals_change_no_sign(method, least):
    kernel = REFLECTION.by_method(method)
    for name in ("generic", "k = 0, total reflection", "near the critical angle"):
        samples = NAMES[name].samples(500)
        with_zero = matrix_numbers(kernel, samples._replace(k=np.zeros_like(samples.n)))
        found = matrix_numbers(kernel, samples._replace(k=np.full_like(samples.n, least)))
        np.testing.assert_array_equal(np.sign(found[:, [0, 2]]), np.sign(with_zero[:, [0, 2]]))
        assert not np.any(np.signbit(found[:, [0, 1, 3]]))


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("method", ["stable", "compensated"])
@pytest.mark.parametrize("what", ["reflection", "transmission"])
def test_no_index_and_no_angle_makes_what_cannot_be(what, method, dtype):
    """Indices and angles over all the range that floats have, and 0 and 90 degrees exactly."""
    count, reach = 20_000, {"float64": 300, "float32": 36}[dtype]
    rng = np.random.default_rng(7)
    phase = rng.choice([0.0, 0.3, 0.8, 1.5, np.pi / 2], count)
    index = 10 ** rng.uniform(-reach, reach, count) * (np.cos(phase) + 1j * np.sin(phase))
    small = rng.choice([0.0, 1.0], count) * 10 ** rng.uniform(-reach, 0, count)
    angle = np.where(rng.random(count) < 0.5, small, rng.uniform(0, np.pi / 2, count))
    c, s = np.cos(angle), np.sin(angle)
    turned = rng.random(count) < 0.5
    c, s = np.where(turned, s, c), np.where(turned, c, s)
    function = {"reflection": op.fresnel_reflection, "transmission": op.fresnel_transmission}[what]
    A, B, C, S = np.array(function(index, c, s, method, dtype)).astype(float)
    assert np.all(np.isfinite([A, B, C, S]))
    assert np.all((A >= 0.0) & (A <= 1.0))
    assert np.all(np.abs(B) <= A)
    zeros = np.array([A, B, C, S]) == 0.0
    assert not np.any(zeros & np.signbit([A, B, C, S]))
    if what == "reflection":
        grazing = c == 0.0
        assert grazing.sum() > 1000
        np.testing.assert_array_equal(np.array([A, B, C, S])[:, grazing].T - [1, 0, 1, 0], 0.0)


def test_a_boundary_of_equal_media_lets_all_the_light_through_and_no_more():
    angle = np.linspace(0, np.pi / 2, 5000)
    A, B, C, _ = op.fresnel_transmission(1.0, np.cos(angle), np.sin(angle))
    assert np.all(A <= 1.0)
    np.testing.assert_allclose([A, C], 1.0, rtol=1e-15)
    np.testing.assert_array_equal(B, 0.0)
