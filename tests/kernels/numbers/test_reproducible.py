"""Elementary functions that every engine does alike, against 50 digits."""

import mpmath
import numpy as np

from optipath.kernels.numbers.arc_tangent import arc_tangent
from optipath.kernels.numbers.exponential import exponential
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from optipath.kernels.numbers.reproducible import reproducible_numpy
from tables import rows


def ulps(found, exact):
    """How many units in the last place the worst is off."""
    steps = [np.spacing(abs(f), dtype=f.dtype) for f in found]
    return max(
        float(abs(mpmath.mpf(float(f)) - e) / mpmath.mpf(float(step)))
        for f, e, step in zip(found, exact, steps, strict=True)
    )


@rows("dtype", ["float64", "float32"])
def test_exponentials_are_right_to_one_unit_in_the_last_place(rng, dtype):
    numbers = np.concatenate([rng.uniform(-80, 80, 600), rng.uniform(-1, 1, 600)]).astype(dtype)
    with mpmath.workdps(50):
        exact = [mpmath.exp(mpmath.mpf(float(x))) for x in numbers]
        found = exponential(NUMPY, dtype)(numbers)
        assert found.dtype == dtype
        assert ulps(found, exact) < 1.0


@rows("dtype", ["float64", "float32"])
def test_exponentials_end_where_floats_do(dtype):
    numbers = np.array([0.0, -np.inf, -1e30, 1e30, np.inf, np.nan], dtype)
    with np.errstate(all="ignore"):
        found = exponential(NUMPY, dtype)(numbers)
    assert np.array_equal(found, [1.0, 0.0, 0.0, np.inf, np.inf, np.nan], equal_nan=True)


@rows("dtype", ["float64", "float32"])
def test_angles_of_points_are_right_to_three_units_in_the_last_place(rng, dtype):
    y, x = (10.0 ** rng.uniform(-6, 6, (2, 600)) * rng.choice([-1, 1], (2, 600))).astype(dtype)
    with mpmath.workdps(50):
        pairs = zip(y.tolist(), x.tolist(), strict=True)
        exact = [mpmath.atan2(mpmath.mpf(a), mpmath.mpf(b)) for a, b in pairs]
        found = arc_tangent(reproducible_numpy(dtype))(y, x)
        assert found.dtype == dtype
        assert ulps(found, exact) < 3.0


def test_floats_arrays_and_complex_numbers_come_to_the_same_bits(rng):
    numbers = rng.uniform(-3, 3, 200)
    one, many = exponential(FLOAT, "float64"), exponential(NUMPY, "float64")
    assert [one(x) for x in numbers.tolist()] == many(numbers).tolist()
    one, many = arc_tangent(FLOAT), arc_tangent(NUMPY)
    assert [one(x, 0.7) for x in numbers.tolist()] == many(numbers, 0.7).tolist()
    xp = reproducible_numpy("float64")
    angles = np.array([0.3, 1e9, -2.0])
    for function, plain in ((xp.sin, np.sin), (xp.cos, np.cos)):
        alone = [function(angles[:1])[0], plain(1e9), function(angles[2:])[0]]
        assert function(angles).tolist() == alone
    xp, number = reproducible_numpy("float64"), np.array([0.3 + 0.2j])
    for name in ("sin", "cos", "exp"):
        assert getattr(xp, name)(number) == getattr(np, name)(number)
