"""Light that no light can be is refused, and measured noise is told apart from it."""

import copy
import pickle

import numpy as np
import pytest

import optipath as op
from tables import rows


@rows(
    "stokes, sentence",
    [
        ([1.0, 1.0, 1.0, 1.0], r"light is \[1.0, 1.0, 1.0, 1.0\], polarised by 173.205 %"),
        ([1.0, 1.0 + 1e-9, 0.0, 0.0], "polarised by 100 % and a little"),
        ([1.0, 0.8, 0.7, np.nan], "polarised by 106.301 %"),
        ([-1.0, 0.0, 0.0, 0.0], "intensity -1.0 is negative"),
        ([np.inf, 0.0, 0.0, 0.0], "not finite"),
        ([1.0, 0.0, -np.inf, 0.0], "not finite"),
        ([0.0, 1e-300, 0.0, 0.0], "polarised, and dark"),
        ([1e308, 1e308, 1e308, 1e308], "polarised by 173.205 %"),
        ([[1.0, 0, 0, 0], [1.0, 2.0, 0, 0], [1.0, 3.0, 0, 0]], r"light \[1\] .* \(one of 2 such\)"),
        (np.array([1.0, 1.001, 0.0, 0.0], np.float32), "polarised by 100.1 %"),
    ],
)
def test_what_no_light_can_be_is_refused_with_the_numbers_and_the_cure(stokes, sentence):
    with pytest.raises(op.ValueFault, match=rf"{sentence}.*physical=False.*nearest_physical"):
        op.Light(stokes)


@rows(
    "stokes",
    [
        [1.0, 0.6, 0.0, 0.8],
        [0.0, 0.0, 0.0, 0.0],
        [1.0, 1.0 + 2e-16, 0.0, 0.0],
        [1.0, np.nan, np.nan, np.nan],
        [np.nan, np.nan, np.nan, np.nan],
        [1.0, 0.6, 0.8, np.nan],
        np.float32([0.3, 0.1, 0.2, 0.2]) * np.float32([1.0, 1.0, 1.0, 1.0000001]),
        np.float32([1.0, np.sqrt(0.5), np.sqrt(0.5), 0.0]),
        np.float16([1.0, np.sqrt(0.5), np.sqrt(0.5), 0.0]),
        np.ones((0, 4)),
    ],
)
def test_light_within_its_rounding_is_light(stokes):
    np.testing.assert_array_equal(op.Light(stokes), stokes)


def test_what_is_computed_with_noise_is_not_refused():
    noise = op.Light([1.0, 1.0, 1.0, 1.0], physical=False)
    turned = noise.in_frame(op.Frame().turned(0.3))
    for light in (noise + noise, 2 * noise, noise / 3, turned, noise[...], noise.reshape(1)):
        assert np.all(light.dop > 1.7)
    assert (op.Mueller(3 * np.eye(4)) @ noise).S0 == 3.0
    assert (op.Mueller(np.diag([0.5, 1, 1, 1])) @ (noise / 2)).dop == pytest.approx(2 * 3**0.5)
    for again in (pickle.loads(pickle.dumps(noise)), copy.deepcopy(noise)):
        assert again == noise
    with pytest.raises(op.ValueFault, match=r"173\.205 %"):
        op.Light([1.0, 1.0, 1.0, 1.0], exponent=-4000)
    assert op.Light([1.0, 1.0, 1.0, 1.0], exponent=-4000, physical=False).dop > 1.7


@rows(
    "noisy, nearest",
    [
        ([1.0, 3.0, 0.0, -4.0], [1.0, 0.6, 0.0, -0.8]),
        ([2.0, 0.6, 0.0, 0.8], [2.0, 0.6, 0.0, 0.8]),
        ([-1.0, 0.5, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]),
        ([0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]),
        ([1.0, 3.0, 4.0, np.nan], [1.0, 0.6, 0.8, np.nan]),
        ([1e300, 3e300, 0.0, 4e300], [1e300, 0.6e300, 0.0, 0.8e300]),
    ],
)
@rows("exponent", [0, -5000])
def test_the_nearest_light_keeps_its_intensity_and_its_ellipse(noisy, nearest, exponent):
    found = op.Light(noisy, exponent=exponent, physical=False).nearest_physical()
    np.testing.assert_allclose(found.mantissa, nearest, rtol=1e-15)
    assert op.Light(found.mantissa, exponent=exponent) == found


def test_the_nearest_light_keeps_the_frame_and_each_of_a_batch():
    frame = op.Frame().turned([0.1, 0.2])
    light = op.Light([[1.0, 2.0, 0.0, 0.0], [1.0, 0.5, 0.0, 0.0]], frame, physical=False)
    expected = op.Light([[1.0, 1.0, 0.0, 0.0], [1.0, 0.5, 0.0, 0.0]], frame)
    assert light.nearest_physical() == expected


def test_light_that_jax_traces_is_not_judged_and_comes_near():
    jax = pytest.importorskip("jax")

    def nearest(stokes):
        return op.Light(stokes).nearest_physical().stokes

    stokes = np.array([1.0, 3.0, 0.0, 4.0], np.float32)
    np.testing.assert_allclose(jax.jit(nearest)(stokes), [1.0, 0.6, 0.0, 0.8], rtol=1e-6)
    dark = jax.numpy.zeros(4)
    assert np.isfinite(jax.jacobian(nearest)(dark)).all()
    with pytest.raises(op.ValueFault, match="500 %"):
        op.Light(jax.numpy.array(stokes))
