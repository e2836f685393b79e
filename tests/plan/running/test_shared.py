"""Equal paths are run by what ran the last one, unless something else than they may differ."""

import numpy as np
import pytest

import optipath as op
from optipath.plan.running import shared
from tables import rows

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


def pane(*, parallel):
    made = op.PathGraph()
    made.add("lamp", op.Source())
    made.add("front", op.Interface(1.5, op.Parameter("t")))
    made.add("back", op.Interface(1.0, 0.3, outside=1.5, parallel=parallel))
    made.add("eye", op.Detector())
    for begin, end in (
        ("lamp", "front"),
        ("front.transmitted", "back"),
        ("back.transmitted", "eye"),
    ):
        made.connect(begin, end)
    return made


def refracted_in_space(degrees):
    made, theta = op.PathGraph(), np.radians(degrees)
    plane = op.plane_of_incidence((np.sin(theta), 0, -np.cos(theta)), (0, 0, 1))
    inside = np.arcsin(np.sin(theta) / 1.5)
    behind = op.Frame.from_direction((np.sin(inside), 0, -np.cos(inside)), plane.arriving.x)
    made.add("lamp", op.Source(), frames={"out": plane.arriving})
    glass = op.Interface(op.Parameter("n"), op.Parameter("t"))
    made.add("glass", glass, frames={"in": plane.arriving, "transmitted": behind})
    made.add("eye", op.Detector())
    made.connect("lamp", "glass")
    made.connect("glass.transmitted", "eye")
    return made


@rows("turned_first", [True, False])
def test_what_must_agree_is_not_taken_from_a_path_of_equal_steps(turned_first):
    for parallel in (not turned_first, turned_first, not turned_first):
        path = pane(parallel=parallel)
        if parallel:
            with pytest.raises(op.ParameterError, match="parallel=False"):
                path.trace(t=0.8)
        else:
            assert path.trace(t=0.8).S0 > 0.9


def test_world_frames_are_held_to_by_each_path_for_itself():
    for degrees in (45.0, 30.0, 45.0):
        path = refracted_in_space(degrees)
        assert path.trace(n=1.5, t=f"{degrees} deg").S0 > 0.9
        with pytest.raises(op.ParameterError, match="in the world, but by"):
            path.trace(n=1.5, t="20 deg")
