"""Angles next to right angles and of any size: one light by every engine, precision and run."""

from functools import cache

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.engines.choice import is_installed
from optipath.lab.path_reference import exact_lights
from paths import chain
from tables import rows, slow, slow_except

OFF = 10.0 ** -np.arange(1.0, 16.0, 1.5)
GRAZING = [*map(float, np.pi / 2 - OFF), float(np.nextafter(np.pi / 2, 0.0)), *OFF, np.pi / 4]
# Nearer to a right angle the light is rounding.
CROSSED = [place * np.pi / 2 + off for place in (0, 1, -1, 2, 3) for off in (1e-3, -1e-6, 1e-8)]
PAIRS = [(off, np.sqrt(1 - off**2)) for off in OFF]
PAIRS = [op.CosSin(*pair) for pair in (*PAIRS, *[pair[::-1] for pair in PAIRS], (1e-18, 1.0))]
WAYS = [(engine, dtype) for engine in ("numpy", "numba", "jax") for dtype in ("float64", "float32")]
WAYS += [("numpy", "longdouble")]


def glass_behind_a_filter():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 1.0, 0.0, 0.0]))
    glass = op.Interface(op.Parameter("n", default=1.5), op.Parameter("theta", default=0.5))
    turned = lamp >> op.Rotator(op.Parameter("angle", default=0.1)) >> op.Polarizer()
    turned >> path.add("glass", glass)
    path["glass.transmitted"] >> path.add("eye", op.Detector(reads="intensity"))
    return path


PATH = glass_behind_a_filter()


@cache
def plan_of(engine, dtype):
    pytest.importorskip(engine if engine != "auto" else "numpy")
    if dtype == "longdouble" and np.finfo(dtype).eps == np.finfo("float64").eps:
        pytest.skip("longdouble is float64 here")
    return op.Composer(engine=engine, dtype=dtype).compose(PATH)


def filled(value, count=1100):
    if isinstance(value, op.CosSin):
        return op.CosSin(filled(value.cos), filled(value.sin))
    return np.full(count, value)


@pytest.mark.parametrize(("engine", "dtype"), slow_except([WAYS[n] for n in (0, 1, 3, 6)], WAYS))
def test_a_batch_next_to_right_angles_is_like_a_single_run(engine, dtype):
    plan, single = plan_of(engine, dtype), plan_of("auto", dtype)
    assert plan.engine_for(1100).startswith(engine)
    assert dtype == "longdouble" or "step" not in plan.engine_for(1100)
    # Each value fills a batch of its own, so that no other makes the engine more careful.
    given = [{"theta": theta} for theta in GRAZING] + [{"angle": angle} for angle in CROSSED]
    several = [{n: filled(v) for n, v in values.items()} for values in given]
    # In double precision Numba does the same to pairs and to single values as NumPy.
    if (engine, dtype) != ("numba", "float64"):
        given += [{"theta": pair} for pair in PAIRS]
        several += [{"theta": filled(pair)} for pair in PAIRS]
        given += [{"theta": theta, "n": 1.4} for theta in GRAZING]
        several += [{"theta": theta, "n": np.linspace(1.4, 1.6, 1100)} for theta in GRAZING]
    for values, many in zip(given, several, strict=True):
        found, wanted = plan.run(**many).intensity[0], float(single.run(**values).intensity)
        assert abs(float(found) - wanted) <= 100 * np.finfo(dtype).eps * wanted, values


@rows("dtype", ["float64", "float32"])
def test_next_to_grazing_incidence_the_light_is_that_of_fifty_digits(dtype):
    for engine in ("numpy", "numba"):
        plan = plan_of(engine, dtype)
        for theta in GRAZING[:12]:
            exact = float(exact_lights(PATH, theta=theta)["eye"].stokes[0])
            found = plan.run(theta=filled(theta)).intensity[0]
            assert abs(found - exact) <= 100 * np.finfo(dtype).eps * exact


@rows("engine", ["numpy", "numba"])
def test_parts_of_a_grid_next_to_grazing_incidence_are_like_the_whole(engine):
    theta, n = np.pi / 2 - OFF[:, np.newaxis], np.linspace(1.3, 1.8, 1100)
    wanted = plan_of("numpy", "float64").run(theta=theta, n=n).intensity
    plan, out = plan_of(engine, "float32"), np.full_like(wanted, np.nan)
    for part in plan.stream(1500, theta=theta, n=n):
        assert part.light.size <= 1500
        out[part.where] = part.light.intensity
    np.testing.assert_allclose(out, wanted, rtol=1e-5)
    theta[2] = 2.0
    with pytest.raises(op.errors.ParameterError, match="theta"):
        list(plan.stream(1100, theta=theta, n=n))


@rows("engine", ["numpy", "numba"])
def test_one_angle_beside_a_grid_of_others_is_like_a_single_run_in_single_precision(engine):
    a, b, u = (op.Parameter(name) for name in "abu")
    path = op.Source() >> op.Polarizer(a) >> op.Interface(1.5, u, azimuth=b) >> op.Detector()
    x = np.linspace(0.1, 1.0, 33)  # Enough to be computed in stages.
    light = op.Composer(engine=engine, dtype="float32").compose(path).run(a=x[:, None], b=x, u=0.4)
    wanted = [[path.trace(a=a, b=b, u=0.4).stokes for b in x[::8]] for a in x[::8]]
    np.testing.assert_allclose(light.stokes[::8, ::8], wanted, atol=3e-7)


A = op.Parameter("a")
STATE = (1.0, 0.5, 0.3, 0.4)
ELEMENTS = {
    "rotator": op.Rotator(A),
    "polarizer": op.Polarizer(A, leakage=0.1),
    "retardance": op.Retarder(A, 0.3),
    "axis of a retarder": op.Retarder(1.1, A),
    "azimuth": op.Interface(1.5 + 0.2j, 0.8, azimuth=A),
    "diattenuator": op.Diattenuator(0.8, 0.3, A),
    "mirror": op.Mirror(-0.9 + 0.1j, 0.8, A),
    "rotation": op.Medium(1.0, 0.1, rotation=A),
    "retardance of a medium": op.Medium(1.0, 0.1, retardance=A, angle=0.2),
    "axis of a medium": op.Medium(1.0, 0.1, retardance=1.0, angle=A),
    "Faraday's angle": op.FaradayRotator(A),
    "axis of a plate": op.Waveplate(1e-3, 0.0091, 5e-7, A),
    "stack": op.LayerStack([1.0, 1.3, 1.5 + 0.1j], 0.7, A),
    "matrix": op.MuellerElement(np.diag([1.0, 0.5, 0.4, 0.3]), A),
}
ROUNDINGS = {"float64": 1e-13, "float32": 3e-6}
# They are meant in radians.
in_radians = pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")


def of_any_size(dtype):
    most = 38 if dtype == "float32" else 307
    sizes = [10.0**power for power in range(0, most, 9)] + [3e5, 1e16]
    right = [m * np.pi / 2 for m in (1, 2, 3, 1001, 10**6 + 1, 10**9 + 1, 10**12 + 1)]
    found = np.array([*sizes, *right], dtype)
    next_to = np.nextafter(found[-len(right) :], np.array(0.0, dtype))
    return np.concatenate([found, -found, next_to])


@in_radians
@rows("element", ELEMENTS)
@rows("dtype", ROUNDINGS)
@pytest.mark.parametrize("by_jax", [[], slow(["rotator", "retardance", "azimuth"])])
def test_engines_batches_and_runs_agree_on_angles_of_any_size(element, dtype, by_jax):
    path, given = chain([ELEMENTS[element]], STATE), of_any_size(dtype)
    plan = op.Composer(engine="numpy", dtype=dtype).compose(path)
    found = {
        "few": plan.run(a=given).stokes,
        "many": plan.run(a=np.tile(given, 1024 // len(given) + 1)).stokes[: len(given)],
        "first": np.array([plan.run(a=float(a)).stokes for a in given[:3]]),
        "later": np.array([plan.run(a=float(a)).stokes for a in given]),
    }
    compiled = ["jax"] if element in by_jax else []
    compiled += ["numba"] if (element, dtype) == ("rotator", "float64") else []
    for engine in filter(is_installed, compiled):
        plan = op.Composer(engine=engine, dtype=dtype).compose(path)
        found[engine] = plan.run(a=given).stokes
    for name, stokes in ((name, np.float64(stokes)) for name, stokes in found.items()):
        expected = found["few"][: len(stokes)]
        np.testing.assert_allclose(stokes, expected, rtol=0, atol=ROUNDINGS[dtype], err_msg=name)
        polarised = np.linalg.norm(stokes[:, 1:], axis=-1)
        assert np.all(polarised <= stokes[:, 0] * (1.0 + ROUNDINGS[dtype])), name


@in_radians
def test_a_rotator_turns_by_the_exact_double_of_its_angle_and_loses_nothing():
    given = of_any_size("float64")
    plan = op.Composer(engine="numpy").compose(chain([op.Rotator(A)], (1.0, 1.0, 0.0, 0.0)))
    with mpmath.workdps(400):
        exact = [(mpmath.cos(2 * mpmath.mpf(a)), mpmath.sin(2 * mpmath.mpf(a))) for a in given]
        exact = np.array([[float(c), float(s)] for c, s in exact])
    single = [np.array([plan.run(a=float(a)).stokes for a in given]) for _ in range(2)]
    for stokes in (plan.run(a=given).stokes, single[1]):
        np.testing.assert_allclose(stokes[:, 0], 1.0, rtol=1e-14)
        # Next to a multiple of a right angle, what an angle cannot tell from 0 is 0.
        off = np.abs(stokes[:, 1:3] - exact)
        assert np.all(off <= np.where(np.abs(exact) < 2e-8, 2e-8, 1e-14))


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
def test_angles_of_many_turns_are_right_in_compiled_batches():
    path = chain([op.Polarizer(op.Parameter("angle"))], [1.0, 0.5, 0.0, 0.5])
    plan = op.Composer(engine="numba").compose(path)
    turns = np.full(2000, 0.3) + 2 * np.pi * 1e7 * (np.arange(2000) % 3)
    expected = [plan.run(angle=float(angle)).stokes for angle in turns[:3]]
    np.testing.assert_allclose(plan.run(angle=turns).stokes[:3], expected, rtol=1e-13, atol=1e-16)
