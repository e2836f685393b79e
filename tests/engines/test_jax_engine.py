"""Gradients by JAX, against differences and closed forms; needs the extra [jax]."""

import numpy as np
import pytest

import optipath as op
from optipath.lab.bench import random_values
from paths import chain
from slabs import slab
from tables import slow, slow_except

jax = pytest.importorskip("jax")
jnp = jax.numpy

pytestmark = pytest.mark.usefixtures("jax_once")
METAL = {"k1": 2.16, "n2": 0.608, "k2": 2.12, "delta": 0.8, "rho": 0.5, "phi": 0.4}


# JAX takes long to compile a pile of plates, which is what a window is many times.
PRESETS = {*op.preset_names()} - {"pile-of-plates", "absorbing-pile"}
# Light that goes round, or through a stack, has no one Jones vector; others have no Jones matrix.
NO_MATRIX = {"dichroic-sheet", "ellipsometer-rough"}
WITH_JONES = PRESETS - {"glass-slab", "coated-metal", "sky-and-window"} - NO_MATRIX
# Each is compiled for seconds.
QUICK = [("npgr026", "jones"), ("malus", "stokes")]


EVERY = [(n, "stokes") for n in sorted(PRESETS)] + [(n, "jones") for n in sorted(WITH_JONES)]


@pytest.mark.parametrize(("name", "composing"), slow_except(QUICK, EVERY))
def test_every_preset_gives_what_numpy_gives(name, composing):
    path = op.load_preset(name)
    composers = [op.Composer(engine=engine, composing=composing) for engine in ("numpy", "jax")]
    plans = [composer.compose(path) for composer in composers]
    given = random_values(plans[0], 20)
    for expected, found in zip(*(plan.run_all(**given).values() for plan in plans), strict=True):
        scale = np.nanmax(np.abs(expected.stokes))
        np.testing.assert_allclose(found.stokes, expected.stokes, rtol=0, atol=4e-15 * scale)
        assert found.stokes.dtype == np.float64
    if len(plans[0].program.detectors) == len(plans[0].program.sources) == 1:
        numpy_matrix, jax_matrix = (plan.mueller(**given).matrix for plan in plans)
        np.testing.assert_allclose(jax_matrix, numpy_matrix, rtol=0, atol=4e-15)


@pytest.mark.slow
@pytest.mark.parametrize("method", ["compensated", "stable", "amplitude", "textbook"])
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
        np.testing.assert_allclose(slope, expected, rtol=0, atol=3e-7)


def test_a_path_can_be_built_of_what_is_not_known_yet_and_lights_looked_at_meanwhile():
    path = op.load_preset("npgr026")

    def built(n):
        return op.load_preset("npgr026", n1=n, **METAL).trace().stokes[0]

    expected = jax.grad(lambda n: path.trace(n1=n, **METAL).stokes[0])(1.12)
    np.testing.assert_allclose(jax.grad(built)(1.12), expected, rtol=1e-14)
    np.testing.assert_allclose(jax.jit(built)(1.12), built(1.12), rtol=1e-14)
    dop = jax.jit(lambda n: path.trace(**METAL, n1=n).dop)(1.12)
    np.testing.assert_allclose(dop, path.trace(**METAL, n1=1.12).dop, rtol=1e-14)
    many = jax.vmap(lambda n: path.trace(**METAL, n1=n).intensity)(jnp.array([1.1, 1.2]))
    assert many.shape == (2,)


def test_slopes_of_faces_loops_and_degrees_are_those_of_closed_forms():
    path = op.load_preset("npgr026", delta=0.0, phi=0.0, n2=1.5)
    # R = ((n - 1) / (n + 1))^2, so dR/dn = 4 (n - 1) / (n + 1)^3.
    slope = jax.jit(jax.grad(lambda n: path.trace(n1=n).stokes[0]))(1.5)
    np.testing.assert_allclose(slope, 100 * 0.04 * 4 * 0.5 / 2.5**3, rtol=1e-12)
    source = op.Source(op.Parameter("i")) >> op.Detector()
    assert jax.grad(lambda i: source.trace(i=i).dop)(1.0) == 0.0
    path = slab(op.Parameter("n"), 0.0)
    # A slab lets 2 n / (n^2 + 1) through, so dT/dn = 2 (1 - n^2) / (n^2 + 1)^2.
    slope = jax.jit(jax.grad(lambda n: path.trace_all(n=n)["T"].intensity))(1.5)
    assert float(slope) == pytest.approx(2 * (1 - 1.5**2) / (1.5**2 + 1) ** 2, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "value"),
    [("delta", 0.0), ("phi", np.arctan(1.5)), slow(("k1", 0.0)), slow(("rho", 0.0))],
)
def test_where_methods_fail_slopes_are_finite(name, value):
    slope = jax.jacobian(lambda x: op.load_preset("npgr026").trace(**{name: x}).stokes)(value)
    assert np.all(np.isfinite(slope))


def test_what_jax_or_others_cannot_take_is_refused():
    path = op.load_preset("npgr026")
    by_numpy, by_jax = (op.Composer(engine=each).compose(path) for each in ("numpy", "jax"))
    for refused, told in (
        (lambda: by_numpy.run(n1=jnp.array(1.5)), "engine='jax'"),
        (lambda: by_jax.run(delta=7.0), "outside its range"),
        (lambda: next(by_jax.stream(10, delta=np.zeros(20))), "keeps a batch whole"),
        (lambda: op.Composer(engine="jax", dtype="longdouble"), "longdouble"),
    ):
        with pytest.raises(op.OptipathError, match=told):
            refused()


def test_slopes_in_single_precision_are_not_taken_for_double():
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto
    path = op.load_preset("npgr026")
    with pytest.raises(op.errors.ComposerError, match="jax_enable_x64"):
        jax.grad(lambda n: path.trace(n1=n).stokes[0])(1.5)
    assert path.trace(n1=1.5).stokes.dtype == np.float64


@pytest.mark.parametrize("transformed", [lambda f: f, slow(jax.grad)])
def test_each_boundary_of_a_stack_stays_a_function_of_its_own_for_xla(transformed):
    # In one piece, XLA took minutes to compile second derivatives of four media.
    pytest.importorskip("jax.experimental.xla_metadata")
    stack = op.LayerStack([1.0, 1.3, op.Parameter("layer"), 0.2 + 3j], 0.5)
    path = chain([stack], reads="intensity")
    text = jax.jit(transformed(lambda n: path.trace(layer=n).intensity)).lower(1.5).as_text()
    # Of three boundaries, what is reflected and what is let through.
    assert text.count('inlineable = "false"') >= 6
