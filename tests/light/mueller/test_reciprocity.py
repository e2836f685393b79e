"""The way back through a system that is known by its Mueller matrix."""

import pickle

import numpy as np
import pytest

import optipath as op
from optipath.light.mueller.reciprocity import reciprocal
from tables import rows

Q = np.diag([1.0, 1.0, -1.0, 1.0])


def mueller_of_jones(jones):
    """A (J x J*) A^-1, of the library's signs of S2 and S3; written without it."""
    a = np.array([[1, 0, 0, 1], [1, 0, 0, -1], [0, 1, 1, 0], [0, 1j, -1j, 0]])
    return (a @ np.kron(jones, jones.conj()) @ np.linalg.inv(a)).real


def test_the_jones_matrix_of_what_is_reciprocal_is_transposed_in_space():
    # De Hoop: in axes that stay, J becomes J^T; light that comes back counts Ey the other way.
    rng, over = np.random.default_rng(5), np.diag([1.0, -1.0])
    for _ in range(20):
        jones = rng.normal(size=(2, 2)) + 1j * rng.normal(size=(2, 2))
        jones /= np.linalg.norm(jones, 2)
        back = op.Mueller(mueller_of_jones(jones)).reversed().matrix
        np.testing.assert_allclose(back, mueller_of_jones(over @ jones.T @ over), atol=2e-15)


def test_products_and_batches_are_reversed_matrix_by_matrix():
    matrices = np.random.default_rng(1).normal(size=(3, 2, 4, 4))
    found = op.Mueller(matrices).reversed().matrix
    expected = [[Q @ matrix.T @ Q for matrix in row] for row in matrices]
    np.testing.assert_array_equal(found, expected)
    there = op.Interface(0.2 + 3j, 1.0, azimuth=0.3).mueller()
    assert there.reversed().reversed() == there
    first = op.Mueller(op.Retarder(1.0, 0.3).mueller().matrix, frame_out=op.Frame().turned(0.7))
    second = op.Polarizer(0.2, leakage=0.3).mueller()
    both, apart = (second @ first).reversed(), first.reversed() @ second.reversed()
    np.testing.assert_allclose(both.matrix, apart.matrix, atol=1e-15)
    there = op.Mueller(np.eye(4), op.Frame().turned(0.2), op.Frame().turned(-0.4))
    back = there.reversed()
    assert back.frame_in == op.Frame().turned(-0.4).reversed()
    assert back.frame_out == op.Frame().turned(0.2).reversed()


@rows("angle", [0.0, 0.3, -1.2])
def test_a_turn_between_frames_has_the_same_numbers_on_the_way_back(angle):
    before, behind = op.Frame(), op.Frame().turned(angle)
    there = before.turn_to(behind)
    np.testing.assert_allclose(behind.reversed().turn_to(before.reversed()), there, atol=1e-15)


def test_noise_precision_slopes_and_pickles_go_through():
    crossed = op.Polarizer("90 deg").mueller() @ op.Polarizer(0.0).mueller()
    assert crossed.noise > crossed.matrix[0, 0]
    assert crossed.reversed().noise == crossed.noise
    back = op.Mueller(np.eye(4, dtype=np.float32)).reversed()
    assert back.matrix.dtype == np.float32
    assert not np.signbit(back.matrix).any()
    back = op.Retarder(1.0, 0.3).mueller().reversed()
    assert pickle.loads(pickle.dumps(back)) == back


def test_slopes_come_through():
    jax = pytest.importorskip("jax")
    slope = jax.jacfwd(reciprocal)(np.eye(4))
    assert slope[1, 2, 2, 1] == -1.0
    assert slope[0, 3, 3, 0] == 1.0
