"""Single amplitudes, against Maxwell's boundary conditions in 60 digits."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import optipath as op
from tables import rows

INDICES = st.floats(0.1, 5.0)
EXTINCTIONS = st.one_of(st.just(0.0), st.floats(-14.0, 1.0).map(lambda x: 10.0**x))
ANGLES = st.floats(0.0, math.pi / 2).map(lambda t: (math.cos(t), math.sin(t)))
NEAR = st.floats(-12.0, -1.0).map(lambda x: 10.0**x)
NORMAL = NEAR.map(lambda s: (math.sqrt((1.0 - s) * (1.0 + s)), s))
GRAZING = NORMAL.map(lambda pair: pair[::-1])


def forward(g):
    return -g if g.imag < 0 or (g.imag == 0 and g.real < 0) else g


def waves(m, c, s, outside=1.0):
    """m1, m2, y, g1 and g2, of a cosine and a sine that are brought to the length 1."""
    m1, m2 = mpmath.mpc(outside), mpmath.mpc(m)
    c, s = mpmath.mpf(c), mpmath.mpf(s)
    c, s = (part / mpmath.sqrt(c * c + s * s) for part in (c, s))
    n1, k1 = m1.real, m1.imag
    if k1:
        contrast = n1 * n1 - k1 * k1
        root = mpmath.sqrt(contrast**2 + (2 * n1 * k1 / c) ** 2)
        y = mpmath.sqrt((contrast + root) / 2) * s
        g1 = forward(mpmath.sqrt(m1 * m1 - y * y))
    else:
        y, g1 = n1 * s, mpmath.mpc(n1 * c)
    return m1, m2, y, g1, forward(mpmath.sqrt(m2 * m2 - y * y))


def by_fields(m, c, s, outside=1.0):
    """The four amplitudes for which E and H along the face are the same on both sides."""
    m1, m2, _, g1, g2 = waves(m, c, s, outside)
    c1, c2 = g1 / m1, g2 / m2
    # Along s: 1 + r = t, g1 (1 - r) = g2 t. Along p: c1 (1 - r) = c2 t, m1 (1 + r) = m2 t.
    r_s, t_s = mpmath.lu_solve(mpmath.matrix([[-1, 1], [g1, g2]]), mpmath.matrix([1, g1]))
    r_p, t_p = mpmath.lu_solve(mpmath.matrix([[c1, c2], [-m1, m2]]), mpmath.matrix([c1, m1]))
    return [r_s, r_p, t_s, t_p]


def units_off(given):
    """How far each is off, over 2^-53 of it and what that of the numbers given makes."""
    with mpmath.workdps(60):
        exact = by_fields(*given)
        allowed = [abs(number) for number in exact]
        for place, number in enumerate(given):
            for part in (1, 1j):
                step = (mpmath.mpc(number).real if part == 1 else mpmath.mpc(number).imag) * part
                if step == 0:
                    continue
                moved = list(given)
                moved[place] = mpmath.mpmathify(number) + step * mpmath.mpf(2) ** -53
                # Each rounding of what is given may move the result by as much.
                moves = zip(by_fields(*moved), exact, strict=True)
                allowed = [a + abs(x - y) * 2**53 for a, (x, y) in zip(allowed, moves, strict=True)]
        found = op.fresnel_amplitudes(*given)
        return [
            float(abs(mpmath.mpc(complex(number)) - one) * 2**53 / size) if size else 0.0
            for number, one, size in zip(found, exact, allowed, strict=True)
        ]


@given(n=INDICES, k=EXTINCTIONS, angle=st.one_of(ANGLES, NORMAL, GRAZING))
def test_amplitudes_have_all_digits_that_the_numbers_given_allow(n, k, angle):
    assume(not (k == 0.0 and abs(angle[1] - n) < 1e-9))
    assert max(units_off((complex(n, k), *angle))) <= 16.0


@given(contrast=st.floats(-15.0, -1.0), sign=st.sampled_from([-1, 1]), k=EXTINCTIONS, angle=ANGLES)
def test_amplitudes_of_nearly_equal_media_have_all_digits(contrast, sign, k, angle):
    n = 1.5 * (1.0 + sign * 10.0**contrast)
    assume(n != 1.5 and angle[0] > 1e-6)
    assume(k > 0.0 or abs(1.5 * angle[1] - n) > 1e-9)
    assert max(units_off((complex(n, k), *angle, 1.5))) <= 16.0


@given(n=INDICES, k=EXTINCTIONS, n1=INDICES, share=st.floats(-14.0, -0.2), angle=ANGLES | NORMAL)
def test_amplitudes_out_of_an_absorbing_medium_have_all_digits(n, k, n1, share, angle):
    outside = complex(n1, n1 * 10.0**share)
    assume(angle[0] > 1e-6)
    *_, g1, g2 = waves(complex(n, k), *angle, outside)
    assume(g1.real > g1.imag and abs(g2) > 1e-3)
    assert max(units_off((complex(n, k), *angle, outside))) <= 16.0


@rows(
    "given, worst",
    [
        ((5.717117667348051 + 3.37069957e-8j, 0.002373893039514527, 0.9999971823119488, 0.57), 8.0),
        ((0.1 + 1.0759455e-7j, 0.9999999999298715, 1.1843000608717061e-05, 2.13), 11.0),
        (
            (
                *(0.4385014911987668 + 7.665294999319383e-06j, 1.1056503059421287e-05),
                *(0.9999999999388768, 0.3433323580527496 + 1.2061656076512248e-14j),
            ),
            13.0,
        ),
    ],
)
def test_the_worst_that_climbing_found_is_a_few_units(given, worst):
    assert max(units_off(given)) <= worst


@given(n=INDICES, k=EXTINCTIONS, angle=ANGLES)
def test_powers_and_phases_follow_from_amplitudes(n, k, angle):
    m, (c, s) = complex(n, k), angle
    assume(c > 1e-6)
    r_s, r_p, t_s, t_p = op.fresnel_amplitudes(m, c, s)
    A, B, C, S = op.fresnel_reflection(m, c, s)
    np.testing.assert_allclose(abs(r_s) ** 2, A + B, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(abs(r_p) ** 2, A - B, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(r_s * np.conj(r_p), C + 1j * S, rtol=1e-13, atol=1e-15)
    g = np.sqrt(m * m - s * s + 0j)
    g = -g if g.imag < 0.0 else g
    T_s, T_p = abs(t_s) ** 2 * g.real / c, abs(t_p) ** 2 * (m * np.conj(g / m)).real / c
    A, B, C, S = op.fresnel_transmission(m, c, s)
    # Next to a critical angle the root of here loses digits.
    assume(abs(g) > 1e-3)
    np.testing.assert_allclose([T_s, T_p], [A + B, A - B], rtol=1e-9, atol=1e-12)
    if T_s * T_p > 0.0:
        both = t_s * np.conj(t_p) / abs(t_s * t_p) * math.sqrt(T_s * T_p)
        np.testing.assert_allclose(both, C + 1j * S, rtol=1e-9, atol=1e-9)


def test_amplitudes_at_the_ends_of_all_angles_and_of_equal_media_are_those_of_the_books():
    indices = np.array([1.5, 0.6, 0.608 + 2.12j])
    normal, grazing = (op.fresnel_amplitudes(indices, *angle) for angle in ((1, 0), (0, 1)))
    assert np.array_equal(normal.r_p, -normal.r_s)
    assert np.array_equal(normal.t_p, normal.t_s)
    np.testing.assert_allclose([grazing.r_s, grazing.r_p], -1.0, rtol=1e-15)
    assert not np.any([grazing.t_s, grazing.t_p])
    r_s, r_p, t_s, t_p = op.fresnel_amplitudes(1.0, 0.6, 0.8, outside=1.5)
    assert abs(r_s) == pytest.approx(1.0, rel=1e-15) == abs(r_p)
    # Fresnel's rhomb: tan(delta / 2) = cos sqrt(sin^2 - 1/n^2) / sin^2 (Born & Wolf, 1.5.4).
    delta = np.angle(r_p / r_s)
    assert abs(math.tan(delta / 2)) == pytest.approx(0.6 * math.sqrt(0.64 - 1 / 2.25) / 0.64)
    assert t_s == pytest.approx(1.0 + r_s)
    assert abs(t_p) > 1.0
    for angle in ((1.0, 0.0), (0.8, 0.6), (0.0, 1.0)):
        found = op.fresnel_amplitudes(1.5, *angle, outside=1.5)
        np.testing.assert_allclose(found, (0.0, 0.0, 1.0, 1.0), rtol=4e-16)


def test_a_boundary_is_met_from_either_side_by_stokes_relations():
    """r' = -r and t t' = 1 - r^2 (Stokes, 1849), which hold of complex amplitudes as well."""
    into = op.fresnel_amplitudes(1.6, 0.8, 0.6, outside=1.2)
    s = 1.2 * 0.6 / 1.6
    out = op.fresnel_amplitudes(1.2, math.sqrt(1.0 - s * s), s, outside=1.6)
    np.testing.assert_allclose([out.r_s, out.r_p], [-into.r_s, -into.r_p], rtol=1e-14)
    np.testing.assert_allclose(out.t_s * into.t_s, 1.0 - into.r_s**2, rtol=1e-14)
    np.testing.assert_allclose(out.t_p * into.t_p, 1.0 - into.r_p**2, rtol=1e-14)


def test_slopes_are_those_of_50_digits_and_what_is_not_allowed_is_nan_where_it_is_traced(jax):
    jnp = jax.numpy
    reflected = jax.jit(lambda m, c: op.fresnel_amplitudes(m, c, 0.6).r_s)
    traced = [reflected(*given) for given in ((1.5, 0.8), (-1.5, 0.8), (1.5, 0.7))]
    assert np.isfinite(traced).tolist() == [True, False, False]

    def found(n, k, angle, n1):
        c, s = jnp.cos(angle), jnp.sin(angle)
        return op.fresnel_amplitudes(n + 1j * k, c, s, outside=n1)

    slopes_of = jax.jit(lambda at, along: jax.jvp(found, at, along)[1])
    for at in [(1.5, 0.0, 0.7, 1.0), (0.608, 2.12, 1.2, 1.3), (1.0, 0.0, 0.9, 1.5)]:
        with mpmath.workdps(60):
            step = mpmath.mpf(10) ** -25

            def exact(n, k, angle, n1):
                return by_fields(mpmath.mpc(n, k), mpmath.cos(angle), mpmath.sin(angle), n1)

            for place in range(4):
                moved = list(map(mpmath.mpf, at))
                moved[place] += step
                both = zip(exact(*moved), exact(*map(mpmath.mpf, at)), strict=True)
                expected = [complex((x - y) / step) for x, y in both]
                along = tuple(jnp.float64(part == place) for part in range(4))
                there = slopes_of(tuple(map(jnp.float64, at)), along)
                np.testing.assert_allclose(there, expected, rtol=1e-12, atol=1e-13)


@rows(
    "given, fault",
    [
        ((1.5 - 0.1j, 1.0, 0.0), r"index is \(1.5-0.1j\); .*k not negative"),
        ((1.5, 0.5, 0.5), "belong to no angle"),
        ((1.5, 0.0, 1.0, 1.0 + 0.1j), "right angle out of a medium that absorbs"),
        ((1.5, 1.0, 0.0, 0.0), "outside is 0.0; .* n above 0"),
        ((np.ones(2), np.ones(3), np.zeros(3)), r"index \(2,\), .*incidence \(3,\)"),
    ],
)
def test_what_no_boundary_has_is_refused_in_words(given, fault):
    with pytest.raises((op.errors.ValueFault, op.errors.ShapeError), match=fault):
        op.fresnel_amplitudes(*given)
