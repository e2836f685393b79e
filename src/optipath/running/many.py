"""Many paths: a formula filled in piece by piece, with more care where it does not hold."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.formulas import Symbol
from optipath.precision import wide
from optipath.running.pieces import pieces

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.engines import ArrayPath
    from optipath.formulas import Formula
    from optipath.program import Program
    from optipath.running.given import Given
    from optipath.running.pieces import Piece

    Rows = np.ndarray[Any, Any]

_AT_ONCE = 1 << 16
"""How many paths are done before it is looked whether the formula holds for them."""


class Many:
    """Does a compiled formula to batches of any shape.

    Parameters
    ----------
    program : Program
        Where the arrays are that are known beforehand.
    formula : Formula
        What is done.
    path : ArrayPath
        The formula, compiled.
    threads : int
        How many threads share a batch of several pieces.
    read : int
        How many of the results are always read; exponents of 0 are not.
    """

    def __init__(
        self, program: Program, formula: Formula, path: ArrayPath, *, threads: int, read: int
    ) -> None:
        self.formula = formula
        self.path = path
        self.threads = threads
        self.read = read
        kind = formula.dtype
        self._known = {
            f".{place}": view.present()
            if view.part == "present"
            else view.numbers({}, wide(kind)).astype(kind)
            for place, view in enumerate(program.leaves)
            if view.known and any(s.operands == (f".{place}",) for s in formula.inputs)
        }

    @property
    def has_exponents(self) -> bool:
        """Whether light comes with exponents that are not known."""
        return any(isinstance(result, Symbol) for result in self.formula.results[self.read :])

    def results(
        self, given: Given, refused: Callable[[], object], careful: Callable[[Given], Rows]
    ) -> tuple[Rows, bool]:
        """Return the results, shape (results, paths), and whether care was needed.

        Parameters
        ----------
        given : Given
            The numbers.
        refused : callable
            Called once where the formula does not hold; it raises if that is because of
            what is given.
        careful : callable
            Gives the results for a part of what is given, where the formula does not hold.
        """
        formula = self.formula
        # Exponents that are known to be 0 are asked for only where light is too faint.
        rows = len(formula.results) if self.has_exponents else self.read
        computed = [r for r in range(rows) if isinstance(formula.results[r], Symbol)]
        out = np.empty((len(computed), given.paths), formula.dtype)
        numbers = {str(raw): number for raw, number in given.numbers.items()}
        numbers |= formula.constants
        numbers |= {name: given.cut(array) for name, array in self._known.items()}
        arrays = [numbers[symbol.operands[0]] for symbol in formula.inputs]
        failed = list(self._failures(arrays, given.batch, out))
        found: list[Any] = list(formula.results)
        for row, place in enumerate(computed):
            found[place] = out[row]
        if failed:
            refused()
            found = [np.array(np.broadcast_to(r, given.paths), formula.dtype) for r in found]
        for piece in failed:
            for row, result in zip(found, careful(given.part(piece.where)), strict=True):
                row[piece.start : piece.stop] = result
        return found, bool(failed)

    def _failures(self, arrays: list[Any], batch: tuple[int, ...], out: Rows) -> Iterator[Piece]:
        """Fill the results; yield the pieces for which the formula does not hold."""
        lying = all(
            n.shape == batch and n.flags.c_contiguous for n in arrays if isinstance(n, np.ndarray)
        )
        if lying:
            flat = [n.reshape(-1) if isinstance(n, np.ndarray) else n for n in arrays]

        def holds(piece: Piece) -> bool:
            if lying:
                return self.path(piece.start, piece.stop, flat, out, 0)
            cut = [
                np.ascontiguousarray(np.broadcast_to(n, batch)[piece.where]).reshape(-1)
                if isinstance(n, np.ndarray)
                else n
                for n in arrays
            ]
            return self.path(0, piece.stop - piece.start, cut, out, piece.start)

        parts = pieces(batch, _AT_ONCE)
        if self.threads == 1:
            return (piece for piece in parts if not holds(piece))
        return self._shared(list(parts), holds)

    def _shared(self, parts: list[Piece], holds: Callable[[Piece], bool]) -> Iterator[Piece]:
        with ThreadPoolExecutor(self.threads) as pool:
            for piece, held in zip(parts, pool.map(holds, parts), strict=True):
                if not held:
                    yield piece
