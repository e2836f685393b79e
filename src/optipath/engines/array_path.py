"""What every engine for arrays makes of a formula."""

from __future__ import annotations

from typing import Any, Protocol


class ArrayPath(Protocol):
    """A formula that can be done to arrays.

    Called with a range of paths, what is given in the order of the formula's inputs (a
    number or an array over paths each), an array of shape (results, paths) to be filled, and
    the column for path 0; returns whether the formula holds for all of the range.
    """

    def __call__(self, start: int, stop: int, given: list[Any], out: Any, at: int) -> bool:
        """Fill a range of the results."""
