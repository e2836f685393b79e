"""Axes to draw into: given or new; their labels and legends; saved pictures."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from optipath.errors import OptipathError, shown
from optipath.plots.colors import LINES, positive
from optipath.plots.text import draw_key, missing_letters_as_boxes
from optipath.values.files import input_file, message_of, write_picture

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from matplotlib.text import Text

    Panel: TypeAlias = np.ndarray[Any, Any]


Drawn = TypeVar("Drawn", bound=Axes)


def own_axes(argument: Any, size: tuple[float, float]) -> Axes:
    """Return the axes that are given, or those of a new figure that no window belongs to."""
    if argument is None:
        return own_lines(Figure(figsize=size, layout="constrained").add_subplot())
    if not isinstance(argument, Axes):
        raise OptipathError(f"ax is {shown(argument)}; give Axes of Matplotlib, or leave it out")
    if argument.name != "rectilinear":
        raise OptipathError(
            f"ax has the projection '{argument.name}', and the picture is a flat one; give plain "
            f"Axes, as figure.add_subplot() makes them, or leave it out"
        )
    return argument


def own_panel(argument: Any, shape: tuple[int, int], size: tuple[float, float]) -> Panel:
    """Return the axes that are given, or those of a new figure, row by row."""
    if argument is None:
        panel = Figure(figsize=size, layout="constrained").subplots(*shape, squeeze=False)
        for ax in panel.flat:
            own_lines(ax)
        return panel
    panel = np.array(argument, object)
    flat = all(isinstance(ax, Axes) and ax.name == "rectilinear" for ax in panel.flat)
    if not flat or panel.size != np.prod(shape):
        rows, columns = shape
        raise OptipathError(
            f"axes are {shown(argument)}; give {rows} x {columns} Axes of Matplotlib, as "
            f"figure.subplots({rows}, {columns}) makes them, or leave them out"
        )
    return panel.reshape(shape)


def own_lines(ax: Drawn) -> Drawn:
    """Return axes whose lines are solid by default, whatever Matplotlib's settings are."""
    ax.set_prop_cycle(color=LINES)
    return ax


def fitting_text(text: Text, texts: Sequence[str], room: float) -> None:
    """Give a text the first of several wordings that is no longer than there is room."""
    for each in texts:
        text.set_text(each)
        box = text.get_window_extent()
        if max(box.width, box.height) <= room:
            return


def label_axes(ax: Axes, along: Sequence[str], up: Sequence[str]) -> None:
    """Label axes by the longest of several wordings that fit."""
    ax.set(xlabel=along[-1], ylabel=up[-1])
    figure: Any = ax.figure
    figure.draw_without_rendering()  # By which axes have the places of their layout.
    box = ax.get_window_extent()
    fitting_text(ax.xaxis.label, along, box.width)
    fitting_text(ax.yaxis.label, up, box.height)


_APART = 1.6
"""How far ticks are apart at least, of the height of a line of the legend."""

_SIZES = 8.5, 7.5, 6.5, 5.5
"""Of letters in points, from which the first is taken that leaves curves enough room."""

_ENOUGH = 0.36
"""The share of the axes that a legend takes at most, if a smaller one can help it."""


def legend_above(sides: Sequence[Axes], lines: Sequence[Any]) -> None:
    """Draw a legend in a strip at the top, for which the axes are made higher."""
    on_top = sides[-1]
    figure: Any = on_top.figure
    figure.draw_without_rendering()  # By which axes have the places of their layout.
    whole = on_top.get_window_extent()
    looks: dict[str, Any] = {"loc": "upper center", "borderaxespad": 0.2, "columnspacing": 1.2}
    looks["handlelength"] = 2.6
    looks |= {"frameon": True, "facecolor": "white", "edgecolor": "none", "framealpha": 1.0}
    for size in _SIZES:
        legend = draw_key(on_top, lines, len(lines), math=True, fontsize=size, **looks)
        legend.set_in_layout(False)  # It is within the axes, which need no more room for it.
        box = legend.get_window_extent()
        if box.width <= whole.width and box.height <= _ENOUGH * whole.height:
            break
    line = legend.get_texts()[0].get_window_extent().height
    share = min(1.04 * box.height / whole.height, 0.8)
    for side in sides:
        low, high = side.get_ylim()
        ticks = [tick for tick in side.get_yticks() if low <= tick <= high]
        room = whole.height * (1.0 - share) / max(len(ticks), 1)
        side.set_yticks(ticks[:: ceil(_APART * line / room)])
        side.set_ylim(low, low + (high - low) / (1.0 - share))


def save(drawn: Any, file: str | os.PathLike[str], dots_per_inch: float = 150.0) -> None:
    """Save a picture in a file whose ending says the form: ``.png``, ``.svg`` or ``.pdf``.

    Texts of ``.svg`` and ``.pdf`` are texts, which can be searched; a file is there whole or not
    at all, and that of a picture which is drawn anew has the same bits.

    Parameters
    ----------
    drawn : Axes, array_like of Axes, or Figure
        What a function of `optipath.plots` returned.
    file : str or path
        Where; what is there is replaced.
    dots_per_inch : float, optional
        Of ``.png``, and of the pixels of maps in the other forms.

    Raises
    ------
    OptipathError
        If nothing was drawn, nothing can be drawn in the form that the ending says, or the file
        cannot be written.
    """
    first = np.array(drawn, object).ravel()[:1]
    if not (first.size and isinstance(first[0], Axes | Figure)):
        raise OptipathError(f"{shown(drawn)} is no picture; give what a function of plots returned")
    if faults := positive("dots_per_inch", dots_per_inch):
        raise OptipathError(*faults)
    figure: Any = first[0].figure.figure if isinstance(first[0], Axes) else first[0]
    place = input_file(file, OptipathError)
    with message_of(place, OptipathError), missing_letters_as_boxes():
        write_picture(figure, place, dots_per_inch)
