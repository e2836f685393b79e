"""Elementary functions that every engine does alike, by polynomials, against 50 digits."""

import math

import mpmath
import numpy as np

from optipath.kernels import primitives
from optipath.kernels.exponential import complementary_error, exponential, reproducible_numpy
from optipath.kernels.primitives import FLOAT, NUMPY
from optipath.kernels.trigonometry import (
    DIGITS,
    any_quadrant,
    arc_tangent,
    first_quadrant,
    from_axes,
    from_nearer_axis,
)
from tables import rows


def ulps(found, function, *given, dtype=None):
    """How many units in the last place the worst is off."""
    with mpmath.workdps(50):
        numbers = zip(*(each.tolist() for each in given), strict=True)
        exact = [function(*map(mpmath.mpf, each)) for each in numbers]
        steps = np.spacing(np.array([float(abs(e)) for e in exact], dtype or given[0].dtype))
        pairs = zip(found.tolist(), exact, steps.tolist(), strict=True)
        return max(float(abs(mpmath.mpf(f) - e) / mpmath.mpf(step)) for f, e, step in pairs)


def assert_within_two(found, angles, dtype):
    for value, exact in zip(found, (mpmath.sin, mpmath.cos), strict=True):
        assert ulps(value, exact, angles, dtype=dtype) < 2.0


@rows("dtype", ["float64", "float32"])
def test_sines_of_any_angle_and_in_the_first_quadrant_are_right_to_two_units(rng, dtype):
    digits = DIGITS[dtype]
    near = np.round(rng.uniform(-500, 500, 300)) * (np.pi / 2) * (1 + rng.normal(0, 1e-5, 300))
    angles = np.concatenate([rng.uniform(-digits.most, digits.most, 500), near, [0.0]])
    angles = angles.astype(dtype)
    assert_within_two(any_quadrant(NUMPY, digits)(angles), angles, dtype)
    near = np.pi / 2 - 10.0 ** rng.uniform(-6, -1, 300)
    angles = np.concatenate([rng.uniform(0, np.pi / 2, 600), near, 10.0 ** rng.uniform(-9, 0, 99)])
    angles = np.minimum(angles.astype(dtype), np.nextafter(np.dtype(dtype).type(np.pi / 2), 0))
    assert_within_two(first_quadrant(NUMPY, digits)(angles), angles, dtype)
    sine, cosine = first_quadrant(NUMPY, digits)(np.array([np.pi / 2], dtype))
    assert (sine[0], cosine[0]) == (1.0, 0.0)
    assert first_quadrant(FLOAT, DIGITS["float64"])(0.0) == (0.0, 1.0)


def test_next_to_any_right_angle_float32_has_what_double_precision_leaves(rng):
    near = np.pi / 2 - 10.0 ** rng.uniform(-15.6, 0, 500)
    turns = np.round(rng.uniform(-500, 500, 500))
    # Of a larger angle the double itself has fewer digits.
    far = turns * (np.pi / 2) + rng.choice([-1, 1], 500) * 10.0 ** rng.uniform(-9, -0.2, 500)
    for left, function, angles in (
        (from_nearer_axis, first_quadrant, near),
        (from_axes, any_quadrant, far),
    ):
        both = angles, left(NUMPY, DIGITS["float64"])(angles)
        found = function(NUMPY, DIGITS["float32"])(*(x.astype("float32") for x in both))
        assert_within_two(found, angles, "float32")
    angles = np.arange(-9, 10) * (np.pi / 2)
    np.testing.assert_array_equal(from_axes(NUMPY, DIGITS["float64"])(angles), 0.0)


@rows("dtype", ["float64", "float32"])
def test_exponentials_and_angles_of_points_are_right_and_end_where_floats_do(rng, dtype):
    numbers = np.concatenate([rng.uniform(-80, 80, 600), rng.uniform(-1, 1, 600)]).astype(dtype)
    found = exponential(NUMPY, dtype)(numbers)
    assert found.dtype == dtype
    assert ulps(found, mpmath.exp, numbers) < 1.0
    numbers = np.array([0.0, -np.inf, -1e30, 1e30, np.inf, np.nan], dtype)
    with np.errstate(all="ignore"):
        found = exponential(NUMPY, dtype)(numbers)
    assert np.array_equal(found, [1.0, 0.0, 0.0, np.inf, np.inf, np.nan], equal_nan=True)
    y, x = (10.0 ** rng.uniform(-6, 6, (2, 600)) * rng.choice([-1, 1], (2, 600))).astype(dtype)
    found = arc_tangent(reproducible_numpy(dtype))(y, x)
    assert found.dtype == dtype
    assert ulps(found, mpmath.atan2, y, x) < 3.0


def test_floats_arrays_and_complex_numbers_come_to_the_same_bits(rng):
    numbers = rng.uniform(-3, 3, 200)
    one, many = exponential(FLOAT, "float64"), exponential(NUMPY, "float64")
    assert [one(x) for x in numbers.tolist()] == many(numbers).tolist()
    one, many = arc_tangent(FLOAT), arc_tangent(NUMPY)
    assert [one(x, 0.7) for x in numbers.tolist()] == many(numbers, 0.7).tolist()
    xp, angles, number = reproducible_numpy("float64"), np.array([0.3, 1e9, -2.0]), [0.3 + 0.2j]
    for function, plain in ((xp.sin, np.sin), (xp.cos, np.cos), (xp.exp, np.exp)):
        if function is not xp.exp:
            alone = [function(angles[:1])[0], plain(1e9), function(angles[2:])[0]]
            assert function(angles).tolist() == alone
        assert function(np.array(number)) == plain(number)


POSITIVE = np.concatenate([[0.0], np.geomspace(1e-300, 50.0, 400), np.linspace(0.0, 8.0, 401)])


def test_the_error_function_has_the_digits_of_fifty_in_arrays_and_floats():
    of_arrays = complementary_error(NUMPY)
    with mpmath.workdps(50):
        exact = np.array([float(mpmath.erfc(x)) for x in POSITIVE.tolist()])
    assert np.max(np.abs(of_arrays(POSITIVE) - exact)) <= 4e-16
    few = np.linspace(0.0, 4.0, 81)
    np.testing.assert_allclose(of_arrays(few), [math.erfc(x) for x in few], rtol=1e-14)
    of_floats = [complementary_error(FLOAT)(x) for x in POSITIVE.tolist()]
    np.testing.assert_allclose(of_arrays(POSITIVE), of_floats, atol=2e-16)


def test_the_slope_of_the_error_function_is_that_of_the_normal_density(jax):
    JAX = primitives.of_module(jax.numpy)
    x = np.array([0.0, 1e-8, 0.3, 1.0, 3.14159, 6.3, 32.0])
    found = jax.vmap(jax.grad(complementary_error(JAX)))(x)
    np.testing.assert_allclose(found, -2.0 / math.sqrt(math.pi) * np.exp(-x * x), atol=2e-15)
