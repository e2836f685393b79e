"""What a picture in space shows of a path, and that nothing in it is over another or cut."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import optipath as op
from pictures import faults_of
from tables import rows


def texts_in(ax):
    return {text.get_text() for text in ax.texts if text.get_text()}


def key_of(ax):
    return {text.get_text() for text in ax.get_legend().get_texts()}


@rows("preset", ["npgr026", "two-panes", "lyot-filter", "faraday-isolator"])
@rows("size", [(8.0, 6.0), (4.0, 3.0)])
def test_no_name_is_over_another_or_cut(preset, size):
    figure = Figure(figsize=size, layout="constrained")
    op.plots.geometry(op.load_preset(preset), figure.add_subplot())
    assert faults_of(figure) == []


def test_the_assignment_has_all_names_a_key_and_what_was_chosen():
    ax = op.plots.geometry(op.load_preset("npgr026", case="8"))
    angles = {"delta = 48 deg", "phi = 20 deg", "rho = 34 deg", "filter = 0 deg"}
    assert {"L", "P", "X2", "X1", "E"} | angles <= texts_in(ax)
    straight = op.plots.geometry(op.load_preset("malus"))
    assert key_of(straight) == {"x of a frame", "y", "polarisation"}
    sampled = op.plots.geometry(op.load_preset("ellipsometer-pcsa"))
    assert {"x of a frame (s)", "y (p)", "plane of incidence", "tap"} <= key_of(sampled)
    texts = texts_in(op.plots.geometry(op.load_preset("ellipsometer-rough")))
    (note,) = [text for text in texts if "lengths are chosen" in text]
    assert "schematic" in note


@rows(
    "values",
    [
        {"delta": "0 deg", "phi": "0 deg"},
        {"delta": "90 deg", "phi": "90 deg", "rho": "90 deg"},
        {"rho": "180 deg"},
        {"intensity": 0.0},
    ],
)
def test_extreme_values_are_drawn_without_a_fault(values):
    for preset in ("npgr026", "npgr026-3d"):
        ax = op.plots.geometry(op.load_preset(preset), **values)
        assert faults_of(ax.figure) == [], preset


def test_total_reflection_in_a_prism_is_drawn():
    assert faults_of(op.plots.geometry(op.load_preset("fresnel-rhomb")).figure) == []
    slab = op.plots.geometry(op.load_preset("glass-slab"), n=0.5, theta="60 deg")
    assert faults_of(slab.figure) == []


def test_links_are_as_long_to_the_right_as_up_and_straight_paths_level():
    ax = op.plots.geometry(op.load_preset("malus"))
    ax.figure.draw_without_rendering()
    (x0, y0), (x1, y1) = ax.transData.transform([(0.0, 0.0), (1.0, 1.0)])
    assert abs((x1 - x0) / (y1 - y0) - 1.0) < 1e-6
    ax = op.plots.geometry(op.load_preset("malus"), view=(0.0, -90.0))
    rays = [line for line in ax.lines if line.get_zorder() == 4.0]
    heights = np.concatenate([line.get_ydata() for line in rays])
    assert len(rays) == 3
    assert np.allclose(heights, 0.0, atol=1e-12)
    given = Figure().add_subplot()
    assert op.plots.geometry(op.load_preset("malus"), given) is given


@rows("s3", [1.0, -1.0])
@rows("azimuth, towards", [(45.0, 1.0), (225.0, -1.0)])
def test_heads_on_ellipses_turn_as_the_field_does(s3, azimuth, towards):
    path = op.Source(stokes=[1.0, 0.0, 0.0, s3]) >> op.Detector()
    ax = op.plots.geometry(path, view=(20.0, azimuth))
    (head,) = [patch for patch in ax.patches if patch.get_gid() == "turn"]
    (ellipse,) = [line for line in ax.lines if line.get_zorder() == 5.0]
    tip, *foot = head.get_xy()[:3]
    out = np.mean(foot, axis=0) - np.mean(ellipse.get_xydata()[:-1], axis=0)
    way = tip - np.mean(foot, axis=0)
    # The light goes along x of the world: from an azimuth of 45 deg one looks at the source.
    assert np.sign(out[0] * way[1] - out[1] * way[0]) == s3 * towards


def test_what_cannot_be_drawn_is_refused_with_the_cure():
    path = op.load_preset("malus")
    with pytest.raises(op.OptipathError, match="give plain Axes"):
        op.plots.geometry(path, Figure().add_subplot(projection="3d"))
    for view in (3, "front", (1, 2, 3), (np.nan, 0.0)):
        with pytest.raises(op.OptipathError, match="give elevation and azimuth"):
            op.plots.geometry(path, view=view)
    with pytest.raises(op.PathError, match="geometry draws one path"):
        op.plots.geometry(op.load_preset("malus"), angle=[0.1, 0.2])


@rows("preset", ["npgr026", "npgr026-3d", "copper-gold-spectrum"])
def test_what_is_left_out_has_its_name_at_its_plate(preset):
    ax = op.plots.geometry(op.load_preset(preset))
    boxes = {text.get_text(): text.get_window_extent() for text in ax.texts}
    plate, absent = boxes["P"], boxes["filter = none"]
    apart = np.maximum(absent.min - plate.max, plate.min - absent.max)
    assert apart.max() < 3.0 * plate.height
