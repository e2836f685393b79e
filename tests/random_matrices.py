"""Random Mueller matrices whose parts are known, written without the library."""

import numpy as np


def unit_vectors(rng, count):
    vectors = rng.normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def turn(axis, angle):
    """Rodrigues's formula."""
    x, y, z = axis
    crossed = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * crossed + (1 - np.cos(angle)) * crossed @ crossed


def bordered(lower, row=0.0, column=0.0):
    matrix = np.zeros((*np.shape(lower)[:-2], 4, 4))
    matrix[..., 0, 0] = 1.0
    matrix[..., 0, 1:], matrix[..., 1:, 0], matrix[..., 1:, 1:] = row, column, lower
    return matrix


def diattenuator(vector):
    size = np.linalg.norm(vector)
    along = np.outer(vector, vector) / size**2 if size else np.zeros((3, 3))
    a = np.sqrt(1 - size**2)
    return bordered(a * np.eye(3) + (1 - a) * along, vector, vector)


def parts(rng, count, most=0.99, least=0.05):
    """Depolarizers, retarders and diattenuators, of shape (count, 4, 4) each."""
    turns = [turn(axis, rng.uniform(0, np.pi)) for axis in unit_vectors(rng, 2 * count)]
    sizes = rng.uniform(least, 1.0, (count, 3))
    symmetric = [t @ np.diag(s) @ t.T for t, s in zip(turns[count:], sizes, strict=True)]
    column = rng.uniform(-0.2, 0.2, (count, 3))
    vectors = rng.uniform(0, most, (count, 1)) * unit_vectors(rng, count)
    return (
        bordered(np.array(symmetric), column=column),
        bordered(np.array(turns[:count])),
        np.array([diattenuator(vector) for vector in vectors]),
    )


def of_jones(T):
    """Return the Mueller matrix of a Jones matrix, by 1/2 tr(s_i T s_j T*)."""
    pauli = np.array([[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]])
    return 0.5 * np.einsum("iab,...bc,jcd,...ad->...ij", pauli, T, pauli, np.conj(T)).real


def jones(rng, *shape):
    return rng.normal(size=(*shape, 2, 2)) + 1j * rng.normal(size=(*shape, 2, 2))
