"""Arrays at equal distances as one."""

import numpy as np

from optipath.sweeps.whole.stacked_views import stacked
from tables import rows


@rows("places", [[0], [0, 1], [1, 3, 5], [4, 2]])
def test_rows_at_equal_distances_are_a_view(places):
    rows = np.random.default_rng(1).normal(size=(6, 4, 3))
    found = stacked([rows[place] for place in places])
    np.testing.assert_array_equal(found, rows[places])
    assert np.may_share_memory(found, rows) or len(places) == 1


@rows(
    "parts",
    [
        [np.arange(3.0), np.arange(3.0)],
        [*np.arange(12.0).reshape(4, 3)[[0, 1]], np.arange(3.0)],
        [np.arange(9.0)[:3], np.arange(9.0)[:6:2]],
    ],
)
def test_others_are_copied(parts):
    np.testing.assert_array_equal(stacked(parts), np.stack(parts))
    assert not stacked(parts).flags.writeable


def test_rows_at_other_distances_are_copied():
    rows = np.arange(12.0).reshape(4, 3)
    found = stacked([rows[0], rows[1], rows[3]])
    np.testing.assert_array_equal(found, rows[[0, 1, 3]])
    assert not np.may_share_memory(found, rows)
