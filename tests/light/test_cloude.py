"""Cloude's eigenvalues: what can exist, and what is nearest to it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from random_matrices import jones, of_jones
from tables import rows

PAULI = np.array([[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]])


@rows("count", [1, 2, 3, 4, 6])
@rows("scale", [1e-290, 1.0, 1e290])
def test_a_mixture_has_an_eigenvalue_for_each_jones_matrix(count, scale):
    rng = np.random.default_rng(count)
    weights = rng.uniform(0.1, 1.0, (20, count, 1, 1))
    mixed = op.Mueller(scale * (weights * of_jones(jones(rng, 20, count))).sum(axis=1))
    values = mixed.cloude_eigenvalues / mixed.matrix[..., :1, 0]
    rank = min(count, 4)
    assert (values[:, :rank] > 1e-4).all()
    np.testing.assert_allclose(values[:, rank:], 0.0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(values.sum(axis=-1), 1.0, rtol=1e-14)
    assert (np.diff(values) <= 0.0).all()
    assert mixed.is_physical().all()


def test_the_coherency_is_the_mean_of_the_products_of_pauli_components():
    rng = np.random.default_rng(3)
    T = jones(rng, 5)
    c = 0.5 * np.einsum("kab,nba->nk", PAULI, T)
    mean = np.einsum("nk,nl->kl", c, c.conj())
    found = op.Mueller(of_jones(T).sum(axis=0)).coherency
    np.testing.assert_allclose(found, mean, rtol=1e-13, atol=1e-14)
    np.testing.assert_array_equal(found, found.conj().T)


def test_what_cannot_exist_is_told_and_no_size_hides_it():
    for matrix in (
        *[np.diag([1.0, 1.0, 1.0, -1.0]), np.diag([1.0, 1.2, 1.0, 1.0]), np.diag([0.0, 1, 1, 1])],
        *[-np.eye(4), np.full((4, 4), np.nan)],
    ):
        assert not op.Mueller(matrix).is_physical()
    for scale in (1.7e308, 1.0, 1e-310):
        unlike = op.Mueller(scale * (np.diag([1.0, 1.0, 1.0, -1.0]) + np.eye(4, k=1)))
        assert not unlike.is_physical(), scale
        assert op.Mueller(scale * np.eye(4)).is_physical(), scale
    for element in (op.Polarizer(0.3), op.Retarder(1.0, 0.2), op.Interface(0.6 + 2.1j, 0.8)):
        assert element.mueller().is_physical()
    assert op.Mueller(np.zeros((4, 4))).is_physical(tolerance=0.0)
    np.testing.assert_allclose(op.Mueller(np.diag([1.0, 0, 0, 0])).cloude_eigenvalues, 0.25)


def test_the_tolerance_is_against_the_largest_eigenvalue_by_default_of_the_precision():
    slightly = op.Mueller(1e-100 * np.diag([1.0, 1.0, 1.0, 1.0 - 4e-6]))
    slightly_not = op.Mueller(1e-100 * np.diag([1.0, 1.0, 1.0, 1.0 + 4e-6]))
    assert slightly.is_physical(tolerance=1e-5)
    assert slightly_not.is_physical(tolerance=1.1e-6)
    assert not slightly_not.is_physical(tolerance=0.9e-6)
    T = jones(np.random.default_rng(9), 300)
    single = of_jones(T).astype(np.float32)
    assert op.Mueller(single).is_physical().all()
    assert not op.Mueller(single.astype(np.float64)).is_physical().all()
    assert not op.Mueller(single).is_physical(tolerance=1e-9).all()
    for dtype in (np.float32, np.float64, np.longdouble):
        assert not op.Mueller(np.diag([1.0, 1.0, 1.0, 1.0 + 1e-4]).astype(dtype)).is_physical()


def test_a_tolerance_is_a_finite_number_of_at_least_0():
    for wrong in (-1e-9, np.nan, np.inf, "1e-9", [1e-9], True, 10**400):
        with pytest.raises(op.errors.ValueFault, match=r"give a number >= 0") as fault:
            op.Mueller(np.eye(4)).is_physical(wrong)
        assert repr(wrong)[:20] in str(fault.value)
    for right in (0, 1e-9, np.float32(1e-9), np.array(1e-9)):
        assert op.Mueller(np.eye(4)).is_physical(right)


@given(seed=st.integers(0, 10**6), power=st.integers(-280, 280))
def test_no_physical_matrix_is_nearer_than_the_nearest(seed, power):
    rng = np.random.default_rng(seed)
    noisy = op.Mueller(10.0**power * rng.normal(size=(4, 4)))
    nearest = noisy.nearest_physical()
    assert nearest.is_physical(tolerance=1e-13)
    distance = np.linalg.norm((nearest.matrix - noisy.matrix) / 10.0**power)
    other = of_jones(jones(rng, 4)).sum(axis=0)
    between = nearest.matrix / 10.0**power + 1e-3 * (other - nearest.matrix / 10.0**power)
    assert np.linalg.norm(between - noisy.matrix / 10.0**power) >= distance - 1e-12


def test_what_is_physical_is_its_own_nearest_and_what_is_not_known_stays_so():
    metal = op.Interface(0.6 + 2.1j, 0.8).mueller()
    nearest = metal.nearest_physical()
    np.testing.assert_allclose(nearest.matrix, metal.matrix, rtol=0, atol=1e-15)
    assert (nearest.frame_in, nearest.frame_out) == (metal.frame_in, metal.frame_out)
    matrices = np.stack([np.eye(4), np.eye(4), np.eye(4)])
    matrices[1, 3], matrices[2, 0, 0] = np.nan, np.inf
    mixed = op.Mueller(matrices)
    np.testing.assert_array_equal(mixed.is_physical(), [True, False, False])
    for found in (mixed.coherency, mixed.nearest_physical().matrix):
        np.testing.assert_array_equal(np.isnan(found).all(axis=(1, 2)), [False, True, True])
    np.testing.assert_array_equal(np.isnan(mixed.cloude_eigenvalues[:, 0]), [False, True, True])
