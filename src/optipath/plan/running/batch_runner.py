"""Many paths: a formula filled in piece by piece, with more care where it does not hold."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.formulas import Symbol, stages
from optipath.plan.running.grid import Grid
from optipath.plan.running.pieces import pieces
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from optipath.engines import ArrayPath
    from optipath.engines.formulas import Formula
    from optipath.engines.program.program import Program
    from optipath.plan.running.batch import Layout
    from optipath.plan.running.pieces import Piece
    from optipath.plan.running.reading import ResolvedInputs

    Array = np.ndarray[Any, Any]

_AT_ONCE = 1 << 16
"""How many paths are done before it is looked whether the formula holds for them."""


class Results(NamedTuple):
    """What a formula has come to: for each result a number, or an array over paths.

    Attributes
    ----------
    each : list
        The results.
    out : ndarray, shape (rows, paths)
        Where the last of them were written.
    rows : list of int or None
        In which row of it each result stands, if it does.
    """

    each: list[Any]
    out: Array
    rows: list[int | None]

    def together(self, start: int, stop: int) -> Array | None:
        """Return some results as rows of one array, if they stand there one after the other."""
        first = self.rows[start]
        if first is None or self.rows[start:stop] != list(range(first, first + stop - start)):
            return None
        return self.out[first : first + stop - start]


class _Stage(NamedTuple):
    formula: Formula
    path: ArrayPath


class BatchRunner:
    """Does a formula to batches of any shape whose arrays differ along the same axes.

    Parameters
    ----------
    formula : Formula
        What is done.
    compiled : callable
        Compiles a formula.
    layout : Layout
        The axes of a batch, its own or one like it.
    threads : int
        How many threads share a batch of several pieces.
    read : int
        How many of the results are always read; exponents of 0 are not.
    staged : bool
        Whether what differs along a few axes only is computed along these alone.
    """

    def __init__(
        self,
        formula: Formula,
        compiled: Callable[[Formula], ArrayPath],
        layout: Layout,
        *,
        threads: int,
        read: int,
        staged: bool,
    ) -> None:
        self.formula = formula
        self.compiled = compiled
        self.threads = threads
        self.read = read
        parts = stages(formula, layout.all_axes, layout.last) if staged else (formula,)
        self._stages = [_Stage(part, compiled(part)) for part in parts]

    @property
    def has_exponents(self) -> bool:
        """Whether light comes with exponents that are not known."""
        return any(isinstance(result, Symbol) for result in self.formula.results[self.read :])

    @cached_property
    def _in_one(self) -> _Stage:
        """The formula in one stage, which tells in which part of a batch it does not hold."""
        if len(self._stages) == 1:
            return self._stages[0]
        whole = replace(self.formula, last=None)
        return _Stage(whole, self.compiled(whole))

    def results(
        self,
        given: ResolvedInputs,
        layout: Layout,
        known: Mapping[str, Array],
        refused: Callable[[], object],
        fallback: Callable[[ResolvedInputs], Array],
    ) -> tuple[Results, bool]:
        """Return the results, an array over paths or a number each, and whether care was needed.

        Parameters
        ----------
        given : ResolvedInputs
            The numbers.
        layout : Layout
            The axes of its batch.
        known : mapping of str to ndarray
            The arrays that are known beforehand.
        refused : callable
            Called once where the formula does not hold; it raises if that is because of
            what is given.
        fallback : callable
            Gives the results for a part of what is given, where the formula does not hold.
        """
        numbers = {str(key): number for key, number in given.numbers.items()}
        numbers |= {**self.formula.constants, **known}
        found, failed = self._found(self._stages, numbers, layout)
        if failed and len(self._stages) > 1:
            found, failed = self._found([self._in_one], numbers, layout)
        if failed:
            refused()
            out = np.empty((len(found.each), given.paths), self.formula.dtype)
            for row, result in zip(out, found.each, strict=True):
                row[...] = result
            for piece in failed:
                out[:, piece.start : piece.stop] = fallback(given.part(piece.where))
            found = Results([*out], out, [*range(len(out))])
        return found, bool(failed)

    def _found(
        self, several: Sequence[_Stage], numbers: Mapping[str, Any], layout: Layout
    ) -> tuple[Results, list[Piece]]:
        """Return the results, and the pieces for which they do not hold."""
        arrays: dict[str, tuple[Array, frozenset[int]]] = {
            name: (number, layout.axes[name])
            for name, number in numbers.items()
            if isinstance(number, np.ndarray)
        }
        for formula, path in several[:-1]:
            shape = layout.lengths(formula.axes)
            own = {
                name: layout.among(array, axes, formula.axes)
                for name, (array, axes) in arrays.items()
                if axes <= formula.axes
            }
            grid = Grid(formula, path, shape, own, shape, own, numbers)
            out = np.empty((len(formula.computed), prod(shape)), formula.dtype)
            failed = list(self._failures(grid, shape, out))
            if failed:
                return Results([], out, []), failed
            for symbol, row in zip(formula.computed, out, strict=True):
                kept = row if symbol.kind == "float" else row.astype(symbol.kind)
                arrays[f"#{symbol.index}"] = kept.reshape(shape), symbol.axes
        formula, path = several[-1]
        across = {n: layout.among(a, x, layout.all_axes) for n, (a, x) in arrays.items()}
        cells = {n: layout.in_batch(a, x) for n, (a, x) in arrays.items()}
        grid = Grid(formula, path, layout.shape, across, layout.batch, cells, numbers)
        results, count = self.formula.results, len(formula.computed)
        # Numbers that are known follow, so that all of a light may stand together.
        known = [i for i in range(self.read) if _is_read_number(results[i])]
        out = np.empty((count + len(known), prod(layout.batch)), formula.dtype)
        failed = list(self._failures(grid, layout.batch, out))
        place = {symbol.index: row for row, symbol in reversed([*enumerate(formula.computed)])}
        rows = [place.get(r.index) if isinstance(r, Symbol) else None for r in results]
        for row, i in enumerate(known, count):
            out[row], rows[i] = results[i], row
        each = [
            self._result(result, cells, layout) if row is None else out[row]
            for result, row in zip(results, rows, strict=True)
        ]
        return Results(each, out, rows), failed

    @staticmethod
    def _result(result: Any, cells: Mapping[str, Array], layout: Layout) -> Any:
        """Return a result that the last stage has not computed."""
        if not isinstance(result, Symbol):
            return result
        return np.broadcast_to(cells[f"#{result.index}"], layout.batch).reshape(-1)

    def _failures(self, grid: Grid, batch: tuple[int, ...], out: Array) -> Iterator[Piece]:
        """Fill the results; yield the pieces for which the formula does not hold."""
        parts = pieces(batch, _AT_ONCE)
        if self.threads == 1:
            yield from (piece for piece in parts if not grid.fill(piece, out))
            return
        several = list(parts)
        with ThreadPoolExecutor(self.threads) as pool:
            held = pool.map(lambda piece: grid.fill(piece, out), several)
            yield from (piece for piece, holds in zip(several, held, strict=True) if not holds)


def _is_read_number(result: Any) -> bool:
    return not (isinstance(result, Symbol) or np.isnan(result))


def known_arrays(program: Program, dtype: np.dtype[Any]) -> dict[str, Array]:
    """Return the numbers of a program that are known, as formulas name them."""
    return {
        f".{place}": operand.numbers(kind=wide(dtype)).astype(
            bool if operand.part == "present" else dtype, copy=False
        )
        for place, operand in enumerate(program.operands)
        if operand.known and operand.numbers().ndim
    }
