import numpy as np
import pytest

import optipath as op
from pictures import faults_of, texts_of
from tables import rows

figures = pytest.importorskip("matplotlib.figure")
patches = pytest.importorskip("matplotlib.patches")
colors = pytest.importorskip("matplotlib.colors")

NAN = np.nan
LIGHTS = {
    "elliptical": op.Light([2.0, 0.6, 0.9, 0.8]),
    "linear": op.Light([1.0, 0.9, 0.1, 0.0]),
    "circular": op.Light([1.0, 0.0, 0.0, -1.0]),
    "unpolarised": op.Light([1.0, 0.0, 0.0, 0.0]),
    "dark": op.Light([0.0, 0.0, 0.0, 0.0]),
    "not read": op.Light([1.0, NAN, NAN, NAN]),
    "down": op.Light([1.0, -0.5, -0.6, -0.3]),
    "faint": op.Light([1e-300, 0.0, 0.6e-300, 0.3e-300]),
    "beyond floats": op.Light([1.0, 0.6, 0.0, 0.8], exponent=-332193),
    "single": op.Light(np.array([1.0, 0.6, 0.0, 0.8], np.float32)),
    "noise": op.Light([1.0, 0.9, 0.3, 0.6], physical=False),
    "weak": op.Light([1.0, 0.01, 0.0, 0.01]),
    "negative": op.Light([-1.0, 0.0, 0.0, 0.0], physical=False),
}


def axes(width, height):
    return figures.Figure(figsize=(width, height), layout="constrained").add_subplot()


def curves_of(ax):
    """The lines that are ellipses: those of many points."""
    return [line for line in ax.get_lines() if len(line.get_xdata()) > 2]


def circles_of(ax):
    return [patch for patch in ax.patches if isinstance(patch, patches.Circle)]


@rows("light", LIGHTS.values())
def test_no_text_is_over_another_or_cut(light):
    ax = op.plots.ellipse(light)
    assert faults_of(ax.figure) == []


@rows("name", ["elliptical", "not read", "beyond floats", "weak"])
def test_no_text_is_over_another_or_cut_on_small_axes(name):
    ax = op.plots.ellipse(LIGHTS[name], axes(2.5, 2.9))
    assert faults_of(ax.figure) == []


@rows("size", [(5.0, 7.3), (2.5, 3.7)])
def test_no_text_of_six_lights_is_over_another_or_cut(size):
    names = ["elliptical", "linear", "circular", "unpolarised", "dark", "down"]
    ax = op.plots.ellipse({name: LIGHTS[name] for name in names}, axes(*size))
    assert faults_of(ax.figure) == []


def test_half_axes_go_by_the_degree_of_polarisation():
    # Half axes of circular light are the root of 1/2, of which the squares add up to 1.
    (curve,) = curves_of(op.plots.ellipse(LIGHTS["circular"]))
    np.testing.assert_allclose(np.hypot(*curve.get_data()), np.sqrt(0.5), rtol=1e-12)
    light = LIGHTS["elliptical"]
    (curve,) = curves_of(op.plots.ellipse(light))
    radii = np.hypot(*curve.get_data())
    dop = np.sqrt(0.6**2 + 0.9**2 + 0.8**2) / 2.0
    assert radii.max() ** 2 + radii.min() ** 2 == pytest.approx(dop, rel=1e-3)


def test_linear_unpolarised_and_dark_light_are_a_line_a_circle_and_nothing():
    (curve,) = curves_of(op.plots.ellipse(op.Light([1.0, 0.5, np.sqrt(0.75), 0.0])))
    x, y = curve.get_data()
    np.testing.assert_allclose(y, x * np.tan(np.pi / 6.0), atol=1e-12)
    assert np.hypot(x, y).max() == pytest.approx(1.0)
    ax = op.plots.ellipse(LIGHTS["linear"])
    assert all(text.get_text() for text in ax.texts)
    (circle,) = circles_of(op.plots.ellipse(op.Light([2.0, 0.0, 0.6, 0.8])))
    # As circular light of that power has it, both of whose half axes are the radius.
    assert 2.0 * circle.radius**2 == pytest.approx(0.5)
    light = op.load_preset("senarmont").trace()
    assert "dark" in op.plots.ellipse(light).get_title()


@rows("s3, turns", [(1.0, 1.0), (-1.0, -1.0)])
def test_heads_go_from_x_to_y_where_s3_is_positive(s3, turns):
    ax = op.plots.ellipse(op.Light([1.0, 0.0, 0.0, s3]))
    heads = [text for text in ax.texts if not text.get_text()]
    assert len(heads) == 2
    for head in heads:
        (x, y), (dx, dy) = head.xyann, np.subtract(head.xy, head.xyann)
        assert np.sign(x * dy - y * dx) == turns


@rows("name", ["unpolarised", "dark", "not read", "negative"])
def test_light_without_an_ellipse_says_why(name):
    ax = op.plots.ellipse(LIGHTS[name])
    assert curves_of(ax) == []
    told = {
        "dark": "dark",
        "not read": "S1, S2 and S3 are not read",
        "negative": "no light: S0 is negative",
    }.get(name, name)
    assert ax.get_title().split("\n")[0] == told
    assert len(circles_of(ax)) == (name == "unpolarised")


def test_figures_and_the_angle_are_told_and_from_where_it_is_seen():
    title = op.plots.ellipse(LIGHTS["down"]).get_title().replace("\N{MINUS SIGN}", "-")
    aop = np.degrees(np.arctan2(-0.6, -0.5)) / 2.0
    assert "left-handed elliptical" in title
    assert f"AoP = {aop:.4g}°" in title
    ax = op.plots.ellipse(op.Light([1.0, 0.5, np.sqrt(0.75), 0.0]))
    (arc,) = (patch for patch in ax.patches if isinstance(patch, patches.Arc))
    assert (arc.theta1, arc.theta2) == pytest.approx((0.0, 30.0))
    assert "30°" in {text.get_text() for text in texts_of(ax.figure)}
    ax = op.plots.ellipse(LIGHTS["elliptical"])
    assert "seen towards the source" in ax.get_xlabel()
    assert (ax.get_xlabel().split("\n")[0], ax.get_ylabel()) == ("Ex / √S0", "Ey / √S0")
    ax = op.plots.ellipse(LIGHTS["circular"], axes(6.0, 3.0))
    ax.figure.draw_without_rendering()
    step = ax.transData.transform([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    assert step[1, 0] - step[0, 0] == pytest.approx(step[2, 1] - step[0, 1])


def test_light_too_faint_for_floats_has_its_ellipse_and_its_power_of_ten():
    ax = op.plots.ellipse(LIGHTS["beyond floats"])
    assert len(curves_of(ax)) == 1
    assert "S0 = 10^\N{MINUS SIGN}100000" in ax.get_title()


def test_a_batch_has_a_curve_each_by_its_name():
    angles = np.radians([0.0, 30.0, 60.0])
    light = op.Light(np.stack([np.ones(3), np.cos(angles), np.sin(angles), np.zeros(3)], -1))
    ax = op.plots.ellipse(light, labels=["a", "b", "c"])
    assert len(curves_of(ax)) == 3
    told = [text.get_text().split(":")[0] for text in ax.get_legend().get_texts()]
    assert told == ["a", "b", "c"]


def test_light_with_a_circle_alone_has_its_colour_in_the_key_and_dark_light_none():
    ax = op.plots.ellipse({name: LIGHTS[name] for name in ("linear", "unpolarised", "dark")})
    (circle,) = (each for each in circles_of(ax) if each.radius == pytest.approx(np.sqrt(0.5)))
    _, unpolarised, dark, _ = ax.get_legend().get_lines()
    assert colors.same_color(unpolarised.get_color(), circle.get_edgecolor())
    assert unpolarised.is_dashed()
    assert dark.get_linestyle() == "None"


def test_names_are_told_as_they_are():
    names = ["_lamp", "$a_b$ and $"]
    ax = op.plots.ellipse(dict(zip(names, [LIGHTS["linear"], LIGHTS["down"]], strict=True)))
    assert faults_of(ax.figure) == []
    told = [text.get_text().split(":")[0] for text in ax.get_legend().get_texts()]
    assert told[:2] == names
    assert op.plots.ellipse(LIGHTS["linear"], labels=names[1]).get_title().startswith(names[1])


@rows(
    "light, labels, told",
    [
        (op.Light(np.tile([1.0, 0.0, 0.0, 0.0], (7, 1))), None, "7 lights are too many"),
        (op.Light(np.ones((2, 2, 1)) * [1.0, 0, 0, 0]), None, r"shape \(2, 2\) is more than a row"),
        (op.Light(np.zeros((0, 4))), None, "there is no light to draw"),
        (op.Light(np.zeros((2, 4))), ["a"], "1 labels for 2 lights"),
        (op.Light(np.zeros((2, 4))), ["a", "a"], "name two lights alike"),
        (op.Light(np.zeros((2, 4))), 3, "give a text for each"),
        ({"a": op.Light(np.zeros((2, 4)))}, ["b"], "has names already.*'a' is a batch"),
        ([1.0, 0.0, 0.0, 0.0], None, "is no light; give a Light"),
    ],
)
def test_what_cannot_be_drawn_is_told(light, labels, told):
    with pytest.raises(op.OptipathError, match=f"(?s){told}"):
        op.plots.ellipse(light, labels=labels)


def test_axes_of_something_else_and_traced_light_are_refused():
    with pytest.raises(op.OptipathError, match="give Axes of Matplotlib"):
        op.plots.ellipse(LIGHTS["linear"], "here")
    jax = pytest.importorskip("jax")
    with pytest.raises(op.ParameterError, match="a picture of light takes numbers"):
        jax.jit(lambda stokes: op.plots.ellipse(op.Light(stokes)))(np.array([1.0, 0, 0, 1]))
