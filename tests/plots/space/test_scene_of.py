"""A path laid out in space obeys the laws of reflection and refraction, in the library's frames."""

import json

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import optipath as op
from optipath.paths.presets.loader import preset_names
from optipath.plots.space.scene import SceneNode
from optipath.plots.space.scene_of import scene_of
from tables import rows

DEGREES = st.floats(0.0, 90.0)
PANE = [[0, -1, 1], [0, 0, 0], [0, 1, -np.sqrt(3.5)], [0, 2, 0], [0, 3, 1]]
"""Into glass at 45 degrees, reflected below, and out again."""


def by_name(several):
    return {each.name: each for each in several}


def direction(ray):
    way = ray.head - ray.tail
    return way / np.linalg.norm(way)


def turn(first, second):
    """The turn about z from one frame to another, in radians."""
    return np.arctan2(second[0] @ first[1], second[0] @ first[0])


@rows("preset", preset_names())
def test_every_frame_of_every_preset_is_right_handed_along_its_ray(preset):
    scene = scene_of(op.load_preset(preset))
    for axes in [each.axes for each in (*scene.rays, *scene.frames)]:
        assert np.allclose(axes @ axes.T, np.eye(3), atol=1e-13)
        assert np.allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-13)
    for ray in scene.rays:
        assert np.allclose(direction(ray), ray.axes[2], atol=1e-12), ray.name


@rows("preset", preset_names())
def test_what_every_preset_tells_a_page_is_plain_json_with_the_agreed_keys(preset):
    told = scene_of(op.load_preset(preset)).as_json()
    assert json.loads(json.dumps(told, allow_nan=False)) == told
    expected = "notes schematic nodes rays planes frames angles bounds"
    assert [*told] == expected.split()
    assert {*told["nodes"][0]} == {*SceneNode._fields} - {"axis"}
    ray = "name start end from to frame ellipse intensity dop leaves tap"
    assert {*told["rays"][0]} == {*ray.split()}


def test_links_of_a_relative_path_are_1_long_and_that_is_said():
    scene = scene_of(op.load_preset("npgr026"))
    lengths = [np.linalg.norm(ray.head - ray.tail) for ray in scene.rays if not ray.leaves]
    assert np.allclose(lengths, 1.0, atol=1e-12)
    assert "lengths are chosen: each link is drawn 1 long" in scene.notes


@settings(max_examples=25, deadline=None)
@given(DEGREES, st.floats(0.1, 90.0), st.floats(-180.0, 180.0))
@example(0.0, 9.0, 0.0)
@example(0.0, 20.0, 34.0)
@example(90.0, 90.0, 0.0)
@example(48.0, 20.0, 180.0)
def test_the_assignment_by_angles_is_that_by_points_up_to_a_rigid_motion(delta, phi, rho):
    given = {name: f"{v!r} deg" for name, v in (("delta", delta), ("phi", phi), ("rho", rho))}
    relative, points = (
        scene_of(op.load_preset(name), **given) for name in ("npgr026", "npgr026-3d")
    )
    one, other = by_name(relative.nodes), by_name(points.nodes)
    first, second = (by_name(scene.rays)["X2.reflected -> X1.in"] for scene in (relative, points))
    motion = second.axes.T @ first.axes
    for name, node in one.items():
        moved = motion @ (node.at - one["X2"].at) + other["X2"].at
        assert np.allclose(moved, other[name].at, atol=1e-9), name
    frames = {each.port: each.axes for each in points.frames}
    for each in relative.frames:
        if each.port in frames:
            assert np.allclose(each.axes @ motion.T, frames[each.port], atol=1e-9), each.port


@settings(max_examples=15, deadline=None)
@given(DEGREES, DEGREES, st.floats(-180.0, 180.0))
def test_light_is_reflected_at_the_given_angles_and_turned_by_minus_rho(delta, phi, rho):
    given = {"delta": f"{delta!r} deg", "phi": f"{phi!r} deg", "rho": f"{rho!r} deg"}
    scene = scene_of(op.load_preset("npgr026"), **given)
    nodes, frames = by_name(scene.nodes), {each.port: each.axes for each in scene.frames}
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
    found = turn(frames["X2.reflected"], frames["X1.in"])
    assert abs(np.sin(found + np.radians(rho))) < 1e-12
    assert np.cos(found + np.radians(rho)) > 0.0


def test_nodes_and_frames_of_a_chain_of_points_are_those_of_its_light():
    path = op.path_from_vertices(PANE, materials=[1.5, 0.2 + 3.4j, 1.0], events="TRT")
    lights, scene = path.trace(keep="all"), scene_of(path)
    for ray in scene.rays:
        frame = lights[ray.name].frame
        assert np.allclose(ray.axes, [frame.x, frame.y, frame.z], atol=1e-12), ray.name
    path = op.path_from_vertices(PANE, materials=[1.5, 0.2 + 3.4j, 1.0], events="TRT")
    scene = scene_of(path)
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


def test_world_frames_that_ports_are_given_are_the_drawn_ones():
    arriving = op.Frame.from_direction(z=(1, 0, -1), x=(0, 1, 0))
    leaving = op.Frame.from_direction(z=(1, 0, 1), x=(0, 1, 0))
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": arriving})
    glass = path.add("glass", op.Interface(1.5, np.pi / 4), {"in": arriving, "reflected": leaving})
    lamp >> glass >> path.add("eye", op.Detector())
    scene = scene_of(path)
    frames = {each.port: each.axes for each in scene.frames}
    assert np.allclose(frames["glass.in"], [arriving.x, arriving.y, arriving.z])
    assert np.allclose(frames["glass.reflected"], [leaving.x, leaving.y, leaving.z])
    assert np.allclose(by_name(scene.nodes)["glass"].normal, [0, 0, 1])


@rows("theta", [0.0, 30.0, 56.3, 89.0, 90.0])
def test_a_slab_refracts_by_snell_and_lets_light_out_parallel(theta):
    scene = scene_of(op.load_preset("glass-slab"), theta=np.radians(theta))
    ways = {name: direction(ray) for name, ray in by_name(scene.rays).items()}
    normal = by_name(scene.nodes)["front"].normal
    into, out = ways["front.transmitted -> down.in"], ways["back.transmitted -> transmitted.in"]
    assert np.allclose(out, ways["lamp.out -> front.in"], atol=1e-12)
    sine = np.linalg.norm(np.cross(into, normal))
    assert abs(1.5 * sine - np.sin(np.radians(theta))) < 1e-12


def test_light_that_comes_back_or_from_a_second_source_is_drawn_beside():
    scene = scene_of(op.load_preset("glass-slab"))
    front, ray = by_name(scene.nodes)["front"], by_name(scene.rays)["up.out -> front.back"]
    assert abs((ray.head - front.at) @ front.normal) < 1e-12
    assert "light comes to 'front' again at another place of its face" in scene.notes
    scene = scene_of(op.load_preset("sky-and-window"))
    rays = by_name(scene.rays)
    into, out = rays["lamp.out -> pane.back"], rays["pane.reflected -> polarizer.in"]
    assert np.allclose(direction(into), direction(out), atol=1e-12)
    scene = scene_of(op.load_preset("double-pass-waveplate"))
    rays = by_name(scene.rays)
    there, back = rays["plate.out -> mirror.in"], rays["mirror.reflected -> plate-back.in"]
    assert np.allclose(direction(there), -direction(back), atol=1e-12)
    assert np.linalg.norm(there.head - back.tail) > 0.2
    assert any("beside the way it came" in note for note in scene.notes)


@rows("leaves", [("reflected", "transmitted"), ("transmitted", "reflected")])
@rows("splitter", [op.BeamSplitter, op.PolarizingBeamSplitter])
def test_light_that_a_mirror_sends_back_keeps_away_from_detectors_and_other_light(leaves, splitter):
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("cube", splitter())
    for name, element in zip(
        ("aside", "mirror", "eye"), (op.Detector(), op.Mirror(), op.Detector()), strict=True
    ):
        path.add(name, element)
    for port in leaves:
        path.connect(f"cube.{port}", {"reflected": "aside", "transmitted": "mirror"}[port])
    path.connect("mirror", "eye")
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


def test_an_angle_that_nobody_knows_is_said_to_be_schematic():
    scene = scene_of(op.load_preset("ellipsometer-rough"))
    assert scene.schematic
    assert any("schematic" in note and "'S'" in note for note in scene.notes)
    assert not scene_of(op.load_preset("ellipsometer-pcsa")).schematic


def test_a_polarizing_beam_splitter_reflects_to_the_side():
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("cube", op.PolarizingBeamSplitter())
    path.add("aside", op.Detector())
    path.add("on", op.Detector())
    path.connect("lamp", "cube.in")
    path.connect("cube.reflected", "aside")
    path.connect("cube.transmitted", "on")
    rays = by_name(scene_of(path).rays)
    ways = {name: direction(ray) for name, ray in rays.items()}
    into = ways["lamp.out -> cube.in"]
    assert abs(into @ ways["cube.reflected -> aside.in"]) < 1e-12
    assert np.allclose(into, ways["cube.transmitted -> on.in"], atol=1e-12)


def test_lights_that_meet_come_from_several_sides():
    path = op.PathGraph()
    one, two = path.add("one", op.Source()), path.add("two", op.Source())
    eye = path.add("eye", op.Detector())
    one >> eye
    two >> eye
    ways = [direction(ray) for ray in scene_of(path).rays]
    assert ways[0] @ ways[1] < 0.9


def test_a_picture_that_cannot_close_says_so():
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("first", op.BeamSplitter())
    path.add("turned", op.Rotator(0.1))
    path.add("second", op.Combiner())
    path.add("eye", op.Detector())
    for leaves, enters in (
        ("lamp", "first.in"),
        ("first.transmitted", "second"),
        ("first.reflected", "turned"),
        ("turned", "second"),
        ("second", "eye"),
    ):
        path.connect(leaves, enters)
    scene = scene_of(path)
    assert any("cannot close" in note for note in scene.notes)
    ray = by_name(scene.rays)["turned.out -> second.in"]
    assert np.allclose(direction(ray), ray.axes[2], atol=1e-12)


def test_angles_have_names_values_and_arcs_as_wide_as_they_are():
    scene = scene_of(op.load_preset("npgr026", case="8"), delta="40 deg")
    texts = [angle.text for angle in scene.angles]
    assert texts == ["filter = 0 deg", "phi = 20 deg", "rho = 34 deg", "delta = 40 deg"]
    scene = scene_of(op.load_preset("npgr026", case="8"))
    nodes, angles = by_name(scene.nodes), by_name(scene.angles)
    for name, node, expected in (("phi", "X2", 20.0), ("delta", "X1", 48.0)):
        first, last = (angles[name].arc[end] - nodes[node].at for end in (0, -1))
        cosine = first @ last / np.linalg.norm(first) / np.linalg.norm(last)
        assert abs(np.degrees(np.arccos(cosine)) - expected) < 1e-9


@rows("preset", preset_names())
def test_the_names_of_angles_belong_to_their_arcs(preset):
    scene = scene_of(op.load_preset(preset))
    for angle in scene.angles:
        seen = len(angle.arc) and np.linalg.norm(angle.arc[-1] - angle.arc[0]) > 0.01 * scene.unit
        near = angle.arc if seen else np.array([angle.centre])
        away = np.linalg.norm(near - angle.at, axis=1).min()
        assert away < 0.02 * scene.unit, angle.text


def test_a_page_is_told_which_rays_are_taps():
    told = scene_of(op.load_preset("ellipsometer-pcsa")).as_json()
    taps = [ray["name"] for ray in told["rays"] if ray["tap"]]
    assert taps == ["S.reflected -> state.in"]


def test_an_element_that_is_left_out_has_no_arc_and_no_sign():
    (found,) = [a for a in scene_of(op.load_preset("npgr026")).angles if a.name == "filter"]
    assert found.text == "filter = none"
    assert found.arc.shape == (0, 3)
    texts = [angle.text for angle in scene_of(op.load_preset("npgr026").reversed()).angles]
    assert "filter = none" in texts
    assert not any(text.startswith("-") for text in texts)


@rows("given", [{"default": "10 arcsec"}, {"default": "10 arcsec", "unit": "arcsec"}])
def test_small_angles_are_told_in_the_unit_of_their_parameter(given):
    tilt = op.Parameter("tilt", **given)
    path = op.Source() >> op.Polarizer(tilt) >> op.Detector()
    assert [angle.text for angle in scene_of(path).angles] == ["tilt = 10 arcsec"]


def test_ellipses_are_as_large_as_the_light_is_polarised():
    scene = scene_of(op.load_preset("npgr026", case="8"))
    rays = by_name(scene.rays)
    linear = rays["P.out -> X2.in"]
    assert np.allclose(linear.ellipse @ linear.axes[2], 0.0, atol=1e-12)
    assert abs(np.abs(linear.ellipse @ linear.axes[0]).max() - 0.18) < 1e-12
    assert rays["L.out -> P.in"].ellipse is None
    assert rays["L.out -> P.in"].light.dop == 0.0
    told = scene_of(op.load_preset("npgr026"), intensity=0.0).as_json()
    assert {ray["ellipse"] for ray in told["rays"]} == {None}
    assert {ray["dop"] for ray in told["rays"]} == {None}
    assert {ray["intensity"] for ray in told["rays"]} == {0.0}


@rows("draw", [op.plots.geometry, op.plots.bench, scene_of])
@rows("given", ["malus", op.Polarizer(0.0), None])
def test_what_is_no_path_is_refused_with_the_cure(draw, given):
    with pytest.raises(op.OptipathError, match=r"draws a path, not .*give a PathGraph"):
        draw(given)


@rows("draw", [op.plots.geometry, op.plots.bench, scene_of])
def test_light_that_goes_a_way_that_there_is_not_is_refused(draw):
    points = [[0, -1, 1], [0, 0, 0], [0, 9, 1]]
    path = op.path_from_vertices(points, [1.5], events="T", bad="mask")
    with pytest.raises(op.PathError, match=r"ways that light can go, but on '.*not a number"):
        draw(path)


def test_several_paths_at_once_are_refused():
    with pytest.raises(op.PathError, match=r"a scene draws one path, but .*delta.*single values"):
        scene_of(op.load_preset("npgr026"), delta=[0.1, 0.2])
