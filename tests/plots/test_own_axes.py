"""Axes of a figure of their own."""

import matplotlib as mpl
import pytest
from cycler import cycler

from optipath.plots.own_axes import own_axes, own_panel
from optipath.plots.states.poincare_sphere import sphere_axes

SIZE = (3.0, 3.0)


@pytest.mark.parametrize(
    "made",
    [
        lambda: own_axes(None, SIZE),
        lambda: own_panel(None, (1, 2), SIZE)[0, 1],
        lambda: sphere_axes(None, SIZE),
    ],
)
def test_lines_are_solid_where_matplotlib_is_told_to_dash_them(made):
    with mpl.rc_context({"axes.prop_cycle": cycler(color=["k"], linestyle=[":"])}):
        (line,) = made().plot([0, 1], [0, 1], color="r")
    assert line.get_linestyle() == "-"
