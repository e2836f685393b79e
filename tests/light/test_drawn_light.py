import sys

import numpy as np
import pytest

import optipath as op
from tables import rows

figures = pytest.importorskip("matplotlib.figure")

LIGHT = op.Light([1.0, 0.0, 0.6, 0.8])


@rows("kind", ["ellipse", "poincare", "stokes"])
def test_each_kind_is_the_function_of_its_name(kind):
    titles = [drawn.get_title() for drawn in (LIGHT.plot(kind), getattr(op.plots, kind)(LIGHT))]
    assert titles[0] == titles[1]


def test_an_ellipse_is_drawn_into_the_axes_that_are_given():
    ax = figures.Figure().add_subplot()
    assert LIGHT.plot(ax=ax) is ax
    assert ax.get_title().startswith("right-handed elliptical")


def test_options_are_those_of_the_kind():
    batch = op.Light([[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, -1.0]])
    ax = batch.plot("poincare", by=[0.0, 1.0], label="turns")
    assert [each.get_ylabel() for each in ax.figure.axes[1:]] == ["turns"]


@rows(
    "kind, options, told",
    [
        ("elipse", {}, "kind of picture 'elipse' is unknown; did you mean 'ellipse'"),
        ("map", {}, "there are: ellipse, poincare, stokes"),
        (3, {}, "there are: ellipse, poincare, stokes"),
        (
            "stokes",
            {"publish": [1]},
            "stokes option 'publish' is unknown; did you mean 'published'",
        ),
        ("ellipse", {"by": [1]}, "ellipse option 'by' is unknown"),
    ],
)
def test_kinds_and_options_that_are_not_there_are_told(kind, options, told):
    with pytest.raises(op.ParameterError, match=told):
        LIGHT.plot(kind, **options)


def test_a_matrix_draws_itself():
    ax = figures.Figure().add_subplot()
    assert op.Mueller(np.eye(4)).plot(ax) is ax


def test_without_matplotlib_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(vars(op.plots), "ellipse", raising=False)
    with pytest.raises(op.OptipathError, match="matplotlib"):
        LIGHT.plot()
