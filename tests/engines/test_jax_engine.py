"""Gradients by JAX, against differences and closed forms; needs the extra [jax]."""

import numpy as np
import pytest

import optipath as op
from optipath.bench.values import random_values

jax = pytest.importorskip("jax")
jnp = jax.numpy

METAL = {"k1": 2.16, "n2": 0.608, "k2": 2.12, "delta": 0.8, "rho": 0.5, "phi": 0.4}


@pytest.fixture(autouse=True)
def _double():
    jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - as JAX has it
    yield
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto


@pytest.mark.parametrize("name", op.preset_names())
@pytest.mark.parametrize("composing", ["stokes", "jones"])
def test_every_preset_gives_what_numpy_gives(name, composing):
    path = op.load_preset(name)
    plans = [
        op.Composer(engine=engine, composing=composing).compose(path) for engine in ("numpy", "jax")
    ]
    given = random_values(plans[0], 20)
    for expected, found in zip(*(plan.run_all(**given).values() for plan in plans), strict=True):
        scale = np.max(np.abs(expected.stokes))
        np.testing.assert_allclose(found.stokes, expected.stokes, atol=4e-15 * scale)
        assert found.stokes.dtype == np.float64
    if len(plans[0].program.detectors) == len(plans[0].program.sources) == 1:
        numpy_matrix, jax_matrix = (plan.mueller(**given).matrix for plan in plans)
        np.testing.assert_allclose(jax_matrix, numpy_matrix, atol=4e-15)


@pytest.mark.parametrize("method", ["stable", "compensated", "amplitude", "textbook"])
def test_slopes_are_those_of_differences(method):
    plan = op.Composer(method=method).compose(op.load_preset("npgr026"))

    def stokes(n, k, delta, rho):
        values = {**METAL, "k1": k, "delta": delta, "rho": rho}
        return plan.run(n1=n, filter="diagonal", **values).stokes

    at = (1.12, 2.16, 0.8, 0.5)
    slopes = jax.jacobian(stokes, argnums=(0, 1, 2, 3))(*at)
    for place, slope in enumerate(slopes):
        up, down = list(at), list(at)
        up[place] += 1e-6
        down[place] -= 1e-6
        expected = (stokes(*up) - stokes(*down)) / 2e-6
        np.testing.assert_allclose(slope, expected, atol=3e-7)


def test_a_path_can_be_built_of_what_is_not_known_yet():
    def intensity(n):
        path = op.load_preset("npgr026", n1=n, **METAL)
        return path.trace().stokes[0]

    expected = jax.grad(lambda n: op.load_preset("npgr026").trace(n1=n, **METAL).stokes[0])(1.12)
    np.testing.assert_allclose(jax.grad(intensity)(1.12), expected, rtol=1e-14)
    np.testing.assert_allclose(jax.jit(intensity)(1.12), intensity(1.12), rtol=1e-14)


def test_normal_incidence_has_the_slope_of_the_closed_form():
    path = op.load_preset("npgr026", delta=0.0, phi=0.0, n2=1.5)
    # R = ((n - 1) / (n + 1))^2, so dR/dn = 4 (n - 1) / (n + 1)^3.
    slope = jax.grad(lambda n: path.trace(n1=n).stokes[0])(1.5)
    np.testing.assert_allclose(slope, 100 * 0.04 * 4 * 0.5 / 2.5**3, rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "value"), [("k1", 0.0), ("delta", 0.0), ("phi", np.arctan(1.5)), ("rho", 0.0)]
)
def test_where_methods_fail_slopes_are_finite(name, value):
    path = op.load_preset("npgr026")
    slope = jax.jacobian(lambda x: path.trace(**{name: x}).stokes)(value)
    assert np.all(np.isfinite(slope))


def test_lights_can_be_looked_at_while_they_are_traced():
    path = op.load_preset("npgr026")
    dop = jax.jit(lambda n: path.trace(**METAL, n1=n).dop)(1.12)
    np.testing.assert_allclose(dop, path.trace(**METAL, n1=1.12).dop, rtol=1e-14)
    many = jax.vmap(lambda n: path.trace(**METAL, n1=n).intensity)(jnp.array([1.1, 1.2]))
    assert many.shape == (2,)


def test_values_of_jax_are_refused_by_other_engines():
    plan = op.Composer(engine="numpy").compose(op.load_preset("npgr026"))
    with pytest.raises(op.ParameterError, match="engine='jax'"):
        plan.run(n1=jnp.array(1.5))


def test_slopes_in_single_precision_are_not_taken_for_double():
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto
    path = op.load_preset("npgr026")
    with pytest.raises(op.ComposerError, match="jax_enable_x64"):
        jax.grad(lambda n: path.trace(n1=n).stokes[0])(1.5)
    assert path.trace(n1=1.5).stokes.dtype == np.float64


def test_known_values_are_checked_as_by_other_engines():
    plan = op.Composer(engine="jax").compose(op.load_preset("npgr026"))
    with pytest.raises(op.ParameterError, match="outside its range"):
        plan.run(delta=7.0)


def test_longdouble_is_refused():
    with pytest.raises(op.ComposerError, match="longdouble"):
        op.Composer(engine="jax", dtype="longdouble")
