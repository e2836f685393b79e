import numpy as np
import pytest

import optipath as op
from tables import rows

START = op.Frame()
SIDE = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
"""Behind a mirror at 45 degrees."""


def faults_of(element, frames, leaves):
    path = op.PathGraph()
    path.add("lamp", op.Source(), {"out": START})
    path.add("element", element, {"in": START, **frames})
    path.add("eye", op.Detector())
    path.connect("lamp.out", "element.in")
    path.connect(f"element.{leaves}", "eye.in")
    try:
        path.check()
    except op.PathError as error:
        return " | ".join(error.faults)
    return ""


@rows("incidence", [np.pi / 4, [np.pi / 4, np.pi / 4]])
def test_an_incidence_that_agrees_with_the_frames_is_allowed(incidence):
    assert faults_of(op.Interface(1.5, incidence), {"reflected": SIDE}, "reflected") == ""


@rows(
    "incidence, message",
    [
        (np.pi / 4 + 1e-6, "incidence of 45 deg, but its incidence is 45.0000573 deg"),
        (op.Parameter("t"), "incidence of 45 deg; give that, not the parameter 't'"),
        (op.Parameter("t", 0.1, bound=True), "but its incidence is 5.72957795 deg"),
    ],
)
def test_an_incidence_that_the_frames_contradict_is_refused(incidence, message):
    assert message in faults_of(op.Interface(1.5, incidence), {"reflected": SIDE}, "reflected")


def test_grazing_frames_are_told_from_nearly_grazing_ones():
    nearly = op.Frame.from_direction(z=(0, np.sin(1.4e-3), np.cos(1.4e-3)), x=(1, 0, 0))
    found = faults_of(op.Interface(1.5, np.pi / 2), {"reflected": nearly}, "reflected")
    assert "but its incidence is 90 deg" in found


@rows("element", [op.Interface(1.5, np.pi / 4), op.BeamSplitter()])
@rows("turn", [1e-4, 0.5])
def test_reflected_light_keeps_its_x(element, turn):
    found = faults_of(element, {"reflected": SIDE.turned(turn)}, "reflected")
    assert "must share one x" in found


def test_light_that_a_splitter_transmits_keeps_its_frame():
    found = faults_of(op.BeamSplitter(), {"transmitted": START.turned(0.1)}, "transmitted")
    assert "straight through" in found
    assert faults_of(op.BeamSplitter(), {"transmitted": START}, "transmitted") == ""


MEETS = op.plane_of_incidence([0.3, 0.2, -0.9], [0, 0, 1])
INSIDE = np.arcsin(MEETS.sin / 1.5)


def rounded(frame):
    return op.Frame(*map(np.float32, (frame.x, frame.y, frame.z)))


@pytest.mark.parametrize(
    "element",
    [
        op.Interface(1.5, MEETS.incidence),
        op.Mirror(),
        op.BeamSplitter(),
        op.LayerStack([1, 1.5], MEETS.incidence),
    ],
)
def test_elements_that_reflect_stand_in_frames_of_single_precision(element, tmp_path):
    arriving, reflected = MEETS.arriving, MEETS.reflected
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1, 0.4, 0.3, 0.2]), {"out": arriving})
    path.add("element", element, {"in": rounded(arriving), "reflected": rounded(reflected)})
    path.add("eye", op.Detector(), {"in": reflected})
    path.connect("lamp", "element")
    path.connect("element.reflected", "eye")
    exact = element.mueller("in", "reflected").matrix @ [1, 0.4, 0.3, 0.2]
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml())
    for light in (path.trace(), op.load_preset(file).trace()):
        np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=2e-6)


def test_light_refracted_between_frames_of_single_precision_is_placed_by_them():
    into = op.Frame.from_direction(
        np.sin(INSIDE) * np.array([0.3, 0.2, 0]) / np.hypot(0.3, 0.2) - [0, 0, np.cos(INSIDE)],
        MEETS.arriving.x,
    )
    for kept in (["in", "reflected"], ["in", "transmitted"]):
        frames = {"in": MEETS.arriving, "reflected": MEETS.reflected, "transmitted": into}
        path = op.PathGraph()
        path.add("lamp", op.Source(), {"out": MEETS.arriving})
        glass = op.Interface(1.5, np.float32(MEETS.incidence))
        path.add("glass", glass, {port: rounded(frames[port]) for port in kept})
        path.add("eye", op.Detector(), {"in": into})
        path.connect("lamp", "glass")
        path.connect("glass.transmitted", "eye")
        s = (np.sin(MEETS.incidence - INSIDE) / np.sin(MEETS.incidence + INSIDE)) ** 2
        p = (np.tan(MEETS.incidence - INSIDE) / np.tan(MEETS.incidence + INSIDE)) ** 2
        assert path.trace().intensity == pytest.approx(1 - (s + p) / 2, rel=1e-6)
