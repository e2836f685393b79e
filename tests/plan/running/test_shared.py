"""Equal paths are run by what ran the last one, unless something else than they may differ."""

import numpy as np
import pytest

import optipath as op
from optipath.plan.running import shared

FACTOR = {"now": 0.5}


class ReadsOutside(op.Element):
    """An element whose kernel reads what stands outside of it, as cells of a notebook do."""

    angle: op.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        factor = FACTOR["now"] + 0.0 * xp.cos(angle)
        rows = np.eye(4, dtype=int).tolist()
        return [[factor * entry for entry in row] for row in rows]


def path(element):
    made = op.PathGraph()
    lamp = made.add("lamp", op.Source(100.0))
    lamp >> made.add("element", element) >> made.add("eye", op.Detector())
    return made


@pytest.mark.parametrize("angle", [0.2, np.array([0.2, 0.3])])
def test_a_path_built_anew_is_what_its_elements_say_now(angle, monkeypatch):
    for _ in range(6):
        path(ReadsOutside(op.Parameter("a"))).trace(a=angle)
    monkeypatch.setitem(FACTOR, "now", 0.25)
    found = path(ReadsOutside(op.Parameter("a"))).trace(a=angle).intensity
    np.testing.assert_array_equal(found, np.full(np.shape(angle), 25.0))


def test_an_equal_path_built_anew_is_run_by_what_ran_the_last_one():
    first, second = (path(op.Polarizer(op.Parameter("a"))).compose() for _ in range(2))
    assert first.answers.light is second.answers.light


def test_paths_that_differ_in_one_number_are_run_each_by_its_own():
    first, second = (path(op.Attenuator(t)).compose() for t in (0.5, 0.25))
    assert [plan.run().intensity for plan in (first, second)] == [50.0, 25.0]


def test_so_many_runners_are_kept_and_no_more(monkeypatch):
    monkeypatch.setattr(shared, "_MOST", 3)
    for t in np.linspace(0.1, 0.9, 7):
        path(op.Attenuator(float(t))).trace()
    assert len(shared._RUNNERS) <= 3
