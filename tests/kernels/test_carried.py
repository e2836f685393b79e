import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.kernels import FLOAT, NUMPY, add, carry, cosine, sine, stokes_of

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


def test_light_that_crossed_filters_leave_keeps_its_digits():
    # A leakage of 1e-20 behind a crossed polariser is 1e-20, not the rounding of 1.
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(2.0))
    first = path.add("first", op.Polarizer(leakage=1e-20))
    second = path.add("second", op.Polarizer(angle=np.pi / 2, leakage=0.0))
    lamp >> first >> second >> path.add("eye", op.Detector())
    stokes = path.trace().stokes
    np.testing.assert_allclose(stokes, [1e-20, -1e-20, 0, 0], rtol=1e-15, atol=1e-36)


def test_s1_near_the_normal_keeps_its_law_of_theta_squared():
    # B = -2 sqrt(F) * d sqrt(F) ~ theta^2 (n - 1)^2 / (n (n + 1)^2) * 2 for glass.
    path = op.PathGraph()
    glass = path.add("glass", op.Interface(1.5, op.Parameter("theta")))
    path.add("lamp", op.Source()) >> glass >> path.add("eye", op.Detector())
    ratio = path.trace(theta=1e-9).stokes[1] / path.trace(theta=1e-6).stokes[1]
    assert abs(ratio / 1e-6 - 1) < 1e-11


def test_right_angles_have_no_trace_of_the_other_component():
    assert sine(FLOAT)(math.pi) == 0.0
    assert cosine(FLOAT)(math.pi / 2) == 0.0
    assert cosine(NUMPY)(np.float32(np.pi / 2)) == 0.0
    assert cosine(NUMPY)(np.pi / 2 - 1e-12) == np.cos(np.pi / 2 - 1e-12)


@given(angle=st.floats(-7.0, 7.0))
def test_elsewhere_cosine_and_sine_are_those_of_the_platform(angle):
    for ours, theirs in ((cosine, math.cos), (sine, math.sin)):
        assert abs(ours(FLOAT)(angle) - theirs(angle)) <= 4.5e-16
