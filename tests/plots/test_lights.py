"""Pictures of light: ellipses, bars, Mueller matrices, and states and trails on the sphere."""

import numpy as np
import pytest
from matplotlib.colors import same_color, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle
from matplotlib.patheffects import Stroke

import optipath as op
from optipath.plots import ellipse, mueller, poincare, poincare_path, stokes
from optipath.plots.poincare_sphere import is_near, name_points, parameter_trail
from pictures import faults_of, texts_of
from tables import rows, slow

NAN = np.nan
UNREAD = [1.0, NAN, NAN, NAN]
ELLIPTICAL = op.Light([2.0, 0.6, 0.9, 0.8])
LINEAR = op.Light([1.0, 0.9, 0.1, 0.0])
CIRCULAR = op.Light([1.0, 0.0, 0.0, -1.0])
UNPOLARISED = op.Light([1.0, 0.0, 0.0, 0.0])
DARK = op.Light([0.0, 0.0, 0.0, 0.0])
DOWN = op.Light([1.0, -0.5, -0.6, -0.3])
AT_30 = op.Light([1.0, 0.5, np.sqrt(0.75), 0.0])


def words_of(ax):
    return {text.get_text() for text in texts_of(ax.figure)}


def keys_of(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def plain(text):
    return text.replace("\N{MINUS SIGN}", "-")


def curves_of(ax):
    """The lines that are ellipses: those of many points."""
    return [line for line in ax.get_lines() if len(line.get_xdata()) > 2]


def circles_of(ax):
    return [patch for patch in ax.patches if isinstance(patch, Circle)]


def test_half_axes_go_by_the_degree_of_polarisation_and_heads_from_x_to_y_where_s3_is_positive():
    # Half axes of circular light are the root of 1/2, of which the squares add up to 1.
    (curve,) = curves_of(ellipse(CIRCULAR))
    np.testing.assert_allclose(np.hypot(*curve.get_data()), np.sqrt(0.5), rtol=1e-12)
    (curve,) = curves_of(ellipse(ELLIPTICAL))
    radii = np.hypot(*curve.get_data())
    dop = np.sqrt(0.6**2 + 0.9**2 + 0.8**2) / 2.0
    assert radii.max() ** 2 + radii.min() ** 2 == pytest.approx(dop, rel=1e-3)
    (circle,) = circles_of(ellipse(op.Light([2.0, 0.0, 0.6, 0.8])))
    # As circular light of that power has it, both of whose half axes are the radius.
    assert 2.0 * circle.radius**2 == pytest.approx(0.5)
    for s3 in (1.0, -1.0):
        ax = ellipse(op.Light([1.0, 0.0, 0.0, s3]))
        heads = [text for text in ax.texts if not text.get_text()]
        assert len(heads) == 2
        for head in heads:
            (x, y), (dx, dy) = head.xyann, np.subtract(head.xy, head.xyann)
            assert np.sign(x * dy - y * dx) == s3


@rows(
    "light, told",
    [
        (UNPOLARISED, "unpolarised"),
        (DARK, "dark"),
        (op.load_preset("senarmont").trace(), "dark: S0 is no more than rounding"),
        (op.Light(UNREAD), "S1, S2 and S3 are not read"),
        (op.Light([-1.0, 0.0, 0.0, 0.0], physical=False), "no light: S0 is negative"),
    ],
)
def test_light_without_an_ellipse_says_why(light, told):
    ax = ellipse(light)
    assert curves_of(ax) == []
    assert ax.get_title().split("\n")[0] == told
    assert len(circles_of(ax)) == (told == "unpolarised")


def test_figures_and_the_angle_are_told_and_from_where_it_is_seen():
    title = plain(ellipse(DOWN).get_title())
    assert "left-handed elliptical" in title
    assert f"AoP = {np.degrees(np.arctan2(-0.6, -0.5)) / 2.0:.4g}°" in title
    ax = ellipse(AT_30)
    (curve,) = curves_of(ax)
    x, y = curve.get_data()
    np.testing.assert_allclose(y, x * np.tan(np.pi / 6.0), atol=1e-12)
    assert np.hypot(x, y).max() == pytest.approx(1.0)
    (arc,) = (patch for patch in ax.patches if isinstance(patch, Arc))
    assert (arc.theta1, arc.theta2) == pytest.approx((0.0, 30.0))
    assert "30°" in words_of(ax)
    assert all(text.get_text() for text in ellipse(LINEAR).texts)
    ax = ellipse(ELLIPTICAL)
    assert "seen towards the source" in ax.get_xlabel()
    assert (ax.get_xlabel().split("\n")[0], ax.get_ylabel()) == ("Ex / √S0", "Ey / √S0")
    ax = ellipse(CIRCULAR, Figure((6.0, 3.0), layout="constrained").add_subplot())
    ax.figure.draw_without_rendering()
    step = ax.transData.transform([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    assert step[1, 0] - step[0, 0] == pytest.approx(step[2, 1] - step[0, 1])
    ax = ellipse(op.Light([1e-300, 0.6e-300, 0.0, 0.8e-300]))
    assert len(curves_of(ax)) == 1
    assert "S0 = 1e-300" in plain(ax.get_title())


def test_each_of_several_lights_has_its_curve_its_colour_and_its_name_as_it_is():
    angles = np.radians([0.0, 30.0, 60.0])
    light = op.Light(np.stack([np.ones(3), np.cos(angles), np.sin(angles), np.zeros(3)], -1))
    ax = ellipse(light, labels=["a", "b", "c"])
    assert len(curves_of(ax)) == 3
    assert [key.split(":")[0] for key in keys_of(ax)] == ["a", "b", "c"]
    ax = ellipse({"linear": LINEAR, "unpolarised": UNPOLARISED, "dark": DARK})
    (circle,) = (each for each in circles_of(ax) if each.radius == pytest.approx(np.sqrt(0.5)))
    _, unpolarised, dark, _ = ax.get_legend().get_lines()
    assert same_color(unpolarised.get_color(), circle.get_edgecolor())
    assert (unpolarised.is_dashed(), dark.get_linestyle()) == (True, "None")
    ax = ellipse({"_lamp": LINEAR, "$a_b$ and $": DOWN})
    assert faults_of(ax.figure) == []
    assert [key.split(":")[0] for key in keys_of(ax)][:2] == ["_lamp", "$a_b$ and $"]
    assert ellipse(LINEAR, labels="$a_b$ and $").get_title().startswith("$a_b$ and $")


# Bars.

PATH = op.load_preset("npgr026", case="8")
PUBLISHED = PATH.cases["8"].published["E"]
ROW = op.Light([[1.0, np.cos(a), np.sin(a), 0.0] for a in range(6)])
INFINITE = op.Light([np.inf, 0.0, 0.0, 0.0], physical=False)


def heights_of(ax):
    return np.array([[bar.get_height() for bar in bars] for bars in ax.containers])


def ticks_of(ax):
    return [plain(text.get_text()).split("\n") for text in ax.get_xticklabels()]


def test_bars_are_as_high_as_the_stokes_parameters_with_published_numbers_and_differences_below():
    ax = stokes(ROW, published=np.add(ROW.stokes, [0.0, 0.0, 0.0, 0.01]))
    assert faults_of(ax.figure) == []
    assert keys_of(ax) == [*(f"light[{place}]" for place in range(6)), "published"]
    assert [lines[-1] for lines in ticks_of(ax)] == ["Δ 0", "Δ 0", "Δ 0", "Δ -0.01"]
    heights = heights_of(stokes(op.Light([2.0, 0.6, -0.9, 0.8])))
    np.testing.assert_allclose(heights, [[2.0, 0.6, -0.9, 0.8]])
    assert "eye" in words_of(stokes(ROW[0], labels="eye"))
    lights = {"a": ROW[0], "b" * 60: ROW[1], "$x_2$": ROW[2]}
    assert [key.replace("\n", "") for key in keys_of(stokes(lights))] == [*lights]
    ax = stokes(op.Light([1.0, 0.5, 0.0, -0.25]), published=[1.0, 0.49, 0.0, NAN])
    assert ticks_of(ax) == [
        ["S0", "1", "(1)", "Δ 0"],
        ["S1", "0.5", "(0.49)", "Δ 0.01"],
        ["S2", "0", "(0)", "Δ 0"],
        ["S3", "-0.25", "(none)"],
    ]
    assert ax.get_xlabel() == "computed, (published), Δ = computed less published"
    ax = stokes(PATH.trace(), published=PUBLISHED)
    told = [float(lines[2].strip("()")) for lines in ticks_of(ax)]
    assert told == [19.1245, 10.9873, -13.0076, -8.70795]
    (marks,) = (line for line in ax.get_lines() if line.get_marker() == "D")
    np.testing.assert_allclose(marks.get_ydata(), PUBLISHED)
    assert keys_of(ax) == ["computed", "published"]
    ax = stokes(op.Light([0.1 + 0.2, 0.2, 0.0, 0.0]), published=[0.3, 0.2, 0.0, 0.0])
    assert [lines[-1] for lines in ticks_of(ax)] == ["Δ 0"] * 4


@rows(
    "light, told",
    [
        (op.load_preset("senarmont").trace(), ["0", "0", "0", "0"]),
        (DARK, ["0", "0", "0", "0"]),
        (op.Light([0.0, NAN, NAN, NAN]), ["0", "not read", "not read", "not read"]),
        (op.Light([NAN] * 4), ["not read"] * 4),
        (op.Light(UNREAD), ["1", "not read", "not read", "not read"]),
        (INFINITE, ["infinite", "0", "0", "0"]),
    ],
)
def test_dark_infinite_and_unread_light_is_told_as_such_on_axes_from_0_to_1(light, told):
    ax = stokes(light)
    assert [lines[1] for lines in ticks_of(ax)] == told
    assert faults_of(ax.figure) == []
    assert ax.get_ylabel() == "Stokes parameter\n(unit of the source)"
    if told[0] in {"0", "not read"}:
        assert not np.nan_to_num(heights_of(ax)).any()
        assert ax.get_ylim() == (0.0, 1.0)
        assert ax.yaxis.get_offset_text().get_text() == ""
    if light is DARK:
        assert stokes(light, published=[4.0, 0.0, 0.0, 0.0]).get_ylim()[1] > 4.0
    if light is INFINITE:
        assert keys_of(stokes({"hot": light, "lamp": ROW[0]})) == ["hot: infinite", "lamp"]


@rows(
    "light, power",
    [
        (op.Light([3e-300, 0.6e-300, 0.0, 1.5e-300]), "-300"),
        (op.Light([3.0, 0.6, 0.0, 1.5]) * 1e300, "300"),
    ],
)
def test_light_beyond_plain_numbers_is_in_powers_of_ten(light, power):
    ax = stokes(light)
    assert f"10^{power} " in plain(ax.get_ylabel())
    heights = heights_of(ax)[0]
    np.testing.assert_allclose(heights / heights[0], [1.0, 0.2, 0.0, 0.5], rtol=1e-9)
    assert 1.0 <= heights[0] < 10.0


# Mueller matrices.

GOLD = op.Interface(0.17 + 3.15j, "70 deg").mueller("in", "reflected")


def changed(place, value):
    numbers = np.diag([1.0, 0.5, 0.5, -0.5])
    numbers[place] = value
    return op.Mueller(numbers)


def digits_of(ax):
    """The text of each cell that has one, by its row and column."""
    cells = [(text.get_position()[::-1], plain(text.get_text())) for text in ax.texts]
    return {(int(row), int(column)): text for (row, column), text in cells}


def lightness(colour):
    shares = np.array(to_rgb(colour))
    linear = np.where(shares <= 0.04045, shares / 12.92, ((shares + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


def test_cells_are_over_m00_in_colours_apart_from_white_at_zero_with_digits_that_are_read():
    ax = mueller(op.Polarizer("0 deg").mueller())
    assert ax.get_title() == "M / M00, with M00 = 0.5"
    cells = digits_of(ax)
    assert {place for place, text in cells.items() if text == "1"} == {*np.ndindex(2, 2)}
    assert {text for place, text in cells.items() if max(place) > 1} == {"0"}
    numbers = np.eye(4)
    numbers[0, 3] = 0.25
    ax = mueller(op.Mueller(numbers))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("in", "out")
    assert [text.get_text() for text in ax.get_xticklabels()] == ["S0", "S1", "S2", "S3"]
    assert digits_of(ax)[0, 3] == "0.25"
    # What is NaN, dark or noise is told.
    ax = mueller(changed((1, 2), NAN))
    (hatched,) = ax.patches
    assert hatched.get_hatch()
    assert hatched.get_xy() == (1.5, 0.5)
    assert (1, 2) not in digits_of(ax)
    assert "not known (NaN)" in words_of(ax)
    ax = mueller(op.Mueller(np.zeros((4, 4))))
    assert len(ax.patches) == 16
    assert "none: M00 is 0, or noise" in words_of(ax)
    for value, told in ((2e-5, "2e-5"), (-3e-17, "0")):
        assert digits_of(mueller(changed((2, 2), value)))[2, 2] == told
    # A contrast of 3 at least, as WCAG 2.1 (1.4.11) asks of what is drawn.
    (image,) = mueller(GOLD).get_images()
    assert image.get_clim() == (-1.0, 1.0)
    np.testing.assert_allclose(image.cmap(image.norm(0.0))[:3], 1.0, atol=0.04)
    (image,) = mueller(changed((1, 1), 3.0)).get_images()
    assert image.get_clim() == (-3.0, 3.0)
    numbers = np.linspace(-1.0, 1.0, 16).reshape(4, 4)
    numbers[0, 0] = 1.0
    ax = mueller(op.Mueller(numbers))
    (image,) = ax.get_images()
    assert len(ax.texts) == 16
    for text in ax.texts:
        column, row = map(int, text.get_position())
        ground = image.cmap(image.norm(numbers[row, column]))
        dim, bright = sorted((lightness(ground[:3]), lightness(text.get_color())))
        assert (bright + 0.05) / (dim + 0.05) > 3.0


TWO = op.Light(np.zeros((2, 4)))


@rows(
    "draw, told",
    [
        (lambda: ellipse(op.Light(np.tile([1.0, 0, 0, 0], (7, 1)))), "7 lights are not drawn"),
        (lambda: ellipse(op.Light(np.ones((2, 2, 1)) * [1.0, 0, 0, 0])), r"shape \(2, 2\) is more"),
        (lambda: ellipse(TWO[:0]), "0 lights are not drawn"),
        (lambda: ellipse(TWO, labels=["a"]), "give 2 texts, one for each light"),
        (lambda: ellipse(TWO, labels=["a", "a"]), "one for each light, all different"),
        (lambda: ellipse(TWO, labels=3), "give 2 texts, one for each"),
        (lambda: ellipse({"a": LINEAR}, labels=["b"]), "has names already"),
        (lambda: ellipse({"a": TWO}), "'a' is a batch"),
        (lambda: ellipse([1.0, 0.0, 0.0, 0.0]), "is no light; give a Light"),
        (lambda: ellipse(LINEAR, "here"), "give flat Axes"),
        (lambda: stokes(LINEAR, published=[1.0, 0.0]), "give finite numbers of shape"),
        (lambda: stokes(LINEAR, published=["a", "b", "c", "d"]), "published"),
        (lambda: stokes(LINEAR, published=[1.0, np.inf, 0.0, 0.0]), "NaN where missing"),
        (lambda: stokes(ROW, published=[1.0, 0.0, 0.0, 0.0]), r"numbers of shape \(6, 4\)"),
        (
            lambda: stokes({"eye": LINEAR}, published=[1.0, 0.0, 0.0, 0.0]),
            "give them by names of lights",
        ),
        (lambda: stokes({"eye": LINEAR}, published={"eey": [1.0, 0, 0, 0]}), "did you mean 'eye'"),
        (
            lambda: mueller(op.Mueller(np.zeros((3, 4, 4)))),
            r"batch of shape \(3,\); give one of it by its index",
        ),
        (lambda: mueller(np.eye(4)), r"is no Mueller matrix; give one"),
    ],
)
def test_what_cannot_be_drawn_is_told(draw, told):
    with pytest.raises(op.OptipathError, match=f"(?s){told}"):
        draw()


def test_what_jax_traces_is_refused():
    jax = pytest.importorskip("jax")
    for draw, told in (
        (lambda given: ellipse(op.Light(given[0])), "a picture of light takes numbers"),
        (lambda given: mueller(op.Mueller(given)), "a picture of a Mueller matrix takes numbers"),
    ):
        with pytest.raises(op.errors.ParameterError, match=told):
            jax.jit(draw)(np.eye(4))


# The sphere.

ANGLES = np.radians(np.arange(0.0, 181.0, 10.0))
TRAIL = op.Retarder(ANGLES, "10 deg") @ op.Light([1.0, 0.0, 0.95, 0.0])
MALUS, NONE = op.load_preset("malus"), [0.0] * 4


def points_of(ax):
    """The places of points in space, of all that are drawn."""
    drawn = [each for each in ax.collections if hasattr(each, "_offsets3d")]
    return np.concatenate([np.transpose(each._offsets3d) for each in drawn])


def segments_of(ax):
    """The ends of the lines between lights."""
    drawn = [each for each in ax.collections if hasattr(each, "_segments3d")]
    return np.concatenate([np.asarray(each._segments3d) for each in drawn])


def test_states_are_named_at_their_places_and_points_are_the_stokes_parameters():
    ax = poincare(TRAIL[0])
    assert {"R", "L", "H", "V", "D", "A", "S1/S0", "S2/S0", "S3/S0"} <= words_of(ax)
    places = {text.get_text(): np.array(text.get_position()) for text in ax.texts}
    assert places["R"][1] > places["H"][1] > places["L"][1]
    np.testing.assert_allclose(places["H"] + places["V"], places["D"] + places["A"], atol=1e-12)
    light = op.Light([[2.0, 1.0, 0.0, 0.0], [5.0, 0.0, 3.0, 4.0]])
    np.testing.assert_allclose(points_of(poincare(light)), [[0.5, 0.0, 0.0], [0.0, 0.6, 0.8]])
    faint = op.Light([2e-300, 1e-300, 0.0, 0.0])
    np.testing.assert_allclose(points_of(poincare(faint)), [[0.5, 0.0, 0.0]])


def test_trails_have_hollow_points_behind_gaps_a_labelled_colour_bar_and_a_second_one_beside():
    ax = poincare(op.Light([[1.0, 1.0, 0.0, 0.0], [1.0, -1.0, 0.0, 0.0]]))
    # Matplotlib has them in the order of their depth.
    white = (ax.collections[-1].get_facecolors() == 1.0).all(axis=1)
    assert sorted(white) == [False, True]
    assert "hollow: far half" in words_of(ax)
    assert is_near(np.array([0.0, 0.0, 1.0]))
    ax = poincare(
        op.Light([[1.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0], NONE, [1.0, 0.0, 0.0, 1.0]])
    )
    np.testing.assert_allclose(segments_of(ax), [[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    ax = poincare(op.Light([[1.0, 0.0, 0.0, 1.0], NONE, UNREAD]))
    assert ax.get_title() == "2 of 3 have no point: dark, or not read"
    assert len(points_of(ax)) == 1
    for numbers, told in ((NONE, "dark"), (UNREAD, "S1, S2 and S3 are not read")):
        assert poincare(op.Light(numbers)).get_title().split("\n")[0] == told
    ax = poincare(TRAIL, by=np.degrees(ANGLES), label="retardance (deg)")
    (bar,) = (each for each in ax.figure.axes if each is not ax)
    assert bar.get_ylabel() == "retardance (deg)"
    np.testing.assert_allclose(bar.get_ylim(), (0.0, 180.0), atol=1e-9)
    ax = poincare(TRAIL[:3], by=[2.0, 2.0, 2.0], label="n")
    assert faults_of(ax.figure) == []
    lines = len(ax.get_lines())
    assert poincare(TRAIL[7], ax) is ax
    assert lines == len(ax.get_lines()) > 0


@rows(
    "draw, told",
    [
        (lambda: poincare(TRAIL.reshape(1, -1)), "is no trail"),
        (lambda: poincare(TRAIL[:0]), "is no trail"),
        (lambda: poincare(TRAIL, by=ANGLES), "by and label belong together"),
        (lambda: poincare(TRAIL, label="delta (deg)"), "by and label belong together"),
        (
            lambda: poincare(TRAIL, by=ANGLES[:2], label="x"),
            r"each light of a trail \(19,\)",
        ),
        (
            lambda: poincare(TRAIL, by=["a"] * 19, label="x"),
            r"each light of a trail \(19,\)",
        ),
        (
            lambda: poincare(TRAIL[:2], by=[0.0, np.nan], label="x"),
            "by is .0.0, nan.*give a finite number",
        ),
        (
            lambda: poincare(TRAIL[0], by=1.0, label="x"),
            "give a finite number for each light of a trail",
        ),
        (lambda: poincare(TRAIL, Figure().add_subplot()), r'add_subplot\(projection="3d"\)'),
        (lambda: poincare(TRAIL, "no axes"), r'add_subplot\(projection="3d"\)'),
        (
            lambda: poincare_path(MALUS, angle=[0.0, 0.5]),
            r"angle has the shape \(2,\); give single",
        ),
        (lambda: poincare_path("malus"), "draws a path, not .*give a PathGraph"),
        (lambda: poincare_path(op.Polarizer(0.0)), "draws a path, not .*give a PathG"),
    ],
)
def test_what_is_no_trail_is_told(draw, told):
    with pytest.raises(op.OptipathError, match=told):
        draw()


def test_links_are_named_in_the_order_of_travel_at_the_points_of_their_light():
    keys = keys_of(poincare_path(MALUS))
    assert keys[:3] == ["1  lamp → polarizer", "2  polarizer → analyzer", "3  analyzer → eye"]
    assert "straight from light to light" in keys[-1]
    path = op.Source() >> op.Polarizer("0 deg") >> op.Polarizer("0 deg") >> op.Detector()
    assert {"1", "2, 3"} <= words_of(poincare_path(path))
    # Of light across there is one point less.
    dark, lit = (
        len(poincare_path(MALUS, angle=angle).collections[-1]._offsets3d[0])
        for angle in ("0 deg", "30 deg")
    )
    assert dark < lit
    # The key tells light that is dark.
    ax = poincare_path(op.Source(stokes=NONE) >> op.Detector())
    assert keys_of(ax)[0].endswith("(dark)")
    assert faults_of(ax.figure) == []


@pytest.mark.slow
def test_keys_of_presets_tell_light_that_is_dark_and_that_leaves_the_path():
    path = op.load_preset("npgr026", case="8")
    drawn = np.transpose(poincare_path(path).collections[-1]._offsets3d)
    assert np.linalg.norm(drawn - path.trace().normalized[1:], axis=1).min() < 1e-12
    assert any("(dark" in key for key in keys_of(poincare_path(op.load_preset("senarmont"))))
    keys = keys_of(poincare_path(op.load_preset("two-panes")))
    assert "3  pane1.transmitted → away" in keys


def trail(name, values=None, **bound):
    path = op.load_preset("lyot-depolarizer", **bound)
    return parameter_trail(path, name, *path.compose().program.detectors, values)


def test_fast_trails_keep_outside_the_sphere_and_too_fast_ones_are_told():
    ax = trail("wavelength")
    first, last = segments_of(ax).swapaxes(0, 1)
    steps = 2.0 * np.arcsin(np.linalg.norm(last - first, axis=1) / 2.0)
    assert np.degrees(steps.max()) < 20.0
    assert ax.get_title() == ""
    assert faults_of(ax.figure) == []
    # A tenth of a metre of quartz turns by some thousand turns over the visible light.
    ax = trail("wavelength", thickness="100 mm")
    assert "faster with wavelength than 23041 points tell" in ax.get_title().replace("\n", " ")
    assert faults_of(ax.figure) == []
    assert len(segments_of(trail("wavelength", "500 nm:600 nm:9"))) == 8
    with pytest.raises(op.errors.ParameterError, match="did you mean 'wavelength'"):
        trail("wavelenth")


@rows("turn", np.radians([0.0, 30.0, 60.0, 90.0, 120.0]))
def test_a_name_stands_beside_the_line_through_its_point(turn):
    ax = Figure(figsize=(4.0, 4.0), dpi=100).add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    line = 0.5 + np.outer(np.linspace(-0.4, 0.4, 500), [np.cos(turn), np.sin(turn)])
    ax.plot(*line[[0, -1]].T)
    name_points(ax, np.array([[0.5, 0.5]]), ["12"])
    box = ax.texts[0].get_window_extent()
    assert not any(box.contains(x, y) for x, y in ax.transData.transform(line))


@pytest.mark.parametrize("preset", ["ellipsometer-pcsa", slow("dichroic-sheet")])
def test_numbers_and_letters_of_a_sphere_are_seen_over_lines_and_not_in_their_way(preset):
    ax = poincare_path(op.load_preset(preset))
    ax.figure.draw_without_rendering()
    texts = [text for text in ax.texts if text.get_text()]
    assert all(isinstance(text.get_path_effects()[0], Stroke) for text in texts)
    boxes = [text.get_window_extent() for text in texts if text.get_text()[0].isdigit()]
    dashed = [each for each in ax.collections if hasattr(each, "get_segments")]
    ends = np.concatenate([each.get_segments() for each in dashed])
    share = np.linspace(0.0, 1.0, 300)[:, None, None]
    points = (ends[:, 0] + share * (ends[:, 1] - ends[:, 0])).reshape(-1, 2)
    pixels = ax.transData.transform(points)
    assert len(boxes) > 1
    assert not any(((pixels > box.min) & (pixels < box.max)).all(axis=1).any() for box in boxes)
