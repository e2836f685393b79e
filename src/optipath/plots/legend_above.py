"""A legend above curves, within the axes, where no curve goes."""

from __future__ import annotations

from itertools import product
from math import ceil
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

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
    for size, columns in product(_SIZES, range(len(lines), 0, -1)):
        legend = on_top.legend(
            handles=[*lines],
            ncols=columns,
            loc="upper center",
            facecolor="white",
            edgecolor="none",
            framealpha=1.0,
            borderaxespad=0.2,
            columnspacing=1.2,
            handlelength=2.6,
            fontsize=size,
        )
        legend.set_in_layout(False)  # It is within the axes, which need no more room for it.
        box = legend.get_window_extent()
        if box.width <= 0.96 * whole.width and box.height <= _ENOUGH * whole.height:
            break
    line = legend.get_texts()[0].get_window_extent().height
    share = min(1.04 * box.height / whole.height, 0.8)
    for side in sides:
        low, high = side.get_ylim()
        ticks = [tick for tick in side.get_yticks() if low <= tick <= high]
        room = whole.height * (1.0 - share) / max(len(ticks), 1)
        side.set_yticks(ticks[:: ceil(_APART * line / room)])
        side.set_ylim(low, low + (high - low) / (1.0 - share))
