"""The index of an absorbing medium at an angle, and the direction of the ray that follows."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
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
    with pytest.raises(op.ValueFault, match="right angle out of a medium that absorbs"):
        asked(1.5, "90 deg", outside=1.5 + 0.1j)
    assert np.all(np.isfinite(asked(1.5, "90 deg", outside=1.2)))


def refracted_by_subtraction(direction, normal, ratio, cos):
    """The part of a direction along the face, scaled, less the normal times a cosine."""
    along = direction - np.dot(direction, normal) * normal
    return ratio * along - cos * normal


DIRECTION = np.array([math.sin(0.9), 0.0, -math.cos(0.9)])
NORMAL = np.array([0.0, 0.0, 1.0])


@rows("m", [1.5, 4.2 + 0.04j, 0.7 + 2.03j, 0.9 + 6.2j])
def test_the_ray_by_subtraction_has_length_1_and_keeps_the_wave_along_the_face(m):
    n, _ = op.effective_index(m, 0.9, outside=1.2)
    cos = np.cos(op.refraction_angle(m, 0.9, outside=1.2))
    ray = refracted_by_subtraction(DIRECTION, NORMAL, 1.2 / n, cos)
    assert np.linalg.norm(ray) == pytest.approx(1.0, rel=1e-14)
    np.testing.assert_allclose(np.cross(NORMAL, n * ray), np.cross(NORMAL, 1.2 * DIRECTION))


@rows("m", [0.7 + 2.03j, 0.9 + 6.2j])
def test_no_ray_follows_from_the_complex_angle_nor_from_n_alone(m):
    sin = math.sin(0.9)
    cos = np.sqrt(1.0 - (sin / m) ** 2 + 0j)
    for ratio, cosine in ((1.0 / m, cos), (1.0 / m, cos.real), (1.0 / m.real, cos.real)):
        ray = refracted_by_subtraction(DIRECTION, NORMAL, ratio, cosine)
        assert abs(np.linalg.norm(ray) - 1.0) > 0.01


def test_the_field_behind_lags_as_the_phase_of_t_says():
    """The field at a depth is t exp(i g depth): its phase goes on by n' along the real ray."""
    m, incidence, wavelength = 0.7 + 2.03j, 0.9, 500e-9
    n, k = op.effective_index(m, incidence)
    theta = op.refraction_angle(m, incidence)
    t_s = op.fresnel_amplitudes(m, math.cos(incidence), math.sin(incidence)).t_s
    depth, wave = 10e-9, 2.0 * math.pi / wavelength
    g = np.sqrt(m * m - math.sin(incidence) ** 2)
    field = t_s * np.exp(1j * wave * g * depth)
    assert abs(field) == pytest.approx(abs(t_s) * math.exp(-wave * k * depth))
    # Along the ray to that depth, the phase along the face is counted, too.
    way = depth / math.cos(theta)
    along_face = wave * math.sin(incidence) * depth * math.tan(theta)
    assert np.angle(field) + along_face == pytest.approx(np.angle(t_s) + wave * n * way)


@given(n=INDICES, k=st.floats(1e-3, 10.0), angle=st.floats(0.01, 1.57))
def test_of_three_printed_formulas_of_the_angle_two_are_that_of_the_wave_and_one_is_none(
    n, k, angle
):
    with mpmath.workdps(50):
        n, k, s = map(mpmath.mpf, (n, k, math.sin(angle)))
        contrast = n * n - k * k
        R = mpmath.sqrt((contrast - s * s) ** 2 + 4 * n * n * k * k)
        by_wave = mpmath.atan(s / mpmath.sqrt((R + contrast - s * s) / 2))
        by_snell = mpmath.asin(s / mpmath.sqrt((contrast + s * s + R) / 2))
        other_root = (contrast + s * s - R) / 2
        assert abs(by_wave - by_snell) < mpmath.mpf(10) ** -40
        assert other_root < s * s
        found = op.refraction_angle(complex(n, k), op.CosSin(math.cos(angle), math.sin(angle)))
        assert float(found) == pytest.approx(float(by_wave), rel=1e-13)


@rows("m", [1.5, 0.7 + 2.03j])
def test_the_real_wave_vector_has_the_parts_of_the_wave_and_by_the_other_root_it_has_not(m):
    n, k, s = complex(m).real, complex(m).imag, math.sin(0.9)
    g = np.sqrt(m * m - s * s + 0j)
    at, angle = op.effective_index(m, 0.9), op.refraction_angle(m, 0.9)
    ray = refracted_by_subtraction(DIRECTION, NORMAL, 1.0 / at.n, np.cos(angle))
    np.testing.assert_allclose(at.n * ray, [s, 0.0, -g.real], rtol=1e-14)
    root = math.sqrt((n * n - k * k - s * s) ** 2 + 4 * n * n * k * k)
    with np.errstate(invalid="ignore"):
        other = np.sqrt((n * n - k * k + s * s - root) / 2)
        sin = np.minimum(s / other, 1.0)
    # In glass it lies along the face; in a metal there is none.
    assert (sin == pytest.approx(1.0)) if k == 0.0 else np.isnan(sin)
