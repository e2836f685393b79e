"""Grid: the rows and columns of a batch, as a compiled formula goes through them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.known_engines import REGISTRY

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines.array_path import ArrayPath
    from optipath.engines.formulas.formula import Formula
    from optipath.plan.running.batch import Layout
    from optipath.plan.running.pieces import Piece

    Array = np.ndarray[Any, Any]


class Stage(NamedTuple):
    """A formula, compiled."""

    formula: Formula
    path: ArrayPath
    inputs: tuple[tuple[str, str], ...]

    @classmethod
    def of(cls, engine: str, formula: Formula) -> Stage:
        """Return a formula compiled by an engine."""
        inputs = tuple((formula.name_of(s), formula.place_of(s)) for s in formula.inputs)
        return cls(formula, REGISTRY[engine].compiled(formula), inputs)


class Grid:
    """Gives a compiled formula what it needs for each piece of a batch."""

    def __init__(
        self,
        stage: Stage,
        layout: Layout,
        numbers: Mapping[str, Any],
        axes: Mapping[str, frozenset[int]],
        *,
        last: bool,
    ) -> None:
        formula, own = stage.formula, stage.formula.axes
        self.path = stage.path
        shape = layout.shape if last else layout.lengths(own)
        self.batch = layout.batch if last else shape
        self.width = shape[-1] if formula.last is not None else 0
        self.given: list[Any] = []
        self.cells: list[int] = []
        for name, place in stage.inputs:
            number = numbers[name] if name in numbers else formula.constants[name]
            if not isinstance(number, np.ndarray):
                pass
            elif place == "one":
                number = number.item()
            elif place == "cell":
                self.cells.append(len(self.given))
                if number.shape != self.batch:
                    laid = (
                        layout.in_batch(number, axes[name])
                        if last
                        else layout.among(number, axes[name], own)
                    )
                    number = np.broadcast_to(laid, self.batch)
            else:
                number = layout.among(number, axes[name], own)
                if place == "row":
                    number = np.broadcast_to(number, (*shape[:-1], 1))
                number = np.ascontiguousarray(number).reshape(-1)
            self.given.append(number)

    def fill(self, piece: Piece, out: Array) -> bool:
        """Fill a piece of the results; return whether the formula holds for all of it.

        Shape: out (results, paths).
        """
        given, count = list(self.given), piece.stop - piece.start
        for place in self.cells:
            # One number after the other.
            given[place] = np.ascontiguousarray(given[place][piece.where]).reshape(-1)
        if not self.width:
            rows, columns = (0, 1), (0, count)
        elif count < self.width:
            row, first = divmod(piece.start, self.width)
            rows, columns = (row, row + 1), (first, first + count)
        else:
            rows, columns = (piece.start // self.width, piece.stop // self.width), (0, self.width)
        return self.path(rows, columns, given, out, piece.start)
