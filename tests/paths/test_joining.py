"""Paths in one line: elements and paths put one behind the other by ``>>``."""

import numpy as np
import pytest

import optipath as op


class WavePlate(op.Element):
    """An element of one's own, without a kind."""

    retardance: op.Angle = 0.5

    @staticmethod
    def mueller_rows(xp, retardance):
        c, s = xp.cos(retardance), xp.sin(retardance)
        return (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, c, s), (0, 0, -s, c)


class Periscope(op.Element, kind="test.periscope"):
    """Ports of its own names, one of each."""

    inputs = ("below",)
    outputs = ("above",)

    def couplings(self):
        return (op.Coupling("below", "above", ()),)


def reflected():
    return op.Source(100.0) >> op.Polarizer(0.5) >> op.Interface(1.5, 0.9) >> op.Detector()


def names(path):
    return list(path.graph)


def test_a_chain_of_elements_is_the_path_that_is_built_node_by_node():
    built = op.PathGraph()
    built.add("source", op.Source(100.0))
    built.add("polarizer", op.Polarizer(0.5))
    built.add("interface", op.Interface(1.5, 0.9))
    built.add("detector", op.Detector())
    built.connect("source.out", "polarizer.in")
    built.connect("polarizer.out", "interface.in")
    built.connect("interface.reflected", "detector.in")
    chained = reflected()
    assert type(chained) is op.PathGraph
    assert chained == built
    # Brewster's angle is 56.3 deg: light along p, y, is let through whole there.
    np.testing.assert_array_equal(chained.trace().stokes, built.trace().stokes)


def test_nodes_are_named_by_kind_and_numbered():
    path = op.Source() >> op.Polarizer() >> op.Polarizer(0.2) >> op.Polarizer(0.4) >> op.Detector()
    assert names(path) == ["source", "polarizer", "polarizer-2", "polarizer-3", "detector"]
    assert path.trace().intensity == pytest.approx(0.5 * np.cos(0.2) ** 4)


def test_elements_without_a_kind_are_named_by_their_class_and_names_have_no_dot():
    path = op.Source() >> WavePlate() >> Periscope() >> op.Detector()
    assert names(path) == ["source", "wave-plate", "test-periscope", "detector"]
    assert path.trace().intensity == 1.0


def test_nodes_of_a_chain_take_names():
    path = op.Source().named("lamp") >> op.Polarizer().named("analyser") >> op.Detector()
    assert names(path) == ["lamp", "analyser", "detector"]
    assert path.trace_all().keys() == {"detector"}


@pytest.mark.parametrize("name", ["a.b", "", 3])
def test_names_in_a_chain_are_checked(name):
    with pytest.raises(op.PathError, match="must be a text without a dot"):
        op.Source() >> op.Polarizer().named(name)


def test_parameters_in_a_chain_are_open():
    path = op.Source() >> op.Interface(1.5, op.Parameter("theta")) >> op.Detector()
    assert path.trace(theta=0.0).intensity == pytest.approx(0.04, abs=1e-15)


def test_a_chain_changes_neither_side():
    start, end = op.Source() >> op.Polarizer(), op.Polarizer(0.3) >> op.Detector()
    whole = start >> end
    assert [len(path.graph) for path in (start, end, whole)] == [2, 2, 4]
    assert start >> end == whole
    other = start >> op.Detector()
    assert other.trace().intensity == 0.5
    start.add("more", op.Dump())
    assert "more" not in whole.graph


def test_a_chain_does_not_depend_on_where_it_is_cut():
    a, b, c, d = op.Source(), op.Polarizer(0.1), op.Polarizer(0.2), op.Detector()
    whole = a >> b >> c >> d
    assert a >> (b >> c >> d) == whole
    assert a >> (b >> (c >> d)) == whole
    assert (a >> b) >> (c >> d) == whole
    assert op.PathGraph() >> a >> b >> c >> d == whole


def test_names_that_were_given_stand_on_one_side():
    one, other = op.Source() >> op.Polarizer().named("a"), op.Polarizer().named("a") >> op.Dump()
    with pytest.raises(op.PathError, match="node 'a' stands on both sides of >>"):
        one >> other


def test_a_path_goes_on_at_its_only_open_natural_way():
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("split", op.BeamSplitter(0.25))
    path.add("rest", op.Dump())
    path.connect("lamp", "split")
    with pytest.raises(op.PathError, match=r"one by its name: 'split.reflected', 'split.trans"):
        path >> op.Detector()
    path.connect("split.transmitted", "rest")
    with pytest.raises(op.PathError, match=r"one by its name: 'split.reflected'"):
        path >> op.Detector()
    path.add("filter", op.Polarizer())
    path.connect("split.reflected", "filter")
    assert (path >> op.Detector()).trace().intensity == 0.125


def test_several_open_ways_are_listed():
    path = op.PathGraph()
    path.add("sun", op.Source())
    path.add("moon", op.Source())
    with pytest.raises(op.PathError, match=r"2 natural ways out .*: 'sun.out', 'moon.out'"):
        path >> op.Detector()


def test_a_tap_leaves_the_way_of_its_port_open():
    path = op.Source() >> op.Polarizer()
    path.add("state", op.Detector())
    path.connect("polarizer", "state", tap=True)
    whole = path >> op.Attenuator(0.5) >> op.Detector()
    assert {n: light.intensity for n, light in whole.trace_all().items()} == {
        "state": 0.5,
        "detector": 0.25,
    }


def test_paths_that_are_joined_keep_links_loops_and_what_is_told_of_them(tmp_path):
    slab = op.PathGraph("a slab", {"thin": op.Case({"d": 0.1})}, declared=("d", "e"), loops="sum")
    slab.add("front", op.Interface(1.5, 0.3))
    slab.add("down", op.Medium(op.Parameter("d", 0.0), absorption=op.Parameter("e", 0.0)))
    slab.add("back", op.Interface(1.0, 0.3, outside=1.5, incidence_in=1.0))
    slab.add("eye", op.Detector())
    for leaves, enters in (("front.transmitted", "down"), ("down", "back"), ("back", "front.back")):
        slab.connect(leaves, enters)
    slab.connect("back.transmitted", "eye")
    slab.add("dump", op.Dump())
    slab.connect("front", "dump")
    path = op.Source() >> op.Attenuator(0.5) >> slab
    assert (path.description, path.loops, list(path.parameters)) == ("a slab", "sum", ["d", "e"])
    assert path.cases == slab.cases
    lights = path.trace_all()
    assert lights["eye"].intensity + lights["dump"].intensity == pytest.approx(0.5, rel=1e-14)
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml())
    assert op.load_preset(file) == path


def test_a_case_stands_on_one_side():
    cases = {"a": op.Case({})}
    one, other = op.PathGraph(cases=cases), op.PathGraph(cases=cases)
    one.add("lamp", op.Source())
    other.add("eye", op.Detector())
    with pytest.raises(op.PathError, match="case 'a' stands on both sides"):
        one >> other


def test_what_is_published_goes_with_the_name_of_its_detector():
    cases = {"a": op.Case({}, published={"detector": (1.0, 0.0, 0.0, 0.0)})}
    other = op.PathGraph(cases=cases) >> op.Polarizer() >> op.Detector()
    split = op.PathGraph()
    split.add("detector", op.Detector())
    split.add("split", op.BeamSplitter())
    split.add("plate", WavePlate())
    split.connect("split.reflected", "detector")
    split.connect("split.transmitted", "plate")
    other.cases = cases
    assert (split >> other).cases["a"].published == {"detector-2": (1.0, 0.0, 0.0, 0.0)}


def test_a_chain_behind_a_node_is_added_to_its_path():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    end = lamp >> op.Polarizer() >> op.Polarizer(0.3).named("analyser") >> op.Detector()
    assert repr(end) == "Node 'detector'"
    assert names(path) == ["lamp", "polarizer", "analyser", "detector"]
    assert path.trace().intensity == pytest.approx(0.5 * np.cos(0.3) ** 2)


def test_a_whole_chain_behind_a_node_ends_at_its_last():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    assert repr(lamp >> (op.Polarizer() >> op.Detector())) == "Node 'detector'"
    assert path.trace().intensity == 0.5


def test_a_chain_leaves_a_node_by_a_port_and_leads_to_one():
    slab = op.PathGraph(loops="sum")
    front = slab.add("front", op.Interface(1.5, 0.0))
    slab.add("lamp", op.Source()) >> front >> slab.add("R", op.Detector())
    back = op.Interface(1.0, 0.0, outside=1.5).named("back")
    slab["front.transmitted"] >> back >> slab["front.back"]
    slab["back.transmitted"] >> op.Detector().named("T")
    lights = slab.trace_all()
    # Once and for all rounds: R = 2 r / (1 + r) with r = 0.04.
    assert lights["R"].intensity == pytest.approx(0.08 / 1.04, rel=1e-14)
    assert lights["T"].intensity == pytest.approx(0.96 / 1.04, rel=1e-14)
    assert repr(slab["front.back"]) == "Node 'front.back'"
    assert repr(slab["R"]) == "Node 'R'"


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("front.transmited", r"did you mean 'front\.transmitted'"),
        ("frnt.transmitted", "did you mean 'front'"),
        ("front.", r"port 'front\.' does not exist"),
        (3, "node 3 does not exist"),
    ],
)
def test_nodes_and_ports_that_do_not_exist_are_told(name, told):
    path = op.PathGraph()
    path.add("front", op.Interface(1.5, 0.0))
    with pytest.raises(op.PathError, match=told):
        path[name]


def test_what_stands_in_a_path_is_not_put_behind_what_does_not():
    path = reflected()
    with pytest.raises(op.PathError, match=r"path\.add\(name, element\) >> path\['detector'\]"):
        op.Source() >> path["detector"]


def test_a_path_is_put_behind_itself_and_not_behind_a_node_of_its_own():
    dim = op.Attenuator(0.5) >> op.Attenuator(0.5)
    assert (op.Source() >> dim >> dim >> op.Detector()).trace().intensity == 0.0625
    assert len((dim >> dim).graph) == 4
    with pytest.raises(op.PathError, match="use a copy"):
        dim["attenuator-2"] >> dim


def test_a_path_is_unchanged_where_a_chain_cannot_go_on():
    path = reflected()
    for behind in (op.Source(), op.Polarizer().named("a.b"), op.Detector().named("source")):
        with pytest.raises(op.PathError):
            path["interface"] >> behind
    assert path == reflected()


def test_a_detector_in_front_of_a_source_is_refused_in_words():
    with pytest.raises(op.PathError) as error:
        op.Detector() >> op.Source()
    assert error.value.faults == (
        "'detector' has no way out, since light ends there; let it stand last",
        "'source' has no way in, since light begins there; let it stand first",
    )


def test_nothing_goes_on_behind_a_detector():
    with pytest.raises(op.PathError, match="no way out that is open"):
        op.Source() >> op.Detector() >> op.Detector()
    with pytest.raises(op.PathError, match=r"one by its name: 'interface\.transmitted'"):
        reflected() >> op.Detector()


@pytest.mark.parametrize(
    ("chain", "told"),
    [
        (lambda: op.Source() >> op.Detector, r"Detector is a class; write Detector\(...\)"),
        (lambda: op.Source >> op.Detector(), r"Source is a class; write Source\(...\)"),
        (lambda: op.Source() >> "eye", "made of elements, .* not of 'eye'"),
        (lambda: 3 >> op.Detector(), "made of elements, .* not of 3"),
        (lambda: reflected() >> None, "made of elements, .* not of None"),
        (lambda: reflected()["source"] >> 3, "made of elements, .* not of 3"),
        (lambda: np.arange(2) >> op.Detector(), "made of elements"),
    ],
)
def test_what_is_no_element_is_named(chain, told):
    with pytest.raises(op.PathError, match=told):
        chain()


def test_a_chain_is_shown_as_it_is_written():
    assert repr(op.Source() >> op.Polarizer()) == "<PathGraph: source >> polarizer>"
    assert repr(op.load_preset("malus")) == "<PathGraph: lamp >> polarizer >> analyzer >> eye>"


@pytest.mark.parametrize("preset", ["glass-slab", "ellipsometer-pcsa", "sky-and-window"])
def test_other_paths_are_shown_by_how_large_they_are(preset):
    assert " nodes and " in repr(op.load_preset(preset))


def test_links_find_the_natural_ports_of_nodes():
    path = op.PathGraph()
    for name, element in (("a", op.Source()), ("b", op.Interface(1.5, 0.0)), ("c", op.Detector())):
        path.add(name, element)
    path.connect("a", "b")
    path.connect("b.transmitted", "c")
    path.add("d", op.Dump())
    path.connect("b", "d.in")
    links = [(start, end, *ports) for start, end, ports in path.graph.edges(keys=True)]
    assert links == [
        ("a", "b", "out", "in"),
        ("b", "c", "transmitted", "in"),
        ("b", "d", "reflected", "in"),
    ]
    with pytest.raises(op.PathError, match=r"link 'a\.out -> b\.in' is there already"):
        path.connect("a", "b")


def test_links_in_files_find_natural_ports(tmp_path):
    file = tmp_path / "chain.toml"
    text = reflected().to_toml()
    for port in (".out", ".reflected", ".in"):
        text = text.replace(f'{port}"', '"')
    file.write_text(text)
    assert op.load_preset(file) == reflected()
