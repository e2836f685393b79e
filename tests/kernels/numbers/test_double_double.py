import mpmath
import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from optipath.kernels.numbers.twice import twice
from tables import rows

NUMBERS = st.floats(1e-20, 1e20)
PAIRS = st.tuples(NUMBERS, st.floats(-0.4, 0.4)).map(lambda p: (p[0], p[1] * 2.0**-53 * p[0]))
UNIT = 2.0**-53


def exactly(number):
    return mpmath.mpf(float(number.high)) + mpmath.mpf(float(number.low))


def off(number, exact):
    with mpmath.workdps(80):
        return float(abs(exactly(number) / exact - 1))


@rows("xp", [FLOAT, NUMPY])
@given(first=PAIRS, second=PAIRS)
def test_sums_products_quotients_and_roots_have_twice_the_digits(xp, first, second):
    kind = float if xp is FLOAT else np.float64
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


@rows("xp", [FLOAT, NUMPY])
@given(
    angle=st.one_of(st.floats(-10, 10), st.floats(1e-300, 1e-3), st.floats(-1e15, 1e15)),
    rest=st.floats(-0.4, 0.4),
)
@example(angle=901824470526042.0, rest=0.0)
@example(angle=4e15, rest=0.3)
def test_sines_and_cosines_have_twice_the_digits(xp, angle, rest):
    kind = float if xp is FLOAT else np.float64
    number = DoubleDouble(xp, kind(angle), kind(rest * 2.0**-53 * angle))
    with mpmath.workdps(80):
        x = exactly(number)
        pairs = [(twice(xp).sin, mpmath.sin(x)), (twice(xp).cos, mpmath.cos(x))]
    for function, exact in pairs:
        with mpmath.workdps(80):
            assert abs(exactly(function(number)) - exact) <= 16 * UNIT * UNIT * abs(exact) + 1e-305


@rows("xp", [FLOAT, NUMPY])
@given(number=st.floats(-600, 600), y=st.floats(-1e9, 1e9), x=st.floats(-1e9, 1e9))
def test_exponentials_and_angles_have_twice_the_digits(xp, number, y, x):
    with mpmath.workdps(80):
        exact = mpmath.exp(mpmath.mpf(number)), mpmath.atan2(mpmath.mpf(y), mpmath.mpf(x))
    kind = float if xp is FLOAT else np.float64
    double = twice(xp)
    assert off(double.exp(DoubleDouble(xp, kind(number))), exact[0]) <= 64 * UNIT * UNIT
    if min(abs(x), abs(y)) > 1e-200:
        found = double.atan2(DoubleDouble(xp, kind(y)), DoubleDouble(xp, kind(x)))
        assert off(found, exact[1]) <= 64 * UNIT * UNIT
