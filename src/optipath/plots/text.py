"""Text in pictures: measured, broken into lines, shortened."""

from __future__ import annotations

import warnings
from bisect import bisect
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from matplotlib.transforms import ScaledTranslation

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from matplotlib.axes import Axes
    from matplotlib.legend import Legend


_MEASURE = TextToPath()
_NARROW = 3.0
"""In inches, up to which axes have smaller texts."""

_LEAST = 1.1
"""How many inches lines are wide at least."""

_EQUAL = "\u00a0=\u00a0"


def width_of(text: str, points: float) -> float:
    """Return how wide a text is, in inches.

    >>> width_of("iii", 14.0) < width_of("mmm", 14.0) < 1.0
    True
    """
    with missing_letters_as_boxes():
        font = FontProperties(size=points)
        return float(_MEASURE.get_text_width_height_descent(text, font, ismath=False)[0]) / 72.0


def _count(text: str, inches: float, points: float) -> int:
    """Return how many letters of a text fit into a line."""
    cuts = range(1, len(text) + 1)
    return bisect(cuts, inches, key=lambda cut: width_of(text[:cut], points))


def shortened(text: str, inches: float, points: float) -> str:
    """Return a text, or its beginning, so that it is no wider.

    >>> shortened("near the critical angle", 1.0, 14.0)
    'near th…'
    """
    text = " ".join(text.split())
    if width_of(text, points) <= inches:
        return text
    return text[: _count(text, inches - width_of("…", points), points)].rstrip() + "…"


def broken(words: Iterable[str], inches: float, points: float) -> list[str]:
    """Return lines that are no wider, made of words that stay whole where they fit.

    >>> broken(["grazing,", "n near 0,", "metals"], 1.85, 14.0)
    ['grazing, n near 0,', 'metals']
    """
    lines: list[str] = []
    words = [*words]
    if words and width_of(whole := " ".join(words), points) <= inches:  # Which most are.
        return [whole]
    for word in words:
        if lines and width_of(f"{lines[-1]} {word}", points) <= inches:
            lines[-1] += f" {word}"
            continue
        rest = word
        while width_of(rest, points) > inches:
            fits = max(_count(rest, inches, points), 1)
            lines.append(rest[:fits])
            rest = rest[fits:]
        lines.append(rest)
    return lines


def fitting(ax: Axes, text: str, size: str = "small", *, less: float = 0.0) -> str:
    r"""Return a text in lines that are no wider than some axes, less some widths of a letter.

    >>> from matplotlib.figure import Figure
    >>> fitting(Figure(figsize=(1.7, 1.5)).add_subplot(), "polarised part: 80 % of S0")
    'polarised part: 80 %\nof S0'
    """
    points = FontProperties(size=size).get_size_in_points()
    inches = max(inches_wide(ax) - less * points / 120.0, _LEAST)
    # What is equal stays on one line.
    lines = text.replace(" = ", _EQUAL).split("\n")
    fitted = [each for line in lines for each in broken(line.split(" "), inches, points)]
    return "\n".join(fitted).replace(_EQUAL, " = ")


def is_wide(ax: Axes) -> bool:
    """Return whether axes are so wide that texts are not smaller than usual."""
    return inches_wide(ax) > _NARROW


def head(ax: Axes, text: str) -> None:
    """Write a title in lines that are no wider than the axes, smaller above small ones."""
    size = "medium" if is_wide(ax) else "small"
    ax.set_title(fitting(ax, text, size), fontsize=size, parse_math=False)


def inches_wide(ax: Axes) -> float:
    """Return how wide axes are, in inches, before they are laid out.

    >>> from matplotlib.figure import Figure
    >>> round(inches_wide(Figure(figsize=(4.0, 3.0)).add_subplot()), 3)
    3.1
    """
    return float(ax.get_position().width * ax.figure.figure.get_figwidth())


def key_below(ax: Axes, handles: Sequence[Any], size: str = "small") -> None:
    """Draw a legend below some axes, their ticks and their label; a sphere leaves room itself."""
    if not handles:
        return
    down = 20.0 + 14.0 * (1 + ax.get_xlabel().count("\n")) if ax.axison else 0.0
    scale = ax.figure.figure.dpi_scale_trans
    place = ax.transAxes + ScaledTranslation(0.0, -down / 72.0, scale)
    at: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0 if down else 0.08)}
    draw_key(ax, handles, 1, fontsize=size, borderaxespad=0.0, bbox_transform=place, **at)


def draw_key(
    ax: Axes, handles: Sequence[Any], columns: int, *, math: bool = False, **options: Any
) -> Legend:
    """Return a legend in as many columns as fit, of labels as they are, with "_" or "$" within."""
    options = {"frameon": False, **options}
    room = inches_wide(ax) * ax.figure.figure.dpi
    for count in range(columns, 0, -1):
        legend = ax.legend(handles, ["-"] * len(handles), ncols=count, **options)
        for text, handle in zip(legend.get_texts(), handles, strict=True):
            text.set(text=handle.get_label(), parse_math=math)
        if legend.get_window_extent().width <= room:
            break
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
