import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from optipath.plan.running.pieces import pieces
from tables import rows


@given(batch=st.lists(st.integers(0, 6), max_size=4).map(tuple), size=st.integers(1, 50))
def test_pieces_follow_each_other_and_cover_the_batch(batch, size):
    numbers = np.arange(np.prod(batch, dtype=int)).reshape(batch)
    found = list(pieces(batch, size))
    for piece in found:
        part = numbers[piece.where].ravel()
        np.testing.assert_array_equal(part, np.arange(piece.start, piece.stop))
        assert part.size <= size
    assert sum(piece.stop - piece.start for piece in found) == numbers.size


@rows("batch", [(), (1,), (3, 4)])
def test_a_batch_that_is_small_enough_is_one_piece(batch):
    assert len(list(pieces(batch, 100))) == 1
