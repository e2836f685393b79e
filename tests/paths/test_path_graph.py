"""Graphs of elements: how they are built and shown, what they refuse, what light they give."""

import subprocess
import sys

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
from wired import wired

FRAMES, TURN = "a Frame for each port", op.Rotator(0.2)
XARRAY = r'sweeps need xarray, which is not installed; pip install "optipath\[sweep\]"'


def reflections(azimuth):
    first, second = op.Interface(1.5, 0.7), op.Interface(0.6 + 2.1j, 0.4, azimuth=azimuth)
    path = op.Source(stokes=[1.0, 0.3, 0.2, 0.1]).named("lamp") >> first.named("first")
    return path >> second.named("second") >> op.Detector().named("eye")


def reflected(frame, incidence):
    """The frame behind a mirror that light in this frame, x = s, meets at an incidence."""
    turn = np.pi - 2 * incidence
    z = np.cos(turn) * frame.z - np.sin(turn) * frame.y
    return op.Frame.from_direction(z, frame.x)


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
    elements = {name: path.element(name) for name in path}
    return in_world(elements, frames, rotation)


@given(azimuth=st.floats(-4, 4), seed=st.integers(0, 10**6))
def test_rotating_every_world_frame_changes_no_result(azimuth, seed):
    path = placed(azimuth, random_rotation(np.random.default_rng(seed)))
    light = path.trace()
    expected = reflections(azimuth).trace().stokes
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-14)
    np.testing.assert_allclose(light.frame.z, path.graph.nodes["eye"]["frames"]["in"].z)


START = op.Frame()
TILTED = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
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
    with pytest.raises(op.PathError, match=message):
        path.trace()


@given(turn=st.floats(-4, 4))
def test_malus_law_holds_for_a_turn_of_the_frame_and_of_the_axis(turn):
    for analyzer in (op.Polarizer(angle=turn), op.Polarizer(azimuth=turn)):
        path = op.Source(2.0) >> op.Polarizer() >> analyzer >> op.Detector()
        assert path.trace().intensity == pytest.approx(np.cos(turn) ** 2, abs=1e-14)


def test_branches_and_sources_add_up_incoherently():
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.25), "meet": op.Combiner()}
    filters = {"across": op.Polarizer(np.pi / 2), "along": op.Polarizer()}
    path = wired(
        {**ends, **filters, "eye": op.Detector()},
        "lamp -> split, split.reflected -> across, split.transmitted -> along, across -> meet, "
        "along -> meet, meet -> eye",
    )
    np.testing.assert_allclose(path.trace().stokes, [0.5, 0.25, 0, 0], rtol=1e-15, atol=1e-16)
    lamps = {"one": op.Source(1.0), "two": op.Source(2.0, stokes=[1.0, 0, 0, 1.0])}
    path = wired({"eye": op.Detector(), **lamps}, "one -> eye, two -> eye")
    np.testing.assert_allclose(path.trace().stokes, [3, 0, 0, 2])
    with pytest.raises(op.ParameterError, match="2 sources"):
        path.mueller()
    np.testing.assert_allclose(path.mueller("two", "eye").matrix, np.eye(4))
    path = op.PathGraph()
    path.add("eye", op.Detector())
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
    one = reflections(0.2)
    elements = {name: one.element(name) for name in ("eye", "second", "lamp", "first")}
    other = wired(elements, "second -> eye, lamp -> first, first -> second")
    assert one == other
    assert one.compose() == other.compose()


def split():
    return wired({"split": op.BeamSplitter(), "eye": op.Detector()}, "")


@rows(
    "leaves, enters, messages",
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
    path = split()
    with pytest.raises(op.PathError) as error:
        path.connect(leaves, enters)
    for message in messages:
        assert message in str(error.value)
    assert path.graph.number_of_edges() == 0


@rows(
    "make, message",
    [
        (lambda path: path["split"] >> split()["eye"], "different paths"),
        (lambda path: path["split"] >> path["eye"], r"'split\.reflected', 'split\.transmitted'"),
        (lambda path: path["eye"] >> path["split"], "'eye' has no way out, since light ends there"),
        *((lambda path, n=n: path.add(n, TURN), "node name") for n in ("", "a.b", 3)),
        (lambda path: path.add("eye", op.Detector()), "'eye' is there already"),
        *((lambda path, f=f: path.add("a", TURN, f), FRAMES) for f in (3, {"out": [1, 0, 0]})),
        (lambda path: path.add("a", "polarizer"), "must be an element"),
        (lambda path: path["a"], "node 'a' does not exist"),
        (lambda path: path.element(None), "node None does not exist"),
        (lambda _: op.PathGraph(description=3), "description of a path must be a text, not 3"),
        (lambda _: op.Composer().compose(None), "MultiDiGraph is composed, not None"),
        (lambda _: op.Polarizer().mueller(method="stabel"), "did you mean 'stable'"),
        (lambda path: path.add(TURN), r"path\.add\('rotator', Rotator\(angle=0\.2\)\)$"),
        (lambda path: path.add(TURN.named("b")), r"path\.add\('b', Rotator\(angle=0\.2\)\)$"),
    ],
)
def test_nodes_and_paths_that_cannot_be_are_refused(make, message):
    with pytest.raises(op.OptipathError, match=message):
        make(split())


def test_a_chain_of_10000_elements_runs_with_as_many_steps_and_a_plan_is_kept_by_its_composer():
    path = chain([op.Rotator(np.pi / 10_000)] * 10_000, [1, 1, 0, 0])
    np.testing.assert_allclose(path.trace().stokes, [1, 1, 0, 0], rtol=0, atol=1e-11)
    element = op.Interface(1.5, op.Parameter("a"), azimuth=0.1)
    short, long = (len(chain([element] * n).compose().program.steps) for n in (100, 200))
    assert long - short == 200
    path = op.load_preset("malus")
    assert path.plan_by(op.Composer(dtype="float32")) is path.plan_by(op.Composer(dtype="float32"))
    with pytest.raises(op.ComposerError, match=r"a plan is made by a Composer, not \[1\]; write"):
        path.plan_by([1])


def test_the_light_on_every_link_is_kept_when_asked_and_a_parameter_may_be_called_keep():
    path = op.load_preset("npgr026", case="8")
    kept = path.trace(keep="all")
    links = {"L.out -> P.in", "P.out -> X2.in", "X2.reflected -> X1.in", "X1.reflected -> E.in"}
    assert {*kept} == {"E", "X1.transmitted", "X2.transmitted"} | links
    np.testing.assert_array_equal(kept["E"].stokes, kept["X1.reflected -> E.in"].stokes)
    # Both interfaces absorb what they do not reflect, and hand it on behind.
    total = kept["X2.reflected -> X1.in"].intensity + kept["X2.transmitted"].intensity
    assert total == pytest.approx(kept["P.out -> X2.in"].intensity, rel=1e-15)
    with pytest.raises(op.ParameterError, match="keep 'some' is unknown"):
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


def test_a_trace_imports_nothing_of_the_extra_of_sweeps_and_a_sweep_xarray_alone(monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(op.OptipathError, match=XARRAY):
        op.load_preset("malus").sweep(angle=[0.1, 0.2])
    monkeypatch.undo()
    pytest.importorskip("xarray")
    code = (
        # Where Dask is installed, xarray itself imports it.
        "import sys; sys.modules['dask'] = None; import optipath as op; "
        "there = lambda: [n for n in ('xarray', 'zarr', 'distributed') if n in sys.modules]; "
        "path = op.load_preset('malus'); path.trace(angle=0.1); print(there()); "
        "path.sweep(angle=[0.1, 0.2]).DoP.values; print(there())"
    )
    # A new interpreter, since what is imported here stays.
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert ran.stdout.split("\n")[:2] == ["[]", "['xarray']"]
