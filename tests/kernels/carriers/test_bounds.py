"""Bounds of intensities, and matrices that have none."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.kernels.carriers.coherency import is_physical
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from random_matrices import jones, of_jones, unit_vectors
from tables import rows

SHARES = st.floats(0.0, 1.0)
ROUNDING = 20 * np.finfo(float).eps


def behind(dop, diattenuations, axes):
    """The intensity behind diattenuators of mean 1, each with an axis on the Poincare sphere."""
    s0, s = np.ones(len(dop)), dop[:, np.newaxis] * axes[0]
    for d, axis in zip(diattenuations, axes[1:], strict=True):
        along = np.sum(s * axis, axis=-1)
        # Chipman, Lam & Young (2018): the diattenuator of axis a, its mean transmittance 1.
        across = np.sqrt(1.0 - d * d)[:, np.newaxis]
        s_along = along[:, np.newaxis] * axis
        s = d[:, np.newaxis] * s0[:, np.newaxis] * axis + s_along + across * (s - s_along)
        s0 = s0 + d * along
    return s0


@rows("length", range(2, 11))
def test_no_chain_leaves_its_bounds_and_some_reach_them(rng, length):
    count = 112_000  # A million for all lengths together.
    dop = rng.choice([0.0, 1.0, -1.0], count, p=[0.3, 0.1, 0.6])
    dop = np.where(dop < 0.0, rng.random(count), dop)
    diattenuations = rng.random((length, count)) ** rng.choice([0.2, 1.0, 4.0], (length, 1))
    diattenuations[0, ::50] = 1.0
    axes = [unit_vectors(rng, count) for _ in range(length + 1)]
    # Some with all axes along one line, one way or the other.
    for axis in axes:
        axis[::5] = axes[0][::5] * rng.choice([-1.0, 1.0], (len(axis[::5]), 1))
    ratio = behind(dop, diattenuations, axes)
    lower, upper = op.intensity_bounds(dop, list(diattenuations))
    slack = 1e-14 * upper  # What goes to and fro is as large as that.
    assert np.all((lower - slack <= ratio) & (ratio <= upper + slack))
    lit = lower > 1e-6
    assert min(np.max(ratio / upper), np.max(lower[lit] / ratio[lit])) > 0.99


@given(dop=st.floats(0.0, 0.999), shares=st.lists(st.floats(0.0, 0.999), min_size=1, max_size=6))
def test_the_bounds_are_those_of_the_hyperbolic_formula(dop, shares):
    lengths = np.arctanh([dop, *shares])
    scale = np.prod(np.cosh(lengths))
    least = max(0.0, 2.0 * lengths.max() - lengths.sum())
    lower, upper = op.intensity_bounds(dop, shares)
    assert upper == pytest.approx(np.cosh(lengths.sum()) / scale, rel=1e-9)
    assert lower == pytest.approx(np.cosh(least) / scale, rel=1e-9)


@given(dop=SHARES, shares=st.lists(SHARES, max_size=6))
def test_bounds_enclose_one_and_do_not_depend_on_the_sign(dop, shares):
    lower, upper = op.intensity_bounds(dop, shares)
    assert 0.0 <= lower <= 1.0 + 1e-15
    assert upper >= 1.0 - 1e-15
    assert (lower, upper) == op.intensity_bounds(dop, [-share for share in shares])


@rows(
    "dop, shares, message",
    [
        (1.5, [], "source_dop"),
        (0.0, [0.1, -2.0], r"diattenuations\[1\]"),
        (0.5, [1j], "complex"),
        (0.5, 0.5, "sequence"),
    ],
)
def test_shares_that_cannot_be_are_refused(dop, shares, message):
    with pytest.raises(op.ParameterError, match=message):
        op.intensity_bounds(dop, shares)


@rows("terms", [1, 2, 3, 4])
@rows("least", [-0.1, -1e-6, -1e-13])
def test_the_sign_of_the_least_eigenvalue_is_told_to_a_few_roundings(terms, least):
    mixed = of_jones(jones(np.random.default_rng(terms), 2000, terms)).sum(axis=-3)
    # The ideal depolariser has the eigenvalues 1/4: of M00 = 1, the least one is known.
    matrices = mixed / mixed[:, :1, :1] + 4.0 * least * np.diag([1.0, 0.0, 0.0, 0.0])
    matrices /= matrices[:, :1, :1]
    values = op.Mueller(matrices).cloude_eigenvalues[:, 3]
    numbers = np.moveaxis(matrices.reshape(-1, 16), -1, 0)
    for spare in (0.0, -0.5 * least, -least, -2.0 * least):
        found = is_physical(NUMPY, numbers, spare)
        assert np.all(found[values > -spare + ROUNDING])
        assert not np.any(found[values < -spare - ROUNDING])


@rows("size", [1e-300, 1.0, 1e300])
def test_elements_of_any_size_are_judged_by_what_they_do(size):
    can_be = [1, 1, 1, 1], [1, 1, -1, -1], [1, 0, 0, 0]
    cannot = [1, 1, 1, -1], [1, 1.001, 1, 1], [0, 1, 0, 0], [-1, -1, -1, -1]
    for diagonal in (*can_be, *cannot):
        numbers = (size * np.diag(diagonal).astype(float)).ravel().tolist()
        assert is_physical(FLOAT, numbers, 1e-12) == (diagonal in can_be), diagonal
