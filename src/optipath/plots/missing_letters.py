"""Letters that the font lacks, of names in any script."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def missing_letters_as_boxes() -> Iterator[None]:
    """Let letters that the font lacks be drawn and measured as boxes, without a warning of each.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> figure = Figure()
    >>> _ = figure.text(0.5, 0.5, "\u5149")
    >>> with missing_letters_as_boxes():
    ...     figure.draw_without_rendering()
    """
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")
        yield
