import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op


def reflections(azimuth):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 0.3, 0.2, 0.1]))
    first = path.add("first", op.Interface(1.5, 0.7))
    second = path.add("second", op.Interface(0.6 + 2.1j, 0.4, azimuth=azimuth))
    lamp >> first >> second >> path.add("eye", op.Detector())
    return path


def reflected(frame, incidence):
    """The frame behind a mirror that light in this frame, x = s, meets at an incidence."""
    turn = np.pi - 2 * incidence
    z = np.cos(turn) * frame.z - np.sin(turn) * frame.y
    return op.Frame.from_direction(z, frame.x)


def placed(azimuth, rotation):
    """The same reflections with world frames, all rotated together."""
    start = op.Frame()
    first_out = reflected(start, 0.7)
    second_in = first_out.turned(azimuth)
    second_out = reflected(second_in, 0.4)
    frames = {
        "lamp": {"out": start},
        "first": {"in": start, "reflected": first_out},
        "second": {"in": second_in, "reflected": second_out},
        "eye": {"in": second_out},
    }
    path = op.PathGraph()
    elements = {
        "lamp": op.Source(stokes=[1.0, 0.3, 0.2, 0.1]),
        "first": op.Interface(1.5, 0.7),
        "second": op.Interface(0.6 + 2.1j, 0.4),
        "eye": op.Detector(),
    }
    nodes = [
        path.add(
            name, element, {port: frame.rotated(rotation) for port, frame in frames[name].items()}
        )
        for name, element in elements.items()
    ]
    nodes[0] >> nodes[1] >> nodes[2] >> nodes[3]
    return path


def rotation_of(quaternion):
    w, x, y, z = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


QUATERNIONS = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1)


@given(azimuth=st.floats(-4, 4), quaternion=QUATERNIONS)
def test_rotating_every_world_frame_changes_no_result(azimuth, quaternion):
    light = placed(azimuth, rotation_of(quaternion)).trace()
    np.testing.assert_allclose(
        light.stokes, reflections(azimuth).trace().stokes, rtol=0, atol=1e-14
    )


def test_light_at_a_placed_detector_has_its_world_frame():
    path = placed(0.3, np.eye(3))
    np.testing.assert_allclose(path.trace().frame.z, path.graph.nodes["eye"]["frames"]["in"].z)


def test_links_between_other_directions_are_refused_with_both_named():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": op.Frame()})
    tilted = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    lamp >> path.add("eye", op.Detector(), {"in": tilted})
    with pytest.raises(op.PathError, match=r"lamp\.out -> eye\.in.*\(0, 0, 1\).*\(0, 1, 0\)"):
        path.trace()


def test_world_frames_that_contradict_the_incidence_are_refused():
    path = op.PathGraph()
    start = op.Frame()
    lamp = path.add("lamp", op.Source(), {"out": start})
    mirror = path.add(
        "mirror", op.Interface(1.5, 0.4), {"in": start, "reflected": reflected(start, 0.7)}
    )
    lamp >> mirror >> path.add("eye", op.Detector())
    with pytest.raises(op.PathError, match=r"incidence of 40\.107.*is 22\.91"):
        path.trace()


def test_world_frames_and_an_azimuth_do_not_mix():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": op.Frame()})
    filter_ = path.add("filter", op.Polarizer(azimuth=0.1), {"in": op.Frame()})
    lamp >> filter_ >> path.add("eye", op.Detector())
    with pytest.raises(op.PathError, match="by its world frames and by an azimuth"):
        path.trace()


def test_a_straight_element_has_one_frame():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": op.Frame()})
    filter_ = path.add("filter", op.Polarizer(), {"in": op.Frame(), "out": op.Frame().turned(0.1)})
    lamp >> filter_ >> path.add("eye", op.Detector())
    with pytest.raises(op.PathError, match="one frame"):
        path.trace()


@given(turn=st.floats(-4, 4))
def test_malus_law_holds_for_a_turn_of_the_frame_and_of_the_axis(turn):
    for analyzer in (op.Polarizer(angle=turn), op.Polarizer(azimuth=turn)):
        path = op.PathGraph()
        first = path.add("first", op.Polarizer())
        path.add("lamp", op.Source(2.0)) >> first >> path.add("second", analyzer)
        path["second"] >> path.add("eye", op.Detector())
        assert path.trace().intensity == pytest.approx(np.cos(turn) ** 2, abs=1e-14)


def test_branches_part_and_merge_incoherently():
    path = op.PathGraph()
    split = path.add("split", op.BeamSplitter(0.25))
    path.add("lamp", op.Source()) >> split
    path.add("across", op.Polarizer(np.pi / 2))
    path.add("along", op.Polarizer())
    meet = path.add("meet", op.Combiner())
    path.connect("split.reflected", "across.in")
    path.connect("split.transmitted", "along.in")
    path["across"] >> meet
    path["along"] >> meet >> path.add("eye", op.Detector())
    np.testing.assert_allclose(path.trace().stokes, [0.5, 0.25, 0, 0], rtol=1e-15, atol=1e-16)


def test_each_arriving_link_may_have_an_azimuth_of_its_own():
    path = op.PathGraph()
    eye = path.add("eye", op.Detector())
    for name, azimuth in (("a", 0.0), ("b", np.pi / 2)):
        path.add(f"lamp-{name}", op.Source()) >> path.add(name, op.Polarizer())
        path.connect(f"{name}.out", "eye.in", azimuth=azimuth)
    np.testing.assert_allclose(path.trace().stokes, [1.0, 0.0, 0, 0], rtol=1e-15, atol=1e-16)
    assert eye.name == "eye"


def test_several_sources_add_up():
    path = op.PathGraph()
    eye = path.add("eye", op.Detector())
    path.add("one", op.Source(1.0)) >> eye
    path.add("two", op.Source(2.0, stokes=[1.0, 0, 0, 1.0])) >> eye
    np.testing.assert_allclose(path.trace().stokes, [3, 0, 0, 2])
    with pytest.raises(op.ParameterError, match="2 sources"):
        path.mueller()
    np.testing.assert_allclose(path.mueller("two", "eye").matrix, np.eye(4))


def test_one_element_may_stand_in_several_places():
    filter_ = op.Attenuator(0.5)
    path = op.PathGraph()
    nodes = [path.add(f"f{i}", filter_) for i in range(3)]
    path.add("lamp", op.Source()) >> nodes[0] >> nodes[1] >> nodes[2]
    nodes[2] >> path.add("eye", op.Detector())
    assert path.trace().intensity == 0.125


def test_the_graph_is_networkx_and_cannot_be_changed():
    path = reflections(0.1)
    assert isinstance(path.graph, nx.MultiDiGraph)
    assert nx.shortest_path(path.graph, "lamp", "eye") == ["lamp", "first", "second", "eye"]
    assert next(iter(path.graph.edges(keys=True))) == ("lamp", "first", ("out", "in"))
    with pytest.raises(nx.NetworkXError, match=r"[Ff]rozen"):
        path.graph.add_node("more")


def test_a_plain_networkx_graph_can_be_composed():
    path = reflections(0.1)
    plain = nx.MultiDiGraph(path.graph)
    assert op.Composer().compose(plain) == path.compose()


def test_adding_a_node_composes_anew():
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("eye", op.Detector())
    assert path.trace().intensity == 1.0
    path.add("lamp2", op.Source(2.0)) >> path["eye"]
    assert path.trace().intensity == 3.0


def test_the_order_in_which_a_path_is_built_does_not_matter():
    one, other = reflections(0.2), op.PathGraph()
    for name in ("eye", "second", "lamp", "first"):
        other.add(name, one.element(name))
    other.connect("second.reflected", "eye.in")
    other.connect("lamp.out", "first.in")
    other.connect("first.reflected", "second.in")
    assert one == other
    assert one.compose() == other.compose()


@pytest.mark.parametrize(
    ("leaves", "enters", "messages"),
    [
        ("split.transmited", "eye.in", ["'split.transmited'", "did you mean 'split.transmitted'"]),
        ("splt.reflected", "eye.in", ["'splt'", "did you mean 'split'"]),
        ("split.in", "eye.in", ["'split.in' lets light in"]),
        ("split.reflected", "split.transmitted", ["'split.transmitted' lets light out"]),
        ("split", "eye.in", ["'split' has no one natural way out", "'split.transmitted'"]),
        ("eye", "split", ["'eye' has no way out, since light ends there"]),
        ("split.reflected.x", "eye.in", ["'split.reflected.x' is no out-port"]),
        ("split.x", "eye.y", ["split.x", "eye.y", "2 faults"]),
        (3, "eye.in", ["3 is no out-port"]),
    ],
)
def test_links_to_ports_that_do_not_exist_are_refused(leaves, enters, messages):
    path = op.PathGraph()
    path.add("split", op.BeamSplitter())
    path.add("eye", op.Detector())
    with pytest.raises(op.PathError) as error:
        path.connect(leaves, enters)
    for message in messages:
        assert message in str(error.value)
    assert path.graph.number_of_edges() == 0


def test_two_ways_out_need_a_port():
    path = op.PathGraph()
    split, eye = path.add("split", op.BeamSplitter()), path.add("eye", op.Detector())
    with pytest.raises(op.PathError, match=r"'split\.reflected', 'split\.transmitted'"):
        split >> eye
    with pytest.raises(op.PathError, match="'eye' has no way out, since light ends there"):
        eye >> split


@pytest.mark.parametrize("name", ["", "a.b", 3, None])
def test_names_that_cannot_be_are_refused(name):
    with pytest.raises(op.PathError, match="node name"):
        op.PathGraph().add(name, op.Source())


def test_a_name_is_given_once():
    path = op.PathGraph()
    path.add("a", op.Source())
    with pytest.raises(op.PathError, match="'a' is there already"):
        path.add("a", op.Detector())


@pytest.mark.parametrize("frames", [op.Frame(), {"out": [1, 0, 0]}, 3])
def test_what_are_no_frames_is_refused(frames):
    with pytest.raises(op.PathError, match="a Frame for each port"):
        op.PathGraph().add("a", op.Source(), frames)


@pytest.mark.parametrize(
    "make",
    [
        lambda: op.PathGraph(description=3),
        lambda: op.PathGraph()["a"],
        lambda: op.PathGraph().element(None),
        lambda: op.Composer().compose(None),
        lambda: op.load_preset("malus").mueller(1),
        lambda: op.Polarizer().mueller(method="stabel"),
        lambda: op.Interface([1.5, 2.0], [0.1, 0.2, 0.3]).mueller(),
    ],
)
def test_wrong_types_are_refused_in_words(make):
    with pytest.raises(op.OptipathError):
        make()


def test_what_is_no_element_is_refused():
    with pytest.raises(op.PathError, match="must be an element"):
        op.PathGraph().add("a", "polarizer")


def test_nodes_of_different_paths_are_not_linked():
    with pytest.raises(op.PathError, match="different paths"):
        op.PathGraph().add("a", op.Source()) >> op.PathGraph().add("b", op.Detector())


def test_a_chain_of_10000_elements_runs_and_multiplies_up():
    path = op.PathGraph()
    node = path.add("lamp", op.Source(stokes=[1.0, 1.0, 0, 0]))
    for i in range(10_000):
        node = node >> path.add(f"r{i}", op.Rotator(np.pi / 10_000))
    node >> path.add("eye", op.Detector())
    np.testing.assert_allclose(path.trace().stokes, [1, 1, 0, 0], rtol=0, atol=1e-11)


def test_steps_grow_with_the_elements():
    def steps(count):
        path = op.PathGraph()
        node = path.add("lamp", op.Source())
        for i in range(count):
            node = node >> path.add(f"m{i}", op.Interface(1.5, op.Parameter("a"), azimuth=0.1))
        node >> path.add("eye", op.Detector())
        return len(path.compose().program.steps)

    assert steps(200) - steps(100) == 200


def test_the_light_on_every_link_and_outlet_is_kept_when_asked():
    path = op.load_preset("npgr026", case="8")
    kept = path.trace(keep="all")
    assert set(kept) == {
        "E",
        "L.out -> P.in",
        "P.out -> X2.in",
        "X2.reflected -> X1.in",
        "X1.reflected -> E.in",
        "X1.transmitted",
        "X2.transmitted",
    }
    np.testing.assert_array_equal(kept["E"].stokes, kept["X1.reflected -> E.in"].stokes)
    # Both interfaces absorb what they do not reflect, and hand it on behind.
    total = kept["X2.reflected -> X1.in"].intensity + kept["X2.transmitted"].intensity
    assert total == pytest.approx(kept["P.out -> X2.in"].intensity, rel=1e-15)
    with pytest.raises(op.ParameterError, match="keep 'some' is unknown"):
        path.trace(keep="some")


def test_a_parameter_called_keep_is_given_by_that_name():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(op.Parameter("keep", default=2.0)))
    lamp >> path.add("eye", op.Detector())
    assert path.trace(keep=3.0).intensity == 3.0
    assert path.trace().intensity == 2.0
    assert set(path.bind(keep=5.0).trace(keep="all")) == {"eye", "lamp.out -> eye.in"}


def test_a_plan_is_kept_by_its_composer():
    path = op.load_preset("malus")
    assert path.plan_by(op.Composer(dtype="float32")) is path.plan_by(op.Composer(dtype="float32"))
    with pytest.raises(op.ComposerError, match=r"a plan is made by a Composer, not \[1\]; write"):
        path.plan_by([1])
