"""What one out-port gives: to one link all of it, to taps a reading of it."""

import numpy as np
import pytest

import optipath as op
from optipath.paths.drawing import draw
from tables import rows


def filtered_before_the_eye(**link):
    """The two reflections, with one more filter before the eye and the link that was there."""
    path = op.load_preset("npgr026")
    path.add("P2", op.Polarizer(angle=0.3))
    path.connect("X1.reflected", "P2.in", **link)
    path.connect("P2.out", "E.in")
    return path


def tapped_slab():
    """A slab with a tap inside, where light goes to and fro."""
    path = op.load_preset("glass-slab")
    path.add("inside", op.Detector())
    path.connect("front.transmitted", "inside.in", tap=True)
    return path


def faults_of(path):
    with pytest.raises(op.PathError) as error:
        path.check()
    return error.value.faults


def test_a_second_link_of_a_port_is_refused_with_the_cures():
    (fault,) = faults_of(filtered_before_the_eye())
    assert "port 'X1.reflected' feeds 'E.in' and 'P2.in'" in fault
    for cure in ("path.disconnect(", "BeamSplitter", "connect(..., tap=True)", "tap = true"):
        assert cure in fault
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    for name in ("left", "right"):
        lamp >> path.add(name, op.Detector())
    (fault,) = faults_of(path)
    assert "port 'lamp.out' feeds 'left.in' and 'right.in'" in fault
    path = filtered_before_the_eye()
    path.add("D", op.Dump())
    path.connect("X2.reflected", "D.in")
    first, second = faults_of(path)
    assert "'X2.reflected'" in first + second
    assert "'X1.reflected'" in first + second
    path = op.load_preset("npgr026")
    path.add("both", op.Detector())
    path.connect("X1.reflected", "both.in", tap=True)
    path.connect("X2.reflected", "both.in", tap=True)
    (fault,) = faults_of(path)
    assert "meets tap 'X1.reflected -> both.in' at 'both.in'" in fault


def test_a_tap_reads_all_the_light_and_takes_none():
    path = op.load_preset("npgr026", case=8)
    whole = path.trace(keep="all")
    path.add("state", op.Detector())
    path.connect("X2.reflected", "state.in", tap=True)
    lights = path.trace_all()
    np.testing.assert_allclose(lights["E"].stokes, whole["E"].stokes, rtol=1e-14)
    state = whole["X2.reflected -> X1.in"].stokes
    np.testing.assert_allclose(lights["state"].stokes, state, rtol=1e-14, atol=1e-14)
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 1.0, 0.0, 0.0]))
    lamp >> path.add("eye", op.Detector())
    path.add("analyser", op.Polarizer()) >> path.add("meter", op.Detector())
    path.connect("lamp.out", "analyser.in", azimuth=np.pi / 3, tap=True)
    assert path.trace_all()["meter"].intensity == pytest.approx(0.25, abs=1e-15)
    assert path.trace_all()["eye"].intensity == 1.0
    path = op.load_preset("npgr026")
    path.add("lost", op.Detector())
    path.connect("X1.transmitted", "lost.in", tap=True)
    assert "X1.transmitted" in path.compose().outlets
    assert "X1.transmitted has no link" in path.compose().explain()


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


@rows("leaves, enters", [("X1.reflected", "X2.in"), ("X2.reflected", "E.in")])
def test_a_tap_may_not_lead_to_where_other_light_goes(leaves, enters):
    path = op.load_preset("npgr026")
    path.connect(leaves, enters, tap=True)
    faults = faults_of(path)
    told = f"the light of tap '{leaves} -> {enters}' meets other light at '{enters}'"
    assert any(fault.startswith(told) for fault in faults)


def test_a_tap_does_not_merge_with_other_light():
    (fault,) = faults_of(filtered_before_the_eye(tap=True))
    assert "tap 'X1.reflected -> P2.in' meets other light at 'E.in'" in fault
    assert "Detector of its own" in fault
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("eye", op.Detector())
    path.add("sun", op.Source()) >> path.add("sum", op.Combiner()) >> path.add("all", op.Detector())
    path.connect("lamp.out", "sum.in", tap=True)
    (fault,) = faults_of(path)
    assert "'lamp.out -> sum.in' meets other light at 'sum.in'" in fault


def test_a_tap_may_be_tapped_and_its_light_may_part_and_meet_again():
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("eye", op.Detector())
    path.add("split", op.BeamSplitter(0.25))
    path.add("sum", op.Detector())
    path.add("half", op.Detector())
    path.connect("lamp.out", "split.in", tap=True)
    path.connect("split.transmitted", "sum.in")
    path.connect("split.reflected", "sum.in")
    path.connect("split.reflected", "half.in", tap=True)
    lights = path.trace_all()
    assert [lights[n].intensity for n in ("eye", "sum", "half")] == [1.0, 1.0, 0.25]


def test_a_tap_is_told_in_explanations_drawings_and_files(tmp_path):
    path = tapped_slab()
    assert "front.transmitted -> inside.in is a tap" in path.compose().explain()
    assert "transmitted --> inside.in  (a tap)" in draw(path)
    assert "tap = true" in path.to_toml()
    path, file = tapped_slab(), tmp_path / "tapped.toml"
    file.write_text(path.to_toml())
    again = op.load_preset(file)
    assert again == path
    assert again.bind(theta=0.3).compose().taps == ("front.transmitted -> inside.in",)
    file.write_text(path.to_toml().replace("tap = true\n", ""))
    with pytest.raises(op.PathError, match=r"'front\.transmitted' feeds"):
        op.load_preset(file)
    one, other = op.PathGraph(), op.PathGraph()
    for path, tap in ((one, True), (other, False)):
        path.add("lamp", op.Source())
        path.add("eye", op.Detector())
        path.connect("lamp.out", "eye.in", tap=tap)
    assert one != other


@rows("tap", [1, None, "yes"])
def test_a_tap_is_one_or_is_none(tap):
    path = op.load_preset("npgr026")
    path.add("state", op.Detector())
    with pytest.raises(op.PathError, match="tap must be True or False, not"):
        path.connect("X2.reflected", "state.in", tap=tap)


def test_the_ellipsometer_reads_the_state_of_light_by_a_tap():
    assert op.load_preset("ellipsometer-pcsa").compose().taps == ("S.reflected -> state.in",)


@pytest.mark.parametrize("engine", ["numpy", "numba", "jax"])
def test_batches_know_taps(engine):
    if engine != "numpy":
        pytest.importorskip(engine)
    path, angles = op.load_preset("ellipsometer-pcsa"), np.linspace(0.1, 1.4, 40)
    lights = op.Composer(engine=engine).compose(path).run_all(theta=angles)
    for place in (0, 17, 39):
        one = path.trace_all(theta=float(angles[place]))
        np.testing.assert_allclose(
            lights["state"].stokes[place], one["state"].stokes, rtol=0, atol=1e-15
        )
