"""Sines and cosines by polynomials, against 50 digits."""

import mpmath
import numpy as np

from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from optipath.kernels.numbers.trigonometry import (
    DIGITS,
    any_quadrant,
    first_quadrant,
    from_axes,
    from_nearer_axis,
)
from tables import rows


def ulps(found, exact, dtype):
    off = [abs(mpmath.mpf(float(f)) - e) for f, e in zip(found, exact, strict=True)]
    steps = np.spacing(np.array([float(abs(e)) for e in exact], dtype)).astype(float)
    return max(float(o / s) for o, s in zip(off, steps.tolist(), strict=True))


def exactly(angles):
    with mpmath.workdps(50):
        numbers = [mpmath.mpf(float(a)) for a in angles]
        return [mpmath.sin(n) for n in numbers], [mpmath.cos(n) for n in numbers]


@rows("dtype", ["float64", "float32"])
def test_angles_of_any_size_are_right_to_two_units_in_the_last_place(rng, dtype):
    digits = DIGITS[dtype]
    near = np.round(rng.uniform(-500, 500, 300)) * (np.pi / 2) * (1 + rng.normal(0, 1e-5, 300))
    angles = np.concatenate([rng.uniform(-digits.most, digits.most, 500), near, [0.0]])
    angles = angles.astype(dtype)
    found = any_quadrant(NUMPY, digits)(angles)
    for value, exact in zip(found, exactly(angles), strict=True):
        assert ulps(value, exact, dtype) < 2.0


@rows("dtype", ["float64", "float32"])
def test_angles_of_the_first_quadrant_are_right_to_two_units_in_the_last_place(rng, dtype):
    near = np.pi / 2 - 10.0 ** rng.uniform(-6, -1, 300)
    angles = np.concatenate([rng.uniform(0, np.pi / 2, 600), near, 10.0 ** rng.uniform(-9, 0, 99)])
    angles = np.minimum(angles.astype(dtype), np.nextafter(np.dtype(dtype).type(np.pi / 2), 0))
    found = first_quadrant(NUMPY, DIGITS[dtype])(angles)
    for value, exact in zip(found, exactly(angles), strict=True):
        assert ulps(value, exact, dtype) < 2.0


def test_next_to_any_right_angle_float32_has_what_double_precision_leaves(rng):
    angles = np.pi / 2 - 10.0 ** rng.uniform(-15.6, 0, 500)
    left = from_nearer_axis(NUMPY, DIGITS["float64"])(angles)
    found = first_quadrant(NUMPY, DIGITS["float32"])(*(x.astype("float32") for x in (angles, left)))
    for value, exact in zip(found, exactly(angles), strict=True):
        assert ulps(value, exact, "float32") < 2.0
    turns = np.round(rng.uniform(-500, 500, 500))
    # Of a larger angle the double itself has fewer digits.
    angles = turns * (np.pi / 2) + rng.choice([-1, 1], 500) * 10.0 ** rng.uniform(-9, -0.2, 500)
    left = from_axes(NUMPY, DIGITS["float64"])(angles)
    found = any_quadrant(NUMPY, DIGITS["float32"])(*(x.astype("float32") for x in (angles, left)))
    for value, exact in zip(found, exactly(angles), strict=True):
        assert ulps(value, exact, "float32") < 2.0
    angles = np.arange(-9, 10) * (np.pi / 2)
    np.testing.assert_array_equal(from_axes(NUMPY, DIGITS["float64"])(angles), 0.0)


@rows("dtype", ["float64", "float32"])
def test_of_a_right_angle_there_is_no_cosine(dtype):
    right = np.array([np.pi / 2], dtype)
    sine, cosine = first_quadrant(NUMPY, DIGITS[dtype])(right)
    assert (sine[0], cosine[0]) == (1.0, 0.0)
    assert first_quadrant(FLOAT, DIGITS["float64"])(0.0) == (0.0, 1.0)
