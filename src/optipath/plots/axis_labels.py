"""Texts of axes that fit into the room that there is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.ticker import MaxNLocator

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.text import Text


_TICKS = 7, 6, 5, 4, 3, 2
_FILLED = 0.75
"""The share of an axis that its numbers take at most."""


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
    _thin(ax, box.width)
    fitting_text(ax.xaxis.label, along, box.width)
    fitting_text(ax.yaxis.label, up, box.height)


def _thin(ax: Axes, room: float) -> None:
    """Name fewer numbers along x, as long as they would stand one over another."""
    low, high = ax.get_xlim()
    for most in _TICKS:
        within = [
            label.get_window_extent().width
            for place, label in zip(ax.get_xticks(), ax.get_xticklabels(), strict=True)
            if low <= place <= high
        ]
        if sum(within) <= _FILLED * room:
            return
        ax.xaxis.set_major_locator(MaxNLocator(most))
