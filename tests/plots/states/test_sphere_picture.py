import numpy as np
import pytest

import optipath as op
from optipath.plots.states.poincare_sphere import is_near
from pictures import faults_of, texts_of
from tables import rows

figures = pytest.importorskip("matplotlib.figure")

ANGLES = np.radians(np.arange(0.0, 181.0, 10.0))
TRAIL = op.Retarder(ANGLES, "10 deg") @ op.Light([1.0, 0.0, 0.95, 0.0])


def sphere(width, height):
    figure = figures.Figure(figsize=(width, height), layout="constrained")
    return figure.add_subplot(projection="3d")


def points_of(ax):
    """The places of points in space, of all that are drawn."""
    drawn = [each for each in ax.collections if hasattr(each, "_offsets3d")]
    return np.concatenate([np.transpose(each._offsets3d) for each in drawn])


def words_of(ax):
    return {text.get_text() for text in texts_of(ax.figure)}


@rows("scale", [1.0, 0.5])
@rows(
    "light, options",
    [
        (TRAIL[0], {}),
        (TRAIL, {"by": np.degrees(ANGLES), "label": "retardance (deg)"}),
        (TRAIL, {}),
        (TRAIL[:9], {}),
        (op.Light([[1, -0.6, 0, 0.8], [1, -0.2, -0.9, 0.1], [0, 0, 0, 0], [1, 0, 0, 0]]), {}),
    ],
)
def test_no_text_is_over_another_or_cut(light, options, scale):
    size = (6.4, 5.6) if options else (5.4, 5.6)
    ax = op.plots.poincare(light, sphere(*np.multiply(size, scale)), **options)
    assert faults_of(ax.figure) == []


def test_states_are_named_at_their_places_and_points_are_the_stokes_parameters():
    names = {"R", "L", "H", "V", "D", "A", "S1/S0", "S2/S0", "S3/S0"}
    assert names <= words_of(op.plots.poincare(TRAIL[0]))
    ax = op.plots.poincare(TRAIL[0])
    places = {text.get_text(): np.array(text.get_position()) for text in ax.texts}
    assert places["R"][1] > places["H"][1] > places["L"][1]
    np.testing.assert_allclose(places["H"] + places["V"], places["D"] + places["A"], atol=1e-12)
    ax = op.plots.poincare(op.Light([[2.0, 1.0, 0.0, 0.0], [5.0, 0.0, 3.0, 4.0]]))
    np.testing.assert_allclose(points_of(ax), [[0.5, 0.0, 0.0], [0.0, 0.6, 0.8]])


@rows(
    "light", [op.Light([2e-300, 1e-300, 0.0, 0.0]), op.Light([2.0, 1.0, 0.0, 0.0], exponent=-9999)]
)
def test_light_of_any_faintness_has_its_point(light):
    np.testing.assert_allclose(points_of(op.plots.poincare(light)), [[0.5, 0.0, 0.0]])


def test_points_behind_are_hollow_joined_but_for_gaps_and_those_that_are_none_counted():
    light = op.Light([[1.0, 1.0, 0.0, 0.0], [1.0, -1.0, 0.0, 0.0]])
    ax = op.plots.poincare(light)
    # Matplotlib has them in the order of their depth.
    white = (ax.collections[-1].get_facecolors() == 1.0).all(axis=1)
    assert sorted(white) == [False, True]
    assert "hollow: far half" in words_of(ax)
    assert is_near(np.array([0.0, 0.0, 1.0]))
    rows = [[1.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0], [0.0] * 4, [1.0, 0.0, 0.0, 1.0]]
    ax = op.plots.poincare(op.Light(rows))
    (lines,) = (each for each in ax.collections if hasattr(each, "_segments3d"))
    np.testing.assert_allclose(lines._segments3d, [[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    light = op.Light([[1.0, 0.0, 0.0, 1.0], [0.0] * 4, [1.0, np.nan, np.nan, np.nan]])
    ax = op.plots.poincare(light)
    assert ax.get_title() == "2 of 3 have no point: dark, or not read"
    assert len(points_of(ax)) == 1


def test_the_colour_bar_is_labelled_of_one_number_too():
    ax = op.plots.poincare(TRAIL, by=np.degrees(ANGLES), label="retardance (deg)")
    (bar,) = (each for each in ax.figure.axes if each is not ax)
    assert bar.get_ylabel() == "retardance (deg)"
    np.testing.assert_allclose(bar.get_ylim(), (0.0, 180.0), atol=1e-9)
    ax = op.plots.poincare(TRAIL[:3], by=[2.0, 2.0, 2.0], label="n")
    assert faults_of(ax.figure) == []


@rows("numbers", [[0.0] * 4, [1.0, np.nan, np.nan, np.nan]])
def test_one_light_without_a_point_says_why(numbers):
    ax = op.plots.poincare(op.Light(numbers))
    assert ax.get_title().split("\n")[0] in ("dark", "S1, S2 and S3 are not read")


def test_a_second_trail_is_drawn_on_the_sphere_that_is_there():
    ax = op.plots.poincare(TRAIL[:3])
    lines = len(ax.get_lines())
    assert lines
    assert op.plots.poincare(TRAIL[7], ax) is ax
    assert len(ax.get_lines()) == lines


@rows(
    "light, options, told",
    [
        (TRAIL.reshape(1, -1), {}, "is no trail"),
        (TRAIL[:0], {}, "is no trail"),
        (TRAIL, {"by": ANGLES}, "by and label belong together"),
        (TRAIL, {"label": "delta (deg)"}, "by and label belong together"),
        (TRAIL, {"by": ANGLES[:2], "label": "x"}, "a number for each of the 19"),
        (TRAIL, {"by": ["a"] * 19, "label": "x"}, "by"),
        (TRAIL[:2], {"by": [0.0, np.nan], "label": "x"}, r"by\[1\] is nan"),
        (TRAIL[0], {"by": 1.0, "label": "x"}, "one light has none"),
    ],
)
def test_what_cannot_be_drawn_is_told(light, options, told):
    with pytest.raises(op.OptipathError, match=told):
        op.plots.poincare(light, **options)


@rows("flat", ["axes", None])
def test_flat_axes_are_refused_with_the_cure(flat):
    ax = figures.Figure().add_subplot() if flat else "no axes"
    with pytest.raises(op.OptipathError, match='add_subplot\\(projection="3d"\\)'):
        op.plots.poincare(TRAIL, ax)
