import math

import mpmath as mp
import numpy as np

from optipath.kernels.numbers import primitives
from optipath.kernels.numbers.error_function import complementary_error
from optipath.kernels.numbers.primitives import FLOAT, NUMPY

POSITIVE = np.concatenate([[0.0], np.geomspace(1e-300, 50.0, 400), np.linspace(0.0, 8.0, 401)])


def test_it_has_the_digits_of_fifty_in_arrays_and_floats():
    with mp.workdps(50):
        exact = np.array([float(mp.erfc(x)) for x in POSITIVE.tolist()])
    assert np.max(np.abs(complementary_error(NUMPY)(POSITIVE) - exact)) <= 4e-16
    exact = [math.erfc(x) for x in np.linspace(0.0, 4.0, 81)]
    found = complementary_error(NUMPY)(np.linspace(0.0, 4.0, 81))
    np.testing.assert_allclose(found, exact, rtol=1e-14)
    of_floats = [complementary_error(FLOAT)(x) for x in POSITIVE.tolist()]
    np.testing.assert_allclose(complementary_error(NUMPY)(POSITIVE), of_floats, atol=2e-16)


def test_its_slope_is_that_of_the_normal_density(jax):
    JAX = primitives.of_module(jax.numpy)
    x = np.array([0.0, 1e-8, 0.3, 1.0, 3.14159, 6.3, 32.0])
    found = jax.vmap(jax.grad(complementary_error(JAX)))(x)
    np.testing.assert_allclose(found, -2.0 / math.sqrt(math.pi) * np.exp(-x * x), atol=2e-15)
