import numpy as np
import pytest

import optipath as op
from pictures import faults_of, texts_of
from tables import rows

figures = pytest.importorskip("matplotlib.figure")

NAN = np.nan
PATH = op.load_preset("npgr026", case="8")
PUBLISHED = PATH.cases["8"].published["E"]


def axes(width, height):
    return figures.Figure(figsize=(width, height), layout="constrained").add_subplot()


def heights_of(ax):
    return np.array([[bar.get_height() for bar in bars] for bars in ax.containers])


def ticks_of(ax):
    return [
        text.get_text().replace("\N{MINUS SIGN}", "-").split("\n") for text in ax.get_xticklabels()
    ]


def keys_of(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


ROWS = op.Light([[1.0, np.cos(a), np.sin(a), 0.0] for a in range(6)])


@rows("scale", [1.0, 0.5])
@rows(
    "light, published",
    [
        (PATH.trace(), PUBLISHED),
        (op.Light([1.0, NAN, NAN, NAN]), None),
        (op.Light([1e-300, 0.0, 0.6e-300, 0.3e-300]), [1e-300, 0.0, 0.5e-300, NAN]),
        (op.Light([1.0, 0.6, 0.0, 0.8], exponent=-332193), None),
        ({"first": PATH.trace(), "second": 0.5 * PATH.trace()}, {"first": PUBLISHED}),
    ],
)
def test_no_text_is_over_another_or_cut(light, published, scale):
    ax = op.plots.stokes(light, axes(5.6 * scale, 4.4 * scale), published=published)
    assert faults_of(ax.figure) == []


def test_bars_are_as_high_as_the_stokes_parameters_and_named():
    ax = op.plots.stokes(ROWS, published=np.add(ROWS.stokes, [0.0, 0.0, 0.0, 0.01]))
    assert faults_of(ax.figure) == []
    assert keys_of(ax) == [*(f"light[{place}]" for place in range(6)), "published"]
    assert [lines[-1] for lines in ticks_of(ax)] == ["Δ 0", "Δ 0", "Δ 0", "Δ -0.01"]
    light = op.Light([2.0, 0.6, -0.9, 0.8])
    np.testing.assert_allclose(heights_of(op.plots.stokes(light)), [[2.0, 0.6, -0.9, 0.8]])
    ax = op.plots.stokes(ROWS[0], labels="eye")
    assert "eye" in {text.get_text() for text in texts_of(ax.figure)}


def test_published_numbers_and_differences_stand_below_the_bars():
    ax = op.plots.stokes(op.Light([1.0, 0.5, 0.0, -0.25]), published=[1.0, 0.49, 0.0, NAN])
    assert ticks_of(ax) == [
        ["S0", "1", "(1)", "Δ 0"],
        ["S1", "0.5", "(0.49)", "Δ 0.01"],
        ["S2", "0", "(0)", "Δ 0"],
        ["S3", "-0.25", "(none)"],
    ]
    assert ax.get_xlabel() == "computed, (published), Δ = computed less published"
    ax = op.plots.stokes(PATH.trace(), published=PUBLISHED)
    told = [lines[2].strip("()") for lines in ticks_of(ax)]
    assert [float(each) for each in told] == [19.1245, 10.9873, -13.0076, -8.70795]
    ax = op.plots.stokes(PATH.trace(), published=PUBLISHED)
    (marks,) = (line for line in ax.get_lines() if line.get_marker() == "D")
    np.testing.assert_allclose(marks.get_ydata(), PUBLISHED)
    assert keys_of(ax) == ["computed", "published"]
    ax = op.plots.stokes(op.Light([0.1 + 0.2, 0.2, 0.0, 0.0]), published=[0.3, 0.2, 0.0, 0.0])
    assert [lines[-1] for lines in ticks_of(ax)] == ["Δ 0"] * 4


@rows("preset, case", [("achromatic-rhomb", "green"), ("npgr026", "7")])
def test_long_numbers_stand_by_themselves_on_small_axes(preset, case):
    path = op.load_preset(preset, case=case)
    (published,) = path.cases[case].published.values()
    ax = op.plots.stokes(path.trace(), axes(2.8, 2.2), published=published)
    assert faults_of(ax.figure) == []


def test_dark_infinite_and_unread_light_is_told_as_such():
    ax = op.plots.stokes(op.load_preset("senarmont").trace())
    assert [lines[1] for lines in ticks_of(ax)] == ["0", "0", "0", "0"]
    assert ax.get_ylabel() == "Stokes parameter\n(unit of the source)"
    assert not heights_of(ax).any()
    ax = op.plots.stokes(op.Light([1.0, NAN, NAN, NAN]))
    assert [lines[1] for lines in ticks_of(ax)] == ["1", "not read", "not read", "not read"]
    infinite = op.Light([np.inf, 0.0, 0.0, 0.0], physical=False)
    ax = op.plots.stokes(infinite)
    assert [lines[1] for lines in ticks_of(ax)] == ["infinite", "0", "0", "0"]
    ax = op.plots.stokes({"hot": infinite, "lamp": ROWS[0]})
    assert keys_of(ax) == ["hot: infinite", "lamp"]
    ax = op.plots.stokes(op.Light([0.0, 0.0, 0.0, 0.0]))
    assert ax.get_ylabel() == "Stokes parameter\n(unit of the source)"
    assert faults_of(ax.figure) == []


@rows(
    "light, power",
    [
        (op.Light([3e-300, 0.6e-300, 0.0, 1.5e-300]), "-300"),
        (op.Light([3.0, 0.6, 0.0, 1.5], exponent=0) * 1e300, "300"),
        (op.Light([0.75, 0.15, 0.0, 0.375], exponent=-3000), "-904"),
    ],
)
def test_light_beyond_plain_numbers_is_in_powers_of_ten(light, power):
    ax = op.plots.stokes(light)
    assert f"10^{power} " in ax.get_ylabel().replace("\N{MINUS SIGN}", "-")
    heights = heights_of(ax)[0]
    np.testing.assert_allclose(heights / heights[0], [1.0, 0.2, 0.0, 0.5], rtol=1e-9)
    assert 1.0 <= heights[0] < 10.0


@rows("stokes", [[0.0, 0.0, 0.0, 0.0], [NAN, NAN, NAN, NAN]])
def test_axes_of_dark_light_go_from_0_to_1(stokes):
    assert op.plots.stokes(op.Light(stokes)).get_ylim() == (0.0, 1.0)
    lit = op.plots.stokes(op.Light(stokes), published=[4.0, 0.0, 0.0, 0.0])
    assert lit.get_ylim()[1] > 4.0


@rows("scale", [1.0, 0.5])
def test_long_names_are_not_cut(scale):
    lights = {"a": ROWS[0], "b" * 60: ROWS[1], "$x_2$": ROWS[2]}
    ax = op.plots.stokes(lights, axes(5.6 * scale, 4.4 * scale))
    assert faults_of(ax.figure) == []
    assert [key.replace("\n", "") for key in keys_of(ax)] == [*lights]


@rows(
    "light, published, told",
    [
        (ROWS[0], [1.0, 0.0], "give S0, S1, S2 and S3"),
        (ROWS[0], ["a", "b", "c", "d"], "published"),
        (ROWS[0], [1.0, np.inf, 0.0, 0.0], "write NaN"),
        (ROWS, [1.0, 0.0, 0.0, 0.0], r"numbers of shape \(6, 4\)"),
        ({"eye": ROWS[0]}, [1.0, 0.0, 0.0, 0.0], "lights have names"),
        ({"eye": ROWS[0]}, {"eey": [1.0, 0.0, 0.0, 0.0]}, "did you mean 'eye'"),
    ],
)
def test_published_values_that_do_not_fit_are_told(light, published, told):
    with pytest.raises(op.OptipathError, match=told):
        op.plots.stokes(light, published=published)


@rows("light", [op.Light(np.zeros(4)), op.Light([0.0, NAN, NAN, NAN]), op.Light([NAN] * 4)])
def test_an_axis_without_bars_goes_from_0_to_1(light):
    ax = op.plots.stokes(light)
    assert ax.get_ylim() == (0.0, 1.0)
    assert faults_of(ax.figure) == []
    ax.figure.draw_without_rendering()
    assert ax.yaxis.get_offset_text().get_text() == ""
    assert op.plots.stokes(light, published=[2.0, 0.0, 0.0, 0.0]).get_ylim()[1] > 2.0
