"""The index of an absorbing medium at an angle, and the direction of the ray that follows."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import optipath as op
from tables import rows

INDICES = st.floats(0.1, 5.0)
EXTINCTIONS = st.one_of(st.just(0.0), st.floats(-300.0, 1.0).map(lambda x: 10.0**x))
NEAR = st.floats(-12.0, 0.0).map(lambda x: 10.0**x)
ANGLES = st.one_of(
    NEAR.map(lambda s: op.CosSin(math.sqrt((1.0 - s) * (1.0 + s)), s)),
    NEAR.map(lambda c: op.CosSin(c, math.sqrt((1.0 - c) * (1.0 + c)))),
)
OFF = 2.0**-53


def exact(n, k, c, s, n1=1.0):
    """n' and k' of the two lengths of the complex wave vector (y, g), with g^2 = m^2 - y^2."""
    n, k, c, s, n1 = map(mpmath.mpf, (n, k, c, s, n1))
    y = n1 * s / mpmath.sqrt(c * c + s * s)
    g = mpmath.sqrt(mpmath.mpc(n, k) ** 2 - y * y)
    return mpmath.sqrt(y * y + g.real**2), abs(g.imag)


@given(n=INDICES, k=EXTINCTIONS, angle=ANGLES, n1=INDICES)
def test_the_index_has_all_digits_that_the_numbers_given_allow(n, k, angle, n1):
    given = n, k, float(angle.cos), float(angle.sin), n1
    found = op.effective_index(complex(n, k), angle, outside=n1)
    with mpmath.workdps(400):
        expected = exact(*given)
        allowed = list(expected)
        for place in range(5):
            moved = [mpmath.mpf(number) for number in given]
            moved[place] *= 1 + mpmath.mpf(OFF)
            pairs = zip(exact(*moved), expected, strict=True)
            allowed = [a + abs(x - y) / OFF for a, (x, y) in zip(allowed, pairs, strict=True)]
        for one, other, size in zip(found, expected, allowed, strict=True):
            assert abs(float(one) - other) <= 12 * OFF * size


@given(n=INDICES, k=EXTINCTIONS, angle=ANGLES, n1=st.floats(0.1, 1.0))
def test_the_invariants_of_ketteler_hold(n, k, angle, n1):
    at = op.effective_index(complex(n, k), angle, outside=n1)
    refracted = op.refraction_angle(complex(n, k), angle, outside=n1)
    size = n * n + k * k
    assert abs((at.n**2 - at.k**2) - (n * n - k * k)) <= 1e-14 * (size + at.n**2)
    assert abs(at.n * np.sin(refracted) - n1 * float(angle.sin)) <= 1e-14 * (at.n + n1)
    assert abs(at.n * at.k * np.cos(refracted) - n * k) <= 1e-13 * (size + at.n * at.k)


def test_waves_are_plain_at_normal_incidence_and_creep_behind_total_reflection():
    n, k = op.effective_index(np.array([1.5, 0.608 + 2.12j, 0.05 + 12j]), 0.0)
    np.testing.assert_allclose(n, [1.5, 0.608, 0.05], rtol=1e-15)
    np.testing.assert_allclose(k, [0.0, 2.12, 12.0], rtol=1e-15)
    n, k = op.effective_index(1.0, "60 deg", outside=1.5)
    y = 1.5 * math.sin(math.pi / 3)
    assert n == pytest.approx(y, rel=1e-15)
    assert k == pytest.approx(math.sqrt(y * y - 1.0), rel=1e-14)
    first = op.refraction_angle(1.5 + 0.4j, 0.7)
    straight = op.effective_index(0.6 + 2.1j, 0.7)
    through = op.effective_index(0.6 + 2.1j, first, outside=1.5 + 0.4j)
    np.testing.assert_allclose(through, straight, rtol=1e-14)


def test_slopes_are_those_of_50_digits(jax):
    jnp = jax.numpy

    def found(n, k, angle):
        return op.effective_index(op.Material(n, k), angle)

    slopes_of = jax.jit(lambda at, along: jax.jvp(found, at, along)[1])
    for at in [(1.5, 0.0, 0.7), (0.608, 2.12, 1.2), (0.5, 1e-9, 0.3)]:
        with mpmath.workdps(60):
            step = mpmath.mpf(10) ** -25

            def of(n, k, t):
                return exact(n, k, mpmath.cos(t), mpmath.sin(t))

            for place in range(3):
                moved = list(map(mpmath.mpf, at))
                moved[place] += step
                both = zip(of(*moved), of(*map(mpmath.mpf, at)), strict=True)
                expected = [float((x - y) / step) for x, y in both]
                along = tuple(jnp.float64(part == place) for part in range(3))
                there = slopes_of(tuple(map(jnp.float64, at)), along)
                np.testing.assert_allclose(there, expected, rtol=1e-12, atol=1e-13)


@rows("asked", [op.effective_index, op.refraction_angle])
def test_no_light_arrives_at_a_right_angle_out_of_a_medium_that_absorbs(asked):
    with pytest.raises(op.errors.ValueFault, match="right angle out of a medium that absorbs"):
        asked(1.5, "90 deg", outside=1.5 + 0.1j)
    assert np.all(np.isfinite(asked(1.5, "90 deg", outside=1.2)))


@rows("m", [1.5, 4.2 + 0.04j, 0.7 + 2.03j, 0.9 + 6.2j])
def test_the_ray_by_subtraction_has_length_1_and_the_parts_of_the_wave(m):
    n, _ = op.effective_index(m, 0.9, outside=1.2)
    y, behind = 1.2 * math.sin(0.9), op.refraction_angle(m, 0.9, outside=1.2)
    ray = np.array([y / n, np.cos(behind)])
    assert np.linalg.norm(ray) == pytest.approx(1.0, rel=1e-14)
    np.testing.assert_allclose(n * ray, [y, np.sqrt(m * m - y * y + 0j).real], rtol=1e-14)


@given(n=INDICES, k=st.floats(0.0, 1e-3) | st.floats(1e-3, 10.0), angle=st.floats(0.01, 1.57))
def test_the_real_angle_of_refraction_is_that_of_planes_of_constant_phase(n, k, angle):
    assume(k > 0.0 or n > 1.0001 * math.sin(angle))
    with mpmath.workdps(50):
        s = mpmath.mpf(math.sin(angle))
        expected = mpmath.atan2(s, abs(mpmath.sqrt(mpmath.mpc(n, k) ** 2 - s * s).real))
    found = op.refraction_angle(complex(n, k), op.CosSin(math.cos(angle), math.sin(angle)))
    tolerance = {"rel": 1e-13} if k >= 1e-3 else {"abs": 1e-10}
    assert float(found) == pytest.approx(float(expected), **tolerance)
