"""Curves and maps of the light of a path over its parameters, and of what a boundary reflects."""

import numpy as np
import pytest

import optipath as op
from optipath.errors import OptipathError, ParameterError
from optipath.plots import curve, quantity_map, reflection
from optipath.plots.light_at_detector import (
    START,
    drawn_quantities,
    drawn_quantity,
    fine_steps,
)
from optipath.plots.parameter_curves import open_at_jumps
from optipath.plots.reflection_curves import marked_angles, reflected
from pictures import faults_of, texts_of
from tables import rows

NAN = np.nan
X = np.linspace(0.0, 1.0, START)
MALUS, RHOMB = op.load_preset("malus"), op.load_preset("npgr026")
WAVEPLATE = (
    op.Source(stokes=[1, 1, 0, 0]) >> op.Retarder(np.pi, op.Parameter("turn")) >> op.Detector()
)
POWER = op.Source(op.Parameter("power", 1.0))


def fine(shape):
    """The steps of one curve, of a height of 1, and how often it was asked for."""
    asked = []

    def at(values):
        asked.append(len(values))
        return shape(values)[:, np.newaxis]

    return fine_steps(X, at(X), at, on_picture=np.asarray), asked


def test_steps_are_halved_where_a_curve_bends_until_it_is_resolved_but_not_at_jumps_and_corners():
    for shape, expected in (
        (lambda x: 1.0 - x, [START, START - 1]),
        (lambda x: np.full_like(x, NAN), [START]),
    ):
        found, asked = fine(shape)
        assert (asked, found.resolved) == (expected, True)
    found, _ = fine(lambda x: np.where(x > 0.9, NAN, np.where(x > 0.37, 1.0, np.abs(x - 0.2))))
    assert found.told("x") == ""
    assert len(found.values) < 1.05 * 2 * START
    there = np.isfinite(found.numbers[:, 0])
    assert found.values[there].max() == pytest.approx(0.9, abs=1e-4)
    found, _ = fine(lambda x: np.sin(1e6 * x))
    assert len(found.values) == 32 * (START - 1) + 1
    assert found.told("x").startswith("it changes faster with x than 23041 points tell")
    # As lines between mirrors that reflect much: 140, each a twentieth of their distance.
    found, asked = fine(lambda x: 1.0 / (1.0 + 160.0 * np.sin(np.pi * 140.0 * x) ** 2))
    drawn = np.interp(np.arange(1, 140) / 140.0, found.values, found.numbers[:, 0])
    np.testing.assert_allclose(drawn, 1.0, atol=0.05)
    # A thousand waves.
    found, asked = fine(lambda x: 0.5 * np.sin(2.0 * np.pi * 1000.0 * x + 0.3))
    assert (found.resolved, len(asked) <= 6) == (True, True)


@rows(
    "angles, period, x, y",
    [
        ([0.0, 30.0, 60.0], 180.0, [0, 1, 2], [0.0, 30.0, 60.0]),
        ([80.0, -70.0], 180.0, [0, 1 / 3, 1 / 3, 1 / 3, 1], [80.0, 90.0, NAN, -90.0, -70.0]),
        ([-170.0, 170.0], 360.0, [0, 0.5, 0.5, 0.5, 1], [-170.0, -180.0, NAN, 180.0, 170.0]),
        ([0.0, 90.0, 89.0], 180.0, [0, 0, 1, 2], [0.0, NAN, 90.0, 89.0]),
        ([10.0, NAN, 12.0], 180.0, [0, 1, 2], [10.0, NAN, 12.0]),
    ],
)
def test_curves_of_angles_are_open_at_jumps_and_gaps_alone(angles, period, x, y):
    found = open_at_jumps(np.arange(float(len(angles))), np.array(angles), period)
    np.testing.assert_allclose(found, (x, y), atol=1e-6)


def lines(ax):
    """The curves of a picture, by name."""
    sides = [side for side in ax.figure.axes if side.bbox.bounds == ax.bbox.bounds]
    every = [line for side in sides for line in side.get_lines()]
    kept = [line for line in every if line.get_gid() not in {None, "default"}]
    return {line.get_gid(): line.get_xydata() for line in kept}


def texts(ax):
    return [text.get_text() for text in ax.texts]


def test_values_are_those_of_a_sweep_in_their_unit_open_where_refused_and_the_default_is_marked():
    ax = curve(MALUS, "angle")
    x, y = lines(ax)["S0"].T
    assert (x[0], x[-1]) == pytest.approx((0.0, 180.0))
    np.testing.assert_allclose(y, 0.5 * np.cos(np.radians(x)) ** 2, atol=1e-12)
    assert (ax.get_ylabel(), ax.get_legend()) == ("S0: intensity", None)
    path = op.load_preset("quartz-quarter-wave")
    for name, values, expected in (
        ("wavelength", "400 nm:700 nm:4", [400.0, 500.0, 600.0, 700.0]),
        ("angle", [0.0, np.pi / 4, np.pi / 2], [0.0, 45.0, 90.0]),
    ):
        assert lines(curve(path, name, values=values))["S0"][:, 0] == pytest.approx(expected)
    ax = curve(path, "wavelength", values="1.7 eV:3 eV:500")
    assert ax.get_xlabel() == "wavelength in vacuum (eV)"
    (mark,) = [line for line in ax.get_lines() if line.get_gid() == "default"]
    assert mark.get_xdata()[0] == pytest.approx(2.2543, abs=1e-3)  # hc / 550 nm
    assert [each.name for each in drawn_quantities(("s0", "dolp"))] == ["S0", "DoLP"]
    # The value by default is marked where it is seen.
    ax = curve(MALUS, "angle")
    (mark,) = [line for line in ax.get_lines() if line.get_gid() == "default"]
    assert mark.get_xdata()[0] == pytest.approx(30.0)
    assert "30°" in [text.get_text() for text in texts_of(ax.figure)]
    for ax in (curve(MALUS, "angle", values="40 deg:80 deg:9"), curve(RHOMB, "filter")):
        assert "default" not in [line.get_gid() for line in ax.get_lines()]
    # No dye is stronger than the mean absorption, which is 0.1 / um.
    path = op.load_preset("dichroic-sheet")
    x, y = lines(curve(path, "dichroism"))["S0"].T
    np.testing.assert_array_equal(np.isfinite(y), np.abs(x) <= 0.1)
    with pytest.raises(OptipathError, match="dichroi"):
        curve(path, "dichroism", values="-1 1/um:1 1/um:9")


def test_quantities_of_two_units_have_two_axes_looks_of_their_own_and_a_legend_above_all():
    ax = curve(RHOMB, "delta", ("S0", "S1", "DoLP"))
    left, right = [side for side in ax.figure.axes if side.get_ylabel()]
    assert left is ax
    told = left.get_ylabel(), right.get_ylabel()
    assert told == ("S0, S1", "DoLP: degree of linear polarisation")
    shown = [text.get_text() for text in right.get_legend().get_texts()]
    assert shown == ["S0", "S1", "DoLP"]
    names = ("S0", "S1", "S2", "S3", "DoP", "DoLP", "ellipticity")
    ax = curve(op.load_preset("glass-slab"), "theta", names)
    ax.figure.draw_without_rendering()
    drawn = [line for side in ax.figure.axes for line in side.get_lines()]
    drawn = [line for line in drawn if line.get_gid() in names]
    assert len({(line.get_color(), str(line._dash_pattern)) for line in drawn}) == 7
    legend = next(side.get_legend() for side in ax.figure.axes if side.get_legend())
    places = [line.get_transform().transform(line.get_xydata()) for line in drawn]
    assert np.nanmax(np.concatenate(places)[:, 1]) < legend.get_window_extent().y0


def marks(ax):
    """The points that are marked."""
    (line,) = [line for line in ax.get_lines() if line.get_marker() not in {"None", "", None}]
    assert line.get_linestyle() == "None"
    return line.get_xydata()


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")  # ten half turns
def test_angles_that_come_round_or_flip_or_are_not_known_are_no_line_across():
    # A half-wave plate turns x to twice its azimuth, which is over 90 deg from 45 deg on.
    x, y = lines(curve(WAVEPLATE, "turn", "aop"))["AoP"].T
    assert np.nanmax(np.abs(np.diff(y))) < 1.0
    assert x[np.isnan(y)] == pytest.approx([45.0, 135.0])
    assert (np.nanmin(y), np.nanmax(y)) == pytest.approx((-90.0, 90.0))
    # Each step turns the light by 90 deg, which is drawn neither up nor down.
    ax = curve(WAVEPLATE, "turn", "aop", values="0 deg:180 deg:5")
    x, y = marks(ax).T
    assert x == pytest.approx([0.0, 45.0, 90.0, 135.0, 180.0])
    assert np.abs(y) == pytest.approx([0.0, 90.0, 0.0, 90.0, 0.0], abs=1e-9)
    assert faults_of(ax.figure) == []
    # Of many points those are marked that stand alone.
    assert len(marks(curve(WAVEPLATE, "turn", "aop", values="0 deg:1800 deg:41"))) == 41
    assert len(marks(curve(MALUS, "angle", values="0 deg:90 deg:7"))) == 7
    assert not [line for line in curve(MALUS, "angle").get_lines() if line.get_marker() == "o"]
    ax = curve(POWER >> op.Detector(), "power", ("S0", "AoP"))
    assert np.isnan(lines(ax)["AoP"][:, 1]).all()
    assert "AoP: the light has none" in texts(ax)


def test_narrow_lines_are_as_high_as_they_are_and_what_changes_too_fast_is_told_but_not_rounding():
    for thickness in ("0.5 mm", "5 mm"):
        path = op.load_preset("lyot-filter", thickness=thickness)
        x, y = lines(curve(path, "wavelength"))["S0"].T
        between = np.linspace(x[0], x[-1], 50_003)
        true = path.trace(wavelength=between * 1e-9).stokes[:, 0]
        assert np.abs(np.interp(between, x, y) - true).max() < 0.01
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


def test_detectors_are_chosen_by_name_and_asked_for():
    path = op.load_preset("glass-slab")
    _, y = lines(curve(path, "theta", detector="reflected", values="0 deg:10 deg:2"))["S0"].T
    # Both faces of n = 1.5 reflect 2 R / (1 + R) upright, with R = 0.04.
    assert y[0] == pytest.approx(0.08 / 1.04)
    with pytest.raises(ParameterError, match="detector 'reflcted' is unknown"):
        curve(path, "theta", detector="reflcted")
    path = op.PathGraph()
    path.add("lamp", op.Source(op.Parameter("power", 1.0))) >> path.add("split", op.BeamSplitter())
    path["split.reflected"] >> path.add("one", op.Detector())
    path["split.transmitted"] >> path.add("two", op.Detector())
    with pytest.raises(ParameterError, match="the detectors one and two; say which"):
        curve(path, "power")
    assert [*lines(curve(path, "power", detector="two"))] == ["S0"]
    path = POWER >> op.Detector(reads="linear")
    assert "S3: not read" in texts(curve(path, "power", ("S0", "S3", "DoLP")))
    told = "AoP: the light has none\ndelta: not read"
    assert told in texts(curve(path, "power", ("AoP", "delta")))


FEW = {"x_values": "0 deg:180 deg:19", "y_values": "0.5, 1, 2"}


def image(ax):
    (mesh,) = ax.collections
    return mesh


def test_a_map_has_its_values_in_order_with_the_colours_of_its_quantity():
    ax = quantity_map(MALUS, "angle", "intensity", **FEW)
    mesh = image(ax)
    law = 0.5 * np.cos(np.radians(np.linspace(0, 180, 19))) ** 2
    np.testing.assert_allclose(mesh.get_array(), np.outer([0.5, 1.0, 2.0], law), atol=1e-12)
    assert (*ax.get_xlim(), *ax.get_ylim()) == pytest.approx((0.0, 180.0, 0.5, 2.0))
    other = quantity_map(MALUS, "angle", "intensity", **FEW | {"y_values": "2, 0.5, 1"})
    np.testing.assert_array_equal(mesh.get_array(), image(other).get_array())
    assert (mesh.cmap.name, mesh.norm.vmin, mesh.norm.vmax) == ("viridis", 0.0, 1.0)
    assert ax.get_lines()[-1].get_xydata().tolist() == [pytest.approx([30.0, 1.0])]
    assert ax.get_title() == "+ by default: angle 30°, intensity 1"
    with pytest.raises(ParameterError, match="both axes are 'angle'; give two parameters"):
        quantity_map(MALUS, "angle", "angle")
    # Colours are in order, apart from zero, or round.
    for names, expected in {
        "S0 dolp": ("viridis", 0.0, 1.0),
        "S1 ellipticity": ("RdBu_r", -1.0, 1.0),
        "AoP": ("twilight", -90.0, 90.0),
        "delta": ("twilight", -180.0, 180.0),
    }.items():
        for name in names.split():
            scale = drawn_quantity(name).colours(np.array([[0.0, 0.2], [0.5, 1.0]]))
            assert (scale.colours, scale.norm.vmin, scale.norm.vmax) == expected, name


def test_places_without_the_quantity_or_that_the_path_refuses_are_grey(monkeypatch):
    few = {"x_values": "0 deg, 90 deg", "y_values": "0 deg, 180 deg"}
    ax = quantity_map(op.load_preset("senarmont"), "analyzer", "retardance", "aop", **few)
    assert image(ax).get_array().mask.any()
    (bar,) = [side for side in ax.figure.axes if side is not ax]
    assert bar.get_ylabel().endswith("(grey: none)")
    monkeypatch.setattr("optipath.plots.parameter_curves._COUNT", 13)
    # No dye is stronger than the mean absorption.
    path = op.load_preset("dichroic-sheet")
    numbers = image(quantity_map(path, "absorption", "dichroism")).get_array()
    assert {*numbers.mask.ravel()} == {True, False}
    with pytest.raises(OptipathError, match="dichroism"):
        quantity_map(path, "absorption", "dichroism", y_values="-2 1/um:2 1/um:5")


# What a boundary reflects.


def marked(index):
    return {name: float(np.degrees(angle)) for name, angle in marked_angles(index).items()}


def curves(ax):
    return {line.get_label(): line.get_xydata() for line in ax.get_lines()}


def test_curves_of_reflection_are_those_of_the_amplitudes_with_angles_marked_where_there_are_any():
    glass = curves(reflection(1.5))
    for name in ("$R_s$", "$R_p$", "$R$ unpolarised"):
        np.testing.assert_allclose(glass[name][[0, -1]], [[0.0, 0.04], [90.0, 1.0]], atol=1e-6)
    found = curves(reflection(0.6 + 2.1j, outside=1.33))
    x = np.radians(found["$R_s$"][:, 0])
    r_s, r_p, _, _ = op.fresnel_amplitudes(0.6 + 2.1j, np.cos(x), np.sin(x), 1.33)
    np.testing.assert_allclose(found["$R_s$"][:, 1], np.abs(r_s) ** 2, atol=1e-12)
    np.testing.assert_allclose(found["$R_p$"][:, 1], np.abs(r_p) ** 2, atol=1e-12)
    brewster = "Brewster's angle"
    assert marked(1.5) == {brewster: pytest.approx(56.3099, abs=1e-4)}
    assert "Brewster's angle 56.31°" in curves(reflection(1.5))
    assert reflected(1.5, np.arctan(1.5)).dolp == pytest.approx(1.0)
    expected = {brewster: 33.6901, "critical angle": 41.8103}
    assert marked(1.0 / 1.5) == pytest.approx(expected, abs=1e-4)
    assert "critical angle 41.81°" in curves(reflection(1.0, outside=1.5))
    assert [*marked(1.52 + 1e-8j)] == [brewster]
    assert marked(2j) == {}
    # Of metals the least p and the highest polarisation are found.
    grid = np.radians(np.linspace(0.0, 90.0, 90_001))
    for index in (0.608 + 2.12j, 3.882 + 0.019j, 1.5 + 1.0j):
        found = reflected(index, grid)
        least, most = np.degrees(grid[[np.argmin(found.p), np.nanargmax(found.dolp)]])
        expected = {"pseudo-Brewster angle": least, "highest DoLP": most}
        assert marked(index) == pytest.approx(expected, abs=2e-3)


def test_a_material_is_given_by_its_name_or_formula_and_a_wavelength():
    by_name = reflection("gold", wavelength="516 nm")
    at = op.Material.named("gold").at("516 nm").refractive_index
    np.testing.assert_array_equal(curves(by_name)["$R_p$"], curves(reflection(at))["$R_p$"])
    assert "gold at 516 nm" in by_name.get_title()
    for given, title in (
        # n = 1.5 + 0.004 / 0.5^2, in micrometres.
        ((op.Material.cauchy([1.5, 0.004]), 1.0, "500 nm"), "n = 1.516 in n = 1"),
        ((1.00001, 1.00002), "n = 1.00001 in n = 1.00002"),
        (("0.2+3.4j", "1.33"), "n = 0.2 + 3.4i in n = 1.33"),
    ):
        keys = dict(zip(("index", "outside", "wavelength"), given, strict=False))
        assert reflection(**keys).get_title() == f"reflection: {title}"


@rows(
    "draw, told",
    [
        (lambda: curve(MALUS, "angle", "brightness"), "quantity 'brightness' is unknown"),
        (lambda: curve(MALUS, "angle", ("S0", "s0")), "give each of them once"),
        (lambda: curve(MALUS, "angle", ()), "quantities are"),
        (lambda: curve(MALUS, "angle", ("S0", "DoP", "AoP")), "S0, DoP and AoP have 3 units"),
        (lambda: curve(op.Polarizer(), "angle"), "a curve is of a path"),
        (lambda: quantity_map(MALUS, "angle", "intensity", ("S0", "S1")), "give one name, such"),
        (lambda: reflection("gold"), "index 'gold' depends on the wavelength; give one"),
        (lambda: reflection(op.Material.cauchy([1.5, 0.004])), "depends on the wavelength; give"),
        (lambda: reflection(1.5, wavelength="500 nm"), "no index depends on it; leave it out"),
        (lambda: reflection(1.5, outside=1.5), "are both 1.5; nothing is reflected"),
        (lambda: reflection(1.5, outside=1.0 + 1.0j), "give the index of a clear medium"),
        (lambda: reflection(np.array([1.5, 1.6])), "a picture is of one index"),
        (lambda: reflection(-1.0), "index is -1.0"),
        (lambda: reflection("gold", wavelength=516.0), "is 516 metres, which is no wavelength"),
        (lambda: reflection("gold", wavelength=["500 nm", "600 nm"]), "a picture is of one"),
        (lambda: reflection("gold", wavelength="1e-9 m"), r"is 1 nm; .* within 187.9 nm .. 19"),
    ],
)
def test_what_is_wrong_is_told(draw, told):
    with pytest.raises(OptipathError, match=told):
        draw()


BOUND, CHOSEN = op.load_preset("malus", angle="30 deg"), op.load_preset("copper-gold-spectrum")
STOKES = op.Source(stokes=op.Parameter("stokes", [1, 0, 0, 0])) >> op.Detector()


@rows(
    "given, told",
    [
        ((MALUS, "angel"), "parameter 'angel' is unknown; did you mean 'angle'"),
        ((MALUS, 3), "parameter 3 is unknown"),
        ((MALUS, {}), "parameter {} is unknown"),
        ((MALUS, "angle", {"angle": 0.1}), "'angle' goes along an axis; leave out angle="),
        ((MALUS, "angle", {"values": 0.3}), "give two or more"),
        ((MALUS, "angle", {"values": "30 deg:30 deg:5"}), "'angle' are 30 deg alone; give"),
        ((MALUS, "angle", {"values": ["vertical", "10 deg"]}), "has 'vertical' among"),
        ((RHOMB, "filter", {"values": ["none", "30 deg"]}), "has 'none' among"),
        ((MALUS, "angle", {"intensity": [1.0, 2.0]}), "one value"),
        ((MALUS, "angle", {"intensty": 1.0}), "'intensty' is unknown; did you mean 'intensity'"),
        ((BOUND, "angle"), "'angle' is bound to 30 deg"),
        ((CHOSEN, "place"), "'place' is chosen before a path runs"),
        ((STOKES, "stokes"), "'stokes' is an array"),
    ],
)
def test_parameters_that_go_along_no_axis_are_told(given, told):
    path, name, more = (*given, {})[:3]
    with pytest.raises(ParameterError, match=told):
        curve(path, name, **more)
