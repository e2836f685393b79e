"""Angles of any size: the same light by every engine and every run, and no energy lost."""

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.engines.automatic import is_installed
from paths import chain
from tables import rows

# They are meant in radians.
pytestmark = pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")

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


def angles(dtype):
    most = 38 if dtype == "float32" else 307
    sizes = [10.0**power for power in range(0, most, 9)] + [3e5, 1e16]
    right = [m * np.pi / 2 for m in (1, 2, 3, 1001, 10**6 + 1, 10**9 + 1, 10**12 + 1)]
    found = np.array([*sizes, *right], dtype)
    next_to = np.nextafter(found[-len(right) :], np.array(0.0, dtype))
    return np.concatenate([found, -found, next_to])


@rows("element", ELEMENTS)
@rows("dtype", ROUNDINGS)
def test_batches_and_runs_agree_on_angles_of_any_size(element, dtype):
    given = angles(dtype)
    plan = op.Composer(engine="numpy", dtype=dtype).compose(chain([ELEMENTS[element]], STATE))
    found = {
        "few": plan.run(a=given).stokes,
        "many": plan.run(a=np.tile(given, 1024 // len(given) + 1)).stokes[: len(given)],
        "first": np.array([plan.run(a=float(a)).stokes for a in given[:3]]),
        "later": np.array([plan.run(a=float(a)).stokes for a in given]),
    }
    assert_alike(found, dtype)


@rows("element", ["rotator", "retardance", "azimuth"])
@rows("dtype", ROUNDINGS)
def test_engines_agree_on_angles_of_any_size(element, dtype):
    path, given = chain([ELEMENTS[element]], STATE), angles(dtype)
    compiled = ["numba"] if (element, dtype) == ("rotator", "float64") else []
    engines = filter(is_installed, ["numpy", "jax", *compiled])
    plans = {e: op.Composer(engine=e, dtype=dtype).compose(path) for e in engines}
    assert_alike({engine: plan.run(a=given).stokes for engine, plan in plans.items()}, dtype)


def assert_alike(found, dtype):
    first = next(iter(found.values()))
    for name, stokes in ((name, np.float64(stokes)) for name, stokes in found.items()):
        expected = first[: len(stokes)]
        np.testing.assert_allclose(stokes, expected, rtol=0, atol=ROUNDINGS[dtype], err_msg=name)
        polarised = np.linalg.norm(stokes[:, 1:], axis=-1)
        assert np.all(polarised <= stokes[:, 0] * (1.0 + ROUNDINGS[dtype])), name


@rows("batch", [False, True])
def test_a_rotator_turns_by_the_exact_double_of_its_angle_and_loses_nothing(batch):
    given = angles("float64")
    plan = op.Composer(engine="numpy").compose(chain([op.Rotator(A)], (1.0, 1.0, 0.0, 0.0)))
    if batch:
        stokes = plan.run(a=given).stokes
    else:
        stokes = np.array([[plan.run(a=float(a)).stokes for a in given] for _ in range(2)][1])
    with mpmath.workdps(400):
        exact = [(mpmath.cos(2 * mpmath.mpf(a)), mpmath.sin(2 * mpmath.mpf(a))) for a in given]
        exact = np.array([[float(c), float(s)] for c, s in exact])
    np.testing.assert_allclose(stokes[:, 0], 1.0, rtol=1e-14)
    # Next to a multiple of a right angle, what an angle cannot tell from 0 is 0.
    off = np.abs(stokes[:, 1:3] - exact)
    assert np.all(off <= np.where(np.abs(exact) < 2e-8, 2e-8, 1e-14))
