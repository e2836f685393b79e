"""Filters against Jones calculus with the Stokes vector of docs/conventions.md.

The exponentials of dichroism and retardance are held against 4 x 4 matrices in many digits.
"""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.kernels.medium import (
    LARGEST,
    LARGEST_DICHROISM,
    depolarizing_lorentz,
    lorentz,
    retardance,
)
from optipath.kernels.primitives import FLOAT, NUMPY
from tables import rows

FIELDS = st.tuples(*[st.floats(-1.0, 1.0)] * 4).map(lambda p: np.array([p[0:2], p[2:4]]) @ [1, 1j])
ANGLES, SHARES = st.floats(-4.0, 4.0), st.floats(0.0, 1.0)


def stokes_of(jones):
    x, y = jones
    across = 2 * (x.conjugate() * y)
    return np.array(
        [abs(x) ** 2 + abs(y) ** 2, abs(x) ** 2 - abs(y) ** 2, across.real, across.imag]
    )


def turned(diagonal, angle):
    back = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return back @ np.diag(diagonal) @ back.T


@given(field=FIELDS, angle=ANGLES, delay=ANGLES, k1=SHARES, k2=SHARES)
def test_polarizers_retarders_rotators_and_attenuators_are_their_jones_matrices(
    field, angle, delay, k1, k2
):
    c, s = np.cos(angle), np.sin(angle)
    for element, matrix in (
        (op.Polarizer(angle, transmittance=k1, leakage=k2), turned(np.sqrt([k1, k2]), angle)),
        # exp(-i w t): a longer way is a phase exp(+i retardance).
        (op.Retarder(delay, angle), turned([1.0, np.exp(1j * delay)], angle)),
        (op.Rotator(angle), np.array([[c, -s], [s, c]])),
        (op.Attenuator(k1), np.sqrt(k1) * np.eye(2)),
    ):
        light = element.mueller() @ op.Light(stokes_of(field))
        np.testing.assert_allclose(light.stokes, stokes_of(matrix @ field), rtol=0, atol=1e-14)


@rows("port, share, handed", [("reflected", 0.3, -1.0), ("transmitted", 0.7, 1.0)])
def test_a_beam_splitter_shares_the_intensity(port, share, handed):
    light = op.BeamSplitter(0.3).mueller(leaves=port) @ op.Light([1.0, 0.5, 0.2, 0.1])
    assert light.intensity == pytest.approx(share, abs=1e-16)
    np.testing.assert_allclose(light.stokes[2:], handed * share * np.array([0.2, 0.1]))


def pure(p, q):
    return lorentz(FLOAT)(*p, *q, math.hypot(*p))


def depolarizing(p, q, d):
    return depolarizing_lorentz(FLOAT)(*p, *q, d, math.hypot(*p))


def exact(p, q, d=0.0):
    p, q, d = [mpmath.mpf(x) for x in p], [mpmath.mpf(x) for x in q], mpmath.mpf(d)
    size = mpmath.sqrt(sum(x * x for x in p))
    first, second, third = [p[0], -d, -q[2], q[1]], [p[1], q[2], -d, -q[0]], [p[2], -q[1], q[0], -d]
    generator = mpmath.matrix([[0, *p], first, second, third])
    return mpmath.expm(generator - size * mpmath.eye(4), method="taylor")


def error(found, p, q, d=0.0):
    with mpmath.workdps(60):
        wanted = exact(p, q, d)
        differences = [abs(x - wanted[i // 4, i % 4]) for i, x in enumerate(map(mpmath.mpf, found))]
        return float(max(differences) / wanted[0, 0])


def drawn(rng, most):
    """Vectors of any size, some of one size, parallel or across."""
    p, q = rng.normal(size=(2, 3)) * 10.0 ** rng.uniform(-12, np.log10(most / 2), (2, 1))
    kind = rng.integers(5)
    if kind == 1:
        p *= np.linalg.norm(q) / np.linalg.norm(p)
    if kind == 2:
        q = p * rng.normal()
    if kind == 3:
        p = np.cross(p, q) / np.linalg.norm(q)
    if kind == 4:
        p = np.cross(p, q) / np.linalg.norm(p) * (1.0 + 10.0 ** rng.uniform(-16, 0))
    return p.tolist(), q.tolist()


@rows("seed", range(8))
def test_a_pure_or_depolarizing_medium_is_the_exponential_to_13_digits(seed):
    rng = np.random.default_rng(seed)
    for _ in range(8):
        p, q = drawn(rng, 50.0)
        assert error(pure(p, q), p, q) < 1e-13
    for _ in range(2):
        p, q = drawn(rng, 40.0)
        d = float(10.0 ** rng.uniform(-12, np.log10(50)))
        assert error(depolarizing(p, q, d), p, q, d) < 1e-13


@pytest.mark.slow
@pytest.mark.parametrize("depolarizes", [False, True])
def test_no_climb_finds_a_worse_medium(depolarizes):
    rng = np.random.default_rng(11)
    for _ in range(20):
        p, q = drawn(rng, 50.0)
        numbers = [*p, *q, float(rng.uniform(0.0, 50.0))]
        worst, step = 0.0, 0.3
        for _ in range(60):
            moved = [x * (1.0 + step * rng.normal()) for x in numbers]
            p, q, d = moved[:3], moved[3:6], abs(moved[6]) if depolarizes else 0.0
            if max(np.linalg.norm(p), np.linalg.norm(q), d) > 50.0:
                continue
            found = depolarizing(p, q, d) if depolarizes else pure(p, q)
            if (now := error(found, p, q, d)) > worst:
                worst, numbers = now, moved
            else:
                step *= 0.9
        assert worst < 1e-13


@rows("size", [0.0, 5e-324, 1e-200, 1e-160, 1e-3, 1e3, 1e160, 1e300])
def test_numbers_of_any_size_give_numbers(size):
    one, other = (size, 0.3 * size, -0.2 * size), (0.5 * size, -size, 0.1 * size)
    for p, q in ((one, other), (one, (0.0, 0.0, 0.0)), ((0.0, 0.0, 0.0), other)):
        given = (*p, *q, math.hypot(*p))
        for xp in (FLOAT, NUMPY):
            numbers = lorentz(xp)(*(np.float64(x) if xp is NUMPY else x for x in given))
            assert np.all(np.isfinite(np.array(numbers, float)))


def test_a_retardance_is_a_medium_without_dichroism_in_single_precision_too():
    assert retardance(FLOAT)(0.1, 0.2, 0.3)[1:] == pure((0.0, 0.0, 0.0), (0.1, 0.2, 0.3))[1:]
    assert retardance(FLOAT)(0.1, 0.2, 0.3)[0] == 1.0
    single = [np.float32(x) for x in (LARGEST_DICHROISM, 0, 0, 0, 0, 0, LARGEST - 80.0, 80.0)]
    numbers = np.array(depolarizing_lorentz(NUMPY)(*single))
    assert numbers.dtype == np.float32
    assert np.all(np.isfinite(numbers))
    assert numbers[0] > 0.0
