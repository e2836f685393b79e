"""Each formula and its slope against 50 digits, written down from the database's document."""

import numpy as np
import pytest

from optipath.kernels.dispersion.database_formulas import DATABASE_FORMULAS, coefficients_fit
from tables import rows

mp = pytest.importorskip("mpmath")


def sellmeier(w, c):
    return mp.sqrt(1 + c[0] + sum(c[i] * w**2 / (w**2 - c[i + 1] ** 2) for i in (1, 3, 5)))


def sellmeier_squares(w, c):
    return mp.sqrt(1 + c[0] + sum(c[i] * w**2 / (w**2 - c[i + 1]) for i in (1, 3, 5)))


def polynomial(w, c):
    return mp.sqrt(c[0] + sum(c[i] * w ** c[i + 1] for i in range(1, len(c), 2)))


def poles_and_powers(w, c):
    first = c[1] * w ** c[2] / (w**2 - c[3] ** c[4])
    second = c[5] * w ** c[6] / (w**2 - c[7] ** c[8])
    return mp.sqrt(c[0] + first + second + c[9] * w ** c[10] + c[11] * w ** c[12])


def cauchy(w, c):
    return c[0] + c[1] * w ** c[2] + c[3] * w ** c[4]


def gases(w, c):
    return 1 + c[0] + c[1] / (c[2] - 1 / w**2) + c[3] / (c[4] - 1 / w**2)


def herzberger(w, c):
    pole = 1 / (w**2 - mp.mpf("0.028"))
    return c[0] + c[1] * pole + c[2] * pole**2 + c[3] * w**2 + c[4] * w**4 + c[5] * w**6


def retro(w, c):
    ratio = c[0] + c[1] * w**2 / (w**2 - c[2]) + c[3] * w**2
    return mp.sqrt((1 + 2 * ratio) / (1 - ratio))


def exotic(w, c):
    return mp.sqrt(c[0] + c[1] / (w**2 - c[2]) + c[3] * (w - c[4]) / ((w - c[4]) ** 2 + c[5]))


# Coefficients of pages: silica, BK7, APL1, beta-BeAl2O4 (with powers of its own), SiC, argon,
# silicon (and one more power), AgBr, urea.
CASES = {
    1: (sellmeier, [0, 0.6961663, 0.0684043, 0.4079426, 0.1162414, 0.8974794, 9.896161]),
    2: (
        sellmeier_squares,
        [0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653],
    ),
    3: (polynomial, [2.2926, -0.0102, 2, 0.0129, -2, 0.0003, -4]),
    4: (poles_and_powers, [1.5, 1.4, 2, 0.1, 2, 0.02, 0.5, 0.03, 1, -0.01, 2, 0.002, 3]),
    5: (cauchy, [2.55378, 0.03417, -2, 0.0001, -4]),
    6: (gases, [0, 2.50141e-3, 91.012, 5.00283e-4, 87.892]),
    7: (herzberger, [3.41983, 0.159906, -0.123109, 1.26878e-6, -1.95104e-9, 1e-12]),
    8: (retro, [0.452505, 0.09939, 0.0705, -0.0015]),
    9: (exotic, [2.51527, 0.0240, 0.0300, 0.020, 1.52, 0.8771]),
}


@rows("number", CASES)
@rows("w", [0.45, 0.5893, 1.0, 1.7])
def test_a_formula_is_right_to_rounding(number, w):
    reference, c = CASES[number]
    found = DATABASE_FORMULAS[number](np, np.array([w]), c)[0]
    with mp.workdps(50):
        exact = reference(mp.mpf(w), [mp.mpf(value) for value in c])
        assert abs((mp.mpf(float(found)) - exact) / exact) < 4e-16


@rows("number", CASES)
@rows("w", [0.45, 0.5893, 1.0, 1.7])
def test_the_slope_of_a_formula_is_right(jax, number, w):
    reference, c = CASES[number]
    slope = jax.grad(lambda x: DATABASE_FORMULAS[number](jax.numpy, x, c))(w)
    with mp.workdps(50):
        exact = mp.diff(lambda x: reference(x, [mp.mpf(value) for value in c]), mp.mpf(w))
        assert abs(mp.mpf(float(slope)) - exact) < 2e-14 * max(abs(exact), mp.mpf("1e-2"))


def test_where_a_formula_comes_to_no_index_it_is_nan():
    assert DATABASE_FORMULAS[4](np, np.array([1.0]), [2.25, 0, 0, 0, 0]) == 1.5
    assert np.isnan(DATABASE_FORMULAS[3](np, np.array([2.0]), [1.0, -1.0, 2])[0])
    assert np.isnan(DATABASE_FORMULAS[2](np, np.array([0.5]), [0.0, 1.0, 0.25])[0])


@rows(
    "number, counts, others",
    [
        (1, (1, 3, 17), (0, 2, 18)),
        (4, (1, 5, 9, 11, 17), (0, 3, 7, 10)),
        (7, (3, 6), (0, 2)),
        (8, (4,), (3, 5)),
        (9, (6,), (5, 7)),
    ],
)
def test_a_formula_has_so_many_coefficients(number, counts, others):
    assert all(coefficients_fit(number, count) for count in counts)
    assert not any(coefficients_fit(number, count) for count in others)
