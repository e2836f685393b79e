"""Light paths one by one: which there are, in which order, and what they add up to."""

import numpy as np
import pytest

import optipath as op
from tables import rows


def sum_to(path, end, **asked):
    return sum(way.light.intensity for way in path.paths(**asked) if way.end == end)


def test_the_ways_come_the_brightest_first_and_at_once():
    ways = op.load_preset("glass-slab", theta=0.0).paths(limit=5)
    assert [(way.end, way.bounces) for way in ways] == [
        ("transmitted", 0),
        ("reflected", 1),
        ("reflected", 1),
        ("transmitted", 2),
        ("reflected", 3),
    ]
    # F = 0.04 at each face: T^2, F, T^2 F, T^2 F^2, T^2 F^3.
    expected = [0.96**2, 0.04, 0.96**2 * 0.04, 0.96**2 * 0.04**2, 0.96**2 * 0.04**3]
    np.testing.assert_allclose([way.light.intensity for way in ways], expected, rtol=1e-13)
    assert ways[0].route == ("lamp.out", "front.transmitted", "down.out", "back.transmitted")
    (way,) = rings(12).paths(limit=1)
    assert way.light.intensity == pytest.approx(0.9**12)


@rows("name", ["glass-slab", "coated-metal"])
def test_their_sum_comes_nearer_by_the_gain_of_a_round_trip(name):
    path = op.load_preset(name, theta=0.0)
    whole = path.trace_all()
    if name == "glass-slab":
        end, gain, first = "transmitted", 0.04**2, 0
    else:
        A, *_ = op.fresnel_reflection((0.608 + 2.12j) / 1.5, 1.0, 0.0)
        end, gain, first = "eye", 0.04 * float(A), 1
    left = [
        whole[end].intensity - sum_to(path, end, bounces=first + 2 * rounds) for rounds in range(4)
    ]
    np.testing.assert_allclose(np.divide(left[1:], left[:-1]), gain, rtol=1e-4)


def test_all_ways_of_a_batch_or_path_without_loops_add_up_to_its_light():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(2.0, [1.0, 0.3, 0.4, 0.5]))
    lamp >> path.add("wave", op.Retarder(0.4, 0.3))
    path.add("split", op.BeamSplitter(0.3))
    path.add("turn", op.Rotator(0.5))
    path.add("eye", op.Detector())
    path.connect("wave.out", "split.in")
    path.connect("split.reflected", "turn.in")
    path.connect("turn.out", "eye.in")
    path.connect("split.transmitted", "eye.in")
    ways = path.paths()
    assert [way.bounces for way in ways] == [0, 1]
    total = sum(way.light.stokes for way in ways)
    np.testing.assert_allclose(total, path.trace().stokes, rtol=1e-14)
    path = op.load_preset("glass-slab")
    theta = np.linspace(0, 1.2, 7)
    ways = path.paths(bounces=14, theta=theta)
    total = sum(way.light.intensity for way in ways if way.end == "transmitted")
    assert total.shape == (7,)
    np.testing.assert_allclose(
        total, path.trace_all(theta=theta)["transmitted"].intensity, rtol=1e-6
    )
    way = op.load_preset("npgr026-3d").paths()[0]
    assert way.light.frame == op.load_preset("npgr026-3d").trace().frame


def rings(count, kept=0.9, loss=1.0):
    """So many rings in a row, in each of which a share is kept each time round."""
    path, before = op.PathGraph(loops="sum"), "lamp.out"
    path.add("lamp", op.Source())
    for i in range(count):
        path.add(f"split{i}", op.BeamSplitter(1.0 - kept))
        path.add(f"grey{i}", op.Attenuator(loss))
        path.connect(before, f"split{i}.in")
        path.connect(f"split{i}.reflected", f"grey{i}.in")
        path.connect(f"grey{i}.out", f"split{i}.back")
        before = f"split{i}.transmitted"
    path.add("eye", op.Detector())
    path.connect(before, "eye.in")
    return path


def test_light_that_never_fades_is_refused_and_no_list_without_end():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source()) >> path.add("join", op.Combiner())
    path.add("split", op.BeamSplitter(1.0))
    path["join"] >> path["split"]
    path.connect("split.reflected", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.transmitted", "eye.in")
    with pytest.raises(op.ParameterError, match="never fades"):
        path.paths(limit=1)


def test_what_is_dark_or_behind_a_dark_loop_is_no_way():
    path = rings(1, kept=0.5)
    dark = op.PathGraph(loops="sum")
    for name, element in path.graph.nodes(data="element"):
        dark.add(name, element)
    dark.add("shut", op.Attenuator(0.0))
    for start, end, (leaves, enters) in path.graph.edges(keys=True):
        if end == "eye":
            dark.connect(f"{start}.{leaves}", "shut.in")
            dark.connect("shut.out", "eye.in")
        else:
            dark.connect(f"{start}.{leaves}", f"{end}.{enters}")
    assert dark.paths(limit=1) == []
    crossed = op.Source() >> op.Polarizer() >> op.Polarizer("90 deg") >> op.Detector()
    assert crossed.paths() == []


@rows(
    "asked, message",
    [
        ({}, "goes round at 'front.transmitted' for ever; give a limit, or a number of bounces"),
        ({"limit": 0}, "limit must be a whole number of 1 or more, not 0"),
        ({"limit": 2.5}, "limit must be"),
        ({"bounces": -1}, "bounces must be a whole number of 0 or more, not -1"),
        ({"limit": 3, "thete": 1.0}, "did you mean 'theta'"),
    ],
)
def test_what_cannot_be_listed_is_told(asked, message):
    with pytest.raises(op.ParameterError, match=message):
        op.load_preset("glass-slab").paths(**asked)


def test_a_ring_without_reflections_needs_a_limit():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source()) >> path.add("join", op.Combiner())
    path.add("grey", op.Attenuator(0.5))
    path.add("split", op.BeamSplitter(0.5))
    path["join"] >> path["grey"]
    path.connect("grey.out", "split.in")
    path.connect("split.transmitted", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.reflected", "eye.in")
    with pytest.raises(op.ParameterError, match="for ever; give a limit"):
        path.paths(bounces=3)
    found = path.paths(limit=3)
    np.testing.assert_allclose([way.light.intensity for way in found], [0.25, 0.0625, 0.015625])


@pytest.mark.filterwarnings("ignore::optipath.LoopWarning")
def test_a_search_ends_though_roundings_make_gains_of_reflections():
    # Of these faces, `amplitude` makes more light than there was, by the last digit.
    path, rng = op.load_preset("coated-metal"), np.random.default_rng(0)
    plan = op.Composer(method="amplitude").compose(path)
    for apart in 10.0 ** rng.uniform(-10, -1, 12):
        given = {"theta": float(np.pi / 2 - apart), "k_metal": float(rng.choice([0.0, 5.0]))}
        given["n_metal"] = float(rng.choice([0.0, rng.uniform(0, 2)]))
        ways = plan.paths(limit=4, n=float(rng.uniform(1, 3)), **given)
        intensities = np.array([way.intensity for way in ways])
        assert np.all(np.diff(intensities) <= 1e-14 * intensities[0])


def test_a_search_ends_though_light_is_amplified_or_never_arrives():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0)) >> path.add("join", op.Combiner())
    path.add("amplifier", op.MuellerElement(np.diag([1.5, 0.1, 0.1, 0.1]), physical=False))
    path.add("split", op.BeamSplitter(0.5))
    path.connect("join.out", "amplifier.in")
    path.connect("amplifier.out", "split.in")
    path.connect("split.reflected", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.transmitted", "eye.in")
    ways = path.paths(limit=5)
    np.testing.assert_allclose([way.intensity for way in ways], 0.75 ** np.arange(1, 6))
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, [1, 1, 0, 0])) >> path.add("join", op.Combiner())
    for name in "abc":
        path.add(name, op.BeamSplitter(0.5))
    path.connect("join.out", "a.in")
    path.connect("a.reflected", "b.in")
    path.connect("a.transmitted", "b.back")
    path.connect("b.reflected", "join.in")
    path.connect("b.transmitted", "c.in")
    path.connect("c.reflected", "join.in")
    path.add("crossed", op.Polarizer(np.pi / 2))
    path.connect("c.transmitted", "crossed.in")
    path.add("eye", op.Detector())
    path.connect("crossed.out", "eye.in")
    with pytest.raises(op.ParameterError, match="none arrives anywhere; give a smaller limit"):
        path.paths(limit=3)
