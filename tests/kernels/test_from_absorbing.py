"""Fresnel's equations out of an absorbing medium, against amplitudes in 50 digits.

The reference is S. J. Byrnes, "Multilayer optical calculations", arXiv:1603.02720, the formulas
that his program tmm computes, written again with mpmath: tmm itself is not used.
"""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from optipath.kernels.catalog import (
    METHODS,
    PHASE_INDEX,
    REFLECTION,
    REFLECTION_FROM_ABSORBING,
    TRANSMISSION,
    TRANSMISSION_FROM_ABSORBING,
    TRANSMISSION_FROM_BEHIND,
)
from optipath.kernels.primitives import FLOAT, NUMPY
from tables import rows, slow, slow_except

FAMILIES = REFLECTION_FROM_ABSORBING, TRANSMISSION_FROM_ABSORBING, TRANSMISSION_FROM_BEHIND
INDICES = st.floats(0.5, 4.0)
FRONT = st.one_of(st.floats(-12.0, 0.0).map(lambda x: 10.0**x), st.just(0.0))
BEHIND = st.one_of(st.floats(-12.0, 0.7).map(lambda x: 10.0**x), st.just(0.0))
ANGLES = st.floats(0.0, 89.9).map(math.radians)
MEDIA = st.tuples(INDICES, FRONT, INDICES, BEHIND)


def waves(n1, k1, n, k, angle, n0=None):
    """m1, m2 and the waves y along the face and g along the normal."""
    n1, k1, n, k, t = map(mpmath.mpf, (n1, k1, n, k, angle))
    m1, m2 = mpmath.mpc(n1, k1), mpmath.mpc(n, k)
    if n0 is None:
        contrast = n1 * n1 - k1 * k1
        root = mpmath.sqrt(contrast**2 + (2 * n1 * k1 / mpmath.cos(t)) ** 2)
        y = mpmath.sqrt((contrast + root) / 2) * mpmath.sin(t)
    else:
        y = mpmath.mpf(n0) * mpmath.sin(t)
    return m1, m2, y, *(forward(mpmath.sqrt(m * m - y * y)) for m in (m1, m2))


def forward(g):
    return -g if g.imag < 0 or (g.imag == 0 and g.real < 0) else g


def by_byrnes(m1, m2, g1, g2):
    """(Rs, Rp, B, C, S) and (Ts, Tp, B, C, S) by his equations 6 and 21 to 23."""
    c1, c2 = g1 / m1, g2 / m2
    rs = (m1 * c1 - m2 * c2) / (m1 * c1 + m2 * c2)
    rp = (m2 * c1 - m1 * c2) / (m2 * c1 + m1 * c2)
    ts = 2 * m1 * c1 / (m1 * c1 + m2 * c2)
    tp = 2 * m1 * c1 / (m2 * c1 + m1 * c2)
    Ts = abs(ts) ** 2 * (m2 * c2).real / (m1 * c1).real
    Tp = abs(tp) ** 2 * (m2 * mpmath.conj(c2)).real / (m1 * mpmath.conj(c1)).real
    both = ts * mpmath.conj(tp)
    both *= mpmath.sqrt(Ts * Tp) / abs(both)
    Rs, Rp, r = abs(rs) ** 2, abs(rp) ** 2, rs * mpmath.conj(rp)
    return (Rs, Rp, (Rs - Rp) / 2, r.real, r.imag), (Ts, Tp, (Ts - Tp) / 2, both.real, both.imag)


def expected(*media, angle, n0=None):
    """What each family gives; None where the wave in front fades faster than it goes on."""
    m1, m2, _, g1, g2 = waves(*media, angle, n0)
    if g1.real < g1.imag or g1.real < 1e-4 or g2.real < 1e-4:
        return None
    front, back = by_byrnes(m1, m2, g1, g2), by_byrnes(m2, m1, g2, g1)
    return front[0], front[1], back[1]


def computed(family, media, angle, n0, method="stable"):
    before = () if n0 is None else (n0,)
    kernel = family.by_method(method).made_for(FLOAT)
    return kernel(*media, *before, math.cos(angle), math.sin(angle))


@pytest.mark.parametrize("method", ["stable", slow("compensated")])
@rows("family", range(3))
@given(
    media=MEDIA,
    angle=ANGLES,
    n0=st.one_of(st.none(), INDICES),
)
def test_kernels_agree_with_50_digits(family, method, media, angle, n0):
    with mpmath.workdps(50):
        exact = expected(*media, angle=angle, n0=n0)
        assume(exact is not None)
        m1, m2, _, g1, g2 = waves(*media, angle, n0)
        # A root at a critical angle amplifies the rounding of the angle, behind and in front.
        near = min(abs(g / m) ** 2 for g, m in ((g1, m1), (g2, m2)))
        assume(near > 1e-6)
        found = computed(FAMILIES[family], media, angle, n0, method)
        size = max(exact[family][:2])
        errors = [abs(one - other) for one, other in zip(found, exact[family], strict=True)]
        assert max(errors) <= 1e-13 * size * (1 + 1e-2 / near)


@rows("k1", [1e-12, 1e-9, 1e-6, 1e-3, 0.03, 0.3])
@rows(
    "n, k, angle",
    [
        (1.0 / 1.5, 0.0, math.atan(1.0 / 1.5)),
        (1.5 * math.sin(0.7) * (1 + 1e-3), 0.0, 0.7),
        (1.5 * math.sin(0.7) * (1 - 1e-3), 0.0, 0.7),
        (1.5 * (1 + 1e-9), 0.0, 0.4),
        (0.2, 3.4, 1.2),
        (1.2, 1e-9, 1e-8),
    ],
)
def test_what_is_reflected_has_all_digits_in_every_region(n, k, angle, k1):
    with mpmath.workdps(50):
        m1, m2, _, g1, g2 = waves(1.5, k1, n, k, angle)
        exact = [float(R) for R in by_byrnes(m1, m2, g1, g2)[0][:2]]
    found = computed(REFLECTION_FROM_ABSORBING, (1.5, k1, n, k), angle, None)
    assert found[0] == pytest.approx(exact[0], rel=1e-12)
    assert found[1] == pytest.approx(exact[1], rel=1e-12, abs=1e-15 * found[0])


@rows("method", METHODS)
def test_every_method_computes_the_same(method):
    media, angle = (1.5, 0.2, 0.9, 0.05), 0.3
    with mpmath.workdps(50):
        exact = expected(*media, angle=angle)
    for family, numbers in zip(FAMILIES, exact, strict=True):
        found = computed(family, media, angle, None, method)
        np.testing.assert_allclose(found, [float(x) for x in numbers], rtol=1e-13, atol=1e-15)


@given(n1=INDICES, n=INDICES, k=BEHIND, angle=ANGLES, n0=st.one_of(st.none(), INDICES))
def test_without_absorption_in_front_it_is_the_usual_kernel_bit_for_bit(n1, n, k, angle, n0):
    pairs = (REFLECTION_FROM_ABSORBING, REFLECTION), (TRANSMISSION_FROM_ABSORBING, TRANSMISSION)
    before = () if n0 is None else (n0,)
    cos_sin = math.cos(angle), math.sin(angle)
    for general, usual in pairs:
        plain = usual.by_method("stable").made_for(FLOAT)(n1, n, k, *before, *cos_sin)
        assert computed(general, (n1, 0.0, n, k), angle, n0) == plain


@rows("method", METHODS)
def test_known_zeros_take_the_usual_kernels(method):
    def cheapest(family, *media):
        kernel = family.by_method(method)
        return kernel.specialised((*media, 0.8, 0.6), lambda number: number == 0.0)[0]

    usual = REFLECTION.by_method(method), TRANSMISSION.by_method(method)
    for family, kernel in zip(FAMILIES, usual, strict=False):
        assert cheapest(family, 1.5, 0.0, 1.2, 0.1) is kernel
        assert cheapest(family, 1.5, 0.1, 1.2, 0.0) is family.by_method(method)
    lossless = cheapest(TRANSMISSION_FROM_BEHIND, 1.5, 0.0, 1.2, 0.0)
    if usual[1].without:
        assert lossless is usual[1].without[1]
    plain = usual[1].made_for(FLOAT)(1.5, 1.2, 0.0, 0.8, 0.6)
    assert lossless.made_for(FLOAT)(1.5, 1.2, 0.8, 0.6) == pytest.approx(plain, abs=1e-15)


@given(media=MEDIA, angle=ANGLES)
def test_both_ways_are_reciprocal_and_what_is_over_is_the_interference_and_bounded(media, angle):
    m1, _, _, g1, g2 = waves(*media, angle)
    assume(g1.real > max(g1.imag, 1e-3 * abs(m1)))
    R, there, back = (computed(family, media, angle, None) for family in FAMILIES)
    assert 0.0 <= R[0] <= 1.0 + 1e-14
    # |arg(g1 / m1^2)| is at most 45 degrees: |r_p| is at most tan(45 deg + 22.5 deg).
    assert 0.0 <= R[1] <= (1.0 + math.sqrt(2.0)) ** 2 * (1.0 + 1e-6)
    over = 2 * g1.imag / g1.real * ((g1 - g2) / (g1 + g2)).imag
    assert R[0] + there[0] - 1.0 == pytest.approx(float(over), abs=1e-11)
    if g2.real > 1e-6:
        # g1 g2 t t' is symmetric: T (Re g1)^2 / |g1|^2 = T' (Re g2)^2 / |g2|^2 along s.
        first, second = (float(g.real**2 / abs(g) ** 2) for g in (g1, g2))
        assert there[0] * first == pytest.approx(back[0] * second, rel=1e-8)
        # The phase between s and p is the same.
        phase = math.atan2(back[4], back[3])
        assert math.atan2(there[4], there[3]) == pytest.approx(phase, abs=1e-12)


@rows("k1", [1e-12, 1e-3, 0.5])
def test_next_to_grazing_incidence_nothing_is_nan(k1):
    for family in FAMILIES:
        for c in (0.0, 1e-300, 1e-17, 1e-9):
            numbers = family.by_method("stable").made_for(FLOAT)(1.5, k1, 1.2, 0.1, c, 1.0)
            assert np.all(np.isfinite(numbers))


def test_the_index_of_the_phase_is_that_of_kettelers_equations_in_arrays_and_floats():
    (q,) = PHASE_INDEX.made_for(FLOAT)(1.5, 0.4, math.cos(0.7), math.sin(0.7))
    y, normal = q * math.sin(0.7), q * math.cos(0.7)
    across = 1.5 * 0.4 / normal
    assert y * y + normal * normal - across * across == pytest.approx(1.5**2 - 0.4**2, rel=1e-15)
    assert PHASE_INDEX.made_for(FLOAT)(1.5, 0.0, 0.8, 0.6) == (1.5,)
    rng = np.random.default_rng(7)
    *media, angle = (rng.uniform(*span, 50) for span in ((1, 2), (0, 0.2), (1, 2), (0, 1), (0, 1)))
    given_ = *media, np.cos(angle), np.sin(angle)
    for family in FAMILIES:
        kernel = family.by_method("stable")
        one_by_one = [kernel.made_for(FLOAT)(*row) for row in np.transpose(given_)]
        np.testing.assert_allclose(np.transpose(kernel.made_for(NUMPY)(*given_)), one_by_one, 1e-13)


@pytest.mark.parametrize(
    ("k1", "n0"),
    slow_except([(0.05, None)], [(k, n) for k in (0.0, 1e-9, 0.05) for n in (None, 1.3)]),
)
def test_slopes_are_those_of_50_digits(jax, k1, n0):
    sloped = pytest.importorskip("optipath.values.jax_primitives").sloped
    xp, at = sloped(np.dtype(np.float64)), (1.5, k1, 1.2, 0.1, 0.4)
    before = () if n0 is None else (n0,)

    def kernels(*given):
        *media, angle = given
        c, s = jax.numpy.cos(angle), jax.numpy.sin(angle)
        return [f.by_method("stable").made_for(xp)(*media, *before, c, s) for f in FAMILIES]

    found = jax.jacobian(kernels, argnums=(0, 1, 2, 3, 4))(*map(jax.numpy.float64, at))
    with mpmath.workdps(60):
        step = mpmath.mpf(10) ** -25

        def exact(*given):
            return np.array(expected(*given[:4], angle=given[4], n0=n0), dtype=object)

        for place in range(5):
            moved = list(map(mpmath.mpf, at))
            moved[place] += step
            slopes = ((exact(*moved) - exact(*at)) / step).astype(float)
            there = [[number[place] for number in family] for family in found]
            np.testing.assert_allclose(np.array(there, float), slopes, rtol=1e-9, atol=1e-12)
