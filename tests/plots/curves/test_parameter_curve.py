"""Curves of the light of a path against one of its parameters."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import optipath as op
from optipath.errors import OptipathError, ParameterError
from optipath.plots import curve
from optipath.plots.curves.drawn_quantity import drawn_quantities
from pictures import faults_of, texts_of
from tables import rows

WAVEPLATE = (
    op.Source(stokes=[1, 1, 0, 0]) >> op.Retarder(np.pi, op.Parameter("turn")) >> op.Detector()
)


def lines(ax):
    """The curves of a picture, by name."""
    sides = [side for side in ax.figure.axes if side.bbox.bounds == ax.bbox.bounds]
    return {
        line.get_gid(): line.get_xydata()
        for side in sides
        for line in side.get_lines()
        if line.get_gid() not in {None, "default"}
    }


def test_values_are_those_of_a_sweep_in_their_unit():
    ax = curve(op.load_preset("malus"), "angle")
    x, y = lines(ax)["S0"].T
    assert (x[0], x[-1]) == pytest.approx((0.0, 180.0))
    np.testing.assert_allclose(y, 0.5 * np.cos(np.radians(x)) ** 2, atol=1e-12)
    assert ax.get_ylabel() == "S0: intensity"
    assert ax.get_legend() is None
    path = op.load_preset("quartz-quarter-wave")
    x, _ = lines(curve(path, "wavelength", values="400 nm:700 nm:4"))["S0"].T
    assert x.tolist() == [400.0, 500.0, 600.0, 700.0]
    x, _ = lines(curve(path, "angle", values=[0.0, np.pi / 4, np.pi / 2]))["S0"].T
    assert x == pytest.approx([0.0, 45.0, 90.0])
    ax = curve(op.load_preset("quartz-quarter-wave"), "wavelength", values="1.7 eV:3 eV:500")
    assert ax.get_xlabel() == "wavelength in vacuum (eV)"
    (mark,) = [line for line in ax.get_lines() if line.get_gid() == "default"]
    assert mark.get_xdata()[0] == pytest.approx(2.2543, abs=1e-3)  # hc / 550 nm
    assert [each.name for each in drawn_quantities(("s0", "dolp"))] == ["S0", "DoLP"]


def test_quantities_of_two_units_have_two_axes_and_of_three_are_refused():
    ax = curve(op.load_preset("npgr026"), "delta", ("S0", "S1", "DoLP"))
    left, right = [side for side in ax.figure.axes if side.get_ylabel()]
    assert left is ax
    assert (left.get_ylabel(), right.get_ylabel()) == (
        "S0, S1",
        "DoLP: degree of linear polarisation",
    )
    shown = [text.get_text() for text in right.get_legend().get_texts()]
    assert shown == ["S0", "S1", "DoLP"]
    with pytest.raises(OptipathError, match="S0, DoP and AoP have 3 units"):
        curve(op.load_preset("malus"), "angle", ("S0", "DoP", "AoP"))


def test_lines_differ_by_colour_and_by_dash():
    names = ("S0", "S1", "S2", "S3", "DoP", "DoLP", "ellipticity")
    ax = curve(op.load_preset("glass-slab"), "theta", names)
    drawn = [
        line for side in ax.figure.axes for line in side.get_lines() if line.get_gid() in names
    ]
    assert len({(line.get_color(), str(line._dash_pattern)) for line in drawn}) == 7


def test_angles_that_come_round_or_flip_or_are_not_known_are_no_line_across():
    # A half-wave plate turns x to twice its azimuth, which is over 90 deg from 45 deg on.
    x, y = lines(curve(WAVEPLATE, "turn", "aop"))["AoP"].T
    assert np.isnan(y).sum() == 2
    assert np.nanmax(np.abs(np.diff(y))) < 1.0
    ends = x[np.isnan(y)]
    assert ends == pytest.approx([45.0, 135.0])
    assert np.nanmax(y) == pytest.approx(90.0)
    assert np.nanmin(y) == pytest.approx(-90.0)
    # Each step turns the light by 90 deg, which is drawn neither up nor down.
    ax = curve(WAVEPLATE, "turn", "aop", values="0 deg:180 deg:5")
    x, y = marks(ax).T
    assert x == pytest.approx([0.0, 45.0, 90.0, 135.0, 180.0])
    assert np.abs(y) == pytest.approx([0.0, 90.0, 0.0, 90.0, 0.0], abs=1e-9)
    assert faults_of(ax.figure) == []
    assert len(marks(curve(op.load_preset("malus"), "angle", values="0 deg:90 deg:7"))) == 7
    path = op.Source(op.Parameter("power", 1.0)) >> op.Detector()
    ax = curve(path, "power", ("S0", "AoP"))
    assert np.isnan(lines(ax)["AoP"][:, 1]).all()
    assert "AoP: the light has none" in [text.get_text() for text in ax.texts]


def marks(ax):
    """The points that are marked."""
    (line,) = [line for line in ax.get_lines() if line.get_marker() not in {"None", "", None}]
    assert line.get_linestyle() == "None"
    return line.get_xydata()


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")  # ten half turns
def test_of_many_points_those_are_marked_that_stand_alone():
    # The light is turned by 90 deg from each to the next.
    ax = curve(WAVEPLATE, "turn", "aop", values="0 deg:1800 deg:41")
    assert len(marks(ax)) == 41
    lit = op.load_preset("malus")
    assert not [line for line in curve(lit, "angle").get_lines() if line.get_marker() == "o"]


def test_the_value_by_default_is_marked_with_its_text_where_it_is_seen():
    ax = curve(op.load_preset("malus"), "angle")
    (mark,) = [line for line in ax.get_lines() if line.get_gid() == "default"]
    assert mark.get_xdata()[0] == pytest.approx(30.0)
    assert "30°" in [text.get_text() for text in texts_of(ax.figure)]
    ax = curve(op.load_preset("malus"), "angle", values="40 deg:80 deg:9")
    assert "default" not in [line.get_gid() for line in ax.get_lines()]
    ax = curve(op.load_preset("npgr026"), "filter")
    assert "default" not in [line.get_gid() for line in ax.get_lines()]


def test_the_curve_is_open_where_the_path_refuses_values_that_nobody_gave():
    # No dye is stronger than the mean absorption, which is 0.1 / um.
    path = op.load_preset("dichroic-sheet")
    x, y = lines(curve(path, "dichroism"))["S0"].T
    np.testing.assert_array_equal(np.isfinite(y), np.abs(x) <= 0.1)
    with pytest.raises(OptipathError, match="dichroi"):
        curve(path, "dichroism", values="-1 1/um:1 1/um:9")


@rows(
    "preset, x, size",
    [
        ("npgr026", "rho", (6.4, 4.2)),
        ("npgr026", "rho", (3.2, 2.1)),
        ("lyot-depolarizer", "wavelength", (3.2, 2.1)),
        ("dichroic-sheet", "retardance", (3.2, 2.1)),
    ],
)
def test_no_text_is_over_another_or_cut_at_either_size(preset, x, size):
    figure = Figure(figsize=size, layout="constrained")
    names = ("S0", "S1", "S2", "S3", "DoP", "DoLP")
    curve(op.load_preset(preset), x, names, figure.add_subplot())
    assert faults_of(figure) == []


def off_line(ax, path, name, unit):
    """How far the curve of S0 is off at most, between its points."""
    x, y = lines(ax)["S0"].T
    between = np.linspace(x[0], x[-1], 50_003)
    true = path.trace(**{name: between * unit}).stokes[:, 0]
    return np.abs(np.interp(between, x, y) - true).max()


@rows("thickness", ["0.5 mm", "5 mm"])
def test_narrow_lines_of_a_spectrum_are_drawn_as_high_as_they_are(thickness):
    path = op.load_preset("lyot-filter", thickness=thickness)
    assert off_line(curve(path, "wavelength"), path, "wavelength", 1e-9) < 0.01


def test_what_changes_too_fast_is_told_but_not_rounding():
    path = op.load_preset("lyot-filter", thickness="100 mm")
    ax = curve(path, "wavelength")
    told = ax.get_title().replace("\n", " ")
    assert told.startswith("it changes faster with wavelength than 23041 points tell")
    assert faults_of(ax.figure) == []
    ax = curve(path, "wavelength", values="400 nm:700 nm:50")
    assert (ax.get_title(), len(lines(ax)["S0"])) == ("", 50)
    # Light that is linear at every angle, whose S3 is nothing but rounding.
    ax = curve(op.load_preset("double-pass-waveplate"), "angle", "S3")
    assert (ax.get_title(), len(lines(ax)["S3"])) == ("", 1441)


def test_the_legend_is_above_every_curve():
    ax = curve(op.load_preset("glass-slab"), "theta", ("S0", "S1", "DoP"))
    ax.figure.draw_without_rendering()
    legend = next(side.get_legend() for side in ax.figure.axes if side.get_legend())
    bottom = legend.get_window_extent().y0
    for side in ax.figure.axes:
        for line in side.get_lines():
            if line.get_gid() in {"S0", "S1", "DoP"}:
                highest = np.nanmax(side.transData.transform(line.get_xydata())[:, 1])
                assert highest < bottom


def test_detectors_are_chosen_by_name_and_asked_for():
    path = op.load_preset("glass-slab")
    _, y = lines(curve(path, "theta", detector="reflected", values="0 deg:10 deg:2"))["S0"].T
    # Both faces of n = 1.5 reflect 2 R / (1 + R) upright, with R = 0.04.
    assert y[0] == pytest.approx(0.08 / 1.04)
    with pytest.raises(ParameterError, match="detector 'reflcted' is unknown"):
        curve(path, "theta", detector="reflcted")
    path = op.PathGraph()
    path.add("lamp", op.Source(op.Parameter("power", 1.0))) >> path.add("split", op.BeamSplitter())
    path.add("one", op.Detector())
    path.add("two", op.Detector())
    path.connect("split.reflected", "one")
    path.connect("split.transmitted", "two")
    with pytest.raises(ParameterError, match="the detectors one and two; say which"):
        curve(path, "power")
    assert [*lines(curve(path, "power", detector="two"))] == ["S0"]
    path = op.Source(op.Parameter("power", 1.0)) >> op.Detector(reads="linear")
    ax = curve(path, "power", ("S0", "S3", "DoLP"))
    assert "S3: not read" in [text.get_text() for text in ax.texts]
    ax = curve(path, "power", ("AoP", "delta"))
    told = "AoP: the light has none\ndelta: not read"
    assert told in [text.get_text() for text in ax.texts]


@rows(
    "given, told",
    [
        ({"x": "angel"}, "parameter 'angel' is unknown; did you mean 'angle'"),
        ({"x": 3}, "parameter 3 is unknown"),
        ({"x": "angle", "angle": 0.1}, "'angle' goes along an axis; leave out angle="),
        ({"x": "angle", "y": "brightness"}, "quantity 'brightness' is unknown"),
        ({"x": "angle", "y": ("S0", "s0")}, "give each of them once"),
        ({"x": "angle", "y": ()}, "quantities are"),
        ({"x": "angle", "values": 0.3}, "give two or more"),
        ({"x": "angle", "values": "30 deg:30 deg:5"}, "values of 'angle' are 30 deg alone; give"),
        ({"x": "angle", "values": ["vertical", "10 deg"]}, "has the word 'vertical'"),
        ({"x": "angle", "values": "0 deg:90 deg:5", "intensity": [1.0, 2.0]}, "one value"),
        ({"x": "angle", "intensty": 1.0}, "'intensty' is unknown; did you mean 'intensity'"),
        ({"x": "angle", "ax": 3}, "ax is 3"),
    ],
)
def test_what_is_wrong_is_told(given, told):
    with pytest.raises(OptipathError, match=told):
        curve(op.load_preset("malus"), **given)


def test_bound_parameters_choices_arrays_and_what_is_no_path_are_told():
    with pytest.raises(ParameterError, match="'angle' is bound to 30 deg"):
        curve(op.load_preset("malus", angle="30 deg"), "angle")
    with pytest.raises(ParameterError, match="'place' is chosen before a path runs"):
        curve(op.load_preset("copper-gold-spectrum"), "place")
    path = op.Source(stokes=op.Parameter("stokes", [1, 0, 0, 0])) >> op.Detector()
    with pytest.raises(ParameterError, match="'stokes' is an array"):
        curve(path, "stokes")
    with pytest.raises(ParameterError, match="has the word 'none' among its values"):
        curve(op.load_preset("npgr026"), "filter", values=["none", "30 deg"])
    with pytest.raises(OptipathError, match="a curve is of a path"):
        curve(op.Polarizer(), "angle")
