"""What is done to arrays that light gives, or is given, is not done to the light."""

import copy
import pickle

import numpy as np
import pytest

import optipath as op
from tables import rows

STATE = [1.0, 0.6, 0.0, 0.8]
PATH = op.Source(op.Parameter("i")) >> op.Polarizer("30 deg") >> op.Detector()
BATCH = [1.0, 2.0]

LIGHTS = {
    "given": lambda: op.Light(STATE),
    "a batch": lambda: op.Light([STATE, STATE]),
    "broadcast": lambda: op.Light(np.broadcast_to(STATE, (3, 4))),
    "float32": lambda: op.Light(np.array(STATE, np.float32)),
    "faint": lambda: op.Light(STATE, exponent=-5000),
    "of a path": lambda: PATH.trace(i=1.0),
    "of a batch of paths": lambda: PATH.trace(i=BATCH),
    "one of a batch": lambda: PATH.trace(i=BATCH)[1],
    "a sum": lambda: op.Light(STATE) + op.Light(STATE),
    "a multiple": lambda: 0.5 * op.Light(STATE),
    "behind an element": lambda: op.Polarizer(0.2) @ op.Light(STATE),
    "of other software": lambda: op.Light.from_("mitsuba", STATE),
    "a copy": lambda: copy.deepcopy(op.Light(STATE)),
    "a pickle": lambda: pickle.loads(pickle.dumps(PATH.trace(i=BATCH))),
}


@rows("name", LIGHTS)
def test_components_may_be_scaled_in_place(name):
    light = LIGHTS[name]()
    before = light.stokes.copy()
    for component in (light.intensity, light.S0, light.S1, light.S2, light.S3):
        np.multiply(component, 0.0, out=component)
    np.testing.assert_array_equal(light.stokes, before)
    np.testing.assert_array_equal(light.intensity, before[..., 0])


def test_the_intensity_of_a_path_may_be_scaled_before_anything_else_is_asked_for():
    light = PATH.trace(i=BATCH)
    intensity = light.intensity
    intensity /= intensity.max()
    np.testing.assert_allclose(light.S0, [0.5, 1.0], rtol=1e-15)
    np.testing.assert_allclose(light.dop, 1.0, rtol=1e-15)


def test_components_of_very_many_lights_are_read_only_and_no_copies():
    light = PATH.trace(i=np.ones(70_000))
    for component in (light.intensity, light.S0, light.S3):
        with pytest.raises(ValueError, match="read-only"):
            component[...] = 2.0
    assert np.shares_memory(light.S1, light.stokes)


@rows("name", LIGHTS)
def test_the_arrays_of_light_are_read_only(name):
    light = LIGHTS[name]()
    arrays = [light.stokes, np.asarray(light), light.mantissa, light.exponent]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 2
    assert np.array(light).flags.writeable


def test_an_array_that_light_is_made_of_may_change():
    state = np.array([1.0, 1.0, 0.0, 0.0])
    light = op.Light(state)
    state[0] = 0.5
    assert light.dop == 1.0


@rows(
    "made",
    [
        op.Mueller,
        lambda m: op.Mueller(m) @ op.Mueller(m),
        lambda m: op.MuellerElement(m).mueller(),
        lambda m: op.MuellerElement(m) @ op.Rotator(0.0),
        lambda m: op.Mueller(m).nearest_physical(),
        lambda m: op.Mueller(m).lu_chipman().retarder,
        lambda m: pickle.loads(pickle.dumps(op.Mueller(m))),
        lambda m: copy.deepcopy(op.Mueller(m)),
    ],
)
def test_a_mueller_matrix_does_not_change(made):
    given = np.eye(4)
    matrix = made(given).matrix
    given[0, 0] = 0.5
    np.testing.assert_allclose(matrix, np.eye(4), atol=1e-15)
    with pytest.raises(ValueError, match="read-only"):
        matrix[0, 0] = 2.0
