"""What every engine for arrays makes of a formula."""

from __future__ import annotations

from typing import Any, Protocol


class ArrayPath(Protocol):
    """A formula that can be done to arrays.

    Called with a range of rows and of columns; what is given in the order of the formula's
    inputs, each a number or an array along one axis: of all rows, of all columns, or of the
    cells of the range (`Formula.place_of`); an array of shape (results, paths) to be filled;
    and the column of it for the first cell. Returns whether the formula holds for all of the
    range. Where the formula has no inner loop of its own, there is one row.
    """

    def __call__(
        self, rows: tuple[int, int], columns: tuple[int, int], given: list[Any], out: Any, at: int
    ) -> bool:
        """Fill a range of the results."""
