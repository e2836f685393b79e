"""Elements put into the links of a path, taken out of it, and exchanged."""

import dataclasses

import numpy as np
import pytest

import optipath as op


def two_reflections():
    """The two reflections with all values known, the filter at the light."""
    return op.load_preset("npgr026", case=8)


def stokes(path):
    return path.trace().stokes


def test_a_filter_is_inserted_before_the_eye():
    path = op.load_preset("npgr026")
    before = path.trace()
    node = path.insert("P2", op.Polarizer(angle=0.3), behind="X1.reflected")
    assert repr(node) == "Node 'P2'"
    assert repr(path) == "<PathGraph: L >> P >> X2 >> X1 >> P2 >> E>"
    # Malus; the light is along x but for 2e-10 of it, near Brewster's angle.
    assert path.trace().intensity == pytest.approx(before.intensity * np.cos(0.3) ** 2, rel=1e-8)


def test_a_filter_is_inserted_between_links_that_turn():
    path, built = two_reflections(), op.PathGraph()
    path.insert("P2", op.Polarizer(0.4), behind="X2")
    for name in ("L", "P", "X2"):
        built.add(name, path.element(name))
    built.add("P2", op.Polarizer(0.4))
    for name in ("X1", "E"):
        built.add(name, path.element(name))
    for leaves, enters in (("L", "P"), ("P", "X2"), ("X2", "P2"), ("P2", "X1"), ("X1", "E")):
        built.connect(leaves, enters)
    np.testing.assert_array_equal(stokes(path), stokes(built))


def test_the_azimuth_of_a_link_stays_with_what_it_leads_to():
    path = op.Source() >> op.Polarizer()
    path.add("analyser", op.Polarizer())
    path.connect("polarizer", "analyser", azimuth=0.4)
    whole = path >> op.Detector()
    whole.insert("grey", op.Attenuator(0.5), behind="polarizer")
    assert whole.graph.edges["grey", "analyser", ("out", "in")]["azimuth"] == 0.4
    assert whole.trace().intensity == pytest.approx(0.25 * np.cos(0.4) ** 2)


def test_an_inserted_element_turns_nothing_behind_it():
    by_azimuth, by_angle = two_reflections(), two_reflections()
    by_azimuth.insert("P2", op.Polarizer(azimuth=0.3), behind="X1")
    by_angle.insert("P2", op.Polarizer(angle=0.3), behind="X1")
    np.testing.assert_allclose(stokes(by_azimuth), stokes(by_angle), rtol=1e-14, atol=1e-15)


def test_an_azimuth_that_is_open_is_taken_back_as_well():
    path = op.Source() >> op.Polarizer() >> op.Polarizer(0.5).named("last") >> op.Detector()
    turned = op.Polarizer(azimuth=op.Parameter("turn"))
    path.insert("between", turned, behind="polarizer")
    expected = 0.5 * np.cos(0.2) ** 2 * np.cos(0.3) ** 2
    assert path.trace(turn=0.2).intensity == pytest.approx(expected)


def test_taps_stay_with_the_port_in_front_of_what_is_inserted():
    path = op.load_preset("ellipsometer-pcsa")
    state = path.trace().stokes
    path.insert("grey", op.Attenuator(0.5), behind="S")
    lights = path.trace_all()
    np.testing.assert_allclose(lights["state"].stokes, state, rtol=1e-14)
    assert path.compose().taps == ("S.reflected -> state.in",)
    whole = op.load_preset("ellipsometer-pcsa").trace_all()["photometer"].intensity
    assert lights["photometer"].intensity == pytest.approx(whole / 2, rel=1e-14)


def test_what_is_inserted_between_world_frames_stands_in_that_of_the_port():
    frame = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 1.0, 0.0, 0.0]), {"out": frame})
    lamp >> path.add("eye", op.Detector(), {"in": frame})
    path.insert("P", op.Polarizer(np.pi / 3), behind="lamp")
    assert path.trace().intensity == pytest.approx(0.25, abs=1e-15)
    np.testing.assert_array_equal(path.trace().frame.z, frame.z)
    before = path.to_toml()
    for element in (op.Mirror(), op.Polarizer(azimuth=0.1)):
        with pytest.raises(op.PathError, match="world frame"):
            path.insert("more", element, behind="lamp")
    assert path.to_toml() == before


def test_nothing_is_inserted_between_points_in_space():
    path = op.load_preset("npgr026-3d", case=7)
    path.insert("grey", op.Attenuator(0.5), behind="P")
    with pytest.raises(op.PathError, match="stands relatively between the vertices"):
        path.insert("more", op.Polarizer(), behind="X2")


@pytest.mark.parametrize(
    "where", [{"before": "E"}, {"before": "E.in"}, {"behind": "X1", "before": "E.in"}]
)
def test_an_element_is_inserted_before_a_port_as_behind_the_other_of_the_link(where):
    path, other = two_reflections(), two_reflections()
    path.insert("P2", op.Polarizer(0.3), **where)
    other.insert("P2", op.Polarizer(0.3), behind="X1")
    assert path == other


def test_what_is_inserted_before_a_port_that_a_tap_leads_to_stands_in_the_tap():
    path = op.load_preset("ellipsometer-pcsa")
    state, whole = (path.trace_all()[name].intensity for name in ("state", "photometer"))
    path.insert("grey", op.Attenuator(0.5), before="state")
    assert path.compose().taps == ("S.reflected -> grey.in",)
    assert path.trace_all()["state"].intensity == pytest.approx(state / 2)
    assert path.trace_all()["photometer"].intensity == pytest.approx(whole)


def test_a_port_that_several_links_lead_to_asks_for_the_other_end():
    path = op.PathGraph()
    path.add("eye", op.Detector())
    for name, intensity in (("lamp", 1.0), ("other", 3.0)):
        path.add(name, op.Source(intensity)) >> path["eye"]
    with pytest.raises(op.PathError, match=r"'eye\.in' is fed by .*, such as behind='lamp\.out'"):
        path.insert("grey", op.Attenuator(0.5), before="eye")
    path.insert("grey", op.Attenuator(0.5), behind="lamp.out", before="eye")
    assert path.trace().intensity == 3.5


def test_a_mirror_is_inserted_by_its_natural_way():
    path = op.Source() >> op.Detector()
    path.insert("mirror", op.Mirror(r_s=-0.5, r_p=0.5), behind="source")
    assert path.trace().intensity == 0.25


@pytest.mark.parametrize(
    ("element", "behind", "told"),
    [
        (op.BeamSplitter(), "X2", "'new' has no one natural way out"),
        (op.Detector(), "X2", "'new' has no way out"),
        (op.Source(), "X2", "'new' has no way in"),
        (op.Polarizer(), "X2.transmitted", r"'X2\.transmitted' feeds no link"),
        (op.Polarizer(), "X2.in", "lets light in"),
        (op.Polarizer(), "E", "'E' has no way out"),
        (op.Polarizer(), "X3", "node .X3. does not exist"),
        ("red", "X2", "must be an element such as"),
    ],
)
def test_what_cannot_be_inserted_is_told_and_leaves_the_path_as_it_was(element, behind, told):
    path = two_reflections()
    with pytest.raises(op.PathError, match=told):
        path.insert("new", element, behind=behind)
    assert path == two_reflections()


@pytest.mark.parametrize(
    ("where", "told"),
    [
        ({}, r"is told no link; give it behind='node\.port'"),
        (
            {"before": "X1.back"},
            r"write path\.add\('new', \.\.\.\) and path\.connect\('new', 'X",
        ),
        ({"behind": "X2", "before": "E"}, r"no link 'X2\.reflected -> E\.in'; did you mean 'X1"),
    ],
)
def test_where_nothing_can_be_inserted_is_told(where, told):
    path = two_reflections()
    with pytest.raises(op.PathError, match=told):
        path.insert("new", op.Polarizer(), **where)
    assert path == two_reflections()


@pytest.mark.parametrize("name", ["X1", "a.b"])
def test_a_name_for_what_is_inserted_is_new(name):
    with pytest.raises(op.PathError, match="choose another"):
        two_reflections().insert(name, op.Polarizer(), behind="X2")


def test_what_is_removed_leaves_no_gap():
    path = op.Source() >> op.Polarizer() >> op.Polarizer(0.5).named("between") >> op.Detector()
    path.remove("between")
    assert repr(path) == "<PathGraph: source >> polarizer >> detector>"
    assert path.trace().intensity == 0.5


@pytest.mark.parametrize("element", [op.Polarizer(0.3), op.Polarizer(azimuth=0.3)])
def test_what_was_inserted_can_be_removed(element):
    path = two_reflections()
    path.insert("P2", element, behind="X1")
    path.remove("P2")
    assert path == two_reflections()


def test_what_stands_behind_a_removed_element_stays_as_it_was_turned():
    path = op.Source() >> op.Polarizer()
    path = path >> op.Retarder(0.0, azimuth=0.2).named("plate") >> op.Polarizer() >> op.Detector()
    before = path.trace().intensity
    path.remove("plate")
    assert path.trace().intensity == pytest.approx(before)
    assert before == pytest.approx(0.5 * np.cos(0.2) ** 2)


def test_azimuths_of_two_links_add_up():
    path = op.PathGraph()
    for name, element in (
        ("lamp", op.Source(stokes=[1.0, 1.0, 0.0, 0.0])),
        ("grey", op.Rotator(0)),
    ):
        path.add(name, element)
    path.add("filter", op.Polarizer()) >> path.add("eye", op.Detector())
    path.connect("lamp", "grey", azimuth=0.25)
    path.connect("grey", "filter", azimuth=0.5)
    path.remove("grey")
    assert path.trace().intensity == pytest.approx(np.cos(0.75) ** 2)


def test_a_splitter_is_removed_along_the_light_it_lets_through():
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("split", op.BeamSplitter(0.25))
    path.connect("split.transmitted", path.add("eye", op.Detector()).name)
    path.remove("split")
    assert path.trace().intensity == 1.0


def test_an_end_is_removed_with_its_links():
    path = op.load_preset("glass-slab")
    path.remove("reflected")
    assert "front.reflected" in path.compose().outlets


@pytest.mark.parametrize(
    ("preset", "name", "told"),
    [
        ("npgr026", "X1", r"not go straight .* 'X2\.reflected -> X1\.in' and 'X1\.reflected -> E"),
        ("npgr026", "X3", "node 'X3' does not exist"),
        ("glass-slab", "front", r"several links meet at 'front', .*'up\.out -> front\.back'"),
        ("npgr026-3d", "X2", "not go straight through 'X2'"),
    ],
)
def test_a_gap_that_does_not_close_by_itself_is_told(preset, name, told):
    path = op.load_preset(preset)
    with pytest.raises(op.PathError, match=told):
        path.remove(name)
    assert path == op.load_preset(preset)


def test_a_tap_is_in_the_way_of_removing_what_it_reads():
    path = two_reflections()
    path.add("state", op.Detector())
    path.connect("P", "state", tap=True)
    with pytest.raises(op.PathError, match=r"'P\.out -> state\.in'"):
        path.remove("P")


def test_what_stands_in_a_tap_is_removed_and_the_tap_stays():
    path = two_reflections()
    path.add("P2", op.Polarizer()) >> path.add("state", op.Detector())
    path.connect("X2", "P2", tap=True)
    path.remove("P2")
    assert path.compose().taps == ("X2.reflected -> state.in",)


def test_a_gap_is_not_closed_by_a_link_that_is_there():
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("grey", op.Attenuator(0.5))
    path["grey"] >> path.add("eye", op.Detector())
    path.connect("lamp", "eye", tap=True)
    with pytest.raises(op.PathError, match=r"two links 'lamp\.out -> eye\.in'"):
        path.remove("grey")


def test_an_element_is_replaced_in_its_place():
    path = two_reflections()
    mirror = op.Mirror(azimuth=path.element("X1").azimuth)
    assert repr(path.replace("X1", mirror)) == "Node 'X1'"
    assert repr(path) == repr(two_reflections())
    # An ideal mirror keeps all the light.
    lights = path.trace(keep="all")
    expected = lights["X2.reflected -> X1.in"].intensity
    assert lights["E"].intensity == pytest.approx(expected, rel=1e-14)


def test_a_replacement_without_the_azimuth_of_the_old_element_is_refused():
    path, gold = two_reflections(), op.Material(0.17, 3.15)
    delta, azimuth = path.element("X1").incidence, path.element("X1").azimuth
    with pytest.raises(op.PathError, match=r"'X1' is turned by its azimuth -rho, .* 0\.0 for none"):
        path.replace("X1", op.Interface(gold, delta))
    assert path == two_reflections()
    # Both cures do.
    path.replace("X1", op.Interface(gold, delta, azimuth=azimuth))
    assert path.element("X1").azimuth == azimuth
    unturned = two_reflections()
    unturned.disconnect("X2.reflected", "X1.in")
    unturned.connect("X2.reflected", "X1.in", azimuth=0.0)
    unturned.replace("X1", op.Interface(gold, delta))
    np.testing.assert_array_equal(stokes(unturned), path.trace(rho=0.0).stokes)


def test_the_cure_for_a_lost_azimuth_names_the_link_that_it_turned():
    path, azimuth = op.load_preset("glass-slab"), 0.3
    path.disconnect("lamp")
    path.connect("lamp", "front")  # Behind the one to front.back.
    front = path.element("front")
    path.replace("front", dataclasses.replace(front, azimuth=azimuth))
    with pytest.raises(op.PathError, match=r"path\.disconnect\('lamp\.out', 'front\.in'\)"):
        path.replace("front", front)


def test_a_second_link_of_a_port_is_mended_by_the_call_that_the_sentence_names():
    path = op.load_preset("npgr026")
    path.add("P2", op.Polarizer(0.3))
    path.connect("X1.reflected", "P2.in")
    path.connect("P2.out", "E.in")
    call = 'path.disconnect("X1.reflected", "E.in")'
    with pytest.raises(op.PathError) as fault:
        path.trace()
    assert f"take all but one out, by {call}, and put one" in str(fault.value)
    with pytest.raises(op.PathError) as fault:
        path.insert("P3", op.Polarizer(0.3), behind="X1.reflected")
    assert str(fault.value).endswith(f"take all but one out first, by {call}")
    path.disconnect("X1.reflected", "E.in")
    other = op.load_preset("npgr026")
    other.insert("P2", op.Polarizer(0.3), behind="X1")
    assert path == other


def test_a_port_without_a_link_says_how_to_connect_an_element():
    path = two_reflections()
    with pytest.raises(
        op.PathError, match=r"write path\.add\('D', \.\.\.\) and path\.connect\('X1"
    ):
        path.insert("D", op.Polarizer(), behind="X1.transmitted")


def test_world_frames_stay_where_an_element_is_replaced():
    frame = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    path = op.PathGraph()
    nodes = [
        path.add(name, element, {port: frame})
        for name, element, port in (
            ("lamp", op.Source(), "out"),
            ("filter", op.Polarizer(), "in"),
            ("eye", op.Detector(), "in"),
        )
    ]
    nodes[0] >> nodes[1] >> nodes[2]
    path.replace("filter", op.Attenuator(0.25))
    assert path.trace().intensity == 0.25
    with pytest.raises(op.PathError, match="by its world frames and by an azimuth"):
        path.replace("filter", op.Polarizer(azimuth=0.1))
    assert path.trace().intensity == 0.25


@pytest.mark.parametrize(
    ("element", "told"),
    [
        (op.Polarizer(), r"no 'X1\.reflected', .* it has 'X1\.in' and 'X1\.out'"),
        (op.Detector(), r"no 'X1\.reflected', .* it has 'X1\.in'"),
        (op.Source(), r"no 'X1\.in' and 'X1\.reflected', .* it has 'X1\.out'"),
        (1.5, "must be an element such as"),
    ],
)
def test_ports_that_a_replacement_lacks_are_told(element, told):
    path = two_reflections()
    with pytest.raises(op.PathError, match=told):
        path.replace("X1", element)
    assert path == two_reflections()


def test_a_link_is_taken_out_and_another_put_in():
    path = op.load_preset("npgr026")
    path.add("P2", op.Polarizer(0.3))
    # In either order, since a path is judged when it is whole.
    path.connect("X1", "P2")
    path.disconnect("X1.reflected", "E.in")
    path.connect("P2", "E")
    other = op.load_preset("npgr026")
    other.insert("P2", op.Polarizer(0.3), behind="X1")
    assert path == other


def test_the_one_link_of_a_port_is_taken_out_by_the_port_alone():
    path, other = two_reflections(), two_reflections()
    path.disconnect("X1.reflected")
    other.disconnect("X1.reflected", "E.in")
    assert path == other
    with pytest.raises(op.PathError, match=r"'X1\.reflected' feeds no link; there are: L\.out"):
        path.disconnect("X1")


def test_a_port_that_feeds_several_links_is_asked_which_is_taken_out():
    path = op.load_preset("ellipsometer-pcsa")
    with pytest.raises(op.PathError) as told:
        path.disconnect("S")
    assert str(told.value).endswith("such as path.disconnect('S.reflected', 'A.in')")
    path.disconnect("S.reflected", "A.in")
    assert not path.graph.has_edge("S", "A")


@pytest.mark.parametrize(
    ("element", "name"), [(op.Rotator(0.2), "rotator"), (op.Rotator(0.2).named("a"), "a")]
)
def test_an_element_without_a_name_is_told_how_to_add_it(element, name):
    with pytest.raises(op.PathError, match=rf"path\.add\('{name}', Rotator\(angle=0\.2\)\)$"):
        op.PathGraph().add(element)


def test_a_link_that_is_not_there_is_not_taken_out():
    path = two_reflections()
    with pytest.raises(op.PathError, match=r"no link 'X2\.reflected -> E\.in'; did you mean"):
        path.disconnect("X2", "E")
    path.disconnect("X1", "E")
    with pytest.raises(op.PathError, match=r"no link 'X1\.reflected -> E\.in'; there are: L\.out"):
        path.disconnect("X1", "E")
    with pytest.raises(op.PathError, match="reaches no detector"):
        path.trace()


@pytest.mark.parametrize(
    "change",
    [
        lambda path: path.insert("P2", op.Attenuator(0.5), behind="X1"),
        lambda path: path.remove("P"),
        lambda path: path.replace("P", op.Attenuator(0.5)),
        lambda path: path.connect("X1.transmitted", path.add("rest", op.Dump()).name),
    ],
)
def test_a_path_that_is_changed_is_composed_anew(change):
    path = two_reflections()
    plan = path.compose()
    change(path)
    assert path.compose() != plan


def test_the_graph_that_was_handed_out_shows_what_is_changed():
    path = two_reflections()
    graph = path.graph
    path.insert("P2", op.Polarizer(), behind="X1")
    assert "P2" in graph
