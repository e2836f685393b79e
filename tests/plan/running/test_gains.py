import re

import numpy as np
import pytest

import optipath as op
from amplifying import drawn, networks, of_jones, radius, ring
from optipath.lab.accuracy.path_reference import exact_stokes
from tables import rows, slow

pytestmark = pytest.mark.filterwarnings("ignore::optipath.LoopWarning")


def exact(path):
    return {name: np.array([float(p) for p in s]) for name, s in exact_stokes(path).items()}


def told_gain(error):
    # Of several loops each has its own.
    return max(map(float, re.findall(r"never fades: (\S+) of it comes back", str(error))))


@pytest.mark.parametrize("count", [20, slow(200)])
def test_what_amplifies_is_summed_where_it_fades_and_refused_with_its_gain_where_not(count):
    summed = 0
    for network in networks(count):
        gain = network.radius()
        if gain >= 1.0:
            with pytest.raises(op.ParameterError, match="never fades") as refused:
                network.path.trace_all()
            assert told_gain(refused.value) == pytest.approx(gain, rel=1e-6)
            continue
        lights, expected = network.path.trace_all(), exact(network.path)
        summed += 1
        for name, light in lights.items():
            atol = 1e-13 * expected[name][0]
            np.testing.assert_allclose(light.stokes, expected[name], rtol=0, atol=atol)
    assert 0 < summed < count


def test_a_gain_is_judged_however_near_to_one_it_is():
    rng = np.random.default_rng(3)
    for apart in 10.0 ** rng.uniform(-12, -1, 12):
        matrix = drawn(rng, 1.0)
        matrix /= radius(matrix)
        with pytest.raises(op.ParameterError, match="never fades"):
            ring((1.0 + apart) * matrix).trace()
        path = ring((1.0 - apart) * matrix)
        found, expected = path.trace().stokes, exact(path)["eye"]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13 * expected[0])


@rows("gain", [0.7, 1.0, 1.4, 3.0])
def test_what_gains_and_dies_in_the_second_round_is_summed(gain):
    # What comes back of x as x may be all of it, or more: the whole of it is dark next time.
    matrix = gain * of_jones(np.array([[1.0, 1.0], [-1.0, -1.0]]))
    for state in ((1.0, 0.3, 0.4, 0.5), (1.0, 0.0, 0.0, 0.0), (1.0, -1.0, 0.0, 0.0)):
        # Of 1 + M + M^2 + ..., the half that is let out is behind the amplifier and mirrored.
        expected = np.diag([1.0, 1.0, -1.0, -1.0]) @ matrix @ state
        found = ring(matrix, state).trace().stokes
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14 * expected[0])


def test_some_polarised_light_may_gain_that_neither_x_nor_y_tells():
    # Light at 45 deg is amplified by 1.2, that along x and along y dimmed.
    matrix = of_jones(np.array([[0.75, 0.35], [0.35, 0.75]]) * np.sqrt(1.2) / 1.1)
    assert matrix[0, 0] + matrix[0, 1] < 1.0
    with pytest.raises(op.ParameterError, match="never fades") as refused:
        ring(matrix, (1.0, 0.0, 1.0, 0.0)).trace()
    assert told_gain(refused.value) == pytest.approx(1.2, rel=1e-9)


@rows("engine", ["numpy", "auto"])
def test_a_batch_that_gains_is_summed_by_every_engine(engine):
    gains = np.linspace(0.1, 0.95, 40)
    matrix = of_jones(np.diag([1.0, 0.5]) @ np.array([[0.8, -0.6], [0.6, 0.8]]))
    batch = gains[:, None, None] * matrix / radius(matrix)
    found = op.Composer(engine=engine).compose(ring(batch)).run().stokes
    for place in (0, 20, 39):
        expected = exact(ring(batch[place]))["eye"]
        np.testing.assert_allclose(found[place], expected, rtol=0, atol=1e-13 * expected[0])
    batch[7] *= 20.0
    with pytest.raises(op.ParameterError, match="never fades"):
        op.Composer(engine=engine).compose(ring(batch)).run()


@pytest.mark.parametrize("dtype", ["float32", "float64", "longdouble"])
@pytest.mark.parametrize("method", ["stable", "compensated", "amplitude", "textbook"])
def test_values_beyond_all_range_give_light_or_a_sentence(method, dtype):
    if dtype == "longdouble" and np.finfo(dtype).eps == np.finfo(np.float64).eps:
        pytest.skip("longdouble is no more than float64 here")
    path = op.load_preset("coated-metal")
    plan = op.Composer(method=method, dtype=dtype, engine="numpy").compose(path)
    rng = np.random.default_rng(1)
    for index in [1e40, 1e199, *10.0 ** rng.uniform(-2, 300, 2)]:
        given = {"n": float(index), "k_metal": float(10.0 ** rng.uniform(-300, 300))}
        for run in (plan.run_all, lambda **given: plan.mueller("lamp", "eye", **given)):
            try:
                found = run(**given)
            except op.OptipathError:
                continue
            lights = found.values() if isinstance(found, dict) else [found]
            numbers = [getattr(one, "stokes", getattr(one, "matrix", None)) for one in lights]
            assert all(np.all(np.isfinite(number)) for number in numbers)
