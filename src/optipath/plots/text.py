"""Text in pictures: measured, broken into lines, shortened."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from textwrap import fill
from typing import TYPE_CHECKING, Any

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from matplotlib.transforms import ScaledTranslation

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from matplotlib.axes import Axes
    from matplotlib.legend import Legend


_INCH = 72.0
_MEASURE = TextToPath()


def width_of(text: str, points: float) -> float:
    """Return how wide a text is, in inches.

    >>> width_of("iii", 14.0) < width_of("mmm", 14.0) < 1.0
    True
    """
    with missing_letters_as_boxes():
        font = FontProperties(size=points)
        return float(_MEASURE.get_text_width_height_descent(text, font, ismath=False)[0]) / _INCH


def shortened(text: str, inches: float, points: float) -> str:
    """Return a text, or its beginning, so that it is no wider.

    >>> shortened("near the critical angle", 1.0, 14.0)
    'near th…'
    """
    text = " ".join(text.split())
    if width_of(text, points) <= inches:
        return text
    while text and width_of(text + "…", points) > inches:
        text = text[:-1]
    return text.rstrip() + "…"


def broken(words: Iterable[str], inches: float, points: float) -> list[str]:
    """Return lines that are no wider, made of words that stay whole where they fit.

    >>> broken(["grazing,", "n near 0,", "metals"], 1.85, 14.0)
    ['grazing, n near 0,', 'metals']
    """
    lines: list[str] = []
    for word in words:
        fits = lines and width_of(f"{lines[-1]} {word}", points) <= inches
        if fits:
            lines[-1] += f" {word}"
        else:
            lines.append(shortened(word, inches, points))
    return lines


_WIDTH = 0.58
"""Of a letter, of the size of its font, in the middle of texts."""

_LEAST = 10

_NARROW = 3.0
"""In inches."""

_EQUAL = "\u00a0=\u00a0"

_TICKS, _LINE = 20.0, 14.0
"""How much room ticks with their numbers and a line of a label need, in points."""


_SPHERE_LEAVES = 0.08
"""Which share of the height of its axes a sphere leaves free below it."""


def fitting(ax: Axes, text: str, size: str = "small", *, less: int = 0) -> str:
    r"""Return a text in lines that are no wider than some axes.

    >>> from matplotlib.figure import Figure
    >>> fitting(Figure(figsize=(1.5, 1.5)).add_subplot(), "polarised part: 80 % of S0")
    'polarised part:\n80 % of S0'
    """
    letters = (
        72.0 * inches_wide(ax) / (_WIDTH * FontProperties(size=size).get_size_in_points()) - less
    )
    stored = max(_LEAST, int(letters))
    # What is equal stays on one line.
    lines = text.replace(" = ", _EQUAL).split("\n")
    broken = "\n".join(
        fill(line, stored, break_long_words=_EQUAL not in line, break_on_hyphens=False)
        for line in lines
    )
    return broken.replace(_EQUAL, " = ")


def head(ax: Axes, text: str) -> None:
    """Write a title in lines that are no wider than the axes, smaller above small ones."""
    size = "medium" if inches_wide(ax) > _NARROW else "small"
    ax.set_title(fitting(ax, text, size), fontsize=size, parse_math=False)


def inches_wide(ax: Axes) -> float:
    """Return how wide axes are, in inches, before they are laid out.

    >>> from matplotlib.figure import Figure
    >>> round(inches_wide(Figure(figsize=(4.0, 3.0)).add_subplot()), 3)
    3.1
    """
    return float(ax.get_position().width * ax.figure.figure.get_figwidth())


def key_below(ax: Axes, handles: Sequence[Any], size: str = "small") -> None:
    """Draw a legend below some axes, their ticks and their label."""
    if not handles:
        return
    down = _TICKS + _LINE * (1 + ax.get_xlabel().count("\n")) if ax.axison else 0.0
    bottom = 0.0 if ax.axison else _SPHERE_LEAVES
    scale = ax.figure.figure.dpi_scale_trans
    place = ax.transAxes + ScaledTranslation(0.0, -down / 72.0, scale)
    at: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, bottom)}
    _draw_key(ax, handles, fontsize=size, borderaxespad=0.0, bbox_transform=place, **at)


def key_above(ax: Axes, handles: Sequence[Any]) -> None:
    """Draw a legend above some axes, where ticks of many lines are below them."""
    if handles:
        wide = inches_wide(ax) > _NARROW
        size = "small" if wide else "x-small"
        at: dict[str, Any] = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0)}
        for columns in (2, 1) if wide and len(handles) > 1 else (1,):
            legend = _draw_key(ax, handles, fontsize=size, ncols=columns, **at)
            if legend.get_window_extent().width <= inches_wide(ax) * ax.figure.figure.dpi:
                break


def _draw_key(ax: Axes, handles: Sequence[Any], **options: Any) -> Legend:
    """Return a legend of labels as they are, be they begun by "_" or with "$" within."""
    blank = ["-"] * len(handles)
    legend = ax.legend(handles, blank, frameon=False, **options)
    for text, handle in zip(legend.get_texts(), handles, strict=True):
        text.set(text=handle.get_label(), parse_math=False)
    legend.set_zorder(10)
    return legend


@contextmanager
def missing_letters_as_boxes() -> Iterator[None]:
    """Let letters that the font lacks be drawn and measured as boxes, without a warning of each.

    >>> from matplotlib.figure import Figure
    >>> figure = Figure()
    >>> _ = figure.text(0.5, 0.5, "\u5149")
    >>> with missing_letters_as_boxes():
    ...     figure.draw_without_rendering()
    """
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")
        yield
