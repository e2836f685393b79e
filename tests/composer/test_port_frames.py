"""Frames of ports: in space as they are placed, else turned against the unit frame of the light."""

import mpmath
import networkx as nx
import numpy as np
import pytest

import optipath as op
from tables import rows

UNIT = op.Frame()


def apart(frame, axes):
    """How far the axes of a frame are from those of 40 digits."""
    with mpmath.workdps(40):
        pairs = zip((frame.x, frame.y, frame.z), axes, strict=True)
        differences = [abs(u - v) for got, axis in pairs for u, v in zip(got, axis, strict=True)]
        return float(max(differences))


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def across(normal, z):
    """The frame of light along z whose x = s is normal cross direction."""
    x = cross(normal, z)
    length = mpmath.sqrt(sum(one * one for one in x))
    x = [one / length for one in x]
    return x, cross(z, x), z


def test_frames_of_the_two_mirrors_in_space_are_those_of_their_planes_of_incidence():
    rng = np.random.default_rng(3)
    for delta, rho, phi in rng.uniform([0.1, -6, 0.1], [1.5, 6, 1.5], (20, 3)).tolist():
        path = op.load_preset("npgr026-3d").with_defaults(delta=delta, rho=rho, phi=phi)
        with mpmath.workdps(40):
            d, r, p = map(mpmath.mpf, (delta, rho, phi))
            up = [mpmath.mpf(0), mpmath.mpf(0), mpmath.mpf(1)]
            # Light arrives in the plane x = 0 and leaves X2 upwards.
            arrives = [0, -mpmath.sin(2 * p), -mpmath.cos(2 * p)]
            at_x2 = [b - a for a, b in zip(arrives, up, strict=True)]
            # At X1 that plane is turned by -rho about the light.
            s, side = [mpmath.cos(r), -mpmath.sin(r), 0], [mpmath.sin(r), mpmath.cos(r), 0]
            leaves = [
                mpmath.sin(2 * d) * one - mpmath.cos(2 * d) * z
                for one, z in zip(side, up, strict=True)
            ]
            at_x1 = [b - a for a, b in zip(up, leaves, strict=True)]
            frames = path["X2"].frames
            assert apart(frames["in"], across(at_x2, arrives)) < 1e-15
            assert apart(frames["reflected"], across(at_x2, up)) < 1e-15
            frames = path["X1"].frames
            assert apart(frames["in"], across(at_x1, up)) < 1e-15
            assert apart(frames["in"], (s, cross(up, s), up)) < 1e-15
            assert apart(frames["reflected"], across(at_x1, leaves)) < 1e-15
        turned = float(path.frames().turns["X2.reflected -> X1.in"])
        assert np.exp(1j * (turned + rho)) == pytest.approx(1.0, abs=1e-14)
        assert path.frames().relative == frozenset()


def test_frames_in_space_are_those_in_which_a_path_gives_its_light():
    for name in op.preset_names():
        path = op.load_preset(name)
        frames = path.frames()
        for place, light in path.trace(keep="all").items():
            node, _, port = place.partition(" -> ")[0].partition(".")
            port = port or "in"
            if f"{node}.{port}" not in frames.relative:
                assert frames[node][port] == light.frame, place
            else:
                assert light.frame == UNIT


def chain(*elements):
    path = op.Source().named("lamp")
    for number, element in enumerate(elements):
        path = path >> element.named(f"e{number}")
    return path >> op.Detector().named("eye")


def test_relative_frames_are_turned_by_each_link_since_light_went_on_another_way():
    path = chain(op.Polarizer(azimuth=0.3), op.Retarder(1.0, azimuth=0.2), op.Mirror(azimuth=0.1))
    frames = path.frames()
    assert frames["lamp"] == {"out": UNIT}
    assert frames["e0"] == {"in": UNIT.turned(0.3), "out": UNIT.turned(0.3)}
    assert frames["e1"] == {"in": UNIT.turned(0.5), "out": UNIT.turned(0.5)}
    assert frames["e2"] == {"in": UNIT.turned(0.6), "reflected": UNIT}
    assert frames["eye"] == {"in": UNIT}
    assert frames.turns["lamp.out -> e0.in"] == 0.3
    assert frames.turns["e1.out -> e2.in"] == 0.1
    assert frames.relative == {f"{node}.{port}" for node, ports in frames.items() for port in ports}


def test_relative_frames_are_those_of_elements_that_light_is_given_to():
    elements = op.Polarizer(0.2, azimuth=0.3), op.Interface(1.5, 0.7, azimuth=0.2), op.Rotator(0.1)
    path, light = chain(*elements), op.Light([1.0, 0.0, 0.0, 0.0])
    for number, element in enumerate(elements):
        light = element @ light
        leaves = "reflected" if number == 1 else "out"
        assert path[f"e{number}"].frames[leaves] == light.frame


def test_a_link_turns_in_place_of_the_element():
    path = op.PathGraph()
    for name, element in {"lamp": op.Source(), "p": op.Polarizer(), "eye": op.Detector()}.items():
        path.add(name, element)
    path.connect("lamp", "p", azimuth="40 deg")
    path.connect("p", "eye", azimuth=op.Parameter("turn", "10 deg"))
    assert path["eye"].frames["in"] == UNIT.turned(np.radians(40.0) + np.radians(10.0))
    assert path.frames(turn=0.0)["eye"]["in"] == path["p"].frames["out"]


def test_frames_of_many_paths_have_their_shape():
    path = chain(op.Polarizer(azimuth=op.Parameter("a")), op.Retarder(1.0, azimuth=0.2))
    angles = np.array([[0.1], [0.2], [0.3]])
    frames = path.frames(a=angles)
    assert frames["eye"]["in"] == UNIT.turned(angles + 0.2)
    assert frames.turns["lamp.out -> e0.in"].shape == (3, 1)
    in_space = op.load_preset("npgr026-3d").frames(rho=[0.1, 0.2, 0.3])
    assert in_space["X1"]["in"].x.shape == (3, 3)


@rows(
    "ask, message",
    [
        (lambda p: p.frames(), "parameter 'a' has no value; give one, a=..."),
        (lambda p: p["e0"].frames, "parameter 'a' has no value; give one, a=..."),
        (lambda p: p.frames(aa=1.0), "parameter 'aa' is unknown"),
        (lambda p: p.frames(0.3), "values are given by name: frames(a=0.3)"),
        (lambda p: p.frames(a="red"), "parameter 'a'"),
    ],
)
def test_a_value_that_a_frame_needs_is_named(ask, message):
    path = chain(op.Polarizer(azimuth=op.Parameter("a")), op.Attenuator(op.Parameter("t")))
    with pytest.raises(op.errors.ParameterError) as error:
        ask(path)
    assert message in str(error.value)


def test_values_that_no_frame_needs_may_be_missing():
    path = chain(op.Attenuator(op.Parameter("t")), op.Polarizer(azimuth=0.2))
    assert path["e1"].frames["in"] == UNIT.turned(0.2)


def test_world_frames_are_given_as_placed_and_to_ends_next_to_them():
    first, second = UNIT.turned(0.2), UNIT.turned(0.5)
    path = op.PathGraph()
    path.add("lamp", op.Source(), {"out": first})
    path.add("p", op.Polarizer(), {"in": second})
    path.add("eye", op.Detector())
    path["lamp"] >> path["p"] >> path["eye"]
    assert path["p"].frames == {"in": second, "out": second}
    assert path["eye"].frames == {"in": second} == {"in": path.trace().frame}
    assert path.frames().turns["lamp.out -> p.in"] == pytest.approx(0.3, abs=1e-15)
    assert path.frames().relative == frozenset()


def test_where_lights_meet_and_in_loops_a_frame_begins():
    loop = op.load_preset("glass-slab").frames()
    assert all(frame == UNIT for ports in loop.values() for frame in ports.values())
    path = op.PathGraph(loops="sum")
    for name in ("lamp", "other"):
        path.add(name, op.Source())
        path.add(f"{name}-filter", op.Polarizer(azimuth=0.3))
        path[name] >> path[f"{name}-filter"]
    path.add("join", op.Combiner()) >> op.Retarder(1.0, azimuth=0.1) >> op.Detector()
    path["lamp-filter"] >> path["join"]
    path["other-filter"] >> path["join"]
    assert path["join"].frames == {"in": UNIT, "out": UNIT}
    assert path["detector"].frames["in"] == UNIT.turned(0.1)


def test_a_ring_of_nothing_but_straight_elements_has_frames():
    path = op.PathGraph()
    path.add("a", op.Rotator(0.1))
    path.add("b", op.Rotator(0.1))
    path["a"] >> path["b"] >> path["a"]
    assert path["a"].frames["in"] == UNIT


def test_turns_of_a_long_chain_add_up():
    graph = nx.path_graph([str(number) for number in range(2000)], create_using=nx.DiGraph)
    nx.set_node_attributes(graph, op.Polarizer(azimuth=2.0**-8), "element")
    graph.nodes["0"]["element"] = op.Source()
    path = op.PathGraph.from_networkx(graph)
    assert path["1999"].frames["out"] == UNIT.turned(f"{1999 * 2.0**-8} rad")
