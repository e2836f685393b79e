"""Numbers of twice the digits, and systems solved without a difference."""

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mpmath import mp

from optipath.kernels.double_double import DoubleDouble, twice
from optipath.kernels.linear_solve import Elimination
from optipath.kernels.primitives import FLOAT, NUMPY
from tables import rows

NUMBERS = st.floats(1e-20, 1e20)
PAIRS = st.tuples(NUMBERS, st.floats(-0.4, 0.4)).map(lambda p: (p[0], p[1] * 2.0**-53 * p[0]))
UNIT = 2.0**-53
KINDS = [(FLOAT, float), (NUMPY, np.float64)]


def exactly(number):
    return mpmath.mpf(float(number.high)) + mpmath.mpf(float(number.low))


def off(number, exact):
    with mpmath.workdps(80):
        return float(abs(exactly(number) / exact - 1))


@rows("xp, kind", KINDS)
@given(first=PAIRS, second=PAIRS)
def test_sums_products_quotients_and_roots_have_twice_the_digits(xp, kind, first, second):
    a, b = (DoubleDouble(xp, *map(kind, pair)) for pair in (first, second))
    with mpmath.workdps(80):
        x, y = exactly(a), exactly(b)
        results = [(a + b, x + y), (a * b, x * y), (a / b, x / y), (a.sqrt(), mpmath.sqrt(x))]
    for found, exact in results:
        assert off(found, exact) <= 16 * UNIT * UNIT


@given(a=NUMBERS)
def test_what_a_difference_leaves_is_exact(a):
    one = DoubleDouble(FLOAT, 1.0)
    part = one / DoubleDouble(FLOAT, a)
    assert abs((part * DoubleDouble(FLOAT, a) - 1.0).high) <= 8 * UNIT * UNIT


def test_what_is_the_same_to_all_digits_is_equal_and_the_root_of_nothing_nothing():
    assert DoubleDouble(FLOAT, 0.0).sqrt().high == 0.0
    found = twice(NUMPY).sin(DoubleDouble(NUMPY, np.float64(1e300)))
    assert found.high == np.sin(1e300)
    third = 1.0 / DoubleDouble(FLOAT, 3.0)
    assert third + third + third == 1.0
    assert third != 1.0 / 3.0


@rows("dtype", ["float32", "float64", "longdouble"])
def test_a_product_and_its_rounding_are_exact_in_every_precision(dtype):
    rng = np.random.default_rng(0)
    a, b = rng.uniform(0.5, 2, (2, 1000)).astype(dtype)
    product, rest = NUMPY.two_product(a, b)
    assert product.dtype == rest.dtype == np.dtype(dtype)
    with mpmath.workdps(60):
        for i in range(1000):
            x, y, p, r = (
                mpmath.mpf(np.format_float_positional(v, unique=False, precision=80))
                for v in (a[i], b[i], product[i], rest[i])
            )
            assert p + r == x * y


@rows("xp, kind", KINDS)
@given(
    angle=st.one_of(st.floats(-10, 10), st.floats(1e-300, 1e-3), st.floats(-1e15, 1e15)),
    rest=st.floats(-0.4, 0.4),
)
@example(angle=901824470526042.0, rest=0.0)
@example(angle=4e15, rest=0.3)
def test_sines_and_cosines_have_twice_the_digits(xp, kind, angle, rest):
    number = DoubleDouble(xp, kind(angle), kind(rest * 2.0**-53 * angle))
    with mpmath.workdps(80):
        x = exactly(number)
        for function, exact in ((twice(xp).sin, mpmath.sin(x)), (twice(xp).cos, mpmath.cos(x))):
            assert abs(exactly(function(number)) - exact) <= 16 * UNIT * UNIT * abs(exact) + 1e-305


@rows("xp, kind", KINDS)
@given(number=st.floats(-600, 600), y=st.floats(-1e9, 1e9), x=st.floats(-1e9, 1e9))
def test_exponentials_and_angles_have_twice_the_digits(xp, kind, number, y, x):
    with mpmath.workdps(80):
        exact = mpmath.exp(mpmath.mpf(number)), mpmath.atan2(mpmath.mpf(y), mpmath.mpf(x))
    double = twice(xp)
    assert off(double.exp(DoubleDouble(xp, kind(number))), exact[0]) <= 64 * UNIT * UNIT
    if min(abs(x), abs(y)) > 1e-200:
        found = double.atan2(DoubleDouble(xp, kind(y)), DoubleDouble(xp, kind(x)))
        assert off(found, exact[1]) <= 64 * UNIT * UNIT


def system(rng, size, leak):
    """Shares of each unknown that come back as others, of which so little leaves in all."""
    shares = rng.uniform(0, 1, (size, size)) * (rng.random((size, size)) < 0.6)
    shares[(np.arange(size) + 1) % size, np.arange(size)] += 0.1
    leaves = leak * rng.uniform(0.5, 1, size)
    shares *= (1 - leaves) / shares.sum(axis=0)
    back = [{row: float(s) for row, s in enumerate(column)} for column in shares.T]
    return back, leaves.tolist()


def solution(back, leaves, arriving):
    """The same in 50 digits, where what stays is 1 less all that goes elsewhere."""
    with mp.workdps(50):
        matrix = mp.diag(leaves)
        for column, shares in enumerate(back):
            for row, share in shares.items():
                if row != column:
                    matrix[column, column] += mp.mpf(share)
                    matrix[row, column] = -mp.mpf(share)
        return [float(x) for x in mp.lu_solve(matrix, mp.matrix(arriving))]


@rows("leak", [0.3, 1e-6, 1e-12])
@rows("size", [1, 2, 5, 12])
def test_every_digit_stays_however_little_leaves(size, leak):
    rng = np.random.default_rng(size)
    back, leaves = system(rng, size, leak)
    arriving = rng.uniform(0, 1, size).tolist()
    found = Elimination(FLOAT, back, leaves, [True] * size).solved(arriving)
    np.testing.assert_allclose(found, solution(back, leaves, arriving), rtol=2e-14)


def test_what_leaves_is_what_arrived_and_gains_are_told_by_their_pivots():
    back, leaves = system(np.random.default_rng(7), 9, 1e-9)
    found = Elimination(FLOAT, back, leaves, [True] * 9).solved([1.0] + [0.0] * 8)
    assert np.dot(found, leaves) == pytest.approx(1.0, rel=1e-14)
    # Of the one, 1/2 comes back as the other, of which 3 come back: 3/2 in a round.
    pivots = Elimination(FLOAT, [{1: 0.5}, {0: 3.0}], [0.5, -2.0], [True, True]).pivots
    assert min(pivots) < 0
    found = Elimination(FLOAT, [{0: 0.5}, {1: 1.0}], [0.5, 0.0], [True, True]).solved([1.0, 0.0])
    assert found == [2.0, 0.0]


def test_a_pivot_of_0_by_chance_is_moved_and_unknowns_without_intensity_are_solved_too():
    # Of x, all comes back as x and as much as y; of y, minus as much: none in the second round.
    def exact(number):
        return DoubleDouble(FLOAT, number)

    back = [{0: exact(1.0), 1: exact(1.0)}, {0: exact(-1.0), 1: exact(-1.0)}]
    leaves = [exact(-1.0), exact(3.0)]
    system = Elimination(twice(FLOAT), back, leaves, [True, True], fading=False)
    found = system.solved([exact(1.0), 0.0])
    np.testing.assert_allclose([number.high for number in found], [2.0, 1.0], rtol=1e-15)
    # x = 1 + q / 4, q = x / 2, where q carries no intensity: of x, all leaves.
    system = Elimination(FLOAT, [{1: 0.5}, {0: 0.25}], [1.0, -0.25], [True, False])
    np.testing.assert_allclose(system.solved([1.0, 0.0]), [8 / 7, 4 / 7], rtol=1e-15)
