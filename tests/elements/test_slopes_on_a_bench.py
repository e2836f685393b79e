"""Slopes of what stands on a bench, against closed forms."""

import mpmath
import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

jax = pytest.importorskip("jax")

A, B, C = (op.Parameter(name) for name in "abc")


@pytest.fixture(autouse=True)
def _double():
    jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - as JAX has it
    yield
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto


def test_slopes_of_a_faraday_rotator_are_those_of_the_product():
    path = chain([op.FaradayRotator(verdet=A, field=B, length=C)], (1.0, 1.0, 0.0, 0.0))
    slope = jax.grad(lambda v: path.trace(a=v[0], b=v[1], c=v[2]).S2)(np.array([-134.0, 0.1, 0.02]))
    expected = 2 * np.cos(2 * -134.0 * 0.1 * 0.02) * np.array([0.002, -134.0 * 0.02, -13.4])
    np.testing.assert_allclose(slope, expected, rtol=1e-14)


@rows("order", [0.0, 0.25, 0.5, 10.25, 2000.37])
def test_slopes_of_a_plate_are_those_of_its_retardance(order):
    path = chain([op.Waveplate(A, B, C)], (1.0, 0.0, 1.0, 0.0))
    given = np.array([order * 1e-6 / 0.01, 0.01, 1e-6])
    slope = jax.jacobian(lambda v: path.trace(a=v[0], b=v[1], c=v[2]).stokes)(given)
    with mpmath.workdps(50):
        d, n, w = map(mpmath.mpf, given.tolist())
        angle = 2 * mpmath.pi * d * n / w
        rates = np.array([float(2 * mpmath.pi * r) for r in (n / w, d / w, -d * n / w**2)])
        cos, sin = float(mpmath.cos(angle)), float(mpmath.sin(angle))
    # S2 is the cosine, and S3 the sine.
    expected = np.outer([0.0, 0.0, -sin, cos], rates)
    scale = np.abs(rates).max(where=rates != 0.0, initial=1.0)
    np.testing.assert_allclose(slope / scale, expected / scale, rtol=1e-12, atol=1e-15)


def test_slopes_of_a_circular_polariser_are_finite_where_nothing_leaks():
    path = chain([op.CircularPolarizer("right", A, B)], (1.0, 0.3, 0.0, 0.5))
    slope = jax.jacobian(lambda v: path.trace(a=v[0], b=v[1]).stokes)(np.array([1.0, 0.0]))
    np.testing.assert_allclose(slope[0], [0.75, 0.25], rtol=0, atol=1e-15)
    assert np.isfinite(slope).all()


def of_a_cube(port):
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=(1.0, 0.3, 0.5, 0.6)))
    path["lamp"] >> path.add("cube", op.PolarizingBeamSplitter(A, B))
    path.add("eye", op.Detector())
    path.connect(f"cube.{port}", "eye.in")
    return jax.jacobian(lambda v: path.trace(a=v[0], b=v[1]).stokes)


@rows("port", ["transmitted", "reflected"])
@rows("ratios", [(1.000001, 1.000001), (1e30, 1e30), (2.0, 1e6)])
def test_slopes_of_a_polarising_splitter_are_finite_at_every_ratio(port, ratios):
    assert np.isfinite(of_a_cube(port)(np.array(ratios))).all()


def test_slopes_of_a_polarising_splitter_are_those_of_its_transmittances():
    # With an ideal reflection Ts is 1 / t, and Tp is 1: C is t^(-1/2).
    slope = of_a_cube("transmitted")(np.array([10.0, 1e30]))[:, 0]
    across = -0.5 * 10.0**-1.5
    expected = [-0.65 / 100, -0.65 / 100, across * 0.5, across * 0.6]
    np.testing.assert_allclose(slope, expected, rtol=1e-13)
