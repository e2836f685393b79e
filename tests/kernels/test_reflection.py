import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import optipath as op
from optipath.kernels.catalog import (
    METHODS,
    REFLECTION,
    REFLECTION_FROM_ABSORBING,
    TRANSMISSION,
)
from optipath.kernels.primitives import FLOAT, NUMPY
from tables import rows, slow_except

INDICES = st.floats(0.1, 5.0)
EXTINCTIONS = st.one_of(st.just(0.0), st.floats(1e-6, 8.0))
ANGLES = st.floats(0.0, np.pi / 2)
STABLE = REFLECTION.by_method("stable")


def by_amplitudes(n, k, c, s):
    """(A, B, C, S) from r_s and r_p in 50 digits, as docs/conventions.md defines them."""
    with mpmath.workdps(50):
        m = mpmath.mpc(n, k)
        norm = mpmath.sqrt(mpmath.mpf(c) ** 2 + mpmath.mpf(s) ** 2)
        c, s = mpmath.mpf(c) / norm, mpmath.mpf(s) / norm
        g = mpmath.sqrt(m * m - s * s)
        g = -g if g.imag < 0 or (g.imag == 0 and g.real < 0) else g
        rs = (c - g) / (c + g)
        rp = (m * m * c - g) / (m * m * c + g)
        fs, fp, cross = abs(rs) ** 2, abs(rp) ** 2, rs * mpmath.conj(rp)
        numbers = ((fs + fp) / 2, (fs - fp) / 2, cross.real, cross.imag)
        return np.array([float(number) for number in numbers])


@given(n=INDICES, k=EXTINCTIONS, angle=ANGLES)
def test_stable_reflection_agrees_with_50_digit_amplitudes(n, k, angle):
    c, s = np.cos(angle), np.sin(angle)
    numbers = np.array(op.fresnel_reflection(complex(n, k), c, s))
    # The rounding of cos and sin is amplified near a critical angle, by the root.
    slack = 1e-7 if k < 1e-3 and abs(s - n) < 1e-6 else 1e-13
    np.testing.assert_allclose(numbers, by_amplitudes(n, k, c, s), rtol=0, atol=slack)


@rows("method", METHODS)
def test_a_metal_and_normal_incidence_on_glass_are_exact_by_every_method_in_its_precision(method):
    numbers = op.fresnel_reflection(0.608 + 2.12j, 0.8, 0.6, method=method)
    np.testing.assert_allclose(numbers, by_amplitudes(0.608, 2.12, 0.8, 0.6), rtol=1e-13)
    numbers = op.fresnel_reflection(1.5, 1.0, 0.0, method)
    np.testing.assert_allclose(numbers, [0.04, 0.0, -0.04, 0.0], rtol=0, atol=1e-16)
    for dtype in ("float32", "float64"):
        for function in (op.fresnel_reflection, op.fresnel_transmission):
            for index in (1.5, [1.5, 0.2 + 3j]):
                found = function(index, 0.8, 0.6, method, dtype)
                assert {number.dtype for number in found} == {np.dtype(dtype)}


@pytest.mark.parametrize("method", slow_except(["stable", "textbook"], METHODS))
@given(n=INDICES, k=EXTINCTIONS, angle=ANGLES)
def test_reflection_never_gives_more_than_it_gets_and_the_rest_is_let_through(method, n, k, angle):
    given_ = (complex(n, k), np.cos(angle), np.sin(angle), method)
    (A, B, C, S), (TA, TB, TC, TS) = (
        function(*given_) for function in (op.fresnel_reflection, op.fresnel_transmission)
    )
    assert 0.0 <= A <= 1.0 + 1e-14
    assert abs(B) <= A
    # A reflection does not depolarise: A^2 = B^2 + C^2 + S^2.
    assert abs(A * A - B * B - C * C - S * S) <= 1e-14
    if angle <= 1.5:
        # The two old methods lose some digits here already.
        slack = 1e-13 if method in {"stable", "compensated"} else 1e-6
        assert pytest.approx((1.0, 0.0), abs=slack) == (A + TA, B + TB)
        assert abs(TC**2 + TS**2 - (TA + TB) * (TA - TB)) <= slack


def test_brewsters_angle_and_total_reflection_are_those_of_the_books():
    # tan(theta) = n: r_s = (1 - n^2) / (1 + n^2), r_p = 0.
    brewster = 1.5, *np.divide((1.0, 1.5), np.hypot(1.0, 1.5))
    A, B, C, _ = op.fresnel_reflection(*brewster)
    assert pytest.approx(0.5 * (1.25 / 3.25) ** 2, rel=1e-15) == A
    assert B == A
    assert abs(C) <= 1e-16
    # Born & Wolf, sec. 1.5.3: T_p = 1, T_s = 1 - (1-n^2)^2/(1+n^2)^2.
    A, B, C, S = op.fresnel_transmission(*brewster)
    Ts = 1 - (1.25 / 3.25) ** 2
    assert pytest.approx((1.0, Ts, np.sqrt(Ts)), abs=1e-15) == (A - B, A + B, C)
    assert S == 0.0
    # Sec. 1.5.4: tan(delta/2) = cos sqrt(sin^2 - n^2) / sin^2.
    angle, n = np.radians(54.6), 1 / 1.5105
    c, s = np.cos(angle), np.sin(angle)
    half = np.arctan(c * np.sqrt(s * s - n * n) / (s * s))
    _, _, C, S = op.fresnel_reflection(n, c, s)
    # arg r_s = -2 atan(b/c) and arg r_p = -2 atan(b/(n^2 c)) with g = i b: r_p is further behind.
    assert np.arctan2(S, C) == pytest.approx(2 * half, abs=1e-14)
    found = op.fresnel_transmission(0.5, [0.6, 0.0], [0.8, 1.0])
    np.testing.assert_array_equal(found, np.zeros((4, 2)))


@given(n=INDICES, k=EXTINCTIONS, outside=st.floats(0.5, 3.0), angle=st.floats(0.0, 1.57))
def test_only_the_ratio_of_the_indices_matters(n, k, outside, angle):
    given_outside = op.Interface(outside * complex(n, k), angle, outside=outside).mueller()
    relative = op.Interface(complex(n, k), angle).mueller()
    slack = 1e-6 if k < 1e-3 and abs(np.sin(angle) - n) < 1e-6 else 1e-12
    np.testing.assert_allclose(given_outside.matrix, relative.matrix, rtol=0, atol=slack)


@rows(
    "arguments, message",
    [
        ((1.5, 1.0, 0.0, "stabel"), "did you mean 'stable'"),
        ((1.5, 1.0, 0.0, "stable", "flaot64"), "'flaot64' is unknown; give 'float64', 'float32'"),
        ((-1.5, 1.0, 0.0), "index is"),
        ((1.5, 0.5, 0.5), "no angle"),
        ((1.5, -1.0, 0.0), "cos_incidence is -1"),
        (("glass", 1.0, 0.0), "'glass' is no number; give n and k"),
        ((np.ones(2), np.ones(3), np.zeros(3)), r"\(2,\).*\(3,\)"),
    ],
)
def test_what_makes_no_reflection_is_refused(arguments, message):
    with pytest.raises(op.OptipathError, match=message):
        op.fresnel_reflection(*arguments)


@rows("method", ["stable", "compensated"])
@rows("family", [REFLECTION, TRANSMISSION])
@given(n=INDICES, outside=st.floats(0.5, 3.0), angle=ANGLES)
def test_the_cheaper_kernel_for_lossless_media_gives_the_same_bits(
    family, method, n, outside, angle
):
    whole = family.by_method(method)
    all_ = (outside, n, 0.0, float(np.cos(angle)), float(np.sin(angle)))
    cheaper, given_ = whole.specialised(all_, lambda number: number == 0.0)
    assert len(given_) == 4
    denser = cheaper.never_less(given_, lambda number: (number, number))
    expected = [*map(float, whole.made_for(FLOAT)(*all_))]
    for kernel in (cheaper, denser):
        assert [*map(float, kernel.made_for(FLOAT)(*given_))] == expected


@given(n=INDICES, k=EXTINCTIONS, outside=st.floats(0.5, 3.0), angle=ANGLES)
def test_plain_floats_give_the_bits_that_numpy_gives_and_powers_alone_are_those(
    n, k, outside, angle
):
    given_ = outside, n, k, float(np.cos(angle)), float(np.sin(angle))
    plain = STABLE.made_for(FLOAT)(*given_)
    assert all(type(number) is float for number in plain)
    assert [*plain] == [*map(float, STABLE.made_for(NUMPY)(*map(np.float64, given_)))]
    Fs, Fp, over = STABLE.powers.made_for(FLOAT)(*given_)
    assert (Fs / over, Fp / over) == pytest.approx(plain[:2], rel=4e-15, abs=4e-15 * Fs / over)


def test_an_index_that_absorbs_nothing_takes_the_cheaper_kernel():
    path = op.Source() >> op.Interface(np.array([1.4, 1.5]), 0.3) >> op.Interface(0.2 + 3j, 0.4)
    program = (path >> op.Detector()).compose().program
    names = {evaluation.kernel.name for evaluation in program.evaluations}
    lossless = "Fresnel reflection (stable, lossless, from the rarer side)"
    assert {lossless, "Fresnel reflection (stable)"} <= names


LOST = (2.1601279950827297, 1.2841725811036993, 0.8035599507794031)
"""n, an index in front that light from n0 = 3 does not get into at an angle, and the angle."""


@rows("k", [0.0, 1e-12, 0.3])
@rows("n", [0.5, LOST[1], LOST[0], 3.0 * np.sin(LOST[2])])
def test_what_was_all_reflected_before_is_all_reflected_by_every_kernel(n, k):
    _, n1, angle = LOST
    given = (3.0, np.cos(angle), np.sin(angle))
    inhomogeneous = REFLECTION_FROM_ABSORBING.methods["stable"]
    kernels = [(STABLE, (n1, n, k)), (inhomogeneous, (n1, 0.0, n, k))]
    if not k:
        cheaper = STABLE.without[1]
        kernels += [(cheaper, (n1, n)), (cheaper.denser[2], (n1, n))]
    for kernel, media in kernels:
        assert kernel.made_for(FLOAT)(*media, *given)[:3] == (1.0, 1.0, 0.0), kernel.name
        Fs, Fp, over = kernel.powers.made_for(FLOAT)(*media, *given)
        assert (Fs / over, Fp / over) == (pytest.approx(1.0, rel=1e-15),) * 2, kernel.name


@given(n0=INDICES, angle=ANGLES, first=st.floats(-1e-12, 1e-12), other=st.floats(-1e-12, 1e-12))
def test_powers_are_never_more_than_all_next_to_where_light_gets_no_further(
    n0, angle, first, other
):
    c, s = np.cos(angle), np.sin(angle)
    assume(s > 0.01)
    n1, n = n0 * s * (1.0 + first), n0 * s * (1.0 + other)
    for family, media in (
        (REFLECTION, (n1, n, 0.0)),
        (REFLECTION_FROM_ABSORBING, (n1, 0.0, n, 0.0)),
    ):
        powers = family.by_method("stable").powers
        Fs, Fp, over = powers.made_for(FLOAT)(*media, n0, c, s)
        assert 0.0 <= Fp <= (1.0 + 1e-15) * Fs
        assert Fs <= (1.0 + 1e-15) * over


@rows("index", [1e-200, 1e-100 + 1e-100j])
def test_an_index_that_vanishes_reflects_everything(index):
    A, B, C, S = op.fresnel_reflection(index, [1.0, 0.8], [0.0, 0.6])
    np.testing.assert_array_equal(A, [1.0, 1.0])
    np.testing.assert_allclose(B, 0.0, rtol=0, atol=1e-199)
    assert C[0] == -1.0
    np.testing.assert_allclose(C * C + S * S, 1.0, rtol=0, atol=1e-15)


@given(n=INDICES, k=st.floats(0.1, 8.0), angle=ANGLES)
def test_what_the_textbook_lets_into_a_metal_has_the_phase_between_its_amplitudes(n, k, angle):
    c, s, m = np.cos(angle), np.sin(angle), complex(n, k)
    A, B, C, S = op.fresnel_transmission(m, c, s, "textbook")
    g = np.sqrt(m * m - s * s)
    phase = np.angle((m * m * c + g) / (m * (c + g)))  # Of t_s / t_p.
    expected = np.sqrt(max(A * A - B * B, 0.0)) * np.exp(1j * phase)
    assert abs(complex(C, S) - expected) <= 1e-12
