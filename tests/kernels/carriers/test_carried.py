import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.kernels.carriers.carried import add, carry, stokes_of
from optipath.kernels.numbers.circular import cosine, sine
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from tables import rows

COMPONENTS = st.tuples(st.floats(1e-3, 10), st.floats(-1, 1), st.floats(-5, 5), st.floats(-5, 5))


def light(parts):
    intensity, share, s2, s3 = parts
    return intensity, share * intensity, s2, s3


@given(parts=COMPONENTS)
def test_carrying_light_loses_nothing(parts):
    stokes = light(parts)
    np.testing.assert_allclose(stokes_of(FLOAT, carry(FLOAT, stokes)), stokes, rtol=1e-15)


@given(first=COMPONENTS, second=COMPONENTS)
def test_lights_add_component_by_component(first, second):
    total = stokes_of(FLOAT, add(FLOAT, carry(FLOAT, light(first)), carry(FLOAT, light(second))))
    np.testing.assert_allclose(total, np.add(light(first), light(second)), rtol=1e-14, atol=1e-14)


def test_light_next_to_crossed_filters_and_the_normal_keeps_its_digits():
    # A leakage of 1e-20 behind a crossed polariser is 1e-20, not the rounding of 1.
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(2.0))
    first = path.add("first", op.Polarizer(leakage=1e-20))
    second = path.add("second", op.Polarizer(angle=np.pi / 2, leakage=0.0))
    lamp >> first >> second >> path.add("eye", op.Detector())
    stokes = path.trace().stokes
    np.testing.assert_allclose(stokes, [1e-20, -1e-20, 0, 0], rtol=1e-15, atol=1e-36)
    # B = -2 sqrt(F) * d sqrt(F) ~ theta^2 (n - 1)^2 / (n (n + 1)^2) * 2 for glass.
    path = op.PathGraph()
    glass = path.add("glass", op.Interface(1.5, op.Parameter("theta")))
    path.add("lamp", op.Source()) >> glass >> path.add("eye", op.Detector())
    ratio = path.trace(theta=1e-9).stokes[1] / path.trace(theta=1e-6).stokes[1]
    assert abs(ratio / 1e-6 - 1) < 1e-11
    assert sine(FLOAT)(math.pi) == 0.0
    assert cosine(FLOAT)(math.pi / 2) == 0.0
    assert cosine(NUMPY)(np.float32(np.pi / 2)) == 0.0
    assert cosine(NUMPY)(np.pi / 2 - 1e-12) == np.cos(np.pi / 2 - 1e-12)
    axes = np.random.default_rng(3).uniform(-4, 4, 100_000)
    path = op.PathGraph()
    first = path.add("first", op.Polarizer(axes))
    path.add("lamp", op.Source()) >> first >> path.add("second", op.Polarizer(axes + np.pi / 2))
    path["second"] >> path.add("eye", op.Detector())
    light = path.trace().intensity
    assert np.all(light >= 0.0)
    assert np.all(light <= 1e-15)


@given(angle=st.floats(-7.0, 7.0))
def test_elsewhere_cosine_and_sine_are_those_of_the_platform(angle):
    for ours, theirs in ((cosine, math.cos), (sine, math.sin)):
        assert abs(ours(FLOAT)(angle) - theirs(angle)) <= 4.5e-16


@rows("distance", [1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-12])
def test_nearly_crossed_polarizers_keep_malus_law_to_the_last_digits(distance):
    path = op.PathGraph()
    first = path.add("first", op.Polarizer())
    path.add("lamp", op.Source(2.0)) >> first >> path.add("second", op.Polarizer(distance))
    path["second"] >> path.add("third", op.Polarizer(np.pi / 2)) >> path.add("eye", op.Detector())
    law = np.cos(distance) ** 2 * np.sin(distance) ** 2
    assert path.trace().intensity == pytest.approx(law, rel=1e-14)


@given(turn=st.floats(-6.2, 6.2), incidence=st.floats(0.0, 1.57), axis=st.floats(-6.2, 6.2))
def test_no_intensity_is_negative_by_a_rounding(turn, incidence, axis):
    path = op.load_preset("npgr026", n1=3.836, n2=0.2842, delta=1.2187)
    assert path.trace(rho=turn, phi=incidence, filter=axis).intensity >= -1e-30


def test_angles_so_huge_that_their_rounding_is_a_turn_keep_their_length():
    light = op.Rotator("1e16 rad").mueller() @ op.Light([1.0, 1.0, 0.0, 0.0])
    assert light.dop == pytest.approx(1.0, abs=1e-15)


def test_the_precision_is_the_composers_not_that_of_the_input():
    path = op.load_preset("npgr026")
    single = np.float32(0.8)
    for value in (single, np.array(single), [single]):
        stokes = np.ravel(path.trace(delta=value).stokes)
        np.testing.assert_array_equal(stokes, path.trace(delta=float(single)).stokes)
    assert op.fresnel_reflection(np.float32(1.5), 1.0, 0.0)[0].dtype == np.float64
