"""What a Stokes vector says of its ellipse, against the field and the handbook."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from light_figures import STATE as FIGURES
from tables import rows

PHASES = st.floats(-3.1, 3.1)
SIZES = st.floats(1e-3, 1e3)

NONE = np.nan
# Stokes vector; aop, ellipticity, handedness, psi, delta.
HANDBOOK = {
    "horizontal": ([1, 1, 0, 0], 0.0, 0.0, 0, 0.0, NONE),
    "vertical": ([1, -1, 0, 0], np.pi / 2, 0.0, 0, np.pi / 2, NONE),
    "diagonal": ([1, 0, 1, 0], np.pi / 4, 0.0, 0, np.pi / 4, 0.0),
    "antidiagonal": ([1, 0, -1, 0], -np.pi / 4, 0.0, 0, np.pi / 4, np.pi),
    "right-handed": ([1, 0, 0, 1], NONE, 1.0, 1, np.pi / 4, -np.pi / 2),
    "left-handed": ([1, 0, 0, -1], NONE, -1.0, -1, np.pi / 4, np.pi / 2),
    "unpolarised": ([1, 0, 0, 0], NONE, NONE, 0, NONE, NONE),
    "dark": ([0, 0, 0, 0], NONE, NONE, 0, NONE, NONE),
}


def stokes_of_jones(ex, ey):
    across = np.conj(ex) * ey
    powers = abs(ex) ** 2, abs(ey) ** 2
    parts = sum(powers), powers[0] - powers[1], 2 * across.real, 2 * across.imag
    return np.stack(np.broadcast_arrays(*parts), axis=-1)


@rows("name", HANDBOOK)
@rows("size", [1.0, 2.0**-1000])
@rows("zero", [0.0, -0.0])
def test_states_of_the_handbook_come_out(name, size, zero):
    stokes, *expected = HANDBOOK[name]
    light = op.Light([size * float(s) if s else zero for s in stokes])
    found = light.aop, light.ellipticity, light.handedness, light.psi, light.delta
    np.testing.assert_allclose(found, expected, rtol=1e-15, atol=0)
    assert light.ellipticity_angle == pytest.approx(np.arctan(expected[1]), abs=1e-16, nan_ok=True)
    assert light.handedness.dtype.kind == "i"


@given(psi=st.floats(0.01, 1.56), delta=PHASES)
def test_psi_and_delta_are_those_of_the_field(psi, delta):
    # exp(-i w t) here, exp(+i w t) in ellipsometry: the conjugate.
    light = op.Light(stokes_of_jones(np.cos(psi), np.sin(psi) * np.exp(-1j * delta)))
    assert light.psi == pytest.approx(psi, abs=1e-14)
    assert light.delta == pytest.approx(delta, abs=1e-13)


@given(a=SIZES, ratio=st.floats(-1.0, 1.0), turn=st.floats(-1.5, 1.5))
def test_the_ellipse_is_that_which_the_field_draws(a, ratio, turn):
    # An ellipse along x' that turns from x' to y' where the ratio is positive.
    along, across = a, 1j * ratio * a
    c, s = np.cos(turn), np.sin(turn)
    light = op.Light(stokes_of_jones(c * along - s * across, s * along + c * across))
    assert light.ellipticity == pytest.approx(ratio, abs=1e-7)
    if abs(ratio) < 0.99:
        assert light.aop == pytest.approx(turn, abs=1e-12)
        assert light.ellipticity == pytest.approx(ratio, abs=1e-13)


def test_a_hair_of_ellipticity_keeps_its_digits():
    light = op.Light([1.0, 1.0, 0.0, 2e-200])
    for found in (light.ellipticity, light.ellipticity_angle, light.psi):
        assert found == pytest.approx(1e-200, rel=1e-15)
    # Which way it turns is no more than a rounding.
    assert light.handedness == 0
    assert np.isnan(light.delta)


@given(turn=st.floats(-4.0, 4.0))
def test_turning_the_frame_turns_the_axis_and_nothing_else(turn):
    light = op.Light([1.0, 0.4, 0.3, -0.5])
    turned = light.in_frame(op.Frame().turned(turn))
    for name in ("dop", "dolp", "docp", "ellipticity", "handedness"):
        np.testing.assert_allclose(getattr(turned, name), getattr(light, name), rtol=1e-14)
    # Half a turn is none, for an axis.
    assert np.sin(turned.aop - light.aop + turn) == pytest.approx(0.0, abs=1e-14)


def test_what_is_not_read_is_not_known():
    light = op.Light([[1.0, 0.6, 0.3, np.nan], [1.0, np.nan, np.nan, np.nan]])
    np.testing.assert_array_equal(np.isnan([light.aop, light.dolp]), [[False, True]] * 2)
    for name in ("docp", "ellipticity", "ellipticity_angle", "psi", "delta", "dop"):
        assert np.isnan(getattr(light, name)).all(), name
    np.testing.assert_array_equal(light.handedness, 0)


@rows("name", FIGURES)
@rows("batch", [(), (3,), (2, 1, 0)])
def test_each_figure_has_the_shape_of_the_batch(name, batch):
    assert getattr(op.Light(np.ones((*batch, 4)) * [2, 1, 1, 1]), name).shape == batch


def test_jax_gives_what_numpy_gives_and_finite_slopes(jacobian):
    jax = pytest.importorskip("jax")

    def figures(s):
        return {name: getattr(op.Light(s), name) for name in FIGURES}

    def smooth(s):
        return {name: figure for name, figure in figures(s).items() if name != "handedness"}

    both = jacobian(lambda s: (smooth(s), figures(s)), has_aux=True)
    for state, (components, *_) in HANDBOOK.items():
        stokes = np.array(components, np.float32)
        sloping, found = both(jax.numpy.array(stokes))
        for name, expected in figures(stokes).items():
            np.testing.assert_allclose(found[name], expected, rtol=1e-6, err_msg=f"{state} {name}")
        for name, slope in sloping.items():
            assert np.isfinite(slope).all(), (state, name)
        # What has no axis has no slope of it.
        assert np.isnan(found["aop"]) == (not sloping["aop"].any())
    slope = both(np.array([1.0, 1.0, 0.0, 0.0]))[0]["aop"]
    np.testing.assert_allclose(slope, [0.0, 0.0, 0.5, 0.0], rtol=0, atol=1e-7)
