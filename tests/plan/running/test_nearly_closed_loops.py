"""Light of which nearly all comes back each time: every digit of every component stays."""

import numpy as np
import pytest

import optipath as op
from nearly_closed import PLATES, networks, ring
from optipath.engines.automatic import is_installed
from optipath.lab.accuracy.path_reference import exact_stokes
from slabs import slab
from tables import rows, slow

pytestmark = pytest.mark.filterwarnings("ignore::optipath.LoopWarning")


STATES = ([1.0, 0.6, 0.64, 0.48], [1.0, 0.0, 0.6, 0.8], [1.0, 0.2, -0.1, 0.3])


def exact(path, **given):
    return {
        name: np.array([float(part) for part in stokes])
        for name, stokes in exact_stokes(path, **given).items()
    }


def dop_above_one(stokes):
    return np.linalg.norm(stokes[..., 1:], axis=-1) / stokes[..., 0] - 1.0


@rows("plates", PLATES.values())
@rows("leaves", [1e-2, 1e-4, 1e-7, 1e-12, 1e-14, 1e-16])
def test_a_ring_keeps_every_digit_however_little_leaves(leaves, plates):
    for state in STATES:
        path = ring(leaves, state, plates)
        found, expected = path.trace().stokes, exact(path)["eye"]
        # Where there is no closer look, all is computed with 1 - gain of 1e-2 at least, so that
        # each rounding, of 1e-16, counts up to a hundred times.
        np.testing.assert_allclose(found, expected, rtol=0, atol=2e-14 * expected[0])
        assert dop_above_one(found) <= 4e-16


@pytest.mark.parametrize("count", [20, slow(200)])
def test_random_networks_keep_every_digit_however_little_leaves(count):
    for network in networks(count):
        lights, expected = network.path.trace_all(), exact(network.path)
        for name, light in lights.items():
            atol = 2e-14 * expected[name][0]
            np.testing.assert_allclose(light.stokes, expected[name], rtol=0, atol=atol)
            assert not dop_above_one(light.stokes) > 4e-16


def test_what_is_lost_does_not_depend_on_how_the_frame_is_turned():
    turn = np.linspace(0.0, np.pi, 721)
    path = ring(op.Parameter("leaves"), [1.0, 1.0, 0.0, 0.0], turned=op.Parameter("turn"))
    for leaves in (1e-3, 1e-6, 1e-12, 1e-15):
        # Of nothing but splitters, all that enters leaves in the end as it came, mirrored.
        stokes = path.trace(turn=turn, leaves=leaves).stokes
        expected = [np.cos(2 * turn), np.sin(2 * turn), 0.0 * turn]
        np.testing.assert_allclose(stokes[:, 0], 1.0, rtol=1e-14)
        np.testing.assert_allclose(stokes[:, 1], expected[0], rtol=0, atol=1e-14)
        np.testing.assert_allclose(stokes[:, 2], -expected[1], rtol=0, atol=1e-14)
        assert np.max(dop_above_one(stokes)) <= 4e-16


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_of_a_batch_only_nearly_closed_paths_take_a_closer_look(engine):
    if not is_installed(engine):
        pytest.skip("not installed")
    leaves = np.full(3000, 0.3)
    leaves[[17, 1500, 2999]] = [1e-3, 1e-9, 1e-15]
    path = ring(op.Parameter("leaves"), STATES[0], PLATES["three wave plates"])
    found = op.Composer(engine=engine).compose(path).run(leaves=leaves).stokes
    for place in (0, 17, 1500, 2999):
        expected = exact(path, leaves=float(leaves[place]))["eye"]
        np.testing.assert_allclose(found[place], expected, rtol=0, atol=2e-14 * expected[0])
    np.testing.assert_array_equal(found[1], found[0])


def test_matrices_keep_every_digit_too():
    path = ring(np.array([1e-5, 0.5, 1e-13]), None, PLATES["three wave plates"])
    found = path.mueller().matrix
    for place, leaves in enumerate((1e-5, 0.5, 1e-13)):
        for column in range(4):
            state = np.eye(4)[column] + (column > 0) * np.eye(4)[0]
            one = exact(ring(leaves, state, PLATES["three wave plates"]))["eye"]
            none = exact(ring(leaves, None, PLATES["three wave plates"]))["eye"]
            expected = one - none if column else one
            np.testing.assert_allclose(found[place, :, column], expected, rtol=0, atol=4e-15)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_a_slab_next_to_grazing_incidence_keeps_its_polarisation(method):
    theta = float(np.pi / 2 - 1e-6)
    path = slab(1.5, theta, state=STATES[0])
    found, expected = op.Composer(method=method).compose(path).run_all(), exact(path)
    for name, light in found.items():
        # The other methods lose digits in the faces themselves.
        atol = 1e-13 if method in ("stable", "compensated") else 1e-8
        np.testing.assert_allclose(light.stokes, expected[name], rtol=0, atol=atol)


@pytest.mark.parametrize(("dtype", "rounding"), [("float32", 1e-6), ("longdouble", 1e-16)])
def test_every_precision_takes_a_closer_look(dtype, rounding):
    if np.finfo(dtype).eps == np.finfo(np.float64).eps:
        pytest.skip("longdouble is no more than float64 here")
    for leaves in (1e-4, 1e-7, 1e-12):
        path = ring(leaves, STATES[0], PLATES["a half-wave plate"])
        found, expected = op.Composer(dtype=dtype).compose(path).run().stokes, exact(path)["eye"]
        np.testing.assert_allclose(found.astype(float), expected, rtol=0, atol=rounding)


def test_an_angle_by_its_cosine_and_sine_is_an_angle():
    path = ring(1e-14, STATES[0], (op.Rotator(op.Parameter("there")), op.Rotator(-0.3)))
    found = path.trace(there=op.CosSin(np.cos(0.3), np.sin(0.3))).stokes
    assert dop_above_one(found) <= 4e-16
    np.testing.assert_allclose(found[0], 1.0, rtol=1e-14)
