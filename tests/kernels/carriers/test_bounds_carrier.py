import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from tables import rows

SHARES = st.floats(0.0, 1.0)


def directions(rng, count):
    found = rng.normal(size=(count, 3))
    return found / np.linalg.norm(found, axis=-1, keepdims=True)


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
    axes = [directions(rng, count) for _ in range(length + 1)]
    # Some with all axes along one line, one way or the other.
    for axis in axes:
        axis[::5] = axes[0][::5] * rng.choice([-1.0, 1.0], (len(axis[::5]), 1))
    ratio = behind(dop, diattenuations, axes)
    lower, upper = op.intensity_bounds(dop, list(diattenuations))
    slack = 1e-14 * upper  # What goes to and fro is as large as that.
    assert np.all(ratio <= upper + slack)
    assert np.all(ratio >= lower - slack)
    assert np.max(ratio / upper) > 0.99
    lit = lower > 1e-6
    assert np.max(lower[lit] / ratio[lit]) > 0.99


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
        (np.nan, [0], "dop"),
        ("x", [1.0], "source_dop"),
        (0.5, ["a"], "diattenuations"),
        (1j, [0.5], "complex"),
        (0.5, 0.5, "sequence"),
        (0.5, None, "sequence"),
    ],
)
def test_shares_that_cannot_be_are_refused(dop, shares, message):
    with pytest.raises(op.ParameterError, match=message):
        op.intensity_bounds(dop, shares)
