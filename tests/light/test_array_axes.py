"""Mueller matrices are arrays of matrices, as light is one of lights (test_array_of_light.py)."""

import numpy as np
import pytest

import optipath as op
from tables import rows

ANGLES = np.array([[0.0, 0.1, 0.2], [0.3, 0.4, 0.5]])
SHEETS = op.Interface(1.5, 0.8, azimuth=ANGLES).mueller()
RETARDERS = op.Retarder(ANGLES).mueller()


def test_numpy_reads_the_numbers_of_a_matrix():
    np.testing.assert_array_equal(np.asarray(op.Mueller(np.eye(4))), np.eye(4))
    assert np.asarray(RETARDERS, dtype=np.float32).shape == (2, 3, 4, 4)


def test_a_matrix_has_the_shape_of_its_batch():
    assert (RETARDERS.shape, RETARDERS.ndim, RETARDERS.size, len(RETARDERS)) == ((2, 3), 2, 6, 2)
    assert [row.shape for row in RETARDERS] == [(3,), (3,)]
    assert RETARDERS.reshape(-1).shape == (6,)
    assert op.Mueller(np.eye(4)).shape == ()


@rows("key", [0, (1, 2), (..., 1), slice(1), ANGLES > 0.2, (None, 0)])
def test_a_part_of_a_batch_of_matrices_is_that_of_its_values(key):
    expected = op.Interface(1.5, 0.8, azimuth=ANGLES[key]).mueller()
    np.testing.assert_allclose(
        SHEETS[key].matrix, expected.matrix * np.ones_like(SHEETS[key].matrix)
    )
    np.testing.assert_allclose(SHEETS[key].frame_in.x, expected.frame_in.x, rtol=1e-15)
    expected = op.Retarder(ANGLES[key]).mueller().matrix
    np.testing.assert_allclose(RETARDERS[key].matrix, expected, rtol=1e-15, atol=1e-16)


@rows("call", [len, iter, list, bool, lambda m: m[0, 1], lambda m: m.reshape(2)])
def test_a_single_matrix_is_no_batch_and_says_so(call):
    with pytest.raises(op.OptipathError, match=r"Mueller matri(x|ces).*(mueller\.matrix|shape 2)"):
        call(op.Mueller(np.eye(4)))
