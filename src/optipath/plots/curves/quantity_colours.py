"""A map in colours of one quantity of light over two axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np

from optipath.plots.axis_labels import fitting_text, label_axes
from optipath.plots.curves.drawn_curves import tell_missing
from optipath.plots.line_colours import INK

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.plots.curves.along_axis import AlongAxis
    from optipath.plots.curves.drawn_quantity import DrawnQuantity

_NONE = "#9c9c9c"
"""Of places where light does not have the quantity; no colour of a scale."""


def draw_map(
    ax: Axes,
    along: AlongAxis,
    up: AlongAxis,
    quantity: DrawnQuantity,
    numbers: npt.NDArray[np.float64],
    *,
    reads: str = "stokes",
) -> None:
    """Draw a map, its colour bar, and a cross where both values are those by default.

    Shape: numbers (along, up).
    """
    columns, rows = np.argsort(along.numbers), np.argsort(up.numbers)
    sorted_numbers = numbers[np.ix_(columns, rows)].T
    scale = quantity.colours(numbers)
    colours = mpl.colormaps[scale.colours].with_extremes(bad=_NONE)
    x, y = along.numbers[columns], up.numbers[rows]
    image: Any = ax.pcolormesh(
        x,
        y,
        np.ma.masked_invalid(sorted_numbers),
        cmap=colours,
        norm=scale.norm,
        shading="nearest",
        rasterized=True,
    )
    # The outer cells reach beyond the values, where there may be none.
    ax.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    bar = scale.bar(image, ax, "")
    label_axes(ax, along.labels, up.labels)
    room = bar.ax.get_window_extent().height
    texts = [quantity.label, quantity.short]
    if np.isnan(numbers).any():
        texts = [f"{text} (grey: none)" for text in texts] + texts[1:]
    fitting_text(bar.ax.yaxis.label, texts, room)
    tell_missing(ax, [(quantity, numbers)], reads)
    _mark_default(ax, along, up)


def _mark_default(ax: Axes, along: AlongAxis, up: AlongAxis) -> None:
    """Mark where both parameters have the values by default, and say which above."""
    if along.default is None or up.default is None:
        return
    for colour, width in (("white", 3.0), (INK, 1.2)):
        ax.plot(
            along.default,
            up.default,
            marker="+",
            markersize=9,
            markeredgewidth=width,
            color=colour,
            clip_on=False,
            linestyle="none",
        )
    told = [f"{each.name} {each.default_text}" for each in (along, up)]
    title = ax.set_title("", fontsize="small", color=INK)
    wordings = [f"+ by default: {', '.join(told)}", f"+ {', '.join(told)}", "+ by default"]
    fitting_text(title, wordings, ax.get_window_extent().width * 1.1)
