"""Paths laid out in space by the laws of reflection and refraction, and their pictures."""

import json

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.transforms import Bbox

import optipath as op
from optipath.paths.files.presets import preset_names
from optipath.plots import bench, geometry
from optipath.plots.colors import FAINT
from optipath.plots.scene.bench import DIAL, ELLIPSE
from optipath.plots.scene.layout import SceneNode, scene_of
from pictures import faults_of
from tables import rows, slow

PLANE = ["malus", "solc-filter", "sky-and-window", "glass-slab", "coated-metal"]
PLANE += ["double-pass-waveplate", "faraday-isolator", "fresnel-rhomb", "pile-of-plates"]
PLANE += ["npgr026-3d"]
MALUS = op.load_preset("malus")


def texts_in(ax):
    return {text.get_text() for text in ax.texts if text.get_text()}


def beams_in(ax):
    return [line for line in ax.lines if line.get_zorder() == 3.0]


def turn_of(ax, middle):
    """To which side the head in a picture goes round a middle: 1 is counter-clockwise."""
    (head,) = [patch for patch in ax.patches if patch.get_gid() == "turn"]
    tip, *foot = head.get_xy()[:3]
    way, out = tip - np.mean(foot, axis=0), np.mean(foot, axis=0) - middle
    return np.sign(out[0] * way[1] - out[1] * way[0])


def dials_of(ax, colour=ELLIPSE):
    """The lines in dials, from their middles, 1 being the rim."""
    lines = [line for line in ax.lines if line.get_color() == colour and line.get_zorder() > 6]
    points = [np.array(line.get_xydata()) for line in lines]
    return [(p - (p.min(axis=0) + p.max(axis=0)) / 2) / DIAL / 0.92 for p in points]


@pytest.mark.parametrize(
    "presets", [PLANE[-4:-2], pytest.param(PLANE, marks=pytest.mark.report)], ids=["few", "all"]
)
@rows("size", [(9.0, 5.4), (4.5, 2.7)])
def test_no_name_is_over_another_or_a_symbol_or_cut(presets, size):
    for preset in presets:
        ax = bench(op.load_preset(preset), Figure(size, layout="constrained").add_subplot())
        assert faults_of(ax.figure) == [], preset
        drawn = [each.get_path().transformed(each.get_transform()) for each in ax.patches]
        shapes = [Path(points) for each in drawn for points in each.to_polygons()]
        boxes = [(t.get_text(), t.get_window_extent()) for t in ax.texts if t.get_text()]
        assert not [text for text, box in boxes for each in shapes if each.intersects_bbox(box)]


def test_light_begins_and_ends_at_what_is_drawn_and_no_name_lies_over_a_ray():
    for preset in ("glass-slab", "coated-metal", "double-pass-waveplate"):
        ax = bench(op.load_preset(preset))
        beams = [line for line in beams_in(ax) if line.get_color() != FAINT]
        assert len(beams) >= 4
        drawn = [each for each in ax.patches if each.get_zorder() >= 4.0]
        shapes = [each.get_path().transformed(each.get_patch_transform()) for each in drawn]
        for end in np.concatenate([line.get_xydata() for line in beams]):
            around = Bbox([end - 0.02, end + 0.02])
            assert any(shape.intersects_bbox(around) for shape in shapes), end
    for preset in ("ellipsometer-rough", "ellipsometer-pcsa"):
        ax = bench(op.load_preset(preset))
        assert "--" in {line.get_linestyle() for line in beams_in(ax)}
        rays = [Path(ax.transData.transform(line.get_xydata())) for line in beams_in(ax)]
        boxes = [text.get_window_extent() for text in ax.texts if text.get_text()]
        assert not [box for box in boxes for ray in rays if ray.intersects_bbox(box, filled=False)]


BY_ANGLES = op.VerticesByAngles((0.5, op.Parameter("b", 0.25)), (np.pi,), backwards=True)
REFRACTED, OF_PRISM = np.degrees(np.arcsin([np.sin(np.radians(40.0)) / 1.5, 0.75]))
ASSIGNMENT = "X2\nphi = 56 deg", "X1\ndelta = 53 deg\nazimuth -rho = 0 deg"
SENARMONT = (
    "polarizer\n0 deg",
    "sample\n45 deg\nretardance = 60 deg",
    "analyzer\nanalyzer = 120 deg",
)
OF_CHAIN = "vertex1\nb = 14.324 deg", "vertex2\nincidence = 28.648 deg\nazimuth 180 deg"


@rows(
    "path, told",
    [
        (op.load_preset("senarmont"), SENARMONT),
        (op.load_preset("npgr026", case="1"), ASSIGNMENT),
        # Surfaces at points of the world have the angles of their chain.
        *((op.load_preset(name, rho=0.0), ASSIGNMENT) for name in ("npgr026", "npgr026-3d")),
        (op.path_from_vertices(BY_ANGLES, materials=(1.5, 1.5)), OF_CHAIN),
        # The angle of a face is that at which light meets it.
        (op.load_preset("coated-metal"), [f"metal\nincidence = {REFRACTED:.5g} deg"]),
        (op.load_preset("glass-slab"), [f"back\nincidence = {REFRACTED:.5g} deg"]),
        (op.load_preset("prism-refraction"), [f"front\nincidence = {OF_PRISM:.5g} deg"]),
    ],
)
def test_names_and_values_stand_below_their_symbols(path, told):
    assert {*told} <= texts_in(bench(path))


def test_long_straight_benches_take_rows_and_dials_show_the_light_between_as_malus_has_it():
    ax = bench(op.load_preset("lyot-filter"))
    below = [text.get_position() for text in ax.texts if text.get_transform() == ax.transData]
    assert len(below) == 11
    assert len({y for _, y in below}) > 1
    first, second = dials_of(bench(MALUS, angle="30 deg"))
    assert np.allclose(abs(first).max(axis=0), [1.0, 0.0], atol=1e-9)
    along = second[np.argmax(second[:, 0])]
    assert np.allclose(along, [np.cos(np.pi / 6), 0.5], atol=1e-2)
    (axis,) = dials_of(bench(op.load_preset("quartz-quarter-wave")), "#222222")
    way = axis[1] - axis[0]
    assert abs(np.degrees(np.arctan2(way[1], way[0])) % 180.0 - 135.0) < 1e-6
    assert not [patch for patch in bench(MALUS).patches if patch.get_gid() == "turn"]
    assert len(dials_of(bench(MALUS, angle="90 deg"))) == 1
    senarmont = op.load_preset("senarmont")
    dark, lit = (bench(senarmont, analyzer=angle) for angle in ("120 deg", "100 deg"))
    assert len(dials_of(lit)) - len(dials_of(dark)) == 1
    assert len(dials_of(lit, FAINT)) == len(dials_of(dark, FAINT)) == 3


@rows("s3", [1.0, -1.0])
def test_heads_turn_as_the_field_does_to_who_looks_at_the_source(s3):
    for tilt in (0.0, 0.3):
        light = op.Source(stokes=[1.0, np.sin(tilt), 0.0, s3 * np.cos(tilt)])
        assert turn_of(bench(light >> op.Detector()), np.array([0.5, 0.0])) == s3
    # The light goes along x of the world: from an azimuth of 45 deg one looks at the source.
    path = op.Source(stokes=[1.0, 0.0, 0.0, s3]) >> op.Detector()
    for azimuth, towards in ((45.0, 1.0), (225.0, -1.0)):
        ax = geometry(path, view=(20.0, azimuth))
        (ellipse,) = [line for line in ax.lines if line.get_zorder() == 5.0]
        assert turn_of(ax, np.mean(ellipse.get_xydata()[:-1], axis=0)) == s3 * towards


@pytest.mark.parametrize(
    ("preset", "folded"),
    [
        ("fresnel-rhomb", {"incidence": "10 deg"}),
        slow(("npgr026", {"delta": "89.99 deg", "phi": "0.01 deg"})),
    ],
)
def test_where_symbols_lie_over_one_another_that_is_said_with_the_cure(preset, folded):
    said = "symbols lie over one another: the picture 'geometry' has this path in space"
    for values, expected in ((folded, True), ({}, False)):
        ax = bench(op.load_preset(preset), **values)
        assert (said in " ".join(texts_in(ax)).replace("\n", " ")) is expected
        assert faults_of(ax.figure) == []


# In space.


def test_a_picture_in_space_has_all_names_a_key_and_what_was_chosen():
    def key_of(preset):
        return {text.get_text() for text in geometry(preset).get_legend().get_texts()}

    ax = geometry(op.load_preset("npgr026", case="8"))
    angles = {"delta = 48 deg", "phi = 20 deg", "rho = 34 deg", "filter = 0 deg"}
    assert {"L", "P", "X2", "X1", "E"} | angles <= texts_in(ax)
    assert key_of(MALUS) == {"x of a frame", "y", "polarisation"}
    expected = {"x of a frame (s)", "y (p)", "plane of incidence", "tap"}
    assert expected <= key_of(op.load_preset("ellipsometer-pcsa"))
    texts = texts_in(geometry(op.load_preset("ellipsometer-rough")))
    (note,) = [text for text in texts if "lengths are chosen" in text]
    assert "schematic" in note


@pytest.mark.parametrize("preset", ["npgr026", *map(slow, ("npgr026-3d", "copper-gold-spectrum"))])
def test_what_is_left_out_has_its_name_at_its_plate(preset):
    ax = geometry(op.load_preset(preset))
    boxes = {text.get_text(): text.get_window_extent() for text in ax.texts}
    plate, absent = boxes["P"], boxes["filter = none"]
    apart = np.maximum(absent.min - plate.max, plate.min - absent.max)
    assert apart.max() < 3.0 * plate.height


@pytest.mark.parametrize(
    ("values", "presets"),
    [
        ({"delta": "0 deg", "phi": "0 deg"}, ["npgr026"]),
        slow(({"delta": "0 deg", "phi": "0 deg"}, ["npgr026-3d"])),
        slow(({"delta": "90 deg", "phi": "90 deg", "rho": "90 deg"}, ["npgr026", "npgr026-3d"])),
        slow(({"rho": "180 deg"}, ["npgr026", "npgr026-3d"])),
        ({"intensity": 0.0}, ["npgr026-3d"]),
        slow(({"intensity": 0.0}, ["npgr026"])),
        slow(({"n": 0.5, "theta": "60 deg"}, ["glass-slab"])),  # Total reflection.
        slow(({}, ["fresnel-rhomb"])),
    ],
)
def test_extreme_values_are_drawn_without_a_fault(values, presets):
    for preset in presets:
        assert faults_of(geometry(op.load_preset(preset), **values).figure) == [], preset


def test_links_are_as_long_to_the_right_as_up_straight_paths_level_and_odd_views_refused():
    ax = geometry(MALUS)
    ax.figure.draw_without_rendering()
    (x0, y0), (x1, y1) = ax.transData.transform([(0.0, 0.0), (1.0, 1.0)])
    assert abs((x1 - x0) / (y1 - y0) - 1.0) < 1e-6
    ax = geometry(MALUS, view=(0.0, -90.0))
    heights = [line.get_ydata() for line in ax.lines if line.get_zorder() == 4.0]
    assert len(heights) == 3
    assert np.allclose(np.concatenate(heights), 0.0, atol=1e-12)
    for draw in (bench, geometry):
        ax = Figure().add_subplot()
        assert draw(MALUS, ax) is ax
    with pytest.raises(op.errors.PathError, match=r"which light leaves at 'X1'; draw 'geometry'"):
        bench(op.load_preset("npgr026", case="8"))
    for view in (3, "front", (1, 2, 3), (np.nan, 0.0)):
        with pytest.raises(op.OptipathError, match="give elevation and azimuth"):
            geometry(MALUS, view=view)


@rows("draw", [geometry, bench, scene_of])
def test_several_paths_no_path_and_light_that_goes_no_way_are_refused_with_the_cure(draw):
    told = f"{draw.__name__.replace('_of', '')} draws one path.*angle.*single values"
    with pytest.raises(op.errors.PathError, match=told):
        draw(MALUS, angle=[0.1, 0.2])
    for wrong in ("malus", op.Polarizer(0.0)):
        with pytest.raises(op.OptipathError, match=r"draws a path, not .*give a PathGraph"):
            draw(wrong)
    points = [[0, -1, 1], [0, 0, 0], [0, 9, 1]]
    path = op.path_from_vertices(points, [1.5], events="T", bad="mask")
    with pytest.raises(op.errors.PathError, match=r"draws light, which is not a number on '"):
        draw(path)


# Scenes.

DEGREES = st.floats(0.0, 90.0)
PANE = [[0, -1, 1], [0, 0, 0], [0, 1, -np.sqrt(3.5)], [0, 2, 0], [0, 3, 1]]
"""Into glass at 45 degrees, reflected below, and out again."""


def by_name(several):
    return {each.name: each for each in several}


def direction(ray):
    way = ray.head - ray.tail
    return way / np.linalg.norm(way)


def frames_of(scene):
    return {port: axes for port, (_, axes) in scene.frames.items()}


def ways_of(scene):
    return {ray.name: direction(ray) for ray in scene.rays}


def axes_of(frame):
    return [frame.x, frame.y, frame.z]


@rows("preset", preset_names())
def test_every_preset_has_right_handed_frames_angles_beside_their_arcs_and_plain_json(preset):
    scene = scene_of(op.load_preset(preset))
    axes = np.array([*(ray.axes for ray in scene.rays), *frames_of(scene).values()])
    eyes = np.broadcast_to(np.eye(3), axes.shape)
    np.testing.assert_allclose(axes @ axes.swapaxes(1, 2), eyes, rtol=0, atol=1e-13)
    assert np.allclose(np.cross(axes[:, 0], axes[:, 1]), axes[:, 2], atol=1e-13)
    for ray in scene.rays:
        assert np.allclose(direction(ray), ray.axes[2], atol=1e-12), ray.name
    for angle in scene.angles:
        seen = len(angle.arc) and np.linalg.norm(angle.arc[-1] - angle.arc[0]) > 0.01 * scene.unit
        near = angle.arc if seen else np.array([angle.centre])
        away = np.linalg.norm(near - angle.at, axis=1).min()
        assert away < 0.02 * scene.unit, angle.text
    told = scene.as_json()
    assert json.loads(json.dumps(told, allow_nan=False)) == told
    assert " ".join(told) == "notes nodes rays planes frames angles"
    assert {*told["nodes"][0]} == {*SceneNode._fields} - {"axis", "element"}
    ray = "name from to ellipse intensity leaves tap"
    assert {*told["rays"][0]} == {*ray.split()}


def in_degrees(delta, phi, rho):
    return {"delta": f"{delta!r} deg", "phi": f"{phi!r} deg", "rho": f"{rho!r} deg"}


@settings(max_examples=4, deadline=None)
@given(DEGREES, st.floats(0.1, 90.0), st.floats(-180.0, 180.0))
@example(0.0, 9.0, 0.0)
@example(0.0, 20.0, 34.0)
@example(90.0, 90.0, 0.0)
@example(48.0, 20.0, 180.0)
def test_the_assignment_by_angles_is_that_by_points_up_to_a_rigid_motion(delta, phi, rho):
    given = in_degrees(delta, phi, rho)
    relative, points = (
        scene_of(op.load_preset(each), **given) for each in ("npgr026", "npgr026-3d")
    )
    one, other = by_name(relative.nodes), by_name(points.nodes)
    first, second = (by_name(scene.rays)["X2.reflected -> X1.in"] for scene in (relative, points))
    motion = second.axes.T @ first.axes
    for name, node in one.items():
        moved = motion @ (node.at - one["X2"].at) + other["X2"].at
        assert np.allclose(moved, other[name].at, atol=1e-9), name
    frames, others = frames_of(relative), frames_of(points)
    for port in frames.keys() & others.keys():
        assert np.allclose(frames[port] @ motion.T, others[port], atol=1e-9), port


@settings(max_examples=6, deadline=None)
@given(DEGREES, DEGREES, st.floats(-180.0, 180.0))
def test_light_is_reflected_at_the_given_angles_and_turned_by_minus_rho(delta, phi, rho):
    scene = scene_of(op.load_preset("npgr026"), **in_degrees(delta, phi, rho))
    nodes, frames = by_name(scene.nodes), frames_of(scene)
    for name, incidence in (("X2", phi), ("X1", delta)):
        arrives, leaves = frames[f"{name}.in"][2], frames[f"{name}.reflected"][2]
        normal = nodes[name].normal
        assert abs(-arrives @ normal - np.cos(np.radians(incidence))) < 1e-12
        assert np.allclose(leaves, arrives - 2 * (arrives @ normal) * normal, atol=1e-12)
        if 1.0 < incidence < 89.0:
            across = np.cross(leaves, arrives)
            across /= np.linalg.norm(across)
            assert np.allclose(frames[f"{name}.in"][0], across, atol=1e-9)
            assert np.allclose(frames[f"{name}.reflected"][0], across, atol=1e-9)
    # The turn about z from one frame to the other.
    first, second = frames["X2.reflected"], frames["X1.in"][0]
    off = np.arctan2(second @ first[1], second @ first[0]) + np.radians(rho)
    assert abs(np.sin(off)) < 1e-12
    assert np.cos(off) > 0.0


def test_nodes_and_frames_of_a_chain_of_points_are_those_of_its_light():
    path = op.path_from_vertices(PANE, materials=[1.5, 0.2 + 3.4j, 1.0], events="TRT")
    lights, scene = path.trace(keep="all"), scene_of(path)
    for ray in scene.rays:
        assert np.allclose(ray.axes, axes_of(lights[ray.name].frame), atol=1e-12), ray.name
    assert np.allclose([node.at for node in scene.nodes], PANE, atol=1e-12)
    assert not any("1 long" in note for note in scene.notes)
    normals = [node.normal for node in scene.nodes[1:-1]]
    assert np.allclose(normals, [[0, 0, 1], [0, 0, 1], [0, 0, -1]], atol=1e-7)
    points = [[0, 0, 0], [0, 0, 6], [0, 6, 6]]
    path = op.path_from_vertices(points, materials=[1.5])
    path.insert("plate", op.Retarder(1.0, 0.0), behind=next(iter(path.graph.nodes)))
    at = {node.kind: node.at for node in scene_of(path).nodes}
    assert np.allclose(at["retarder"], [0, 0, 3], atol=1e-12)
    assert np.allclose(at["source"], 0.0, atol=1e-12)
    # World frames that ports are given are the drawn ones.
    arriving = op.Frame.from_direction(z=(1, 0, -1), x=(0, 1, 0))
    leaving = op.Frame.from_direction(z=(1, 0, 1), x=(0, 1, 0))
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": arriving})
    glass = path.add("glass", op.Interface(1.5, np.pi / 4), {"in": arriving, "reflected": leaving})
    lamp >> glass >> path.add("eye", op.Detector())
    scene = scene_of(path)
    frames = frames_of(scene)
    assert np.allclose(frames["glass.in"], axes_of(arriving))
    assert np.allclose(frames["glass.reflected"], axes_of(leaving))
    assert np.allclose(by_name(scene.nodes)["glass"].normal, [0, 0, 1])


def test_a_slab_refracts_by_snell_and_light_that_comes_back_or_from_a_second_source_is_beside():
    for theta in np.radians([0.0, 30.0, 56.3, 89.0, 90.0]):
        scene = scene_of(op.load_preset("glass-slab"), theta=theta)
        ways, normal = ways_of(scene), by_name(scene.nodes)["front"].normal
        into, out = ways["front.transmitted -> down.in"], ways["back.transmitted -> transmitted.in"]
        assert np.allclose(out, ways["lamp.out -> front.in"], atol=1e-12)
        assert abs(1.5 * np.linalg.norm(np.cross(into, normal)) - np.sin(theta)) < 1e-12
    scene = scene_of(op.load_preset("glass-slab"))
    front, ray = by_name(scene.nodes)["front"], by_name(scene.rays)["up.out -> front.back"]
    assert abs((ray.head - front.at) @ front.normal) < 1e-12
    assert "light comes to 'front' again at another place of its face" in scene.notes
    ways = ways_of(scene_of(op.load_preset("sky-and-window")))
    into, out = ways["lamp.out -> pane.back"], ways["pane.reflected -> polarizer.in"]
    assert np.allclose(into, out, atol=1e-12)
    scene = scene_of(op.load_preset("double-pass-waveplate"))
    rays = by_name(scene.rays)
    there, back = rays["plate.out -> mirror.in"], rays["mirror.reflected -> plate-back.in"]
    assert np.allclose(direction(there), -direction(back), atol=1e-12)
    assert np.linalg.norm(there.head - back.tail) > 0.2
    assert any("beside the way it came" in note for note in scene.notes)


@rows("leaves", [("reflected", "transmitted"), ("transmitted", "reflected")])
@rows("splitter", [op.BeamSplitter, op.PolarizingBeamSplitter])
def test_light_that_a_mirror_sends_back_keeps_away_from_detectors_and_other_light(leaves, splitter):
    path = op.Source().named("lamp") >> splitter().named("cube")
    path.add("aside", op.Detector())
    path.add("mirror", op.Mirror()) >> path.add("eye", op.Detector())
    for port in leaves:
        path.connect(f"cube.{port}", {"reflected": "aside", "transmitted": "mirror"}[port])
    scene = scene_of(path)
    rays, nodes = by_name(scene.rays), by_name(scene.nodes)
    back = rays.pop("mirror.reflected -> eye.in")
    share = np.linspace(0.0, 1.0, 101)[:, np.newaxis]
    beam = back.tail + share * (back.head - back.tail)
    for ray in rays.values():
        other = ray.tail + share * (ray.head - ray.tail)
        assert np.linalg.norm(beam[:, np.newaxis] - other, axis=2).min() > 0.2, ray.name
    for name in ("lamp", "cube", "aside"):
        assert np.linalg.norm(beam - nodes[name].at, axis=1).min() > 0.2, name


def test_lengths_that_are_chosen_what_nobody_knows_and_what_cannot_close_is_said():
    scene = scene_of(op.load_preset("npgr026"))
    lengths = [np.linalg.norm(ray.head - ray.tail) for ray in scene.rays if not ray.leaves]
    assert np.allclose(lengths, 1.0, atol=1e-12)
    assert "lengths are chosen: each link is drawn 1 long" in scene.notes
    scene = scene_of(op.load_preset("ellipsometer-rough"))
    assert any("schematic" in note and "'S'" in note for note in scene.notes)
    scene = scene_of(op.load_preset("ellipsometer-pcsa"))
    assert not any("schematic" in note for note in scene.notes)
    taps = [ray["name"] for ray in scene.as_json()["rays"] if ray["tap"]]
    assert taps == ["S.reflected -> state.in"]
    path = op.Source() >> op.BeamSplitter().named("first")
    path["first.transmitted"] >> path.add("second", op.Combiner()) >> op.Detector()
    path["first.reflected"] >> path.add("turned", op.Rotator(0.1)) >> path["second"]
    scene = scene_of(path)
    assert any("cannot close" in note for note in scene.notes)
    ray = by_name(scene.rays)["turned.out -> second.in"]
    assert np.allclose(direction(ray), ray.axes[2], atol=1e-12)


def test_a_polarizing_beam_splitter_reflects_to_the_side_and_lights_that_meet_come_from_two():
    path = op.Source() >> op.PolarizingBeamSplitter().named("cube")
    path["cube.reflected"] >> path.add("aside", op.Detector())
    path["cube.transmitted"] >> path.add("on", op.Detector())
    ways = ways_of(scene_of(path))
    into = ways["source.out -> cube.in"]
    assert abs(into @ ways["cube.reflected -> aside.in"]) < 1e-12
    assert np.allclose(into, ways["cube.transmitted -> on.in"], atol=1e-12)
    path = op.PathGraph()
    eye = path.add("eye", op.Detector())
    path.add("one", op.Source()) >> eye
    path.add("two", op.Source()) >> eye
    first, second = ways_of(scene_of(path)).values()
    assert first @ second < 0.9


def test_angles_have_names_values_and_arcs_and_light_ellipses_as_large_as_they_are():
    scene = scene_of(op.load_preset("npgr026", case="8"), delta="40 deg")
    assert [angle.text for angle in scene.angles] == [
        "filter = 0 deg",
        "phi = 20 deg",
        "rho = 34 deg",
        "delta = 40 deg",
    ]
    scene = scene_of(op.load_preset("npgr026", case="8"))
    nodes, angles = by_name(scene.nodes), by_name(scene.angles)
    for name, node, expected in (("phi", "X2", 20.0), ("delta", "X1", 48.0)):
        first, last = (angles[name].arc[end] - nodes[node].at for end in (0, -1))
        cosine = first @ last / np.linalg.norm(first) / np.linalg.norm(last)
        assert abs(np.degrees(np.arccos(cosine)) - expected) < 1e-9
    scene = scene_of(op.load_preset("npgr026", case="8"))
    rays = by_name(scene.rays)
    linear = rays["P.out -> X2.in"]
    assert np.allclose(linear.ellipse @ linear.axes[2], 0.0, atol=1e-12)
    assert abs(np.abs(linear.ellipse @ linear.axes[0]).max() - 0.18) < 1e-12
    assert rays["L.out -> P.in"].ellipse is None
    assert rays["L.out -> P.in"].light.dop == 0.0
    told = scene_of(op.load_preset("npgr026"), intensity=0.0).as_json()
    found = {(ray["ellipse"], ray["intensity"]) for ray in told["rays"]}
    assert found == {(None, 0.0)}
    (found,) = [a for a in scene_of(op.load_preset("npgr026")).angles if a.name == "filter"]
    assert found.text == "filter = none"
    assert found.arc.shape == (0, 3)
    texts = [angle.text for angle in scene_of(op.load_preset("npgr026").reversed()).angles]
    assert "filter = none" in texts
    assert not any(text.startswith("-") for text in texts)
    # Small angles are in the unit of their parameter.
    for unit in ({}, {"unit": "arcsec"}):
        tilt = op.Parameter("tilt", "10 arcsec", **unit)
        path = op.Source() >> op.Polarizer(tilt) >> op.Detector()
        assert [angle.text for angle in scene_of(path).angles] == ["tilt = 10 arcsec"]


def test_frames_are_drawn_as_a_path_has_them_and_turns_by_numbers_have_their_names():
    path = op.load_preset("npgr026-3d", case="7")
    frames = path.frames()
    for port, (_, drawn) in scene_of(path).frames.items():
        name, _, way = port.partition(".")
        frame = frames[name][way]
        assert np.allclose(drawn, [frame.x, frame.y, frame.z], atol=1e-15), port
    path = op.load_preset("ellipsometer-pcsa")
    drawn = {angle.text for angle in scene_of(path).angles if angle.name == "turn"}
    turns = {f"turn = {np.degrees(t):.5g} deg" for t in path.frames().turns.values() if t}
    assert drawn == turns == {"turn = 90 deg", "turn = -90 deg"}
