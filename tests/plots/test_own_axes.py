"""Axes to draw into."""

import matplotlib as mpl
import numpy as np
import pytest
from cycler import cycler
from matplotlib import figure as figures

import optipath as op
from optipath.plots import own_axes
from optipath.plots.own_axes import own_panel
from optipath.plots.states.poincare_sphere import sphere_axes
from tables import rows

LIGHT = op.Light([1.0, 0.6, 0.0, 0.8])
DRAWN = {
    "curve": lambda ax: op.plots.curve(op.load_preset("malus"), "angle", ax=ax),
    "map": lambda ax: op.plots.quantity_map(
        op.load_preset("malus"), "angle", "intensity", ax=ax, x_values=[0, 1], y_values=[0, 1]
    ),
    "reflection": lambda ax: op.plots.reflection(1.5, ax),
    "energy": lambda ax: op.plots.energy(op.load_preset("malus"), ax),
    "stokes": lambda ax: op.plots.stokes(LIGHT, ax),
    "ellipse": lambda ax: op.plots.ellipse(LIGHT, ax),
    "bench": lambda ax: op.plots.bench(op.load_preset("malus"), ax),
}


@rows("projection", ["3d", "polar"])
@rows("draw", DRAWN.values())
def test_a_flat_picture_refuses_axes_in_space_and_of_angles_and_leaves_them_empty(draw, projection):
    ax = figures.Figure().add_subplot(projection=projection)
    with pytest.raises(op.OptipathError, match=f"the projection '{projection}'.*give plain Axes"):
        draw(ax)
    assert not [*ax.lines, *ax.patches, *ax.collections]


def test_a_panel_with_axes_in_space_is_refused():
    figure = figures.Figure()
    panel = [figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="3d")]
    with pytest.raises(op.OptipathError, match="give 1 x 2 Axes of Matplotlib"):
        own_axes.own_panel(panel, (1, 2), (1.0, 1.0))
    assert np.shape(own_axes.own_panel(panel[:1], (1, 1), (1.0, 1.0))) == (1, 1)


SIZE = (3.0, 3.0)


@rows(
    "made",
    [
        lambda: own_axes.own_axes(None, SIZE),
        lambda: own_panel(None, (1, 2), SIZE)[0, 1],
        lambda: sphere_axes(None, SIZE),
    ],
)
def test_lines_are_solid_where_matplotlib_is_told_to_dash_them(made):
    with mpl.rc_context({"axes.prop_cycle": cycler(color=["k"], linestyle=[":"])}):
        (line,) = made().plot([0, 1], [0, 1], color="r")
    assert line.get_linestyle() == "-"
