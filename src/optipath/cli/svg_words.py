"""Texts of a drawing, whose widths are known whatever typeface a viewer has."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from xml.etree.ElementTree import SubElement

from rich.cells import cell_len, chop_cells

from optipath.errors import printable

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

FACE = "ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, 'Liberation Mono', monospace"
"""Typefaces whose letters have one width."""

_CELL = 0.6  # The width of a letter, as a part of its height.
_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def text_width(text: str, size: float) -> float:
    """Return how wide a text is drawn."""
    return cell_len(text) * _CELL * size


def add_text(parent: Element, text: str, x: float, y: float, size: float, kind: str) -> None:
    """Add a text of one line, stretched or squeezed to the width that is reckoned with."""
    if not text:
        return
    SubElement(
        parent,
        "text",
        {
            "x": f"{x:g}",
            "y": f"{y:g}",
            "class": kind,
            "font-size": f"{size:g}",
            "textLength": f"{text_width(text, size):g}",
            "lengthAdjust": "spacingAndGlyphs",
        },
    ).text = text


def drawable(text: str) -> str:
    r"""Return a text on one line, with the codes of characters that XML has no place for.

    Examples
    --------
    >>> print(drawable("a\n b"))
    a b
    """
    tame = printable(" ".join(text.split()))
    return _NO_XML.sub(lambda found: f"U+{ord(found[0]):04X}", tame)


def lines_of(text: str, cells: int) -> list[str]:
    """Return a text in lines of at most so many cells; words that are longer are broken.

    Examples
    --------
    >>> lines_of("a polariser of reflected light", 12)
    ['a polariser', 'of reflected', 'light']
    """
    lines: list[str] = []
    for word in drawable(text).split():
        joined = f"{lines[-1]} {word}" if lines else word
        if lines and cell_len(joined) <= cells:
            lines[-1] = joined
        else:
            lines += chop_cells(word, cells)
    return lines
