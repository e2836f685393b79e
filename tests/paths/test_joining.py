"""Paths in one line: elements and paths put one behind the other by ``>>``."""

import numpy as np
import pytest

import optipath as op
from tables import rows
from wired import read, read_back, wired

FRONT, NAMED = wired({"front": op.Interface(1.5, 0.0)}, ""), op.Polarizer().named("a")
LAMPS = wired({"sun": op.Source(), "moon": op.Source()}, "")
ELEMENTS = r"made of elements, .* not of "


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


def with_case(element):
    return wired({element.kind: element}, "", cases={"a": op.Case({})})


def reflected():
    return op.Source(100.0) >> op.Polarizer(0.5) >> op.Interface(1.5, 0.9) >> op.Detector()


def test_a_chain_is_the_path_that_is_built_node_by_node_named_and_shown_as_it_is_written():
    elements = op.Source(100.0), op.Polarizer(0.5), op.Interface(1.5, 0.9), op.Detector()
    links = "source.out -> polarizer.in, polarizer -> interface, interface.reflected -> detector"
    built = wired({element.kind: element for element in elements}, links)
    assert type(reflected()) is op.PathGraph
    assert reflected() == built
    path = op.Source() >> op.Polarizer() >> op.Polarizer(0.2) >> op.Polarizer(0.4) >> op.Detector()
    assert [*path] == ["source", "polarizer", "polarizer-2", "polarizer-3", "detector"]
    assert path.trace().intensity == pytest.approx(0.5 * np.cos(0.2) ** 4)
    own = op.Source().named("lamp") >> WavePlate() >> Periscope() >> op.Detector()
    assert [*own] == ["lamp", "wave-plate", "test-periscope", "detector"]
    assert own.trace_all()["detector"].intensity == 1.0
    assert repr(op.Source() >> op.Polarizer()) == "<PathGraph: source >> polarizer>"
    assert repr(op.load_preset("malus")) == "<PathGraph: lamp >> polarizer >> analyzer >> eye>"
    for preset in ("glass-slab", "ellipsometer-pcsa", "sky-and-window"):
        assert " nodes and " in repr(op.load_preset(preset))


def test_a_chain_changes_neither_side_nor_a_path_that_it_cannot_go_on():
    start, end = op.Source() >> op.Polarizer(), op.Polarizer(0.3) >> op.Detector()
    whole = start >> end
    assert [len(path.graph) for path in (start, end, whole)] == [2, 2, 4]
    assert start >> end == whole
    start.add("more", op.Dump())
    assert "more" not in whole.graph
    a, b, c, d = op.Source(), op.Polarizer(), op.Polarizer(0.3), op.Detector()
    for other in (a >> (b >> c >> d), a >> (b >> (c >> d)), op.PathGraph() >> a >> b >> c >> d):
        assert other == whole
    dim = op.Attenuator(0.5) >> op.Attenuator(0.5)
    assert (op.Source() >> dim >> dim >> op.Detector()).trace().intensity == 0.0625
    with pytest.raises(op.PathError, match="use a copy"):
        dim["attenuator-2"] >> dim
    path = reflected()
    for behind in (op.Source(), op.Polarizer().named("a.b"), op.Detector().named("source")):
        with pytest.raises(op.PathError):
            path["interface"] >> behind
    assert path == reflected()
    with pytest.raises(op.PathError) as error:
        op.Detector() >> op.Source()
    first, second = error.value.faults
    assert "'detector' has no way out, since light ends there; let it stand last" in first
    assert "'source' has no way in, since light begins there; let it stand first" in second


def test_a_path_goes_on_at_its_only_open_natural_way_as_links_of_files_do(tmp_path):
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.25), "rest": op.Dump()}
    path = wired(ends, "lamp -> split")
    with pytest.raises(op.PathError, match=r"one by its name: 'split.reflected', 'split.trans"):
        path >> op.Detector()
    path.connect("split.transmitted", "rest")
    with pytest.raises(op.PathError, match=r"one by its name: 'split.reflected'"):
        path >> op.Detector()
    path.add("filter", op.Polarizer())
    path.connect("split.reflected", "filter")
    assert (path >> op.Detector()).trace().intensity == 0.125
    # A tap leaves the way of its port open.
    path = op.Source() >> op.Polarizer()
    path.add("state", op.Detector())
    path.connect("polarizer", "state", tap=True)
    whole = path >> op.Attenuator(0.5) >> op.Detector()
    lights = {name: light.intensity for name, light in whole.trace_all().items()}
    assert lights == {"state": 0.5, "detector": 0.25}
    ends = {"a": op.Source(), "b": op.Interface(1.5, 0.0), "c": op.Detector(), "d": op.Dump()}
    path = wired(ends, "a -> b, b.transmitted -> c, b -> d.in")
    links = [f"{a}.{out} -> {b}.{into}" for a, b, (out, into) in path.graph.edges(keys=True)]
    assert links == ["a.out -> b.in", "b.transmitted -> c.in", "b.reflected -> d.in"]
    with pytest.raises(op.PathError, match=r"link 'a\.out -> b\.in' is there already"):
        path.connect("a", "b")
    text = reflected().to_toml()
    for port in (".out", ".reflected", ".in"):
        text = text.replace(f'{port}"', '"')
    assert read(text, tmp_path) == reflected()


def test_paths_in_one_line_keep_links_loops_and_what_is_told_of_them(tmp_path):
    glass = op.Medium(op.Parameter("d", 0.0), absorption=op.Parameter("e", 0.0))
    back = op.Interface(1.0, 0.3, outside=1.5, incidence_in=1.0)
    ends = {"front": op.Interface(1.5, 0.3), "down": glass, "back": back, "eye": op.Detector()}
    links = "front.transmitted -> down, down -> back, back -> front.back, back.transmitted -> eye"
    told = {"description": "a slab", "cases": {"thin": op.Case({"d": 0.1})}, "loops": "sum"}
    slab = wired({**ends, "dump": op.Dump()}, links, declared=("d", "e"), **told)
    slab.connect("front", "dump")
    path = op.Source() >> op.Attenuator(0.5) >> slab
    assert (path.description, path.loops, list(path.parameters)) == ("a slab", "sum", ["d", "e"])
    assert path.cases == slab.cases
    lights = path.trace_all()
    assert lights["eye"].intensity + lights["dump"].intensity == pytest.approx(0.5, rel=1e-14)
    assert read_back(path, tmp_path) == path
    cases = {"a": op.Case({}, published={"detector": (1.0, 0.0, 0.0, 0.0)})}
    other = op.Polarizer() >> op.Detector()
    other.cases = cases
    ends = {"detector": op.Detector(), "split": op.BeamSplitter(), "plate": WavePlate()}
    split = wired(ends, "split.reflected -> detector, split.transmitted -> plate")
    assert (split >> other).cases["a"].published == {"detector-2": (1.0, 0.0, 0.0, 0.0)}


def test_a_chain_behind_a_node_is_added_to_its_path_and_leaves_by_a_port():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    end = lamp >> op.Polarizer() >> op.Polarizer(0.3).named("analyser") >> op.Detector()
    assert repr(end) == "Node 'detector'"
    assert [*path] == ["lamp", "polarizer", "analyser", "detector"]
    assert path.trace().intensity == pytest.approx(0.5 * np.cos(0.3) ** 2)
    whole = op.PathGraph()
    assert repr(whole.add("l", op.Source()) >> (op.Polarizer() >> op.Detector())) == repr(end)
    assert whole.trace().intensity == 0.5
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
    assert (repr(slab["front.back"]), repr(slab["R"])) == ("Node 'front.back'", "Node 'R'")


@rows(
    "join, told",
    [
        *((lambda n=n: NAMED >> op.Dump().named(n), "text without a dot") for n in ("a.b", "", 3)),
        (lambda: NAMED >> NAMED, "node 'a' stands on both sides of >>"),
        (lambda: with_case(op.Source()) >> with_case(op.Dump()), "case 'a' stands on both sides"),
        (lambda: LAMPS >> op.Detector(), r"2 natural ways out .*: 'sun.out', 'moon.out'"),
        (lambda: FRONT["front.transmited"], r"did you mean 'front\.transmitted'"),
        (lambda: FRONT["frnt.transmitted"], "did you mean 'front'"),
        (lambda: FRONT["front."], r"port 'front\.' does not exist"),
        (lambda: FRONT[3], "node 3 does not exist"),
        (lambda: op.Source() >> reflected()["detector"], r"element\) >> path\['detector'\]"),
        (lambda: op.Source() >> op.Detector() >> op.Detector(), "no way out that is open"),
        (lambda: reflected() >> op.Detector(), r"one by its name: 'interface\.transmitted'"),
        (lambda: op.Source() >> op.Detector, r"Detector is a class; write Detector\(...\)"),
        (lambda: op.Source >> op.Detector(), r"Source is a class; write Source\(...\)"),
        (lambda: op.Source() >> "eye", ELEMENTS + "'eye'"),
        (lambda: 3 >> op.Detector(), ELEMENTS + "3"),
        (lambda: reflected() >> None, ELEMENTS + "None"),
        (lambda: reflected()["source"] >> 3, ELEMENTS + "3"),
        (lambda: np.arange(2) >> op.Detector(), "made of elements"),
    ],
)
def test_what_cannot_be_joined_is_refused_by_its_name(join, told):
    with pytest.raises(op.PathError, match=told):
        join()
