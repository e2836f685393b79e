"""A line that shows how many blocks of a sweep are done."""

from __future__ import annotations

import sys

_WIDTH = 40


def progress_line(done: int, total: int) -> None:
    """Write over the last line of the terminal how far a sweep is.

    Examples
    --------
    >>> from contextlib import redirect_stderr
    >>> with redirect_stderr(sys.stdout):
    ...     progress_line(4, 4)
    [########################################] 4 of 4 blocks
    """
    filled = _WIDTH * done // total
    if done and filled == _WIDTH * (done - 1) // total:
        return  # It looks the same.
    bar = f"[{'#' * filled}{' ' * (_WIDTH - filled)}] {done} of {total} blocks"
    sys.stderr.write(f"{bar}\n" if done == total else f"{bar}\r")
    sys.stderr.flush()
