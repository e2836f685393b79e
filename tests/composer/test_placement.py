"""World frames: what follows from those that are given, and what does not fit together."""

import numpy as np
import pytest

import optipath as op
from tables import rows

SIDE = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
THETA = float(np.radians(40.0))


def window(index=1.5, **more):
    """A pane hit at 40 degrees, light falling along -z in the y-z plane."""
    path = op.PathGraph()
    meets = op.plane_of_incidence((0.0, np.sin(THETA), -np.cos(THETA)), normal=(0.0, 0.0, 1.0))
    path.add("lamp", op.Source(), frames={"out": meets.arriving})
    frames = {"in": meets.arriving, "reflected": meets.reflected, **more}
    path.add("pane", op.Interface(index, THETA), frames=frames)
    path.add("eye", op.Detector())
    path.connect("lamp.out", "pane.in")
    path.connect("pane.reflected", "eye.in")
    return path


def test_refracted_light_travels_as_snell_has_it():
    frame = window().trace(keep="all")["pane.transmitted"].frame
    sine = np.sin(THETA) / 1.5
    np.testing.assert_allclose(frame.z, [0.0, sine, -np.sqrt(1 - sine**2)], rtol=0, atol=1e-15)
    np.testing.assert_allclose(np.abs(frame.x), [1.0, 0.0, 0.0], rtol=0, atol=1e-15)


def test_light_that_passes_a_beam_splitter_keeps_its_frame():
    path = op.PathGraph()
    path.add("lamp", op.Source(), frames={"out": op.Frame()})
    path.add("split", op.BeamSplitter(), frames={"in": op.Frame(), "reflected": SIDE})
    path.connect("lamp.out", "split.in")
    for name, port in (("straight", "transmitted"), ("aside", "reflected")):
        path.add(name, op.Detector())
        path.connect(f"split.{port}", f"{name}.in")
    lights = path.trace_all()
    assert lights["straight"].frame == op.Frame()
    assert lights["aside"].frame == SIDE


def test_frames_that_break_snells_law_or_are_missing_are_told():
    wrong = op.plane_of_incidence((0.0, np.sin(THETA), -np.cos(THETA)), (0.0, 0.0, 1.0)).arriving
    path = window(transmitted=wrong)
    with pytest.raises(op.PathError, match=r"'pane\.transmitted' is turned by 0 deg .* 14\.6"):
        path.check()
    path = window(index=op.Parameter("n"))
    path.add("behind", op.Detector())
    path.connect("pane.transmitted", "behind.in")
    with pytest.raises(op.PathError, match=r"'pane\.transmitted' has no world frame, though"):
        path.check()


@rows("placed", [{}, {"in": op.Frame()}])
def test_light_from_directions_that_differ_cannot_meet(placed):
    path = op.PathGraph()
    for name, frame in (("a", op.Frame()), ("b", SIDE)):
        path.add(name, op.Source(), frames={"out": frame})
    path.add("eye", op.Detector(), frames=placed)
    for name in "ab":
        path.connect(f"{name}.out", "eye.in")
    with pytest.raises(op.PathError, match=r"travels along \(0, [01], [01]\) cannot be aligned"):
        path.check()


def test_light_that_has_passed_elements_meets_only_in_its_direction():
    path = op.PathGraph()
    for name, frame in (("a", op.Frame()), ("b", SIDE)):
        path.add(name, op.Source(), frames={"out": frame})
        other = op.Frame.from_direction(z=frame.y, x=frame.x)
        path.add(f"{name}s", op.BeamSplitter(), frames={"in": frame, "reflected": other})
        path.connect(f"{name}.out", f"{name}s.in")
    path.add("eye", op.Detector())
    for name in "ab":
        path.connect(f"{name}s.transmitted", "eye.in")
    with pytest.raises(op.PathError, match="from directions that differ cannot meet at 'eye'"):
        path.check()
