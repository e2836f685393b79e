"""Axes to draw into: those that are given, or those of a figure of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from optipath.errors import OptipathError, shown
from optipath.plots.line_colours import LINES

if TYPE_CHECKING:
    Panel: TypeAlias = np.ndarray[Any, Any]

Drawn = TypeVar("Drawn", bound=Axes)


def own_axes(given: Any, size: tuple[float, float]) -> Axes:
    """Return the axes that are given, or those of a new figure that no window belongs to."""
    if given is None:
        return own_lines(Figure(figsize=size, layout="constrained").add_subplot())
    if not isinstance(given, Axes):
        raise OptipathError(f"ax is {shown(given)}; give Axes of Matplotlib, or leave it out")
    if not _is_flat(given):
        raise OptipathError(
            f"ax has the projection '{given.name}', and the picture is a flat one; give plain "
            f"Axes, as figure.add_subplot() makes them, or leave it out"
        )
    return given


def own_panel(given: Any, shape: tuple[int, int], size: tuple[float, float]) -> Panel:
    """Return the axes that are given, or those of a new figure, row by row."""
    if given is None:
        panel = Figure(figsize=size, layout="constrained").subplots(*shape, squeeze=False)
        for ax in panel.flat:
            own_lines(ax)
        return panel
    panel = np.array(given, object)
    if panel.size != shape[0] * shape[1] or not all(map(_is_flat, panel.flat)):
        rows, columns = shape
        raise OptipathError(
            f"axes are {shown(given)}; give {rows} x {columns} Axes of Matplotlib, as "
            f"figure.subplots({rows}, {columns}) makes them, or leave them out"
        )
    return panel.reshape(shape)


def own_lines(ax: Drawn) -> Drawn:
    """Return axes whose lines are solid by default, whatever Matplotlib's settings are."""
    ax.set_prop_cycle(color=LINES)
    return ax


def _is_flat(ax: Any) -> bool:
    return isinstance(ax, Axes) and ax.name == "rectilinear"
