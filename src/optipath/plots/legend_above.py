"""A legend above curves, within the axes, where no curve goes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

_LARGEST = 0.6
"""The share of the axes that a legend takes at most."""


def legend_above(sides: Sequence[Axes], lines: Sequence[Any]) -> None:
    """Draw a legend in a strip at the top, for which the axes are made higher.

    Parameters
    ----------
    sides : sequence of Axes
        The left axis, and that on the right over it if there is one; the ticks stay.
    lines : sequence of Line2D
        With labels.
    """
    on_top = sides[-1]
    figure: Any = on_top.figure
    for columns in range(len(lines), 0, -1):
        legend = on_top.legend(
            handles=[*lines],
            ncols=columns,
            loc="upper center",
            facecolor="white",
            edgecolor="none",
            framealpha=1.0,
            borderaxespad=0.2,
            columnspacing=1.4,
            handlelength=2.6,
            fontsize="small",
        )
        legend.set_in_layout(False)  # It is within the axes, which need no more room for it.
        figure.draw_without_rendering()
        box, whole = legend.get_window_extent(), on_top.get_window_extent()
        if box.width <= whole.width:
            break
    share = min(box.height / whole.height, _LARGEST)
    for side in sides:
        low, high = side.get_ylim()
        ticks = [tick for tick in side.get_yticks() if low <= tick <= high]
        side.set_yticks(ticks)
        side.set_ylim(low, low + (high - low) / (1.0 - share))
