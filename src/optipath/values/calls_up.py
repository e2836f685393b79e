"""Where a warning is of: the line of whoever called the library."""

from __future__ import annotations

import sys
from typing import Any

_PASSED = ("optipath", "dataclasses", "functools")


def calls_up() -> int:
    """Return how many calls up from the one that warns the library was called."""
    level = 2
    frame: Any = sys._getframe(level)  # noqa: SLF001 - as warnings itself looks
    while frame.f_back is not None and (
        frame.f_globals.get("__name__", "").partition(".")[0] in _PASSED
        # The makers of dataclasses and own elements are made of texts.
        or frame.f_code.co_filename.startswith("<")
    ):
        frame, level = frame.f_back, level + 1
    return level
