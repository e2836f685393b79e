"""Steps along an axis that are halved where what is drawn over them changes fast."""

import numpy as np
import pytest

from optipath.plots.fine_steps import START, fine_steps
from tables import rows

X = np.linspace(0.0, 1.0, START)


def fine(shape):
    """The steps of one curve, of a height of 1, and how often it was asked for."""
    asked = []

    def at(values):
        asked.append(len(values))
        return shape(values)[:, np.newaxis]

    return fine_steps(X, at(X), at, on_picture=np.asarray), asked


def test_straight_lines_are_asked_for_once_more():
    found, asked = fine(lambda x: 1.0 - x)
    assert found.resolved
    assert asked == [START, START - 1]


@rows("periods", [50, 500, 1000])
def test_waves_are_resolved_to_a_hundredth(periods):
    found, asked = fine(lambda x: 0.5 * np.sin(2.0 * np.pi * periods * x + 0.3))
    x = np.linspace(0.0, 1.0, 100_003)
    drawn = np.interp(x, found.values, found.numbers[:, 0])
    assert found.resolved
    assert np.abs(drawn - 0.5 * np.sin(2.0 * np.pi * periods * x + 0.3)).max() < 0.01
    assert len(asked) <= 6


def test_narrow_lines_are_all_found():
    # As those between mirrors that reflect much: 140 lines, each a twentieth of their distance.
    found, _ = fine(lambda x: 1.0 / (1.0 + 160.0 * np.sin(np.pi * 140.0 * x) ** 2))
    at_lines = np.arange(1, 140) / 140.0
    np.testing.assert_allclose(np.interp(at_lines, *_line(found)), 1.0, atol=0.05)


def _line(found):
    return found.values, found.numbers[:, 0]


def test_waves_too_fast_for_all_points_are_told():
    found, _ = fine(lambda x: np.sin(1e6 * x))
    assert len(found.values) == 32 * (START - 1) + 1
    assert found.told("x").startswith("it changes faster with x than 23041 points tell")


def test_jumps_edges_and_corners_are_no_fast_changes():
    def shape(x):
        return np.where(x > 0.9, np.nan, np.where(x > 0.37, 1.0, np.abs(x - 0.2)))

    found, _ = fine(shape)
    assert found.told("x") == ""
    assert len(found.values) < 1.05 * 2 * START
    there = np.isfinite(found.numbers[:, 0])
    assert found.values[there].max() == pytest.approx(0.9, abs=1e-4)


def test_where_there_is_nothing_at_all_nothing_more_is_asked_for():
    found, asked = fine(lambda x: np.full_like(x, np.nan))
    assert (asked, found.resolved) == ([START], True)
