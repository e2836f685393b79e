"""Grid: the rows and columns of a batch, as a compiled formula goes through them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines import ArrayPath
    from optipath.engines.formulas import Formula
    from optipath.plan.running.pieces import Piece

    Array = np.ndarray[Any, Any]


class Grid:
    """Gives a compiled formula what it needs for each piece of a batch.

    Parameters
    ----------
    formula : Formula
        What is done.
    path : ArrayPath
        The formula, compiled.
    shape : tuple of int
        The lengths of the axes that the formula knows.
    across : mapping of str to ndarray
        The arrays, with an axis for each of these.
    batch : tuple of int
        The shape that pieces are parts of.
    cells : mapping of str to ndarray
        The arrays, with an axis for each of the batch.
    numbers : mapping of str to float
        What is not an array.
    """

    def __init__(
        self,
        formula: Formula,
        path: ArrayPath,
        shape: tuple[int, ...],
        across: Mapping[str, Array],
        batch: tuple[int, ...],
        cells: Mapping[str, Array],
        numbers: Mapping[str, Any],
    ) -> None:
        self.path = path
        self.batch = batch
        self.width = shape[-1] if formula.last is not None else 0
        self.given: list[Any] = []
        self.cells: list[tuple[int, Array]] = []
        for symbol in formula.inputs:
            name, place = formula.name_of(symbol), formula.place_of(symbol)
            if place == "one":
                array = across.get(name)
                self.given.append(numbers[name] if array is None else array.item())
            elif place == "row":
                rows = np.broadcast_to(across[name], (*shape[:-1], 1))
                self.given.append(np.ascontiguousarray(rows).reshape(-1))
            elif place == "column":
                self.given.append(np.ascontiguousarray(across[name]).reshape(-1))
            else:
                self.cells.append((len(self.given), cells[name]))
                self.given.append(None)

    def fill(self, piece: Piece, out: Array) -> bool:
        """Fill a piece of the results; return whether the formula holds for all of it."""
        given, count = list(self.given), piece.stop - piece.start
        for place, array in self.cells:
            given[place] = self._cut(array, piece)
        if not self.width:
            rows, columns = (0, 1), (0, count)
        elif count < self.width:
            row, first = divmod(piece.start, self.width)
            rows, columns = (row, row + 1), (first, first + count)
        else:
            rows, columns = (piece.start // self.width, piece.stop // self.width), (0, self.width)
        return self.path(rows, columns, given, out, piece.start)

    def _cut(self, array: Array, piece: Piece) -> Array:
        """Return the numbers of a piece, one after the other."""
        whole = array if array.shape == self.batch else np.broadcast_to(array, self.batch)
        return np.ascontiguousarray(whole[piece.where]).reshape(-1)
