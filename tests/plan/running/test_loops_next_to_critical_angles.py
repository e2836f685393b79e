"""Loops that light enters, or leaves, next to a critical angle: all of it is accounted for."""

import warnings

import numpy as np
import pytest

import optipath as op
from chains import COMPILED, ENGINES
from optipath.lab.accuracy.path_reference import exact_stokes
from slabs import stack
from tables import rows, slow_except

CRITICAL = float(np.arcsin(0.75))
BELOW = CRITICAL - np.array([0.0, 1e-15, 1e-14, 1e-12, 1e-8, 1e-6, 1e-5, 1e-3])
STATE = [1.0, 0.6, 0.64, 0.48]

# The worst that a climb has found, of some thousand points.
WORST = [
    ((1.993000523074928, 1.3307206424584475, 1.993000523074928), 0.7311109655776163),
    ((1.6871193407291787, 2.449993593081757, 1.6871193407291787), 1.570796326780126),
    ((1.4368732173123222, 1.0246598327799235, 2.03593373806575), 0.7939355403387471),
    ((2.0945285357294328, 1.578, 1.079762261605849, 2.2064486275960644), 0.5416093287825459),
    ((1.31675416407414, 1.3463470603282763, 1.376, 1.31675416407414), 1.5707963267942802),
    (
        (1.2013844143721588, 2.3154580605777224, 1.1992097736544047, 2.41156558882614),
        1.5106189446918221,
    ),
]


@pytest.mark.filterwarnings("ignore::optipath.LoopWarning")
@pytest.mark.parametrize("engine", slow_except(COMPILED, ENGINES))
def test_light_that_enters_a_closed_gap_next_to_the_critical_angle_all_comes_back(engine):
    path = stack(2.0, 1.5, 1.0, theta=op.Parameter("theta"))
    lights = op.Composer(engine=engine).compose(path).run_all(theta=BELOW)
    # T of what enters over T of what leaves, which are the same from either side of a face.
    for name in ("R", "face1-face2"):
        np.testing.assert_allclose(lights[name].S0, 1.0, rtol=1e-15)
        for theta, found in zip(BELOW, lights[name].S0, strict=True):
            np.testing.assert_allclose(path.trace_all(theta=theta)[name].S0, found, rtol=1e-15)


@rows(
    "indices, theta",
    [
        ((2.0, 1.5, 1.0), CRITICAL + 1e-15),
        ((2.001175971082208, 1.588144150911419, 0.8387537698418079), 0.9167120995599567),
    ],
)
def test_where_no_light_enters_a_closed_gap_there_is_none_inside(indices, theta):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        lights = stack(*indices, theta=theta, state=STATE).trace_all()
    assert lights["face1-face2"].S0 == 0.0
    np.testing.assert_allclose([lights[end].S0 for end in ("R", "T")], [1.0, 0.0], rtol=1e-15)


def assert_every_digit(path):
    expected = exact_stokes(path)
    for name, light in path.trace_all().items():
        stokes = np.array([float(part) for part in expected[name]])
        np.testing.assert_allclose(light.stokes, stokes, rtol=0, atol=1e-15 * stokes[0])


@pytest.mark.filterwarnings("ignore::optipath.LoopWarning")
@rows("indices, theta", WORST)
def test_lights_inside_and_outside_of_stacks_keep_every_digit(indices, theta):
    assert_every_digit(stack(*indices, theta=theta, state=STATE))


@pytest.mark.filterwarnings("ignore::optipath.LoopWarning")
def test_a_face_by_which_light_leaves_a_loop_is_not_folded_with_what_stands_behind():
    indices, theta = WORST[0]
    path = stack(*indices, theta=theta, state=STATE)
    path.insert("filter", op.Attenuator(0.5), behind="face2.transmitted")
    assert_every_digit(path)


@pytest.mark.filterwarnings("ignore::optipath.LoopWarning")
def test_a_face_behind_a_loop_that_takes_a_closer_look_keeps_every_digit_too():
    path = stack(2.0, 1.5, 1.0, theta=CRITICAL, state=STATE)
    path.insert("behind", op.Interface(1.5, CRITICAL, outside=2.0), behind="face1.reflected")
    path.add("through", op.Detector())
    path.connect("behind.transmitted", "through.in")
    assert_every_digit(path)
