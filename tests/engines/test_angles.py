"""Next to right angles a batch gives what a single run gives, in every precision and engine."""

from functools import cache

import numpy as np
import pytest

import optipath as op
from optipath.lab.accuracy.path_reference import exact_lights
from tables import rows

OFF = 10.0 ** -np.arange(1.0, 16.0, 1.5)
GRAZING = [*(np.pi / 2 - OFF), np.nextafter(np.pi / 2, 0.0), *OFF, np.pi / 4]
# Nearer to a right angle the light is rounding.
CROSSED = [place * np.pi / 2 + off for place in (0, 1, -1, 2, 3) for off in (1e-3, -1e-6, 1e-8)]
WAYS = [
    (engine, dtype)
    for engine in ("numpy", "numba", "jax")
    for dtype in ("float64", "float32", "longdouble")
    if engine == "numpy" or dtype != "longdouble"
]
# In double precision Numba does the same to pairs and to single values as NumPy.
OTHER_WAYS = [way for way in WAYS if way != ("numba", "float64")]


def glass_behind_a_filter():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 1.0, 0.0, 0.0]))
    turned = path.add("turned", op.Rotator(op.Parameter("angle", default=0.1)))
    glass = op.Interface(op.Parameter("n", default=1.5), op.Parameter("theta", default=0.5))
    lamp >> turned >> path.add("filter", op.Polarizer()) >> path.add("glass", glass)
    path.add("eye", op.Detector(reads="intensity"))
    path.connect("glass.transmitted", "eye.in")
    return path


PATH = glass_behind_a_filter()


@cache
def plan_of(engine, dtype):
    pytest.importorskip(engine if engine != "auto" else "numpy")
    if dtype == "longdouble" and np.finfo(dtype).eps == np.finfo("float64").eps:
        pytest.skip("longdouble is float64 here")
    return op.Composer(engine=engine, dtype=dtype).compose(PATH)


def assert_like_a_single_run(engine, dtype, **values):
    """Each value fills a batch of its own, so that no other makes the engine more careful."""
    plan, single = plan_of(engine, dtype), plan_of("auto", dtype)
    assert plan.engine_for(1100).startswith(engine)
    assert dtype == "longdouble" or "step" not in plan.engine_for(1100)
    found = plan.run(**{n: filled(v, 1100) for n, v in values.items()}).intensity[0]
    wanted = single.run(**values).intensity
    slack = 100 * np.finfo(dtype).eps
    assert abs(float(found) - float(wanted)) <= slack * float(wanted)


def filled(value, count):
    if isinstance(value, op.CosSin):
        return op.CosSin(np.full(count, value.cos), np.full(count, value.sin))
    return np.full(count, value)


@rows("engine, dtype", WAYS)
def test_a_batch_next_to_grazing_incidence_is_like_a_single_run(engine, dtype):
    for theta in GRAZING:
        assert_like_a_single_run(engine, dtype, theta=theta)


@rows("engine, dtype", WAYS)
def test_a_batch_next_to_crossed_filters_is_like_a_single_run(engine, dtype):
    for angle in CROSSED:
        assert_like_a_single_run(engine, dtype, angle=angle)


@rows("engine, dtype", OTHER_WAYS)
def test_a_batch_of_cosines_and_sines_is_like_a_single_run(engine, dtype):
    for off in OFF:
        grazing, steep = (op.CosSin(off, np.sqrt(1 - off**2)), op.CosSin(np.sqrt(1 - off**2), off))
        assert_like_a_single_run(engine, dtype, theta=grazing)
        assert_like_a_single_run(engine, dtype, theta=steep)
    assert_like_a_single_run(engine, dtype, theta=op.CosSin(1e-18, 1.0))


@rows("engine, dtype", OTHER_WAYS)
def test_one_grazing_angle_beside_many_indices_is_like_a_single_run(engine, dtype):
    plan, single = plan_of(engine, dtype), plan_of("auto", dtype)
    indices, slack = np.linspace(1.4, 1.6, 1100), 100 * np.finfo(dtype).eps
    for theta in map(float, GRAZING):
        found = plan.run(theta=theta, n=indices).intensity[0]
        wanted = single.run(theta=theta, n=1.4).intensity
        assert abs(float(found) - float(wanted)) <= slack * float(wanted)


@rows("dtype", ["float64", "float32"])
def test_next_to_grazing_incidence_the_light_is_that_of_fifty_digits(dtype):
    for engine in ("numpy", "numba"):
        plan = plan_of(engine, dtype)
        for theta in GRAZING[:12]:
            exact = float(exact_lights(PATH, theta=float(theta))["eye"].stokes[0])
            found = plan.run(theta=np.full(1100, theta)).intensity[0]
            assert abs(found - exact) <= 100 * np.finfo(dtype).eps * exact


@rows("engine", ["numpy", "numba"])
def test_parts_of_a_grid_next_to_grazing_incidence_are_like_the_whole(engine):
    theta, n = np.pi / 2 - OFF[:, np.newaxis], np.linspace(1.3, 1.8, 1100)
    wanted = plan_of("numpy", "float64").run(theta=theta, n=n).intensity
    plan = plan_of(engine, "float32")
    for part in plan.stream(1100, theta=theta, n=n):
        np.testing.assert_allclose(part.light.intensity, wanted[part.where], rtol=1e-5)
    theta[2] = 2.0
    with pytest.raises(op.ParameterError, match="theta"):
        list(plan.stream(1100, theta=theta, n=n))


@rows("engine", ["numpy", "numba"])
def test_one_angle_beside_a_grid_of_others_is_like_a_single_run_in_single_precision(engine):
    angles = [op.Parameter(name) for name in ("a", "b", "u")]
    turned = op.Interface(1.5, angles[2], azimuth=angles[1])
    path = op.Source() >> op.Polarizer(angles[0]) >> turned >> op.Detector()
    x = np.linspace(0.1, 1.0, 33)  # Enough to be computed in stages.
    light = op.Composer(engine=engine, dtype="float32").compose(path).run(a=x[:, None], b=x, u=0.4)
    wanted = [[path.trace(a=a, b=b, u=0.4).stokes for b in x[::8]] for a in x[::8]]
    np.testing.assert_allclose(light.stokes[::8, ::8], wanted, atol=3e-7)
