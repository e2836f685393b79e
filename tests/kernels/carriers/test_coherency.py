import numpy as np

import optipath as op
from optipath.kernels.carriers.coherency import is_physical
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from random_matrices import jones, of_jones
from tables import rows

ROUNDING = 20 * np.finfo(float).eps


def with_a_negative_eigenvalue(rng, least, terms):
    """Matrices of M00 = 1 whose least eigenvalue is known."""
    mixed = of_jones(jones(rng, 2000, terms)).sum(axis=-3)
    mixed /= mixed[:, :1, :1]
    # The ideal depolariser has the eigenvalues 1/4.
    found = mixed + 4.0 * least * np.diag([1.0, 0.0, 0.0, 0.0])
    return found / found[:, :1, :1]


@rows("terms", [1, 2, 3, 4])
@rows("least", [-0.1, -1e-6, -1e-13])
def test_the_sign_of_the_least_eigenvalue_is_told_to_a_few_roundings(terms, least):
    matrices = with_a_negative_eigenvalue(np.random.default_rng(terms), least, terms)
    values = op.Mueller(matrices).cloude_eigenvalues[:, 3]
    numbers = np.moveaxis(matrices.reshape(-1, 16), -1, 0)
    for spare in (0.0, -0.5 * least, -least, -2.0 * least):
        found = is_physical(NUMPY, numbers, spare)
        assert np.all(found[values > -spare + ROUNDING])
        assert not np.any(found[values < -spare - ROUNDING])


@rows("size", [1e-300, 1.0, 1e300])
@rows(
    "diagonal, physical",
    [
        ([1, 1, 1, 1], True),
        ([1, 1, -1, -1], True),
        ([1, 0, 0, 0], True),
        ([1, 1, 1, -1], False),
        ([1, 1.001, 1, 1], False),
        ([0, 1, 0, 0], False),
        ([-1, -1, -1, -1], False),
    ],
)
def test_elements_of_any_size_are_judged_by_what_they_do(diagonal, physical, size):
    numbers = (size * np.diag(diagonal).astype(float)).ravel().tolist()
    assert is_physical(FLOAT, numbers, 1e-12) == physical
