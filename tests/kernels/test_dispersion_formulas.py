"""Dispersion formulas and their slopes against 50 digits, in the forms that are published.

Those of the database are written down from its document.
"""

import numpy as np
import pytest

from optipath.kernels.dispersion import (
    DATABASE_FORMULAS,
    cauchy_index,
    coefficients_fit,
    drude_lorentz_permittivity,
    index_of_permittivity,
    index_of_square,
    sellmeier_square,
    tauc_lorentz_permittivity,
)
from tables import rows, slow_except

mp = pytest.importorskip("mpmath")
BK7 = (1.0, 1.03961212, 0.231792344, 1.01046945, 0.00600069867, 0.0200179144, 103.560653)
GOLD = (1.0, 9.03, 0.760, 0.053, 0.024, 0.415, 0.241, 0.010, 0.830, 0.345, 0.071, 2.969, 0.870)
SILICON = (122.0, 3.45, 2.54, 1.2)


@pytest.fixture(autouse=True)
def _many_digits():
    with mp.workdps(50):
        yield


def sellmeier(xp, w, *c):
    return (index_of_square(xp, sellmeier_square(xp, w, c[0], c[1:4], c[4:])),)


def sellmeier_published(w, *c):
    terms = [b * w**2 / (w**2 - pole) for b, pole in zip(c[1:4], c[4:], strict=True)]
    return (mp.sqrt(c[0] + mp.fsum(terms)),)


def gold(xp, e, *c):
    bound = [c[at : at + 3] for at in range(4, len(c), 3)]
    return index_of_permittivity(xp, *drude_lorentz_permittivity(e, c[0], c[1], c[2:4], bound))


def gold_published(e, *c):
    """Of Rakic et al. (1998), whose field is exp(+iwt)."""
    background, plasma, f0, g0, *bound = c
    eps = background - f0 * plasma**2 / (e * (e - mp.mpc(0, -1) * -g0))
    for at in range(0, len(bound), 3):
        f, w0, g = bound[at : at + 3]
        eps += f * plasma**2 / (w0**2 - e**2 + mp.mpc(0, 1) * e * g)
    index = mp.sqrt(mp.conj(eps))
    return index.real, index.imag


def silicon_published(e, a, e0, c, eg):
    """Eqs. 4 and 6 of Jellison and Modine (1996) with their erratum."""
    alpha, gamma = mp.sqrt(4 * e0**2 - c**2), mp.sqrt(e0**2 - c**2 / 2)
    zeta = (e**2 - gamma**2) ** 2 + alpha**2 * c**2 / 4
    by_log = (eg**2 - e0**2) * e**2 + eg**2 * c**2 - e0**2 * (e0**2 + 3 * eg**2)
    by_angle = (e**2 - e0**2) * (e0**2 + eg**2) + eg**2 * c**2
    ratio = (e0**2 + eg**2 + alpha * eg) / (e0**2 + eg**2 - alpha * eg)
    angles = mp.pi - mp.atan((2 * eg + alpha) / c) + mp.atan((alpha - 2 * eg) / c)
    turn = mp.pi + 2 * mp.atan(2 * (gamma**2 - eg**2) / (alpha * c))
    width = mp.sqrt((e0**2 - eg**2) ** 2 + eg**2 * c**2)
    real = (
        a * c * by_log / (2 * mp.pi * zeta * alpha * e0) * mp.log(ratio)
        - a * by_angle / (mp.pi * zeta * e0) * angles
        + 2 * a * e0 / (mp.pi * zeta * alpha) * eg * (e**2 - gamma**2) * turn
        - a * e0 * c * (e**2 + eg**2) / (mp.pi * zeta * e) * mp.log(abs(e - eg) / (e + eg))
        + 2 * a * e0 * c * eg / (mp.pi * zeta) * mp.log(abs(e - eg) * (e + eg) / width)
    )
    imaginary = a * e0 * c * (e - eg) ** 2 / ((e**2 - e0**2) ** 2 + c**2 * e**2) / e
    return real, imaginary if e > eg else mp.mpf(0)


FORMULAS = {
    "sellmeier": (sellmeier, sellmeier_published, BK7, (0.35, 0.5876, 1.06, 2.3, 0.143)),
    "cauchy": (
        lambda xp, w, *c: (cauchy_index(xp, w, c),),
        lambda w, a, b, c: (a + b / w**2 + c / w**4,),
        (1.458, 0.00354, 1e-5),
        (0.25, 0.6328, 2.0),
    ),
    "drude-lorentz": (gold, gold_published, GOLD, (0.2, 0.415, 0.83, 2.4, 2.969, 6.0)),
    "tauc-lorentz": (
        tauc_lorentz_permittivity,
        silicon_published,
        SILICON,
        (0.05, 0.6, 1.2 - 4e-16, 1.2 + 4e-16, 1.1999, 1.3, 3.45, 9.0),
    ),
}
CASES = [(name, at) for name, (*_, places) in FORMULAS.items() for at in places]


@rows("name, at", CASES)
def test_values_have_fourteen_digits(name, at):
    formula, published, coefficients, _ = FORMULAS[name]
    expected = published(*map(mp.mpf, (at, *coefficients)))
    for found, exact in zip(formula(np, at, *coefficients), expected, strict=True):
        assert float(found) == pytest.approx(float(exact), rel=2e-14, abs=0.0)


@pytest.mark.parametrize(
    ("name", "at"),
    slow_except([(name, places[0]) for name, (*_, places) in FORMULAS.items()], CASES),
)
def test_slopes_in_every_argument_have_twelve_digits(jax, jacobian, name, at):
    formula, published, coefficients, _ = FORMULAS[name]
    arguments = (at, *coefficients)
    exact, places = [mp.mpf(number) for number in arguments], range(len(arguments))
    slopes = jacobian(lambda *a: formula(jax.numpy, *a), argnums=tuple(places))(*arguments)
    for part, value in enumerate(published(*exact)):
        for place, slope in enumerate(slopes[part]):
            order = tuple([int(each == place) for each in places])
            wanted = float(mp.diff(lambda *a, part=part: published(*a)[part], tuple(exact), order))
            scale = abs(float(value)) / abs(arguments[place] or 1.0)
            assert float(slope) == pytest.approx(wanted, rel=1e-12, abs=1e-13 * scale)


@rows("part", [0, 1])
def test_at_the_gap_an_oscillator_and_its_slopes_are_those_next_to_it(jax, part):
    gap = SILICON[-1]
    found = tauc_lorentz_permittivity(np, gap, *SILICON)[part]
    beside = [mp.mpf(gap) + mp.mpf(10) ** -30, *map(mp.mpf, SILICON)]
    expected = silicon_published(*beside)[part]
    assert float(found) == pytest.approx(float(expected), rel=1e-14, abs=1e-28)
    slopes = jax.grad(lambda *a: tauc_lorentz_permittivity(jax.numpy, *a)[part], (0, 4))(
        gap, *SILICON
    )
    for place, slope in zip((0, 4), slopes, strict=True):
        order = tuple([int(each == place) for each in range(5)])
        wanted = mp.diff(lambda *a: silicon_published(*a)[part], tuple(beside), order, h="1e-40")
        assert float(slope) == pytest.approx(float(wanted), rel=1e-12, abs=1e-12)


def test_oscillators_keep_kramers_and_kronig_and_have_no_index_at_a_resonance():
    quad = pytest.importorskip("scipy.integrate").quad

    def absorbed(e):
        return e * float(tauc_lorentz_permittivity(np, e, *SILICON)[1])

    for energy in (1.3, 2.5, 6.0):
        # The principal value, its singularity a weight: f / (x + e) over (x - e).
        cauchy = {"weight": "cauchy", "wvar": energy}
        near, _ = quad(lambda x, e=energy: absorbed(x) / (x + e), SILICON[-1], 60.0, **cauchy)
        far, _ = quad(lambda x, e=energy: absorbed(x) / (x * x - e * e), 60.0, np.inf)
        found = tauc_lorentz_permittivity(np, energy, *SILICON)[0]
        assert float(found) == pytest.approx(2.0 / np.pi * (near + far), rel=1e-6)
    squares = sellmeier_square(np, np.array([0.5, 0.45, 0.7]), 1.0, [1.0], [0.25])
    assert np.isnan(index_of_square(np, squares)).tolist() == [True, True, False]


@rows("real", [-3.0, -1e-100, 0.0, 1e-100, 2.0])
@rows("imaginary", [0.0, 1e-90, 1e-9, 4.0])
def test_the_index_of_a_permittivity_squares_to_it(real, imaginary):
    n, k = [float(part) for part in index_of_permittivity(np, np.float64(real), imaginary)]
    exact = mp.sqrt(mp.mpc(real, imaginary))
    assert min(n, k) >= 0.0
    assert (n, k) == pytest.approx((float(exact.real), float(exact.imag)), rel=1e-15, abs=1e-150)


@rows("real, imaginary", [(0.0, 2.0), (-2.0, 0.0), (2.0, 0.0)])
def test_slopes_of_an_index_are_right_where_a_part_of_the_permittivity_is_0(jax, real, imaginary):
    exact = mp.sqrt(mp.mpc(real, imaginary))
    along = 0.5 / exact
    for part, wanted in enumerate([(along.real, -along.imag), (along.imag, along.real)]):
        slopes = jax.grad(lambda *a, part=part: index_of_permittivity(jax.numpy, *a)[part], (0, 1))
        for slope, each in zip(slopes(real, imaginary), wanted, strict=True):
            assert float(slope) == pytest.approx(float(each), rel=1e-14, abs=1e-16)


def three_poles(w, c, power=1):
    return mp.sqrt(1 + c[0] + sum(c[i] * w**2 / (w**2 - c[i + 1] ** power) for i in (1, 3, 5)))


def poles_and_powers(w, c):
    first = c[1] * w ** c[2] / (w**2 - c[3] ** c[4])
    second = c[5] * w ** c[6] / (w**2 - c[7] ** c[8])
    return mp.sqrt(c[0] + first + second + c[9] * w ** c[10] + c[11] * w ** c[12])


def herzberger(w, c):
    pole = 1 / (w**2 - mp.mpf("0.028"))
    return c[0] + c[1] * pole + c[2] * pole**2 + c[3] * w**2 + c[4] * w**4 + c[5] * w**6


def retro(w, c):
    ratio = c[0] + c[1] * w**2 / (w**2 - c[2]) + c[3] * w**2
    return mp.sqrt((1 + 2 * ratio) / (1 - ratio))


# Of pages: silica, BK7, APL1, beta-BeAl2O4 (with powers of its own), SiC, argon,
# silicon (and one more power), AgBr, urea.
DATABASE = {
    1: (
        lambda w, c: three_poles(w, c, 2),
        [0, 0.6961663, 0.0684043, 0.4079426, 0.1162414, 0.8974794, 9.896161],
    ),
    2: (
        three_poles,
        [0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653],
    ),
    3: (
        lambda w, c: mp.sqrt(c[0] + sum(c[i] * w ** c[i + 1] for i in range(1, len(c), 2))),
        [2.2926, -0.0102, 2, 0.0129, -2, 0.0003, -4],
    ),
    4: (poles_and_powers, [1.5, 1.4, 2, 0.1, 2, 0.02, 0.5, 0.03, 1, -0.01, 2, 0.002, 3]),
    5: (lambda w, c: c[0] + c[1] * w ** c[2] + c[3] * w ** c[4], [2.55378, 0.03417, -2, 1e-4, -4]),
    6: (
        lambda w, c: 1 + c[0] + c[1] / (c[2] - 1 / w**2) + c[3] / (c[4] - 1 / w**2),
        [0, 2.50141e-3, 91.012, 5.00283e-4, 87.892],
    ),
    7: (herzberger, [3.41983, 0.159906, -0.123109, 1.26878e-6, -1.95104e-9, 1e-12]),
    8: (retro, [0.452505, 0.09939, 0.0705, -0.0015]),
    9: (
        lambda w, c: mp.sqrt(
            c[0] + c[1] / (w**2 - c[2]) + c[3] * (w - c[4]) / ((w - c[4]) ** 2 + c[5])
        ),
        [2.51527, 0.0240, 0.0300, 0.020, 1.52, 0.8771],
    ),
}


@rows("number", DATABASE)
@rows("w", [0.45, 0.5893, 1.0, 1.7])
def test_a_formula_of_the_database_is_right_to_rounding(number, w):
    reference, c = DATABASE[number]
    found = DATABASE_FORMULAS[number](np, np.array([w]), c)[0]
    exact = reference(mp.mpf(w), [mp.mpf(value) for value in c])
    assert abs((mp.mpf(float(found)) - exact) / exact) < 4e-16


@rows("number", DATABASE)
@rows("w", [0.45, 0.5893, 1.0, 1.7])
def test_the_slope_of_a_formula_of_the_database_is_right(jax, number, w):
    reference, c = DATABASE[number]
    slope = jax.grad(lambda x: DATABASE_FORMULAS[number](jax.numpy, x, c))(w)
    exact = mp.diff(lambda x: reference(x, [mp.mpf(value) for value in c]), mp.mpf(w))
    assert abs(mp.mpf(float(slope)) - exact) < 2e-14 * max(abs(exact), mp.mpf("1e-2"))


def test_where_a_formula_comes_to_no_index_it_is_nan():
    assert DATABASE_FORMULAS[4](np, np.array([1.0]), [2.25, 0, 0, 0, 0]) == 1.5
    assert np.isnan(DATABASE_FORMULAS[3](np, np.array([2.0]), [1.0, -1.0, 2])[0])
    assert np.isnan(DATABASE_FORMULAS[2](np, np.array([0.5]), [0.0, 1.0, 0.25])[0])


@rows(
    "number, fit, others",
    [
        (1, (1, 3, 17), (0, 2, 18)),
        (4, (1, 5, 9, 11, 17), (0, 3, 7, 10)),
        (7, (3, 6), (0, 2)),
        (8, (4,), (3, 5)),
        (9, (6,), (5, 7)),
    ],
)
def test_a_formula_has_so_many_coefficients(number, fit, others):
    found = [count for count in sorted(fit + others) if coefficients_fit(number, count)]
    assert found == sorted(fit)
