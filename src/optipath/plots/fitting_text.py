"""Texts of axes that fit into the room that there is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.text import Text

_SPARE = 1.08
"""How far a text may reach beyond what it stands beside."""


def fitting_text(text: Text, texts: Sequence[str], room: float) -> None:
    """Give a text the first of several wordings that is no longer than there is room.

    Parameters
    ----------
    text : Text
        What is drawn, along the horizontal or the vertical.
    texts : sequence of str
        The longest first; the last one is taken where none fits.
    room : float
        In pixels.
    """
    for each in texts:
        text.set_text(each)
        box = text.get_window_extent()
        if max(box.width, box.height) <= room:
            return


def label_axes(ax: Axes, along: Sequence[str], up: Sequence[str]) -> None:
    """Label axes by the longest of several wordings that fit.

    Parameters
    ----------
    ax : Axes
        What is labelled.
    along, up : sequence of str
        What x and y are, the longest first.
    """
    box: Any = ax.get_window_extent()
    fitting_text(ax.xaxis.label, along, _SPARE * box.width)
    fitting_text(ax.yaxis.label, up, _SPARE * box.height)
