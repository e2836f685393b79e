import numpy as np
import pytest

import optipath as op
from pictures import faults_of, texts_of
from tables import rows

figures = pytest.importorskip("matplotlib.figure")


def words_of(ax):
    return [text.get_text() for text in texts_of(ax.figure)]


def keys_of(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


@rows(
    "preset, scale",
    [("npgr026", 1.0), ("faraday-isolator", 1.0), ("senarmont", 0.5), ("two-panes", 0.5)],
)
def test_no_text_is_over_another_or_cut(preset, scale):
    figure = figures.Figure(figsize=(5.4 * scale, 6.8 * scale), layout="constrained")
    ax = op.plots.poincare_path(op.load_preset(preset), figure.add_subplot(projection="3d"))
    assert faults_of(ax.figure) == []


def test_links_are_named_in_the_order_of_travel_at_the_points_of_their_light():
    keys = keys_of(op.plots.poincare_path(op.load_preset("malus")))
    assert keys[:3] == ["1  lamp → polarizer", "2  polarizer → analyzer", "3  analyzer → eye"]
    path = op.Source() >> op.Polarizer("0 deg") >> op.Polarizer("0 deg") >> op.Detector()
    ax = op.plots.poincare_path(path)
    assert {"1", "2, 3"} <= {*words_of(ax)}
    path = op.load_preset("npgr026", case="8")
    ax = op.plots.poincare_path(path)
    expected = path.trace().normalized[1:]
    drawn = np.transpose(ax.collections[-1]._offsets3d)
    assert np.linalg.norm(drawn - expected, axis=1).min() < 1e-12


def test_the_key_tells_dark_light_and_that_lines_are_straight():
    assert any(
        "(dark" in key for key in keys_of(op.plots.poincare_path(op.load_preset("senarmont")))
    )
    keys = keys_of(op.plots.poincare_path(op.load_preset("malus")))
    assert "straight from light to light" in keys[-1]
    path = op.Source(stokes=[0.0, 0.0, 0.0, 0.0]) >> op.Detector()
    ax = op.plots.poincare_path(path)
    assert keys_of(ax)[0].endswith("(dark)")
    assert faults_of(ax.figure) == []


def test_light_that_leaves_the_path_goes_away():
    keys = keys_of(op.plots.poincare_path(op.load_preset("two-panes")))
    assert "3  pane1.transmitted → away" in keys


def test_values_are_those_of_parameters():
    path = op.load_preset("malus")
    first, second = (
        op.plots.poincare_path(path, angle=angle).collections[-1]._offsets3d
        for angle in ("0 deg", "30 deg")
    )
    assert len(first[0]) < len(second[0])


def test_several_values_are_refused():
    with pytest.raises(op.OptipathError, match=r"has light of shape \(2,\).*give one"):
        op.plots.poincare_path(op.load_preset("malus"), angle=["0 deg", "30 deg"])


@rows("given", ["malus", op.Polarizer(0.0), None])
def test_what_is_no_path_is_refused_with_the_cure(given):
    with pytest.raises(op.OptipathError, match=r"a trail is of a path, not of .*give a PathGraph"):
        op.plots.poincare_path(given)
