"""What one out-port gives: to one link all of it, to taps a reading of it."""

import numpy as np
import pytest

import optipath as op
from chains import by_engine
from optipath.paths.drawing import draw
from wired import read_back, wired


def tapped(path, leaves, name="tapped"):
    """A path with a detector more, which reads by a tap."""
    path.add(name, op.Detector())
    path.connect(leaves, f"{name}.in", tap=True)
    return path


def filtered_before_the_eye(**link):
    """The two reflections, with one more filter before the eye and the link that was there."""
    path = op.load_preset("npgr026")
    path.add("P2", op.Polarizer(angle=0.3))
    path.connect("X1.reflected", "P2.in", **link)
    path.connect("P2.out", "E.in")
    return path


def tapped_slab():
    """A slab with a tap inside, where light goes to and fro."""
    return tapped(op.load_preset("glass-slab"), "front.transmitted", "inside")


def faults_of(path):
    with pytest.raises(op.errors.PathError) as error:
        path.check()
    return error.value.faults


def test_a_second_link_of_a_port_is_refused_with_the_cures():
    (fault,) = faults_of(filtered_before_the_eye())
    assert "port 'X1.reflected' feeds 'E.in' and 'P2.in'" in fault
    for cure in ("put one behind the other", "BeamSplitter", "connect(..., tap=True)"):
        assert cure in fault
    nodes = {"lamp": op.Source(), "left": op.Detector(), "right": op.Detector()}
    (fault,) = faults_of(wired(nodes, "lamp -> left, lamp -> right"))
    assert "port 'lamp.out' feeds 'left.in' and 'right.in'" in fault
    path = filtered_before_the_eye()
    path.add("D", op.Dump())
    path.connect("X2.reflected", "D.in")
    first, second = faults_of(path)
    assert "'X2.reflected'" in first + second
    assert "'X1.reflected'" in first + second


def test_a_tap_reads_all_the_light_and_takes_none():
    path = op.load_preset("npgr026", case=8)
    whole = path.trace(keep="all")
    lights = tapped(path, "X2.reflected").trace_all()
    np.testing.assert_allclose(lights["E"].stokes, whole["E"].stokes, rtol=1e-14)
    state = whole["X2.reflected -> X1.in"].stokes
    np.testing.assert_allclose(lights["tapped"].stokes, state, rtol=1e-14, atol=1e-14)
    nodes = {"lamp": op.Source(stokes=[1.0, 1.0, 0.0, 0.0]), "eye": op.Detector()}
    nodes |= {"analyser": op.Polarizer(), "meter": op.Detector()}
    path = wired(nodes, "lamp -> eye, analyser -> meter")
    path.connect("lamp.out", "analyser.in", azimuth=np.pi / 3, tap=True)
    assert path.trace_all()["meter"].intensity == pytest.approx(0.25, abs=1e-15)
    assert path.trace_all()["eye"].intensity == 1.0
    plan = tapped(op.load_preset("npgr026"), "X1.transmitted").compose()
    assert "X1.transmitted" in plan.outlets
    assert "X1.transmitted has no link" in plan.explain()


def test_a_tap_in_a_loop_reads_what_has_added_up_there():
    lights = tapped_slab().trace_all()
    untapped = op.load_preset("glass-slab").trace_all()
    for name, light in untapped.items():
        np.testing.assert_allclose(lights[name].stokes, light.stokes, rtol=1e-14, atol=1e-16)
    # What is let in, over 1 less what comes round, for s and for p at 40 deg and n = 1.5.
    c, g = np.cos(np.radians(40.0)), np.sqrt(1.5**2 - np.sin(np.radians(40.0)) ** 2)
    reflectance = np.array([(c - g) / (c + g), (1.5**2 * c - g) / (1.5**2 * c + g)]) ** 2
    s_and_p = 0.5 * (1 - reflectance) / (1 - reflectance**2)
    expected = [s_and_p.sum(), s_and_p[0] - s_and_p[1]]
    np.testing.assert_allclose(lights["inside"].stokes[:2], expected, rtol=1e-13)


def test_a_tap_may_not_lead_to_where_other_light_or_another_tap_goes():
    two = tapped(op.load_preset("npgr026"), "X1.reflected")
    two.connect("X2.reflected", "tapped.in", tap=True)
    merged = filtered_before_the_eye(tap=True)
    nodes = {"lamp": op.Source(), "eye": op.Detector(), "sun": op.Source(), "sum": op.Combiner()}
    summed = wired(nodes | {"all": op.Detector()}, "lamp -> eye, sun -> sum, sum -> all")
    summed.connect("lamp.out", "sum.in", tap=True)
    for path, told in (
        (two, "meets tap 'X1.reflected -> tapped.in' at 'tapped.in'"),
        (merged, "tap 'X1.reflected -> P2.in' meets other light at 'E.in'"),
        (merged, "Detector of its own"),
        (summed, "'lamp.out -> sum.in' meets other light at 'sum.in'"),
    ):
        (fault,) = faults_of(path)
        assert told in fault
    for leaves, enters in (("X1.reflected", "X2.in"), ("X2.reflected", "E.in")):
        path = op.load_preset("npgr026")
        path.connect(leaves, enters, tap=True)
        told = f"the light of tap '{leaves} -> {enters}' meets other light at '{enters}'"
        assert any(fault.startswith(told) for fault in faults_of(path))


def test_a_tap_may_be_tapped_and_its_light_may_part_and_meet_again():
    nodes = {"lamp": op.Source(), "split": op.BeamSplitter(0.25)}
    nodes |= {"eye": op.Detector(), "sum": op.Detector()}
    path = wired(nodes, "lamp -> eye, split.transmitted -> sum, split.reflected -> sum")
    path.connect("lamp.out", "split.in", tap=True)
    lights = tapped(path, "split.reflected").trace_all()
    assert [lights[n].intensity for n in ("eye", "sum", "tapped")] == [1.0, 1.0, 0.25]


def test_a_tap_is_told_in_explanations_drawings_and_files_and_makes_paths_unequal(tmp_path):
    path = tapped_slab()
    assert "front.transmitted -> inside.in is a tap" in path.compose().explain()
    assert "transmitted --> inside.in  (a tap)" in draw(path)
    again = read_back(path, tmp_path)
    assert again == path
    assert again.bind(theta=0.3).compose().taps == ("front.transmitted -> inside.in",)
    assert "tap = true" in path.to_toml()
    one, other = (wired({"lamp": op.Source(), "eye": op.Detector()}, "") for _ in range(2))
    one.connect("lamp.out", "eye.in", tap=True)
    other.connect("lamp.out", "eye.in")
    assert one != other
    for odd in (1, None, "yes"):
        with pytest.raises(op.errors.PathError, match="tap must be True or False, not"):
            op.load_preset("npgr026").connect("X2.reflected", "E.in", tap=odd)


@by_engine
def test_batches_know_the_tap_by_which_an_ellipsometer_reads_the_state(engine):
    path, angles = op.load_preset("ellipsometer-pcsa"), np.linspace(0.1, 1.4, 40)
    assert path.compose().taps == ("S.reflected -> state.in",)
    lights = op.Composer(engine=engine).compose(path).run_all(theta=angles)
    for place in (0, 17, 39):
        one = path.trace_all(theta=float(angles[place]))["state"].stokes
        np.testing.assert_allclose(lights["state"].stokes[place], one, rtol=0, atol=1e-15)
