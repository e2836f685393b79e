import numpy as np
import pytest

import optipath as op
from pictures import faults_of, texts_of
from tables import rows

figures = pytest.importorskip("matplotlib.figure")
colours = pytest.importorskip("matplotlib.colors")

GOLD = op.Interface(0.17 + 3.15j, "70 deg").mueller("in", "reflected")


def changed(place, value):
    numbers = np.diag([1.0, 0.5, 0.5, -0.5])
    numbers[place] = value
    return op.Mueller(numbers)


def digits_of(ax):
    """The text of each cell that has one, by its row and column."""
    cells = {}
    for text in ax.texts:
        column, row = text.get_position()
        cells[int(row), int(column)] = text.get_text().replace("\N{MINUS SIGN}", "-")
    return cells


@rows("scale", [1.0, 0.5])
@rows(
    "matrix",
    [GOLD, changed((1, 2), np.nan), op.Mueller(np.zeros((4, 4))), op.Mueller(1e-300 * np.eye(4))],
)
def test_no_text_is_over_another_or_cut(matrix, scale):
    figure = figures.Figure(figsize=(5.2 * scale, 4.6 * scale), layout="constrained")
    assert faults_of(op.plots.mueller(matrix, figure.add_subplot()).figure) == []


def test_cells_are_over_m00_with_columns_in_and_rows_out():
    ax = op.plots.mueller(op.Polarizer("0 deg").mueller())
    assert ax.get_title() == "M / M00, with M00 = 0.5"
    cells = digits_of(ax)
    assert {place for place, text in cells.items() if text == "1"} == {
        (0, 0),
        (0, 1),
        (1, 0),
        (1, 1),
    }
    assert {text for place, text in cells.items() if max(place) > 1} == {"0"}
    numbers = np.eye(4)
    numbers[0, 3] = 0.25
    ax = op.plots.mueller(op.Mueller(numbers))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("in", "out")
    assert [text.get_text() for text in ax.get_xticklabels()] == ["S0", "S1", "S2", "S3"]
    assert digits_of(ax)[0, 3] == "0.25"


def test_colours_go_apart_from_white_at_zero_on_a_scale_as_wide_as_needed():
    (image,) = op.plots.mueller(GOLD).get_images()
    assert image.get_clim() == (-1.0, 1.0)
    np.testing.assert_allclose(image.cmap(image.norm(0.0))[:3], 1.0, atol=0.04)
    (image,) = op.plots.mueller(changed((1, 1), 3.0)).get_images()
    assert image.get_clim() == (-3.0, 3.0)


def test_digits_are_read_on_every_colour():
    """A contrast of 3 at least, as WCAG 2.1 (1.4.11) asks of what is drawn."""

    def lightness(colour):
        shares = np.array(colours.to_rgb(colour))
        return np.where(shares <= 0.04045, shares / 12.92, ((shares + 0.055) / 1.055) ** 2.4) @ [
            0.2126,
            0.7152,
            0.0722,
        ]

    numbers = np.linspace(-1.0, 1.0, 16).reshape(4, 4)
    numbers[0, 0] = 1.0
    ax = op.plots.mueller(op.Mueller(numbers))
    (image,) = ax.get_images()
    for text in ax.texts:
        column, row = text.get_position()
        ground = image.cmap(image.norm(numbers[int(row), int(column)]))
        pair = sorted((lightness(ground[:3]), lightness(text.get_color())))
        assert (pair[1] + 0.05) / (pair[0] + 0.05) > 3.0


def test_what_is_nan_dark_or_noise_is_told():
    ax = op.plots.mueller(changed((1, 2), np.nan))
    (hatched,) = ax.patches
    assert hatched.get_hatch()
    assert hatched.get_xy() == (1.5, 0.5)
    assert (1, 2) not in digits_of(ax)
    assert "not known (NaN)" in {text.get_text() for text in texts_of(ax.figure)}
    ax = op.plots.mueller(op.Mueller(np.zeros((4, 4))))
    assert len(ax.patches) == 16
    assert "none: M00 is 0, or noise" in {text.get_text() for text in texts_of(ax.figure)}
    cells = digits_of(op.plots.mueller(changed((2, 2), 2e-5)))
    assert cells[2, 2] == "2e-5"
    assert digits_of(op.plots.mueller(changed((2, 2), -3e-17)))[2, 2] == "0"


@rows(
    "matrix, told",
    [
        (op.Mueller(np.zeros((3, 4, 4))), r"a batch of shape \(3,\).*matrix\[0\]"),
        (np.eye(4), r"is no Mueller matrix; give .* op.Mueller\(array\)"),
    ],
)
def test_what_is_not_one_matrix_is_told(matrix, told):
    with pytest.raises(op.OptipathError, match=told):
        op.plots.mueller(matrix)


def test_a_matrix_that_jax_traces_is_refused():
    jax = pytest.importorskip("jax")
    with pytest.raises(op.ParameterError, match="a picture of a Mueller matrix takes numbers"):
        jax.jit(lambda matrix: op.plots.mueller(op.Mueller(matrix)))(np.eye(4))
