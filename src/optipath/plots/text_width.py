"""Texts that fit: as wide as they are drawn, broken into lines, shortened."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath

from optipath.plots.missing_letters import missing_letters_as_boxes

if TYPE_CHECKING:
    from collections.abc import Iterable

_INCH = 72.0
_MEASURE = TextToPath()


def width_of(text: str, points: float) -> float:
    """Return how wide a text is, in inches.

    Examples
    --------
    >>> width_of("iii", 14.0) < width_of("mmm", 14.0) < 1.0
    True
    """
    with missing_letters_as_boxes():
        font = FontProperties(size=points)
        return float(_MEASURE.get_text_width_height_descent(text, font, ismath=False)[0]) / _INCH


def shortened(text: str, inches: float, points: float) -> str:
    """Return a text, or its beginning, so that it is no wider.

    Examples
    --------
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

    Examples
    --------
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
