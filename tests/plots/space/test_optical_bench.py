"""What a flat picture of a set-up shows, and which set-ups it refuses."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.transforms import Bbox

import optipath as op
from optipath.plots.line_colours import FAINT
from optipath.plots.space.bench_symbols import DIAL, ELLIPSE
from pictures import faults_of
from tables import rows

PLANE = ["malus", "solc-filter", "sky-and-window", "glass-slab", "coated-metal"]
PLANE += ["double-pass-waveplate", "faraday-isolator", "fresnel-rhomb", "pile-of-plates"]
PLANE += ["npgr026-3d"]


def texts_in(ax):
    return {text.get_text() for text in ax.texts if text.get_text()}


def dials_of(ax, colour=ELLIPSE):
    """The lines in dials, from their middles, 1 being the rim."""
    lines = [line for line in ax.lines if line.get_color() == colour and line.get_zorder() > 6]
    points = [np.array(line.get_xydata()) for line in lines]
    return [(p - (p.min(axis=0) + p.max(axis=0)) / 2) / DIAL / 0.92 for p in points]


def over_symbols(ax):
    """The texts that touch what is drawn."""
    drawn = [each.get_path().transformed(each.get_transform()) for each in ax.patches]
    shapes = [Path(points) for each in drawn for points in each.to_polygons()]
    boxes = [(t.get_text(), t.get_window_extent()) for t in ax.texts if t.get_text()]
    return [text for text, box in boxes for shape in shapes if shape.intersects_bbox(box)]


@rows("preset", PLANE)
@rows("size", [(9.0, 5.4), (4.5, 2.7)])
def test_no_name_is_over_another_or_a_symbol_or_cut(preset, size):
    figure = Figure(figsize=size, layout="constrained")
    op.plots.bench(op.load_preset(preset), figure.add_subplot())
    assert faults_of(figure) == []
    assert over_symbols(figure.axes[0]) == []


@rows("preset", ["glass-slab", "coated-metal", "double-pass-waveplate"])
def test_light_begins_and_ends_at_what_is_drawn(preset):
    ax = op.plots.bench(op.load_preset(preset))
    beams = [line for line in ax.lines if line.get_zorder() == 3.0 and line.get_color() != FAINT]
    assert len(beams) >= 4
    drawn = [each for each in ax.patches if each.get_zorder() >= 4.0]
    shapes = [each.get_path().transformed(each.get_patch_transform()) for each in drawn]
    for end in np.concatenate([line.get_xydata() for line in beams]):
        around = Bbox([end - 0.02, end + 0.02])
        assert any(shape.intersects_bbox(around) for shape in shapes), end


def test_names_and_values_stand_below_their_symbols():
    texts = texts_in(op.plots.bench(op.load_preset("senarmont")))
    assert {"polarizer\n0 deg", "sample\n45 deg\nretardance = 60 deg"} <= texts
    assert "analyzer\nanalyzer = 120 deg" in texts
    texts = texts_in(op.plots.bench(op.load_preset("npgr026", case="1")))
    assert "X1\ndelta = 53 deg\nazimuth -rho = 0 deg" in texts


def test_surfaces_at_points_of_the_world_are_told_by_the_angles_of_their_chain():
    flat, world = (
        texts_in(op.plots.bench(op.load_preset(name, rho=0.0)))
        for name in ("npgr026", "npgr026-3d")
    )
    told = {"X2\nphi = 56 deg", "X1\ndelta = 53 deg\nazimuth -rho = 0 deg"}
    assert told <= flat
    assert told <= world
    chain = op.VerticesByAngles((0.5, op.Parameter("b", 0.25)), (np.pi,), backwards=True)
    path = op.path_from_vertices(chain, materials=(1.5, 1.5))
    texts = "; ".join(sorted(texts_in(op.plots.bench(path)))).replace("\n", ", ")
    assert "b = 14.324 deg" in texts
    assert "incidence = 28.648 deg, azimuth 180 deg" in texts


def test_dials_show_the_light_between_as_malus_has_it():
    first, second = dials_of(op.plots.bench(op.load_preset("malus"), angle="30 deg"))
    assert np.allclose(abs(first).max(axis=0), [1.0, 0.0], atol=1e-9)
    along = second[np.argmax(second[:, 0])]
    assert np.allclose(along, [np.cos(np.pi / 6), 0.5], atol=1e-2)
    ax = op.plots.bench(op.load_preset("quartz-quarter-wave"))
    (axis,) = dials_of(ax, "#222222")
    way = axis[1] - axis[0]
    assert abs(np.degrees(np.arctan2(way[1], way[0])) % 180.0 - 135.0) < 1e-6
    ax = op.plots.bench(op.load_preset("malus"))
    assert [patch for patch in ax.patches if patch.get_gid() == "turn"] == []
    dark = dials_of(op.plots.bench(op.load_preset("malus"), angle="90 deg"))
    assert len(dark) == 1
    dark, lit = (
        op.plots.bench(op.load_preset("senarmont"), analyzer=angle)
        for angle in ("120 deg", "100 deg")
    )
    assert len(dials_of(lit)) - len(dials_of(dark)) == 1
    assert len(dials_of(lit, FAINT)) == len(dials_of(dark, FAINT)) == 3


def round_about(head, middle):
    """To which side a head goes round a middle: 1 is counter-clockwise."""
    tip, *foot = head.get_xy()[:3]
    way = tip - np.mean(foot, axis=0)
    out = np.mean(foot, axis=0) - middle
    return np.sign(out[0] * way[1] - out[1] * way[0])


@rows("s3", [1.0, -1.0])
@rows("tilt", [0.0, 0.3])
def test_heads_in_dials_turn_as_the_field_does_to_who_looks_at_the_source(s3, tilt):
    light = op.Source(stokes=[1.0, np.sin(tilt), 0.0, s3 * np.cos(tilt)])
    ax = op.plots.bench(light >> op.Detector())
    (head,) = [patch for patch in ax.patches if patch.get_gid() == "turn"]
    assert round_about(head, np.array([0.5, 0.0])) == s3


def test_long_straight_benches_take_rows():
    ax = op.plots.bench(op.load_preset("lyot-filter"))
    below = [text for text in ax.texts if text.get_transform() == ax.transData]
    assert len(below) == 11
    assert len({text.get_position()[1] for text in below}) > 1


def test_several_paths_and_light_out_of_the_plane_are_refused():
    with pytest.raises(op.PathError, match=r"leaves that at 'X1'; op.plots.geometry"):
        op.plots.bench(op.load_preset("npgr026", case="8"))
    with pytest.raises(op.PathError, match="bench draws one path"):
        op.plots.bench(op.load_preset("malus"), angle=[0.1, 0.2])


def test_the_assignment_is_drawn_in_one_plane_and_into_given_axes():
    ax = op.plots.bench(op.load_preset("npgr026", case="1"))
    assert {"X1\ndelta = 53 deg", "X2\nphi = 56 deg"} <= {
        "\n".join(text.split("\n")[:2]) for text in texts_in(ax)
    }
    given = Figure().add_subplot()
    assert op.plots.bench(op.load_preset("malus"), given) is given


@rows(
    "preset, name, sine",
    [
        ("coated-metal", "metal", np.sin(np.radians(40.0)) / 1.5),
        ("glass-slab", "back", np.sin(np.radians(40.0)) / 1.5),
        ("prism-refraction", "front", 1.5 * 0.5),
    ],
)
def test_the_angle_that_is_told_of_a_face_is_that_at_which_light_meets_it(preset, name, sine):
    texts = texts_in(op.plots.bench(op.load_preset(preset)))
    assert f"{name}\nincidence = {np.degrees(np.arcsin(sine)):.5g} deg" in texts


@rows(
    "preset, folded",
    [
        ("fresnel-rhomb", {"incidence": "10 deg"}),
        ("npgr026", {"delta": "89.99 deg", "phi": "0.01 deg"}),
    ],
)
def test_where_symbols_lie_over_one_another_that_is_said_with_the_cure(preset, folded):
    said = "symbols lie over one another: op.plots.geometry(path) draws this path in space"
    for values, expected in ((folded, True), ({}, False)):
        ax = op.plots.bench(op.load_preset(preset), **values)
        texts = " ".join(texts_in(ax)).replace("\n", " ")
        assert (said in texts) is expected
        assert faults_of(ax.figure) == []


@rows("preset", ["ellipsometer-rough", "ellipsometer-pcsa"])
def test_no_name_lies_over_a_ray(preset):
    ax = op.plots.bench(op.load_preset(preset))
    beams = [line for line in ax.lines if line.get_zorder() == 3.0]
    assert "--" in {line.get_linestyle() for line in beams}
    rays = [Path(ax.transData.transform(line.get_xydata())) for line in beams]
    for text in ax.texts:
        if text.get_text():
            box = text.get_window_extent()
            assert not any(ray.intersects_bbox(box, filled=False) for ray in rays), text
