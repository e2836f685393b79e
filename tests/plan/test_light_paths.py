"""Light paths one by one: which there are, in which order, and what they add up to."""

import numpy as np
import pytest

import optipath as op
from tables import rows
from wired import wired


def rings(count, kept=0.9, behind=None):
    """So many rings in a row, in each of which a share is kept each time round."""
    nodes, links, before = {"lamp": op.Source(), "eye": op.Detector()}, "", "lamp"
    for i in range(count):
        nodes[f"split{i}"] = op.BeamSplitter(1.0 - kept)
        links += f"{before} -> split{i}.in, split{i}.reflected -> split{i}.back, "
        before = f"split{i}.transmitted"
    if behind is not None:
        nodes["behind"] = behind
        links, before = f"{links}{before} -> behind, ", "behind"
    return wired(nodes, f"{links}{before} -> eye", loops="sum")


def joined(inner, leaves, enters, share=0.5):
    """Light that goes round by a way of a splitter, through an element, and leaves by the other."""
    nodes = {"lamp": op.Source(), "join": op.Combiner(), "inner": inner, "eye": op.Detector()}
    links = f"lamp -> join, join -> inner, inner -> split, split.{enters} -> join, "
    nodes["split"] = op.BeamSplitter(share)
    return wired(nodes, f"{links}split.{leaves} -> eye", loops="sum")


def test_the_ways_come_the_brightest_first_and_at_once():
    ways = op.load_preset("glass-slab", theta=0.0).paths(limit=5)
    ends = ["transmitted", "reflected", "reflected", "transmitted", "reflected"]
    assert [way.end for way in ways] == ends
    assert [way.bounces for way in ways] == [0, 1, 1, 2, 3]
    # F = 0.04 at each face: T^2, F, T^2 F, T^2 F^2, T^2 F^3.
    expected = [0.96**2, 0.04, 0.96**2 * 0.04, 0.96**2 * 0.04**2, 0.96**2 * 0.04**3]
    np.testing.assert_allclose([way.light.intensity for way in ways], expected, rtol=1e-13)
    assert ways[0].route == ("lamp.out", "front.transmitted", "down.out", "back.transmitted")
    (way,) = rings(12).paths(limit=1)
    assert way.light.intensity == pytest.approx(0.9**12)


METAL, *_ = op.fresnel_reflection((0.608 + 2.12j) / 1.5, 1.0, 0.0)


@rows(
    "name, end, gain, first",
    [("glass-slab", "transmitted", 0.04**2, 0), ("coated-metal", "eye", 0.04 * float(METAL), 1)],
)
def test_their_sum_comes_nearer_by_the_gain_of_a_round_trip(name, end, gain, first):
    path = op.load_preset(name, theta=0.0)
    left = [
        path.trace_all()[end].intensity
        - sum(w.intensity for w in path.paths(bounces=first + 2 * i) if w.end == end)
        for i in range(4)
    ]
    np.testing.assert_allclose(np.divide(left[1:], left[:-1]), gain, rtol=1e-4)


def test_all_ways_of_a_batch_or_path_without_loops_add_up_to_its_light():
    nodes = {"lamp": op.Source(2.0, [1.0, 0.3, 0.4, 0.5]), "wave": op.Retarder(0.4, 0.3)}
    nodes |= {"split": op.BeamSplitter(0.3), "turn": op.Rotator(0.5), "eye": op.Detector()}
    links = "lamp -> wave, wave -> split, split.reflected -> turn, turn -> eye, "
    path = wired(nodes, links + "split.transmitted -> eye")
    ways = path.paths()
    assert [way.bounces for way in ways] == [0, 1]
    total = sum(way.light.stokes for way in ways)
    np.testing.assert_allclose(total, path.trace().stokes, rtol=1e-14)
    path, theta = op.load_preset("glass-slab"), np.linspace(0, 1.2, 7)
    ways = path.paths(bounces=14, theta=theta)
    total = sum(way.light.intensity for way in ways if way.end == "transmitted")
    assert total.shape == (7,)
    expected = path.trace_all(theta=theta)["transmitted"].intensity
    np.testing.assert_allclose(total, expected, rtol=1e-6)
    path = op.load_preset("npgr026-3d")
    assert path.paths()[0].light.frame == path.trace().frame


def test_what_is_dark_or_behind_a_dark_loop_is_no_way():
    assert rings(1, kept=0.5, behind=op.Attenuator(0.0)).paths(limit=1) == []
    crossed = op.Source() >> op.Polarizer() >> op.Polarizer("90 deg") >> op.Detector()
    assert crossed.paths() == []


SLAB = op.load_preset("glass-slab")
# Without a reflection, bounces are no limit.
RING = joined(op.Attenuator(0.5), "reflected", "transmitted")


@rows(
    "path, asked, message",
    [
        (SLAB, {}, "goes round at 'front.transmitted' for ever; give a limit, or a number of bou"),
        (SLAB, {"limit": 0}, "limit must be a whole number of 1 or more, not 0"),
        (SLAB, {"bounces": -1}, "bounces must be a whole number of 0 or more, not -1"),
        (SLAB, {"limit": 3, "thete": 1.0}, "did you mean 'theta'"),
        (RING, {"bounces": 3}, "for ever; give a limit"),
        (joined(op.Attenuator(1.0), "transmitted", "reflected", 1.0), {"limit": 1}, "never fades"),
    ],
)
def test_what_cannot_be_listed_is_told(path, asked, message):
    with pytest.raises(op.errors.ParameterError, match=message):
        path.paths(**asked)


def test_light_that_goes_round_without_reflections_or_is_amplified_is_listed_up_to_a_limit():
    found = [way.light.intensity for way in RING.paths(limit=3)]
    np.testing.assert_allclose(found, [0.25, 0.0625, 0.015625])
    amplifier = op.MuellerElement(np.diag([1.5, 0.1, 0.1, 0.1]), physical=False)
    ways = joined(amplifier, "transmitted", "reflected").paths(limit=5)
    np.testing.assert_allclose([way.intensity for way in ways], 0.75 ** np.arange(1, 6))


@pytest.mark.filterwarnings("ignore::optipath.errors.LoopWarning")
def test_a_search_ends_though_roundings_make_gains_of_reflections():
    # Of these faces, `amplitude` makes more light than there was, by the last digit.
    path, rng = op.load_preset("coated-metal"), np.random.default_rng(0)
    plan = op.Composer(method="amplitude").compose(path)
    for apart in 10.0 ** rng.uniform(-10, -1, 4):
        given = {"theta": float(np.pi / 2 - apart), "k_metal": float(rng.choice([0.0, 5.0]))}
        given["n_metal"] = float(rng.choice([0.0, rng.uniform(0, 2)]))
        ways = plan.paths(limit=4, n=float(rng.uniform(1, 3)), **given)
        intensities = np.array([way.intensity for way in ways])
        assert np.all(np.diff(intensities) <= 1e-14 * intensities[0])


def test_a_search_ends_though_no_light_ever_arrives():
    nodes = {"lamp": op.Source(1.0, [1, 1, 0, 0]), "join": op.Combiner(), "eye": op.Detector()}
    nodes |= {name: op.BeamSplitter(0.5) for name in "abc"} | {"crossed": op.Polarizer(np.pi / 2)}
    links = "lamp -> join, join -> a.in, a.reflected -> b.in, a.transmitted -> b.back, "
    links += "b.reflected -> join, b.transmitted -> c.in, c.reflected -> join, "
    path = wired(nodes, links + "c.transmitted -> crossed, crossed -> eye", loops="sum")
    with pytest.raises(
        op.errors.ParameterError, match="none arrives anywhere; give a smaller limit"
    ):
        path.paths(limit=3)
