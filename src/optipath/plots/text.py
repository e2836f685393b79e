"""Text in pictures: measured, broken into lines; titles and legends."""

from __future__ import annotations

import re
import warnings
from bisect import bisect
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from matplotlib.transforms import ScaledTranslation

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from matplotlib.axes import Axes
    from matplotlib.legend import Legend


_MEASURE = TextToPath()
_NARROW = 3.0
"""In inches, up to which axes have smaller texts."""

_LEAST = 1.1
"""How many inches lines are wide at least."""


def width_of(text: str, points: float) -> float:
    """Return how wide a text is, in inches."""
    with missing_letters_as_boxes():
        font = FontProperties(size=points)
        return float(_MEASURE.get_text_width_height_descent(text, font, ismath=False)[0]) / 72.0


def broken(text: str, inches: float, points: float) -> str:
    r"""Return a text in lines that are no wider; what is equal stays on one, if it fits.

    >>> broken("grazing, n = 0, metals", 1.85, 14.0)
    'grazing, n = 0,\nmetals'
    """
    lines: list[str] = []
    for paragraph in text.split("\n"):
        lines.append("")
        for word in re.split("(?<!=) (?!=)", paragraph):
            joined = f"{lines[-1]} {word}".lstrip(" ")
            if lines[-1] and width_of(joined, points) > inches:
                lines.append(joined := word)
            while width_of(joined, points) > inches:
                cuts = range(1, len(joined))
                fits = bisect(cuts, inches, key=lambda cut: width_of(joined[:cut], points)) or 1
                lines[-1:] = joined[:fits], joined[fits:]
                joined = lines[-1]
            lines[-1] = joined
    return "\n".join(lines)


def fitting(
    ax: Axes, text: str, size: str = "small", *, less: float = 0.0, upright: bool = False
) -> str:
    r"""Return a text in lines no wider than some axes (or high), less some widths of a letter.

    >>> from matplotlib.figure import Figure
    >>> fitting(Figure(figsize=(1.7, 1.5)).add_subplot(), "polarised part: 80 % of S0")
    'polarised part: 80 %\nof S0'
    """
    points = FontProperties(size=size).get_size_in_points()
    room = inches_of(ax)[int(upright)] - less * points / 120.0
    return broken(text, max(room, _LEAST), points)


def inches_of(ax: Axes) -> tuple[float, float]:
    """Return how wide and high axes are, in inches, before they are laid out."""
    place, (width, height) = ax.get_position(), ax.figure.figure.get_size_inches()
    return float(place.width * width), float(place.height * height)


def is_wide(ax: Axes) -> bool:
    """Return whether axes are so wide that texts are not smaller than usual."""
    return inches_of(ax)[0] > _NARROW


def head(ax: Axes, text: str) -> None:
    """Write a title in lines that are no wider than the axes, smaller above small ones."""
    size = "medium" if is_wide(ax) else "small"
    ax.set_title(fitting(ax, text, size), fontsize=size, parse_math=False)


def label_axes(ax: Axes, along: str, up: str) -> None:
    """Label axes, in lines that are no longer than they are."""
    ax.set(xlabel=fitting(ax, along, "medium"), ylabel=fitting(ax, up, "medium", upright=True))


def key_below(ax: Axes, handles: Sequence[Any], size: str = "small") -> None:
    """Draw a legend below some axes, their ticks and their label; round ones leave room."""
    if not handles:
        return
    down = 20.0 + 14.0 * (1 + ax.get_xlabel().count("\n")) if ax.axison else 0.0
    scale = ax.figure.figure.dpi_scale_trans
    place = ax.transAxes + ScaledTranslation(0.0, -down / 72.0, scale)
    edge = 0.0 if down else 0.08 if ax.name == "3d" else 0.04
    at: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, edge)}
    draw_key(ax, handles, 1, fontsize=size, borderaxespad=0.0, bbox_transform=place, **at)


def key_within(sides: Sequence[Axes], handles: Sequence[Any]) -> None:
    """Draw a legend in a strip at the top of axes, whose limits make room for it."""
    on_top = sides[-1]
    figure: Any = on_top.figure.figure
    figure.draw_without_rendering()  # By which axes have the places of their layout.
    looks: dict[str, Any] = {"fontsize": "small" if is_wide(on_top) else "xx-small"}
    looks |= {"loc": "upper center", "borderaxespad": 0.2, "columnspacing": 1.2}
    looks |= {"frameon": True, "facecolor": "white", "edgecolor": "none", "framealpha": 1.0}
    legend = draw_key(on_top, handles, len(handles), math=True, **looks)
    legend.set_in_layout(False)  # It is within the axes, which need no more room for it.
    whole = on_top.get_window_extent()
    share = min(1.04 * legend.get_window_extent().height / whole.height, 0.8)
    for side in sides:
        low, high = side.get_ylim()
        side.set_ylim(low, low + (high - low) / (1.0 - share))
        side.set_yticks([tick for tick in side.get_yticks() if low <= tick <= high])


def draw_key(
    where: Axes | Figure, handles: Sequence[Any], most: int, *, math: bool = False, **options: Any
) -> Legend:
    """Return a legend in as many columns as fit, of labels as they are, with "_" or "$" within."""
    wide = where.get_figwidth() if isinstance(where, Figure) else inches_of(where)[0]
    for count in range(most, 0, -1):
        legend = where.legend(
            handles, ["-"] * len(handles), **{"frameon": False, **options}, ncols=count
        )
        for text, handle in zip(legend.get_texts(), handles, strict=True):
            text.set(text=handle.get_label(), parse_math=math)
        if count == 1 or legend.get_window_extent().width <= wide * where.figure.figure.dpi:
            break
        legend.remove()
    legend.set_zorder(10)
    return legend


@contextmanager
def missing_letters_as_boxes() -> Iterator[None]:
    """Let letters that the font lacks be drawn and measured as boxes, without a warning of each."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")
        yield
