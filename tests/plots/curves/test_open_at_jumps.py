"""Curves of angles that come back."""

import numpy as np

from optipath.plots.curves.open_at_jumps import open_at_jumps


def opened(angles, period=180.0):
    x, y = open_at_jumps(np.arange(float(len(angles))), np.array(angles, float), period)
    return x.round(6).tolist(), y.round(6).tolist()


def test_curves_are_open_at_jumps_and_gaps_alone():
    assert opened([0.0, 30.0, 60.0]) == ([0.0, 1.0, 2.0], [0.0, 30.0, 60.0])
    x, y = opened([80.0, -70.0])
    assert x == [0.0, 0.333333, 0.333333, 0.333333, 1.0]
    assert np.array_equal(y, [80.0, 90.0, np.nan, -90.0, -70.0], equal_nan=True)
    x, y = opened([-170.0, 170.0], 360.0)
    assert x[1] == 0.5
    assert y[1] == -180.0
    x, y = opened([0.0, 90.0, 89.0])
    assert len(x) == 4
    assert np.isnan(y[1])
    _, y = opened([10.0, np.nan, 12.0])
    assert np.isnan(y[1])
    assert len(y) == 3
