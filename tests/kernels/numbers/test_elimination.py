import numpy as np
import pytest
from mpmath import mp

from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.elimination import Elimination
from optipath.kernels.numbers.primitives import FLOAT
from optipath.kernels.numbers.twice import twice
from tables import rows


def system(rng, size, leak):
    """Shares of each unknown that come back as others, of which so little leaves in all."""
    shares = rng.uniform(0, 1, (size, size)) * (rng.random((size, size)) < 0.6)
    shares[(np.arange(size) + 1) % size, np.arange(size)] += 0.1
    leaves = leak * rng.uniform(0.5, 1, size)
    shares *= (1 - leaves) / shares.sum(axis=0)
    back = [{row: float(s) for row, s in enumerate(column)} for column in shares.T]
    return back, leaves.tolist()


def exact(back, leaves, arriving):
    """The same in 50 digits, where what stays is 1 less all that goes elsewhere."""
    with mp.workdps(50):
        size = len(back)
        matrix = mp.matrix(size)
        for column, shares in enumerate(back):
            others = {row: mp.mpf(s) for row, s in shares.items() if row != column}
            matrix[column, column] = sum(others.values(), mp.mpf(leaves[column]))
            for row, share in others.items():
                matrix[row, column] = -share
        return [float(x) for x in mp.lu_solve(matrix, mp.matrix(arriving))]


@rows("leak", [0.3, 1e-6, 1e-12])
@rows("size", [1, 2, 5, 12])
def test_every_digit_stays_however_little_leaves(size, leak):
    rng = np.random.default_rng(size)
    back, leaves = system(rng, size, leak)
    arriving = rng.uniform(0, 1, size).tolist()
    found = Elimination(FLOAT, back, leaves, [True] * size).solved(arriving)
    np.testing.assert_allclose(found, exact(back, leaves, arriving), rtol=2e-14)


def test_what_leaves_is_what_arrived_and_gains_are_told_by_their_pivots():
    rng = np.random.default_rng(7)
    back, leaves = system(rng, 9, 1e-9)
    found = Elimination(FLOAT, back, leaves, [True] * 9).solved([1.0] + [0.0] * 8)
    assert np.dot(found, leaves) == pytest.approx(1.0, rel=1e-14)
    # Of the one, 1/2 comes back as the other, of which 3 come back: 3/2 in a round.
    pivots = Elimination(FLOAT, [{1: 0.5}, {0: 3.0}], [0.5, -2.0], [True, True]).pivots
    assert min(pivots) < 0
    found = Elimination(FLOAT, [{0: 0.5}, {1: 1.0}], [0.5, 0.0], [True, True]).solved([1.0, 0.0])
    assert found == [2.0, 0.0]


def test_a_pivot_that_is_0_by_chance_is_moved_where_light_may_gain():
    # Of x, all comes back as x and as much as y; of y, minus as much: none in the second round.
    xp = twice(FLOAT)
    back = [{0: 1.0, 1: 1.0}, {0: -1.0, 1: -1.0}]
    columns = [{to: DoubleDouble(FLOAT, gain) for to, gain in column.items()} for column in back]
    leaves = [DoubleDouble(FLOAT, -1.0), DoubleDouble(FLOAT, 3.0)]
    system = Elimination(xp, columns, leaves, [True, True], fading=False)
    found = system.solved([DoubleDouble(FLOAT, 1.0), 0.0])
    np.testing.assert_allclose([number.high for number in found], [2.0, 1.0], rtol=1e-15)


def test_unknowns_without_intensity_are_solved_beside_others():
    # x = 1 + q / 4, q = x / 2, where q carries no intensity: of x, all leaves.
    found = Elimination(FLOAT, [{1: 0.5}, {0: 0.25}], [1.0, -0.25], [True, False]).solved(
        [1.0, 0.0]
    )
    np.testing.assert_allclose(found, [8 / 7, 4 / 7], rtol=1e-15)
