"""Light that goes round: every digit of every component stays, however little leaves each time."""

import re
import warnings

import numpy as np
import pytest

import amplifying
import nearly_closed
import optipath as op
from chains import COMPILED, by_engine
from nearly_closed import PLATES, ring
from optipath.lab.path_reference import exact_stokes
from slabs import slab, stack
from tables import rows, slow, slow_except

pytestmark = pytest.mark.filterwarnings("ignore::optipath.errors.LoopWarning")
STATES = ([1.0, 0.6, 0.64, 0.48], [1.0, 0.0, 0.6, 0.8], [1.0, 0.2, -0.1, 0.3])
WAVE_PLATES = PLATES["three wave plates"]


def exact(path, **given):
    found = exact_stokes(path, **given)
    return {name: np.array([float(part) for part in stokes]) for name, stokes in found.items()}


def assert_exact(path, slack, lights=None):
    """Light is, within a share of its intensity, that of many digits."""
    expected = exact(path)
    for name, light in (lights or path.trace_all()).items():
        atol = slack * expected[name][0]
        np.testing.assert_allclose(light.stokes, expected[name], rtol=0, atol=atol)


def dop_above_one(stokes):
    return np.linalg.norm(stokes[..., 1:], axis=-1) / stokes[..., 0] - 1.0


@rows("plates", PLATES.values())
@pytest.mark.parametrize(
    "leaves", slow_except([1e-4, 1e-14], [1e-2, 1e-4, 1e-7, 1e-12, 1e-14, 1e-16])
)
def test_a_ring_keeps_every_digit_however_little_leaves(leaves, plates):
    for state in STATES:
        path = ring(leaves, state, plates)
        # Where there is no closer look, all is computed with 1 - gain of 1e-2 at least, so that
        # each rounding, of 1e-16, counts up to a hundred times.
        assert_exact(path, 2e-14)
        assert dop_above_one(path.trace().stokes) <= 4e-16


@pytest.mark.parametrize("count", [20, slow(200)])
def test_random_networks_keep_every_digit_however_little_leaves(count):
    for network in nearly_closed.networks(count):
        lights = network.path.trace_all()
        assert_exact(network.path, 2e-14, lights)
        assert not any(dop_above_one(light.stokes) > 4e-16 for light in lights.values())


def test_what_is_lost_does_not_depend_on_how_the_frame_is_turned():
    turn = np.linspace(0.0, np.pi, 721)
    path = ring(op.Parameter("leaves"), [1.0, 1.0, 0.0, 0.0], turned=op.Parameter("turn"))
    for leaves in (1e-3, 1e-6, 1e-12, 1e-15):
        # Of nothing but splitters, all that enters leaves in the end as it came, mirrored.
        stokes = path.trace(turn=turn, leaves=leaves).stokes
        expected = np.transpose([turn**0, np.cos(2 * turn), -np.sin(2 * turn)])
        np.testing.assert_allclose(stokes[:, :3], expected, rtol=0, atol=1e-14)
        assert np.max(dop_above_one(stokes)) <= 4e-16


@rows("engine", COMPILED)
def test_of_a_batch_only_nearly_closed_paths_take_a_closer_look(engine):
    leaves = np.full(3000, 0.3)
    leaves[[17, 1500, 2999]] = [1e-3, 1e-9, 1e-15]
    path = ring(op.Parameter("leaves"), STATES[0], WAVE_PLATES)
    found = op.Composer(engine=engine).compose(path).run(leaves=leaves).stokes
    for place in (0, 17, 1500, 2999):
        expected = exact(path, leaves=float(leaves[place]))["eye"]
        np.testing.assert_allclose(found[place], expected, rtol=0, atol=2e-14 * expected[0])
    np.testing.assert_array_equal(found[1], found[0])


def test_matrices_keep_every_digit_too():
    several = 1e-5, 0.5, 1e-13
    found = ring(np.array(several), None, WAVE_PLATES).mueller().matrix
    for place, leaves in enumerate(several):
        none = exact(ring(leaves, None, WAVE_PLATES))["eye"]
        for column, state in enumerate(np.eye(4)):
            one = exact(ring(leaves, [1.0, *state[1:]], WAVE_PLATES))["eye"]
            expected = one - none if column else one
            np.testing.assert_allclose(found[place, :, column], expected, rtol=0, atol=4e-15)


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_a_slab_next_to_grazing_incidence_keeps_its_polarisation(method):
    path = slab(1.5, float(np.pi / 2 - 1e-6), state=STATES[0])
    expected = exact(path)
    # The other methods lose digits in the faces themselves.
    atol = 1e-13 if method in ("stable", "compensated") else 1e-8
    for name, light in op.Composer(method=method).compose(path).run_all().items():
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


CRITICAL = float(np.arcsin(0.75))
BELOW = CRITICAL - np.array([0.0, 1e-15, 1e-14, 1e-12, 1e-8, 1e-6, 1e-5, 1e-3])

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


@by_engine
def test_light_that_enters_a_closed_gap_next_to_the_critical_angle_all_comes_back(engine):
    path = stack(2.0, 1.5, 1.0, theta=op.Parameter("theta"))
    lights = op.Composer(engine=engine).compose(path).run_all(theta=BELOW)
    # T of what enters over T of what leaves, which are the same from either side of a face.
    for name in ("R", "face1-face2"):
        alone = [path.trace_all(theta=theta)[name].S0 for theta in BELOW]
        for one in (lights[name].S0, alone):
            np.testing.assert_allclose(one, 1.0, rtol=1e-15)
        np.testing.assert_allclose(alone, lights[name].S0, rtol=1e-15)


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
        lights = stack(*indices, theta=theta, state=STATES[0]).trace_all()
    assert lights["face1-face2"].S0 == 0.0
    np.testing.assert_allclose([lights[end].S0 for end in ("R", "T")], [1.0, 0.0], rtol=1e-15)


def test_lights_inside_and_outside_of_stacks_keep_every_digit_whatever_stands_behind():
    for indices, theta in WORST:
        assert_exact(stack(*indices, theta=theta, state=STATES[0]), 1e-15)
    # A face by which light leaves a loop is not folded with what stands behind.
    indices, theta = WORST[0]
    path = stack(*indices, theta=theta, state=STATES[0])
    path.insert("filter", op.Attenuator(0.5), behind="face2.transmitted")
    assert_exact(path, 1e-15)
    path = stack(2.0, 1.5, 1.0, theta=CRITICAL, state=STATES[0])
    path.insert("behind", op.Interface(1.5, CRITICAL, outside=2.0), behind="face1.reflected")
    path.add("through", op.Detector())
    path.connect("behind.transmitted", "through.in")
    assert_exact(path, 1e-15)


def assert_refused_with_its_gain(path, gain, rel):
    with pytest.raises(op.errors.ParameterError, match="never fades") as refused:
        path.trace_all()
    # Of several loops each has its own.
    told = re.findall(r"never fades: (\S+) of it comes back", str(refused.value))
    assert max(map(float, told)) == pytest.approx(gain, rel=rel)


@pytest.mark.parametrize("count", [20, slow(200)])
def test_what_amplifies_is_summed_where_it_fades_and_refused_with_its_gain_where_not(count):
    summed = 0
    for network in amplifying.networks(count):
        if (gain := network.radius()) >= 1.0:
            assert_refused_with_its_gain(network.path, gain, 1e-6)
        else:
            assert_exact(network.path, 1e-13)
            summed += 1
    assert 0 < summed < count


def test_a_gain_is_judged_however_near_to_one_it_is_and_though_neither_x_nor_y_tells_it():
    rng = np.random.default_rng(3)
    for apart in 10.0 ** rng.uniform(-12, -1, 12):
        matrix = amplifying.drawn(rng, 1.0)
        matrix /= amplifying.radius(matrix)
        with pytest.raises(op.errors.ParameterError, match="never fades"):
            amplifying.ring((1.0 + apart) * matrix).trace()
        assert_exact(amplifying.ring((1.0 - apart) * matrix), 1e-13)
    # Light at 45 deg is amplified by 1.2, that along x and along y dimmed.
    matrix = amplifying.of_jones(np.array([[0.75, 0.35], [0.35, 0.75]]) * np.sqrt(1.2) / 1.1)
    assert matrix[0, 0] + matrix[0, 1] < 1.0
    assert_refused_with_its_gain(amplifying.ring(matrix, (1.0, 0.0, 1.0, 0.0)), 1.2, 1e-9)


@rows("gain", [0.7, 1.0, 1.4, 3.0])
def test_what_gains_and_dies_in_the_second_round_is_summed(gain):
    # What comes back of x as x may be all of it, or more: the whole of it is dark next time.
    matrix = gain * amplifying.of_jones(np.array([[1.0, 1.0], [-1.0, -1.0]]))
    for state in ((1.0, 0.3, 0.4, 0.5), (1.0, 0.0, 0.0, 0.0), (1.0, -1.0, 0.0, 0.0)):
        # Of 1 + M + M^2 + ..., the half that is let out is behind the amplifier and mirrored.
        expected = np.diag([1.0, 1.0, -1.0, -1.0]) @ matrix @ state
        found = amplifying.ring(matrix, state).trace().stokes
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14 * expected[0])


@rows("engine", ["numpy", "auto"])
def test_a_batch_that_gains_is_summed_by_every_engine(engine):
    matrix = amplifying.of_jones(np.diag([1.0, 0.5]) @ np.array([[0.8, -0.6], [0.6, 0.8]]))
    batch = np.linspace(0.1, 0.95, 40)[:, None, None] * matrix / amplifying.radius(matrix)
    lights = op.Composer(engine=engine).compose(amplifying.ring(batch)).run()
    for place in (0, 20, 39):
        expected = exact(amplifying.ring(batch[place]))["eye"]
        found = lights.stokes[place]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13 * expected[0])
    batch[7] *= 20.0
    with pytest.raises(op.errors.ParameterError, match="never fades"):
        op.Composer(engine=engine).compose(amplifying.ring(batch)).run()


@pytest.mark.parametrize(
    "dtype", slow_except(["float64", "longdouble"], ["float32", "float64", "longdouble"])
)
@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_values_beyond_all_range_give_light_or_a_sentence(method, dtype):
    if dtype == "longdouble" and np.finfo(dtype).eps == np.finfo(np.float64).eps:
        pytest.skip("longdouble is no more than float64 here")
    path = op.load_preset("coated-metal")
    plan = op.Composer(method=method, dtype=dtype, engine="numpy").compose(path)
    rng = np.random.default_rng(1)
    for index in [1e40, 1e199, *10.0 ** rng.uniform(-2, 300, 2)]:
        given = {"n": float(index), "k_metal": float(10.0 ** rng.uniform(-300, 300))}
        for run in (
            lambda given=given: [light.stokes for light in plan.run_all(**given).values()],
            lambda given=given: [plan.mueller("lamp", "eye", **given).matrix],
        ):
            try:
                numbers = run()
            except op.OptipathError:
                continue
            assert all(np.all(np.isfinite(number)) for number in numbers)
