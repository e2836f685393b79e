"""Elements put into links, taken out, exchanged, or moved by a word; nothing else is turned."""

import copy
import functools
import json
import operator
import pickle
from dataclasses import replace

import numpy as np
import pytest

import optipath as op
from optipath.cli.command import main
from optipath.paths.editing import are_alike
from tables import rows
from wired import read, read_back, wired

A, AT = op.Parameter("a"), {"a": 0.37}
FRAME = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
SEVERAL = np.array([0.1, 0.2])
PLACES = {"light": "P >> X2 >> X1", "between": "X2 >> P >> X1", "eye": "X2 >> X1 >> P"}
ROWS = {place: f"L >> {row} >> E" for place, row in PLACES.items()}

assert_close = functools.partial(np.testing.assert_allclose, rtol=1e-13, atol=1e-13)
npgr026 = functools.partial(op.load_preset, "npgr026")
# The two reflections with all values known, the filter at the light.
two_reflections = functools.partial(npgr026, case=8)


def test_turns_are_alike_if_they_are_one_multiple_of_one_parameter_with_one_offset():
    b = op.Parameter("b")
    assert are_alike(2 * A + 0.3, 2 * A + 0.3 - 0.9 + 0.9)
    for other in (A + 0.3, 2 * b + 0.3, 2 * A + 0.4, 0.3):
        assert not are_alike(2 * A + 0.3, other)


def stokes(path):
    return path.trace(**{name: AT[name] for name in AT if name in path.parameters}).stokes


def refused(told, act, *given, **where):
    with pytest.raises(op.errors.PathError, match=told):
        act(*given, **where)


def test_elements_are_inserted_before_the_eye_between_turns_and_at_one_of_several_links():
    path = npgr026()
    before = path.trace()
    assert repr(path.insert("P2", op.Polarizer(0.3), behind="X1.reflected")) == "Node 'P2'"
    assert repr(path) == "<PathGraph: L >> P >> X2 >> X1 >> P2 >> E>"
    # Malus; the light is along x but for 2e-10 of it, near Brewster's angle.
    assert path.trace().intensity == pytest.approx(before.intensity * np.cos(0.3) ** 2, rel=1e-8)
    for where in ({"before": "E"}, {"before": "E.in"}, {"behind": "X1", "before": "E.in"}):
        other = npgr026()
        other.insert("P2", op.Polarizer(0.3), **where)
        assert other == path
    path = two_reflections()
    path.insert("P2", op.Polarizer(0.4), behind="X2")
    elements = {name: path.element(name) for name in ("L", "P", "X2", "P2", "X1", "E")}
    built = wired(elements, "L -> P, P -> X2, X2 -> P2, P2 -> X1, X1 -> E")
    np.testing.assert_array_equal(stokes(path), stokes(built))
    path = op.Source() >> op.Detector()
    path.insert("mirror", op.Mirror(r_s=-0.5, r_p=0.5), behind="source")
    assert path.trace().intensity == 0.25
    lamps = {"eye": op.Detector(), "lamp": op.Source(1.0), "other": op.Source(3.0)}
    path = wired(lamps, "lamp -> eye, other -> eye")
    with pytest.raises(op.errors.PathError, match=r"'eye\.in' is fed by .* and .*; name both ends"):
        path.insert("grey", op.Attenuator(0.5), before="eye")
    path.insert("grey", op.Attenuator(0.5), behind="lamp.out", before="eye")
    assert path.trace().intensity == 3.5


def test_azimuths_and_taps_stay_with_their_ports_when_something_is_inserted():
    path = op.Source() >> op.Polarizer()
    path.add("analyser", op.Polarizer())
    path.connect("polarizer", "analyser", azimuth=0.4)
    whole = path >> op.Detector()
    whole.insert("grey", op.Attenuator(0.5), behind="polarizer")
    assert whole.graph.edges["grey", "analyser", ("out", "in")]["azimuth"] == 0.4
    assert whole.trace().intensity == pytest.approx(0.25 * np.cos(0.4) ** 2)
    whole = op.load_preset("ellipsometer-pcsa").trace_all()
    for where, tap, dimmed in (
        ({"behind": "S"}, "S.reflected -> state.in", "photometer"),
        ({"before": "state"}, "S.reflected -> grey.in", "state"),
    ):
        path = op.load_preset("ellipsometer-pcsa")
        path.insert("grey", op.Attenuator(0.5), **where)
        assert path.compose().taps == (tap,)
        for name, light in path.trace_all().items():
            expected = whole[name].stokes * (0.5 if name == dimmed else 1.0)
            np.testing.assert_allclose(light.stokes, expected, rtol=1e-14)


def placed(*elements):
    """A path whose nodes stand in one world frame each."""
    path, node = op.PathGraph(), None
    for element in elements:
        new = path.add(element.kind, element, {"in" if element.inputs else "out": FRAME})
        node = new if node is None else node >> new
    return path


def test_world_frames_stay_where_an_element_is_inserted_or_replaced():
    path = placed(op.Source(stokes=[1.0, 1.0, 0.0, 0.0]), op.Detector())
    path.insert("P", op.Polarizer(np.pi / 3), behind="source")
    assert path.trace().intensity == pytest.approx(0.25, abs=1e-15)
    np.testing.assert_array_equal(path.trace().frame.z, FRAME.z)
    before = path.to_toml()
    for element in (op.Mirror(), op.Polarizer(azimuth=0.1)):
        refused("world frame", path.insert, "more", element, behind="source")
    assert path.to_toml() == before
    path = placed(op.Source(), op.Polarizer(), op.Detector())
    path.replace("polarizer", op.Attenuator(0.25))
    assert path.trace().intensity == 0.25
    with pytest.raises(op.errors.PathError, match="by its world frames and by an azimuth") as told:
        path.replace("polarizer", op.Polarizer(azimuth=0.1))
    assert len(told.value.faults) == 1
    assert path.trace().intensity == 0.25


def put(element=None, name="new", **where):
    return lambda path: path.insert(name, op.Polarizer() if element is None else element, **where)


def swap(element):
    return lambda path: path.replace("X1", element)


def drop(name):
    return lambda path: path.remove(name)


def offer(name, **behind):
    return lambda path: path.offer("spot", name, behind)


@rows(
    "change, told, preset",
    [
        (
            drop("front"),
            r"'front' cannot be taken out, since several links meet .*'up\.out -> front\.back'",
            "glass-slab",
        ),
        (drop("X2"), "'X2' cannot be taken out, since light does not go straight", "npgr026-3d"),
        (put(behind="X2"), "stands relatively between the vertices", "npgr026-3d"),
        *(
            (*given, "npgr026")
            for given in (
                (put(op.BeamSplitter(), behind="X2"), "'new' has no one natural way out"),
                (put(op.Detector(), behind="X2"), "'new' has no way out"),
                (put(op.Source(), behind="X2"), "'new' has no way in"),
                (put(behind="X2.transmitted"), r"'X2\.transmitted' feeds no link"),
                (put(name="D", behind="X1.transmitted"), "feeds no link"),
                (put(behind="X2.in"), "lets light in"),
                (put(behind="E"), "'E' has no way out"),
                (put(behind="X3"), "node .X3. does not exist"),
                (put("red", behind="X2"), "must be an element, as"),
                (put(), r"names no link; give behind='node\.port'"),
                (put(before="X1.back"), r"'X1\.back' is fed by no link"),
                (put(behind="X2", before="E"), r"'X2\.reflected -> E\.in'; did you mean 'X1"),
                (put(name="X1", behind="X2"), "choose another"),
                (put(name="a.b", behind="X2"), "must be a text without a dot"),
                (drop("X1"), r"not go straight .* 'X2\.reflected -> X1\.in' and 'X1\.ref.* -> E"),
                (drop("X3"), "node 'X3' does not exist"),
                (swap(op.Interface(2.0, 0.3)), r"'X1' is turned by .* -rho, .* azimuth=0\.0"),
                (swap(op.Polarizer()), r"has no 'X1\.reflected', which"),
                (swap(op.Detector()), r"has no 'X1\.reflected', which"),
                (swap(op.Source()), r"has no 'X1\.in', 'X1\.reflected', which"),
                (swap(1.5), "must be an element, as"),
                (lambda path: path.disconnect("X2", "E"), r"X2\.reflected -> E\.in'; did you mean"),
                (offer("Q", light="L.out"), "'Q' does not exist"),
                (offer("X1", light="L.out"), "not go straight through 'X1'"),
                (offer("P", light="L.ou"), "did you mean 'L.out'"),
                (offer("P", out="X1.transmitted"), "feeds no one link"),
                (offer("P", own="P.out"), "feeds no one link"),
                (offer("P"), "a port for each word"),
                (lambda path: path.offer("spot", "P", ["L.out"]), "a port for each word"),
                (offer("E", light="L.out"), "'E' has no way out"),
                (
                    lambda path: path.offer("a b", "P", {"b": "L.out"}),
                    "letters, digits and underscores",
                ),
            )
        ),
    ],
)
def test_a_change_that_cannot_be_is_told_and_leaves_the_path_as_it_was(change, told, preset):
    path = op.load_preset(preset)
    refused(told, change, path)
    assert path == op.load_preset(preset)


def test_what_is_removed_leaves_no_gap_or_turn_unless_something_is_in_the_way():
    path = op.Source() >> op.Polarizer() >> op.Polarizer(0.5).named("between") >> op.Detector()
    path.remove("between")
    assert path == op.Source() >> op.Polarizer() >> op.Detector()
    for turned in ({"angle": 0.3}, {"azimuth": 0.3}):
        path = two_reflections()
        path.insert("P2", op.Polarizer(**turned), behind="X1")
        by_angle = stokes(inserted(0.3, "X1", two_reflections()))
        np.testing.assert_allclose(stokes(path), by_angle, rtol=1e-14, atol=1e-15)
        path.remove("P2")
        assert path == two_reflections()
    space = op.load_preset("npgr026-3d", case=7)
    space.insert("grey", op.Attenuator(0.5), behind="P")
    space.remove("grey")
    assert space == op.load_preset("npgr026-3d", case=7)
    path = wired({"lamp": op.Source(stokes=[1.0, 1.0, 0.0, 0.0]), "grey": op.Rotator(0)}, "")
    path.add("filter", op.Polarizer()) >> path.add("eye", op.Detector())
    path.connect("lamp", "grey", azimuth=0.25)
    path.connect("grey", "filter", azimuth=0.5)
    path.remove("grey")
    assert path.trace().intensity == pytest.approx(np.cos(0.75) ** 2)
    ends = {"lamp": op.Source(), "split": op.BeamSplitter(0.25), "eye": op.Detector()}
    path = wired(ends, "lamp -> split, split.transmitted -> eye")
    path.remove("split")
    assert path.trace().intensity == 1.0
    slab = op.load_preset("glass-slab")
    slab.remove("reflected")
    assert "front.reflected" in slab.compose().outlets
    path = two_reflections()
    path.add("state", op.Detector())
    path.connect("P", "state", tap=True)
    refused(r"'P\.out -> state\.in'", path.remove, "P")
    path = two_reflections()
    path.add("P2", op.Polarizer()) >> path.add("state", op.Detector())
    path.connect("X2", "P2", tap=True)
    path.remove("P2")
    assert path.compose().taps == ("X2.reflected -> state.in",)
    ends = {"lamp": op.Source(), "grey": op.Attenuator(0.5), "eye": op.Detector()}
    path = wired(ends, "lamp -> grey, grey -> eye")
    path.connect("lamp", "eye", tap=True)
    refused(r"link 'lamp\.out -> eye\.in' is there already", path.remove, "grey")


def test_an_element_is_replaced_in_its_place():
    path = two_reflections()
    assert repr(path.replace("X1", op.Mirror(azimuth=path.element("X1").azimuth))) == "Node 'X1'"
    assert repr(path) == repr(two_reflections())
    # An ideal mirror keeps all the light.
    lights = path.trace(keep="all")
    expected = lights["X2.reflected -> X1.in"].intensity
    assert lights["E"].intensity == pytest.approx(expected, rel=1e-14)
    path, unturned = two_reflections(), two_reflections()
    gold = replace(path.element("X1"), index=op.Material(0.17, 3.15))
    path.replace("X1", gold)
    assert path.element("X1") == gold
    unturned.disconnect("X2.reflected", "X1.in")
    unturned.connect("X2.reflected", "X1.in", azimuth=0.0)
    unturned.replace("X1", replace(gold, azimuth=0.0))
    np.testing.assert_array_equal(stokes(unturned), path.trace(rho=0.0).stokes)
    path = op.load_preset("glass-slab")
    path.disconnect("lamp")
    path.connect("lamp", "front")  # Behind the one to front.back.
    front = path.element("front")
    path.replace("front", replace(front, azimuth=0.3))
    refused("'front' is turned by its azimuth 0.3", path.replace, "front", front)


def test_links_are_taken_out_and_put_in_by_the_calls_that_are_named():
    path, other = npgr026(), npgr026()
    other.insert("P2", op.Polarizer(0.3), behind="X1")
    path.add("P2", op.Polarizer(0.3))
    path.connect("X1.reflected", "P2.in")
    path.connect("P2.out", "E.in")
    refused("each would get all of its light; put one behind the other", path.trace)
    with pytest.raises(
        op.errors.PathError, match=r"'X1\.reflected' feeds .* and .*; name both ends"
    ):
        path.insert("P3", op.Polarizer(0.3), behind="X1.reflected")
    path.disconnect("X1.reflected", "E.in")
    assert path == other
    # A path is judged when it is whole.
    path.disconnect("P2", "E")
    path.connect("P2", "E")
    assert path == other
    path, other = two_reflections(), two_reflections()
    path.disconnect("X1.reflected")
    other.disconnect("X1.reflected", "E.in")
    assert path == other
    for ends, told in ((["X1"], "'X1.reflected' feeds no"), (["X1", "E"], r"no link .* -> E\.in'")):
        refused(told, path.disconnect, *ends)
    refused("reaches no detector", path.trace)
    path = op.load_preset("ellipsometer-pcsa")
    refused("feeds .* and .*; name both ends", path.disconnect, "S")
    path.disconnect("S.reflected", "A.in")
    assert not path.graph.has_edge("S", "A")


@rows(
    "change",
    [
        *(put(behind="X1"), drop("P"), lambda path: path.replace("P", op.Attenuator(0.5))),
        lambda path: path.connect("X1.transmitted", path.add("rest", op.Dump()).name),
    ],
)
def test_a_path_that_is_changed_is_composed_anew_and_shown_by_the_graph_handed_out(change):
    path = two_reflections()
    plan, graph = path.compose(), path.graph
    change(path)
    assert path.compose() != plan
    assert [*graph] == [*path]
    before = path.trace().intensity
    path.add("lamp", op.Source(2.0)) >> path["E"]
    assert path.trace().intensity == pytest.approx(before + 2.0)


def inserted(angle, behind, path=None, azimuth=0.0):
    """A path with a polariser behind a port; turned by its angle, it turns nothing else."""
    path = path or npgr026(case=7)
    path.insert("new", op.Polarizer(angle, azimuth=azimuth), behind=behind)
    return path


@rows("azimuth, turn", [(0.5, 0.5), (0.0, 0.0), (A, 0.37), (2 * A + 0.1, 0.84), (SEVERAL, SEVERAL)])
@rows("first, behind", [(0.3, "P"), (A, "X1")])
def test_what_replaces_an_inserted_element_turns_nothing_behind_it(behind, first, azimuth, turn):
    path = inserted(0.2, behind, azimuth=first)
    path.replace("new", op.Polarizer(0.2, azimuth=azimuth))
    assert_close(stokes(path), stokes(inserted(0.2 + turn, behind)))
    path.remove("new")
    assert_close(stokes(path), stokes(npgr026(case=7)))


@rows(
    "own, turn, behind",
    [
        *((own, turn, by) for own, turn in ((0.25, 0.25), (A, 0.37)) for by in (0.1, 2 * A)),
        ("10 deg" - A, np.radians(10) - 0.37, A + 0.25),
        (SEVERAL, SEVERAL, 0.1),
    ],
)
def test_an_element_is_inserted_before_one_that_has_an_azimuth_as_well(own, turn, behind):
    def path():
        gold = op.Interface(0.17 + 3.15j, 0.8, azimuth=behind)
        return op.Source(stokes=[5, 3, 1, 2]) >> op.Polarizer() >> gold >> op.Detector()

    found = inserted(0.2, "polarizer", path(), azimuth=own)
    assert_close(stokes(found), stokes(inserted(0.2 + turn, "polarizer", path())))
    found.remove("new")
    assert_close(stokes(found), np.broadcast_to(stokes(path()), stokes(found).shape))


def test_an_azimuth_goes_over_to_all_links_that_it_turns_and_is_kept_in_files(tmp_path):
    class Merging(op.Element):
        azimuth: op.fields.Angle = 0.0
        merges = True

        @staticmethod
        def mueller_rows(xp):
            return np.diag([1, 1, 0, 0]).tolist()

    lamp = op.Source(stokes=[1, 1, 0, 0])
    ends = {"sum": Merging(azimuth=0.4), "eye": op.Detector(), "one": lamp, "two": lamp}
    path = wired(ends, "sum -> eye, one -> sum, two -> sum")
    path.insert("new", op.Retarder(0.0, azimuth=0.25), behind="one")
    assert path.trace().stokes == pytest.approx([2, 2 * np.cos(0.8), 0, 0])
    again = read_back(inserted(0.2, "P", azimuth=2 * A + 0.1), tmp_path)
    again.replace("new", op.Polarizer(0.2, azimuth=-A))
    assert_close(stokes(again), stokes(inserted(0.2 - 0.37, "P")))
    path = inserted(0.2, "P", azimuth=0.3)
    path.disconnect("P.out", "new.in")
    path.connect("P.out", "new.in", azimuth=0.0)
    path.replace("new", op.Polarizer(0.2))
    np.testing.assert_allclose(stokes(path), stokes(inserted(0.2, "P")), rtol=1e-14)
    path.remove("new")
    assert path == npgr026(case=7)
    path = op.Source() >> op.Polarizer(azimuth=0.3).named("first") >> op.Polarizer()
    path.add("second", op.Polarizer(0.1)) >> path.add("state", op.Detector())
    path.connect("first", "second", tap=True)
    path = path >> op.Detector().named("eye")
    path.replace("first", op.Polarizer(azimuth=0.5))
    lights = path.trace_all()
    assert lights["eye"].intensity == pytest.approx(0.5 * np.cos(0.2) ** 2)
    assert lights["state"].intensity == pytest.approx(0.5 * np.cos(0.1) ** 2)


@rows("removed", [False, True])
def test_turns_that_make_no_one_azimuth_are_refused(removed):
    path, change = npgr026(case=7), put(op.Polarizer(0.2, azimuth=A), behind="X2")
    if removed:
        change = drop("old")
        path = op.Source(stokes=[5, 3, 1, 2]) >> op.Retarder(0.0, azimuth=A).named("old")
        last = op.Mirror(-0.9, 0.7, azimuth=op.Parameter("rho", 0.2))
        path = path >> last.named("X1") >> op.Detector()
    before = path.to_toml()
    with pytest.raises(op.errors.PathError, match=r"'X1' would be turned by .* no one azimuth"):
        change(path)
    assert path.to_toml() == before
    expected = stokes(path) if removed else stokes(inserted(0.57, "X2"))
    where = {"behind": "old", "before": "X1"} if removed else {"behind": "X2", "before": "X1"}
    path.insert("between", op.Attenuator(1.0), **where)
    change(path)
    assert_close(stokes(path), expected)


def pane(index, azimuth=0.4, polarizer=0.1):
    path = op.Source(stokes=[1, 0.5, 0.2, 0.1]) >> op.Polarizer(0.2, azimuth=polarizer)
    return path >> op.Interface(index, 0.6, azimuth=azimuth) >> op.Detector()


@rows("azimuth", [0.4, 0.7, 2 * A + 0.1, np.array([0.1, 0.7])])
@rows("plate", [0.25, 0.9])
def test_an_azimuth_that_its_link_has_taken_over_is_given_anew_by_a_replacement(azimuth, plate):
    path = pane(1.5, azimuth)
    path.insert("plate", op.Retarder(0.0, azimuth=plate), behind="polarizer")
    path.remove("plate")
    path.replace("interface", op.Interface(1.6, 0.6, azimuth=azimuth))
    assert path == pane(1.6, azimuth)
    # One that stands as its link says turns nothing behind it.
    path.insert("plate", op.Retarder(0.0, azimuth=plate), behind="source")
    path.remove("plate")
    path.replace("polarizer", op.Polarizer(0.2, azimuth=0.1))
    assert path == pane(1.6, azimuth)


def test_a_replacement_that_is_turned_otherwise_is_refused():
    path = pane(1.5)
    path.insert("plate", op.Retarder(0.0, azimuth=0.25), behind="polarizer")
    with pytest.raises(
        op.errors.PathError, match=r"'interface' by 0\.15.* new one by 0\.4; leave its"
    ):
        path.replace("interface", op.Interface(1.6, 0.6, azimuth=0.4))
    path.replace("interface", op.Interface(1.6, 0.6))
    np.testing.assert_allclose(stokes(path), stokes(pane(1.6)), rtol=1e-14)
    path = op.Source() >> op.Polarizer(azimuth=np.array([0.1, 0.2, 0.3])) >> op.Detector()
    with pytest.raises(op.errors.PathError, match="no one azimuth does for both"):
        path.insert("new", op.Polarizer(azimuth=np.array([0.1, 0.2])), behind="source")
    path = op.Source() >> op.Polarizer(azimuth=A) >> op.Polarizer(0.6) >> op.Detector()
    other = op.Polarizer(azimuth=op.Parameter("b", 0.2))
    refused("by a and by -b, and no one azimuth", path.replace, "polarizer", other)
    path.remove("polarizer")
    path.insert("between", op.Attenuator(1.0), behind="source")
    path.insert("polarizer", other, behind="source")
    assert path.trace(a=0.37).intensity == pytest.approx(0.5 * np.cos(0.6 + 0.37 - 0.2) ** 2)


def built(place, angle):
    """Case 8 of the two reflections, with the filter at a place, element by element."""
    second = op.Interface(0.608 + 2.12j, np.radians(20.0))
    first = op.Interface(1.12 + 2.16j, np.radians(48.0), azimuth=np.radians(-34.0))
    row = [op.Source(100.0), second, first, op.Detector()]
    row.insert([*ROWS].index(place) + 1, op.Polarizer(angle))
    return functools.reduce(operator.rshift, row)


@rows("place", [*ROWS])
@rows("angle", [0.0, 0.7])
def test_the_filter_stands_at_the_light_between_the_surfaces_or_before_the_eye(place, angle):
    path = npgr026(case=8, place=place, filter=angle)
    expected = built(place, angle).trace().stokes
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=1e-14, atol=1e-14)
    assert repr(path) == f"<PathGraph: {ROWS[place]}>"


def test_before_the_eye_the_unfiltered_light_is_filtered_by_malus_law():
    lit, angles = npgr026(case=7).trace(), np.linspace(0.0, np.pi, 7)
    eye = npgr026(case=7).bind(place="eye", filter=angles).trace()
    s0, s1, s2, _ = lit.stokes
    expected = 0.5 * (s0 + s1 * np.cos(2 * angles) + s2 * np.sin(2 * angles))
    np.testing.assert_allclose(eye.intensity, expected, rtol=1e-14)
    # The filter is open wherever it stands.
    path = npgr026(case=7, place="eye")
    assert path.trace().intensity == lit.intensity
    assert path.trace(filter="horizontal").dop == pytest.approx(1.0)


def turned(plate=None, link=None, **own):
    """A filter behind gold, turned by 0.35, with a plate that does nothing before it or none."""
    path = op.Source(100) >> op.Interface(0.17 + 3.15j, "45 deg").named("gold")
    path.add("filter", op.Polarizer(0.2, **own)) >> path.add("eye", op.Detector())
    path.connect("gold", "filter", azimuth=link)
    path.offer("place", "filter", {"lamp": "source", "gold": "gold"})
    if plate is not None:
        path.insert("plate", op.Retarder(0.0, azimuth=plate), behind="gold")
    return path


@rows("how", [{"azimuth": 0.35}, {"link": 0.35}])
@rows("plate", [None, 0.1, op.Parameter("a", 0.1)])
def test_a_filter_that_is_moved_stays_turned_in_the_light(plate, how):
    path, gold = turned(plate, **how), op.Interface(0.17 + 3.15j, "45 deg")
    # The eye stays as it was turned, too.
    eye = op.Retarder(0.0, azimuth=0.35) >> op.Detector()
    expected = (op.Source(100) >> op.Polarizer(0.55) >> gold >> eye).trace().stokes
    moved = path.bind(place="lamp")
    found = [moved.trace().stokes, moved.bind(place="gold").trace().stokes]
    assert_close(found, [expected, path.trace().stokes])
    if plate is not None:
        path.remove("plate")
        assert_close(path.bind(place="lamp").trace().stokes, expected)


def test_a_filter_is_moved_past_a_turned_plate_or_by_hand():
    path = turned(op.Parameter("a"))
    path.disconnect("plate")
    path.replace("filter", op.Polarizer(0.2, azimuth=op.Parameter("b")))
    path.connect("plate", "filter")
    with pytest.raises(op.errors.ParameterError, match="by b and by a, and no one azimuth"):
        path.bind(place="lamp")
    path.remove("filter")
    path.insert("filter", op.Polarizer(azimuth=op.Parameter("b")), behind="source")
    assert path.trace(a=0.1, b=0.2).intensity > 0.0

    def path(place):
        path = op.Source(stokes=[2, 1, 1, 0]) >> op.Polarizer(0.3, azimuth=0.2).named("filter")
        path = path >> op.Retarder(0.8, azimuth=op.Parameter("a", 0.4)).named("plate")
        path = path >> op.Polarizer().named("last") >> op.Detector()
        path.offer("place", "filter", {"before": "source", "behind": "plate"})
        return path.bind(place=place)

    # The plate stands at 0.6, and so does what is behind it.
    filtered, plate = op.Polarizer(0.5), op.Retarder(0.8, 0.6)
    lamp, last = op.Source(stokes=[2, 1, 1, 0]), op.Polarizer(0.6)
    for place, row in (("before", (filtered, plate)), ("behind", (plate, filtered))):
        expected = (lamp >> row[0] >> row[1] >> last >> op.Detector()).trace().intensity
        assert path(place).trace().intensity == pytest.approx(expected, rel=1e-13)


def test_choices_are_copied_compared_joined_and_chosen_again(tmp_path):
    path = npgr026()
    assert path == npgr026(place="light")
    assert " ".join(path.parameters) == "delta rho phi n1 k1 n2 k2 filter intensity"
    assert path.choices["place"].place(path.graph) == "light"
    assert npgr026(place="eye").bind(place="between").bind(place="light") == path
    for place in ("light", "eye"):
        path = npgr026(place=place)
        copies = copy.copy(path), copy.deepcopy(path), pickle.loads(pickle.dumps(path))
        for again in (read_back(path, tmp_path), *copies):
            assert again == path
            assert again.choices == path.choices
            assert again.bind(place="between") == path.bind(place="between")
            assert repr(again.bind(place="eye")) == f"<PathGraph: {ROWS['eye']}>"
        assert path.reading("intensity").choices == path.choices
    path = op.Source() >> op.Polarizer() >> op.Mirror() >> op.Detector()
    other = copy.copy(path)
    other.offer("place", "polarizer", {"light": "source", "eye": "mirror"})
    assert path != other
    assert "place" not in path.choices
    assert other.bind(place="eye").choices == other.choices
    tail = op.Polarizer() >> op.Mirror() >> op.Polarizer().named("last") >> op.Detector()
    tail.offer("place", "last", {"before": "polarizer.out", "behind": "mirror.reflected"})
    path = op.Source() >> op.Polarizer() >> tail
    moved = "source >> polarizer >> polarizer-2 >> last >> mirror >> detector"
    assert repr(path.bind(place="before")) == f"<PathGraph: {moved}>"
    twice = op.Source() >> op.Polarizer().named("a") >> op.Mirror()
    twice.offer("place", "a", {"light": "source"})
    with pytest.raises(op.errors.PathError, match="choice 'place' stands on both sides"):
        twice >> tail


@rows(
    "choose, told",
    [
        (lambda: npgr026(place="eyes", delta="steep"), r"(?s)'eyes' .* you mean 'eye'\?.*delta"),
        (lambda: npgr026(plce="eye"), "did you mean 'place'"),
        (lambda: npgr026().trace(place="eye"), r"path\.bind\(place=\.\.\.\)"),
        (lambda: npgr026().compose().run(delta=[0.1, 0.2], place="eye"), r"path\.bind\(place="),
    ],
)
def test_a_place_is_chosen_by_its_word_before_a_path_runs(choose, told):
    with pytest.raises(op.errors.ParameterError, match=told):
        choose()


@rows(
    "old, new, told",
    [
        ('"X1.reflected" }', '"X1.refl" }', "choices.place: place 'eye': port 'X1.refl' does not"),
        ('element = "P"', 'elemnt = "P"', "choices.place: key 'elemnt' is unknown"),
        ('element = "P"', "", "choices.place: 'element' is missing"),
        ("[choices.place]", "[choices.rho]", "choice or parameter 'rho' is there already"),
    ],
)
def test_choices_are_written_with_their_node_and_their_faults_have_a_place(
    old, new, told, tmp_path
):
    text = npgr026().to_toml()
    with pytest.raises(op.errors.PathError, match=told):
        read(text.replace(old, new, 1), tmp_path)
    path = npgr026()
    path.cases.clear()
    path.remove("P")
    assert ("choices" in path.to_toml(), {*path.choices}) == (False, set())
    path = npgr026()
    path.disconnect("X1", "E")
    with pytest.raises(
        op.errors.PathError, match=r"choice 'place': place 'eye': 'X1\.reflected' feeds"
    ):
        path.to_toml()


def test_the_command_line_takes_the_place_and_tells_of_places(capsys):
    assert main(["run", "npgr026", "--case", "8", "--place", "eye", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["choices"] == {"place": "eye"}
    expected = built("eye", 0.0).trace().stokes
    assert found["detectors"]["E"]["stokes"] == pytest.approx(expected, abs=1e-12)
    assert main(["run", "npgr026", "--case", "8", "--json"]) == 0
    assert "choices" not in json.loads(capsys.readouterr().out)
    assert main(["run", "npgr026", "--place", "eyes"]) == 2
    assert "place 'eyes' is unknown; did you mean 'eye'?" in capsys.readouterr().err
    assert main(["show", "npgr026"]) == 0
    assert "light, between, eye" in " ".join(capsys.readouterr().out.split())


def test_a_chain_grows_behind_every_path_that_it_was():
    grown = [op.Source() >> op.Polarizer(0.1)]
    for place in range(60):
        element = op.Rotator(0.1 * place) if place % 3 else op.Interface(1.5, 0.3)
        grown.append(grown[-1] >> element)
    # The first is asked last, when sixty elements have been put behind it.
    for length, path in reversed([*enumerate(grown, 2)]):
        assert len(path) == path.graph.number_of_edges() + 1 == length
    assert list(grown[4]) == [
        "source",
        "polarizer",
        "interface",
        "rotator",
        "rotator-2",
        "interface-2",
    ]
    for element in (op.Rotator(0.2), op.Rotator(0.3)):
        forked = grown[1] >> element >> op.Detector()
        assert forked == grown[0] >> op.Interface(1.5, 0.3) >> element >> op.Detector()


def test_a_change_of_a_chain_is_none_of_what_it_grew_out_of():
    first = op.Source() >> op.Rotator(0.1)
    second = first >> op.Polarizer(0.2)
    shown = second.graph
    third = second >> op.Detector()
    third.replace("rotator", op.Rotator(0.5))
    third.remove("polarizer")
    assert first == op.Source() >> op.Rotator(0.1)
    assert second == first >> op.Polarizer(0.2)
    assert list(shown) == ["source", "rotator", "polarizer"]
    assert pickle.loads(pickle.dumps(first)) == copy.deepcopy(first) == copy.copy(first) == first


def test_a_parameter_is_bound_in_all_elements_that_are_equal():
    path = op.Source(stokes=[1, 1, 0, 0])
    for _ in range(4):
        path = path >> op.Rotator(op.Parameter("a")) >> op.Attenuator(0.5)
    path = path >> op.Detector()
    assert path.bind(a=0.1).trace() == path.trace(a=0.1)
    np.testing.assert_allclose(path.trace(a=0.1).stokes[1], np.cos(0.8) / 16, rtol=1e-15)


def lengths(path):
    return [about.get("length") for *_, about in path.edges(data=True)]


def test_lengths_of_links_stay_in_all_that_is_made_of_a_path(tmp_path):
    path = wired({"lamp": op.Source(op.Parameter("s", 1.0)), "split": op.BeamSplitter()}, "")
    path.add("eye", op.Detector())
    path.add("spare", op.Detector())
    path.connect("lamp", "split", length="20 cm")
    path.connect("split.reflected", "eye", azimuth="30 deg", length=0.1 + 0.2)
    path.connect("split.transmitted", "spare", tap=True)
    known = [0.2, 0.1 + 0.2, None]
    for other in (path.bind(s=2.0), read_back(path, tmp_path), path.reading("intensity")):
        assert lengths(other) == known
    assert read_back(path, tmp_path) == path
    assert op.PathGraph.from_networkx(path.to_networkx()) == path
    chain = wired({"lamp": op.Source(), "film": op.Polarizer(), "eye": op.Detector()}, "")
    chain.connect("lamp", "film", length=1)
    chain.connect("film", "eye", length="2 m")
    assert lengths(chain.reversed()) == [2.0, 1.0]
    assert lengths(op.PathGraph() >> chain) == [1.0, 2.0]
    pair = wired({"film": op.Polarizer(), "plate": op.Retarder(0.3)}, "")
    pair.connect("film", "plate", length=0.5)
    assert lengths(op.there_and_back(pair, op.Mirror())) == [0.5, None, None, 0.5]


def test_what_is_inserted_stands_at_the_port_that_is_named_and_what_is_removed_leaves_the_sum():
    path = wired({"lamp": op.Source(), "film": op.Polarizer(), "eye": op.Detector()}, "")
    path.connect("lamp", "film", length=1.0)
    path.connect("film", "eye", length=2.0)
    path.insert("behind", op.Rotator(0.1), behind="film.out")
    path.insert("before", op.Rotator(0.1), before="eye")
    found = {(start, end): one for start, end, one in path.edges(data="length")}
    assert found == {
        ("lamp", "film"): 1.0,
        ("film", "behind"): 0.0,
        ("behind", "before"): 2.0,
        ("before", "eye"): 0.0,
    }
    for name in ("film", "before", "behind"):
        path.remove(name)
    assert lengths(path) == [3.0]
    path.insert("film", op.Polarizer(), behind="lamp")
    path.disconnect("film")
    path.connect("film", "eye")
    path.remove("film")
    assert lengths(path) == [None]


@rows(
    "length, told",
    [
        (-1.0, r"link 'lamp -> eye' length is -1000 mm; give a real length of 0 mm or more"),
        ("3 deg", r"link 'lamp -> eye' length: '3 deg' is no length; use one of nm, um"),
        (op.Parameter("d"), r"link 'lamp -> eye' length cannot be a parameter"),
        (np.inf, r"link 'lamp -> eye' length is inf; give a finite length"),
    ],
)
def test_lengths_that_cannot_be_are_refused_where_they_are_said(length, told):
    path = wired({"lamp": op.Source(), "eye": op.Detector()}, "")
    with pytest.raises(op.OptipathError, match=told):
        path.connect("lamp", "eye", length=length)
    assert not path.edges
