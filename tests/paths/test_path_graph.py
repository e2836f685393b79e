"""Graphs of elements, node by node or in one line by ``>>``: what they refuse, and their light."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from chains import random_rotation
from optipath.paths.drawing import draw
from paths import chain
from tables import rows
from wired import read, read_back, wired

FRAMES, TURN = "a Frame for each port", op.Rotator(0.2)
FRONT, NAMED = wired({"front": op.Interface(1.5, 0.0)}, ""), op.Polarizer().named("a")
LAMPS = wired({"sun": op.Source(), "moon": op.Source()}, "")
ELEMENTS = r"made of elements, .* not of "


def reflections(azimuth):
    first, second = op.Interface(1.5, 0.7), op.Interface(0.6 + 2.1j, 0.4, azimuth=azimuth)
    path = op.Source(stokes=[1.0, 0.3, 0.2, 0.1]).named("lamp") >> first.named("first")
    return path >> second.named("second") >> op.Detector().named("eye")


def reflected(frame, incidence):
    """The frame behind a mirror that light in this frame, x = s, meets at an incidence."""
    turn = np.pi - 2 * incidence
    return op.Frame.from_direction(np.cos(turn) * frame.z - np.sin(turn) * frame.y, frame.x)


def in_world(elements, frames, rotation=None):
    """A chain of elements by name, with world frames at their ports, rotated together."""
    path, node = op.PathGraph(), None
    for name, element in elements.items():
        ports = frames.get(name, {})
        if rotation is not None:
            ports = {port: frame.rotated(rotation) for port, frame in ports.items()}
        new = path.add(name, element, ports)
        node = new if node is None else node >> new
    return path


def placed(azimuth, rotation):
    """The same reflections with world frames, all rotated together."""
    start, behind = op.Frame(), reflected(op.Frame(), 0.7)
    turned = behind.turned(azimuth)
    end = reflected(turned, 0.4)
    frames = {"lamp": {"out": start}, "first": {"in": start, "reflected": behind}}
    frames |= {"second": {"in": turned, "reflected": end}, "eye": {"in": end}}
    path = reflections(0.0)
    return in_world({name: path.element(name) for name in path}, frames, rotation)


@given(azimuth=st.floats(-4, 4), seed=st.integers(0, 10**6))
def test_rotating_every_world_frame_changes_no_result(azimuth, seed):
    path = placed(azimuth, random_rotation(np.random.default_rng(seed)))
    light, expected = path.trace(), reflections(azimuth).trace().stokes
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-14)
    np.testing.assert_allclose(light.frame.z, path.graph.nodes["eye"]["frames"]["in"].z)


START, TILTED = op.Frame(), op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
MIRROR = {"in": START, "reflected": reflected(START, 0.7)}


@rows(
    "middle, frames, message",
    [
        ({}, {"eye": {"in": TILTED}}, r"lamp\.out -> eye\.in.*\(0, 0, 1\).*\(0, 1, 0\)"),
        ({"m": op.Interface(1.5, 0.4)}, {"m": MIRROR}, r"incidence of 40\.107.*is 22\.91"),
        ({"m": op.Polarizer(azimuth=0.1)}, {"m": {"in": START}}, "by its world fr.* an azimuth"),
        ({"m": op.Polarizer()}, {"m": {"in": START, "out": START.turned(0.1)}}, "one frame"),
    ],
)
def test_world_frames_that_contradict_each_other_or_elements_are_refused(middle, frames, message):
    elements = {"lamp": op.Source(), **middle, "eye": op.Detector()}
    path = in_world(elements, {"lamp": {"out": START}, **frames})
    with pytest.raises(op.errors.PathError, match=message):
        path.trace()


@given(turn=st.floats(-4, 4))
def test_malus_law_holds_for_a_turn_of_the_frame_and_of_the_axis(turn):
    for analyzer in (op.Polarizer(angle=turn), op.Polarizer(azimuth=turn)):
        path = op.Source(2.0) >> op.Polarizer() >> analyzer >> op.Detector()
        assert path.trace().intensity == pytest.approx(np.cos(turn) ** 2, abs=1e-14)


def test_branches_and_sources_add_up_incoherently():
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.25), "meet": op.Combiner()}
    filters = {"across": op.Polarizer(np.pi / 2), "along": op.Polarizer()}
    links = "lamp -> split, split.reflected -> across, split.transmitted -> along, meet -> eye"
    path = wired({**ends, **filters, "eye": op.Detector()}, links)
    for name in filters:
        path.connect(name, "meet")
    np.testing.assert_allclose(path.trace().stokes, [0.5, 0.25, 0, 0], rtol=1e-15, atol=1e-16)
    lamps = {"one": op.Source(1.0), "two": op.Source(2.0, stokes=[1.0, 0, 0, 1.0])}
    path = wired({"eye": op.Detector(), **lamps}, "one -> eye, two -> eye")
    np.testing.assert_allclose(path.trace().stokes, [3, 0, 0, 2])
    with pytest.raises(op.errors.ParameterError, match="2 sources"):
        path.mueller()
    np.testing.assert_allclose(path.mueller("two", "eye").matrix, np.eye(4))
    path = wired({"eye": op.Detector()}, "")
    for name, azimuth in (("a", 0.0), ("b", np.pi / 2)):
        path.add(f"lamp-{name}", op.Source()) >> path.add(name, op.Polarizer())
        path.connect(f"{name}.out", "eye.in", azimuth=azimuth)
    np.testing.assert_allclose(path.trace().stokes, [1.0, 0.0, 0, 0], rtol=1e-15, atol=1e-16)


def test_a_graph_is_networkx_whatever_the_order_it_is_built_in():
    path = reflections(0.1)
    assert isinstance(path.graph, nx.MultiDiGraph)
    assert nx.shortest_path(path.graph, "lamp", "eye") == ["lamp", "first", "second", "eye"]
    assert next(iter(path.graph.edges(keys=True))) == ("lamp", "first", ("out", "in"))
    with pytest.raises(nx.NetworkXError, match=r"[Ff]rozen"):
        path.graph.add_node("more")
    assert op.Composer().compose(nx.MultiDiGraph(path.graph)) == path.compose()
    elements = {name: path.element(name) for name in ("eye", "second", "lamp", "first")}
    other = wired(elements, "second -> eye, lamp -> first, first -> second")
    assert (path, path.compose()) == (other, other.compose())


def split():
    return wired({"split": op.BeamSplitter(), "eye": op.Detector()}, "")


@rows(
    "make, message",
    [
        *(
            (lambda path, start=start, end=end: path.connect(start, end), told)
            for start, end, told in (
                ("split.transmited", "eye.in", "'split.transmited'.* mean 'split.transmitted'"),
                ("splt.reflected", "eye.in", "'splt'.* did you mean 'split'"),
                ("split.in", "eye.in", "'split.in' lets light in"),
                ("split.reflected", "split.transmitted", "'split.transmitted' lets light out"),
                ("split", "eye.in", "'split' has no one natural way out.*'split.transmitted'"),
                ("eye", "split", "'eye' has no way out: light ends there"),
                ("split.reflected.x", "eye.in", "'split.reflected.x' is no out-port"),
                ("split.x", "eye.y", "(?s)2 faults.*split.x.*eye.y"),
                (3, "eye.in", "3 is no out-port"),
            )
        ),
        (lambda path: path["split"] >> split()["eye"], "different paths"),
        (lambda path: path["split"] >> path["eye"], r"'split\.reflected', 'split\.transmitted'"),
        (lambda path: path["eye"] >> path["split"], "'eye' has no way out: light ends there"),
        *((lambda path, n=n: path.add(n, TURN), "node name") for n in ("", "a.b", 3)),
        (lambda path: path.add("eye", op.Detector()), "'eye' is there already"),
        *((lambda path, f=f: path.add("a", TURN, f), FRAMES) for f in (START, {"out": [1, 0, 0]})),
        (lambda path: path.add("a", "polarizer"), "must be an element"),
        (lambda path: path["a"], "node 'a' does not exist"),
        (lambda path: path.element(None), "node None does not exist"),
        (lambda _: op.PathGraph(description=3), "description of a path must be a text, not 3"),
        *((lambda _, n=n: NAMED >> TURN.named(n), "text without a dot") for n in ("a.b", "", 3)),
        (lambda _: NAMED >> NAMED, "node 'a' stands on both sides of >>"),
        (lambda _: with_case(op.Source()) >> with_case(op.Dump()), "case 'a' stands on both sides"),
        (lambda _: LAMPS >> op.Detector(), r"2 natural ways out .*: 'sun.out', 'moon.out'"),
        (lambda _: FRONT["front.transmited"], r"did you mean 'front\.transmitted'"),
        (lambda _: FRONT["frnt.transmitted"], "did you mean 'front'"),
        (lambda _: FRONT["front."], r"port 'front\.' does not exist"),
        (lambda _: FRONT[3], "node 3 does not exist"),
        (lambda _: op.Source() >> chained()["detector"], r"element\) >> path\['detector'\]"),
        (
            lambda _: op.Source() >> op.Detector() >> op.Detector(),
            "0 natural ways out that",
        ),
        (lambda _: chained() >> op.Detector(), r"one by its name: 'interface\.transmitted'"),
        (lambda _: op.Source() >> op.Detector, r"Detector is a class; write Detector\(...\)"),
        (lambda _: op.Source >> op.Detector(), r"Source is a class; write Source\(...\)"),
        (lambda _: op.Source() >> "eye", ELEMENTS + "'eye'"),
        (lambda _: 3 >> op.Detector(), ELEMENTS + "3"),
        (lambda _: chained()["source"] >> 3, ELEMENTS + "3"),
        (lambda _: np.arange(2) >> op.Detector(), "made of elements"),
        (lambda path: path.add(TURN), r"node name Rotator\(angle=0\.2\) must be a text"),
    ],
)
def test_nodes_links_and_paths_that_cannot_be_are_refused(make, message):
    path = split()
    with pytest.raises(op.errors.PathError, match=message):
        make(path)
    assert path == split()


def test_a_chain_of_10000_elements_runs_with_as_many_steps_and_a_plan_is_kept_by_its_composer():
    path = chain([op.Rotator(np.pi / 10_000)] * 10_000, [1, 1, 0, 0])
    np.testing.assert_allclose(path.trace().stokes, [1, 1, 0, 0], rtol=0, atol=1e-11)
    element = op.Interface(1.5, op.Parameter("a"), azimuth=0.1)
    short, long = (len(chain([element] * n).compose().program.steps) for n in (100, 200))
    assert long - short == 200
    path = op.load_preset("malus")
    assert path.plan_by(op.Composer(dtype="float32")) is path.plan_by(op.Composer(dtype="float32"))
    for act, told in (
        (lambda: path.plan_by([1]), r"a plan is made by a Composer, not \[1\]; write"),
        (lambda: op.Composer().compose(None), "MultiDiGraph is composed, not None"),
        (lambda: op.Polarizer().mueller(method="stabel"), "did you mean 'stable'"),
    ):
        with pytest.raises(op.errors.ComposerError, match=told):
            act()


def test_the_light_on_every_link_is_kept_when_asked_and_a_parameter_may_be_called_keep():
    path = op.load_preset("npgr026", case="8")
    kept = path.trace(keep="all")
    links = {"L.out -> P.in", "P.out -> X2.in", "X2.reflected -> X1.in", "X1.reflected -> E.in"}
    assert {*kept} == {"E", "X1.transmitted", "X2.transmitted"} | links
    np.testing.assert_array_equal(kept["E"].stokes, kept["X1.reflected -> E.in"].stokes)
    # Both interfaces absorb what they do not reflect, and hand it on behind.
    total = kept["X2.reflected -> X1.in"].intensity + kept["X2.transmitted"].intensity
    assert total == pytest.approx(kept["P.out -> X2.in"].intensity, rel=1e-15)
    with pytest.raises(op.errors.ParameterError, match="keep 'some' is unknown"):
        path.trace(keep="some")
    path = op.Source(op.Parameter("keep", default=2.0)) >> op.Detector()
    assert (path.trace(keep=3.0).intensity, path.trace().intensity) == (3.0, 2.0)
    assert {*path.bind(keep=5.0).trace(keep="all")} == {"detector", "source.out -> detector.in"}


def test_nodes_are_drawn_in_the_order_of_travel_with_values_by_their_size():
    lines = draw(op.load_preset("npgr026")).splitlines()
    nodes = [line.split()[0] for line in lines if not line.startswith(" ")]
    assert nodes == ["L", "P", "X2", "X1", "E"]
    assert lines[lines.index("  | reflected --> X1.in") - 1].startswith("X2")
    assert "  | transmitted --> leaves the path" in lines
    ring = wired({"one": op.Polarizer(), "other": op.Rotator(0.5)}, "one -> other, other -> one")
    assert "  | out --> one.in" in draw(ring).splitlines()
    drawn = {name: draw(op.load_preset(name)) for name in op.preset_names()}
    assert "stokes=[1, 1, 0, 0]" in drawn["double-pass-waveplate"]
    assert "matrix=a 4 x 4 matrix  straight=no" in drawn["ellipsometer-rough"]
    assert "parallel=no" in drawn["prism-refraction"]
    assert not [name for name, text in drawn.items() if "array" in text]
    lamp = wired({"lamp": op.Source(stokes=np.ones((3, 5, 4)) * [1.0, 0.0, 0.0, 0.5])}, "")
    assert "stokes=array of shape (3, 5, 4)" in draw(lamp)


def test_a_trace_imports_nothing_of_the_extra_of_sweeps_and_a_sweep_xarray_which_is_named():
    pytest.importorskip("xarray")
    code = (
        # Where Dask is installed, xarray itself imports it.
        "import sys; sys.modules['dask'] = sys.modules['xarray'] = None; import optipath as op\n"
        "there = lambda: [n for n in ('xarray', 'zarr', 'distributed') if sys.modules.get(n)]\n"
        "path = op.load_preset('malus'); path.trace(angle=0.1); print(there())\n"
        "try: path.sweep(angle=[0.1, 0.2])\n"
        "except op.OptipathError as missing: print(missing)\n"
        "del sys.modules['xarray']; path.sweep(angle=[0.1, 0.2]).DoP.values; print(there())"
    )
    # A new interpreter, since what is imported here stays.
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    missing = 'sweeps need xarray, which is not installed; pip install "optipath[sweep]"'
    assert ran.stdout.splitlines() == ["[]", missing, "['xarray']"]


class WavePlate(op.Element):
    """An element of one's own, without a kind."""

    def couplings(self):
        return (op.Coupling("in", "out", ()),)


class Periscope(op.Element, kind="test.periscope"):
    """Ports of its own names, one of each."""

    inputs = ("below",)
    outputs = ("above",)

    def couplings(self):
        return (op.Coupling("below", "above", ()),)


def with_case(element):
    return wired({element.kind: element}, "", cases={"a": op.Case({})})


def chained():
    return op.Source(100.0) >> op.Polarizer(0.5) >> op.Interface(1.5, 0.9) >> op.Detector()


def test_a_chain_is_the_path_that_is_built_node_by_node_named_and_shown_as_it_is_written():
    elements = op.Source(100.0), op.Polarizer(0.5), op.Interface(1.5, 0.9), op.Detector()
    links = "source.out -> polarizer.in, polarizer -> interface, interface.reflected -> detector"
    built = wired({element.kind: element for element in elements}, links)
    assert type(chained()) is op.PathGraph
    assert chained() == built
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
    empty = op.PathGraph("empty", {"dark": op.Case({})}, ["a"], loops="sum") >> a >> d
    assert (empty.description, [*empty.cases], empty.loops) == ("empty", ["dark"], "sum")
    dim = op.Attenuator(0.5) >> op.Attenuator(0.5)
    assert (op.Source() >> dim >> dim >> op.Detector()).trace().intensity == 0.0625
    with pytest.raises(op.errors.PathError, match="use a copy"):
        dim["attenuator-2"] >> dim
    path = chained()
    for behind in (op.Source(), op.Polarizer().named("a.b"), op.Detector().named("source")):
        with pytest.raises(op.errors.PathError):
            path["interface"] >> behind
    assert path == chained()
    with pytest.raises(op.errors.PathError) as error:
        op.Detector() >> op.Source()
    first, second = error.value.faults
    assert first == "'detector' has no way out: light ends there"
    assert second == "'source' has no way in: light begins there"


def test_what_a_chain_grows_out_of_keeps_its_elements_and_views():
    first = op.Source() >> op.Polarizer(0.1)
    second = first >> op.Rotator(0.2)
    with pytest.raises(op.errors.PathError):
        second >> op.Source()
    second.replace("polarizer", op.Polarizer(0.9))
    assert first.element("polarizer") == op.Polarizer(0.1)
    third = second >> op.Attenuator(0.5)
    view = second.graph
    third.add("spare", op.Mirror())
    second >> op.Mirror()
    assert [*view] == ["source", "polarizer", "rotator"]
    path = op.Source() >> op.Polarizer()
    assert [len(path >> op.Mirror().named(f"after-{name}")) for name in path] == [3, 3]


def test_threads_let_chains_grow_out_of_one_path():
    def grown(start, number):
        path = start
        for step in range(5):
            path = path >> op.Rotator(0.1).named(f"{number}-{step}")
        return [*path] == ["source", "polarizer", *(f"{number}-{step}" for step in range(5))]

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(8) as threads:
            for _ in range(20):
                start = op.Source() >> op.Polarizer()
                assert all(threads.map(partial(grown, start), range(8)))
                assert [*start] == ["source", "polarizer"]
    finally:
        sys.setswitchinterval(interval)


def test_a_path_goes_on_at_its_only_open_natural_way_as_links_of_files_do(tmp_path):
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.25), "rest": op.Dump()}
    path = wired(ends, "lamp -> split")
    with pytest.raises(
        op.errors.PathError, match=r"one by its name: 'split.reflected', 'split.trans"
    ):
        path >> op.Detector()
    path.connect("split.transmitted", "rest")
    with pytest.raises(op.errors.PathError, match=r"one by its name: 'split.reflected'"):
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
    with pytest.raises(op.errors.PathError, match=r"link 'a\.out -> b\.in' is there already"):
        path.connect("a", "b")
    text = chained().to_toml()
    for port in (".out", ".reflected", ".in"):
        text = text.replace(f'{port}"', '"')
    assert read(text, tmp_path) == chained()


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
