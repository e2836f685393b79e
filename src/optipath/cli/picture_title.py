"""The title of a picture: lines that break between values and are no wider than the picture."""

from __future__ import annotations

from bisect import bisect
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_POINTS, _LINE, _FILLED = 12.0, 0.26, 0.95
"""The size of letters, how many inches a line takes, and the share of the width it fills."""


def draw_title(figure: Figure, title: str) -> None:
    """Write a title above a picture, which becomes so much higher."""
    lines = _lines(title, _FILLED * figure.get_figwidth())
    figure.set_figheight(figure.get_figheight() + _LINE * len(lines))
    figure.suptitle("\n".join(lines), fontsize=_POINTS, parse_math=False)


def _lines(title: str, inches: float) -> list[str]:
    """Return lines that hold each name with its value, unless these alone are wider."""
    from optipath.plots.text_width import broken, width_of  # noqa: PLC0415 - an extra

    *parts, last = title.split(", ")
    words: list[str] = []
    for part in [*(f"{part}," for part in parts), last]:
        rest = part
        while width_of(rest, _POINTS) > inches:
            fits = _count(rest, inches)
            words, rest = [*words, rest[:fits]], rest[fits:]
        words.append(rest)
    return broken(words, inches, _POINTS)


def _count(text: str, inches: float) -> int:
    """Return how many letters of a text that is too wide fit into a line, one at least."""
    from optipath.plots.text_width import width_of  # noqa: PLC0415 - an extra

    cuts = range(1, len(text))
    return max(1, bisect(cuts, inches, key=lambda cut: width_of(text[:cut], _POINTS)))
