"""Batches: a formula run piece by piece over a grid of many paths."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.choice import COMPILER, REGISTRY, is_installed
from optipath.engines.formula import Formula, stages
from optipath.engines.symbols import Recorder, Symbol, reproducible_symbolic
from optipath.kernels.primitives import made
from optipath.plan.reading import Layout, pieces

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.engines.formula import ArrayPath
    from optipath.kernels.primitives import Factory
    from optipath.plan.reading import Piece
    from optipath.values.precision import Array


_AT_ONCE = 1 << 16
"""How many paths are done before it is looked whether the formula holds for them."""


_IN_CACHE, _MANY = 1 << 13, 16
"""The same where more arrays than so many are copied for them, which must stay in the cache."""


class Results(NamedTuple):
    """The results of a formula: numbers, or arrays over paths in rows of ``out``."""

    each: list[Any]
    out: Array
    rows: list[int | None]

    @classmethod
    def of(cls, rows: Array, dtype: np.dtype[Any]) -> Results:
        """Return results of rows (results, paths), in the precision of a plan."""
        out = rows.astype(dtype, copy=False)
        return cls([*out], out, [*range(len(out))])

    def together(self, start: int, stop: int) -> Array | None:
        """Return results (stop - start, paths) as rows of one array, if stored contiguously."""
        first = self.rows[start]
        if first is None or self.rows[start:stop] != list(range(first, first + stop - start)):
            return None
        return self.out[first : first + stop - start]

    def block(self, start: int, stop: int) -> Array:
        """Return results (stop - start, paths) as rows of one array, copied if need be."""
        together = self.together(start, stop)
        if together is not None:
            return together
        rows = np.empty((stop - start, self.out.shape[1]), self.out.dtype)
        for row, result in zip(rows, self.each[start:stop], strict=True):
            row[...] = result
        return rows

    def array(self, place: int) -> Array:
        """Return one result as an array over paths."""
        result = self.each[place]
        if isinstance(result, np.ndarray):
            return result
        return np.full(self.out.shape[1], result, self.out.dtype)


class BatchRunner:
    """Does a formula to batches of any shape whose arrays differ along the same axes."""

    def __init__(self, formula: Formula, layout: Layout, *, threads: int, staged: bool) -> None:
        self.formula = formula
        self.threads = threads
        self.parts = stages(formula, layout.all_axes, layout.last) if staged else (formula,)
        self._compiled: dict[Any, _Compiled] = {}

    def results(
        self,
        engine: str,
        numbers: Mapping[Any, Any],
        layout: Layout,
        refused: Callable[[], object],
        fallback: Callable[[Piece], Array],
    ) -> Results:
        """Return the results, an array over paths or a number each."""
        if self.formula.unread:
            refused()
        outcome, failed = self._rows(self._stages(engine), numbers, layout)
        if failed and len(self.parts) > 1:
            outcome, failed = self._rows(self._stages(engine, in_one=True), numbers, layout)
        if failed:
            refused()
            out = outcome.block(0, len(outcome.each))
            for piece in failed:
                out[:, piece.start : piece.stop] = fallback(piece)
            outcome = Results.of(out, self.formula.dtype)
        return outcome

    def _stages(self, engine: str, *, in_one: bool = False) -> _Compiled:
        """Return the formula compiled; in one stage, it tells in which part of a batch it fails."""
        key = engine, in_one
        if key not in self._compiled:
            parts = (replace(self.formula, last=None),) if in_one else self.parts
            self._compiled[key] = _Compiled(engine, parts, self.formula.results)
        return self._compiled[key]

    def _rows(
        self, compiled: _Compiled, numbers: Mapping[Any, Any], layout: Layout
    ) -> tuple[Results, list[Piece]]:
        """Return the results, and the pieces for which they do not hold."""
        axes = layout.axes
        for formula, path in compiled.stages[:-1]:
            shape = layout.lengths(formula.axes)
            out = np.empty((len(formula.computed), prod(shape)), formula.dtype)
            failed = self._failures(Grid(formula, path, layout, numbers, axes), out)
            if failed:
                return Results([], out, []), failed
            names = [f"#{symbol.index}" for symbol in formula.computed]
            stored = (
                (row if symbol.kind == "float" else row.astype(symbol.kind)).reshape(shape)
                for symbol, row in zip(formula.computed, out, strict=True)
            )
            numbers = {**numbers, **dict(zip(names, stored, strict=True))}
            axes = {**axes, **dict.fromkeys(names, formula.axes)}
        (formula, path), rows = compiled.stages[-1], compiled.rows
        out = np.empty((compiled.room, layout.paths), formula.dtype)
        failed = self._failures(Grid(formula, path, layout, numbers, axes, last=True), out)
        for at, number in compiled.known:
            out[at] = number
        each = list(compiled.results)
        for place, row in enumerate(rows):
            if row is not None:
                each[place] = out[row]
            elif isinstance(each[place], Symbol):
                name = f"#{each[place].index}"
                cells = layout.in_batch(numbers[name], axes[name])
                each[place] = np.broadcast_to(cells, layout.batch).reshape(-1)
        return Results(each, out, rows), failed

    def _failures(self, grid: Grid, out: Array) -> list[Piece]:
        """Fill the results; return the pieces for which the formula does not hold."""
        size = _IN_CACHE if len(grid.cells) > _MANY else _AT_ONCE
        several = [*pieces(grid.batch, size)]
        if self.threads == 1 or len(several) == 1:
            return [piece for piece in several if not grid.fill(piece, out)]
        with ThreadPoolExecutor(self.threads) as pool:
            held = pool.map(lambda piece: grid.fill(piece, out), several)
            return [piece for piece, holds in zip(several, held, strict=True) if not holds]


def holds_for_all(factory: Factory, numbers: Sequence[Any], batch: tuple[int, ...]) -> bool:
    """Tell whether the condition that a kernel makes of numbers holds for all paths of a batch."""
    arrays = {str(place): n for place, n in enumerate(numbers) if isinstance(n, np.ndarray)}
    layout, recorder = Layout(batch, arrays), Recorder(np.dtype(np.float64))
    symbols = [
        recorder.input(name, axes=layout.axes[name]) if name in arrays else number
        for name, number in zip(map(str, range(len(numbers))), numbers, strict=True)
    ]
    with np.errstate(all="ignore"):
        formula = Formula(
            recorder.dtype, (), made(factory, reproducible_symbolic("float64"))(*symbols)
        )
    if not isinstance(formula.holds, Symbol):
        return bool(formula.holds)
    path = REGISTRY[COMPILER if is_installed(COMPILER) else "numpy"].compiled(formula)
    grid, out = Grid(formula, path, layout, arrays, layout.axes, last=True), np.empty((0, 0))
    return all(grid.fill(piece, out) for piece in pieces(batch, _IN_CACHE))


class _Compiled:
    """A formula compiled, stage after stage, and where its results are written."""

    def __init__(self, engine: str, parts: Sequence[Formula], results: tuple[Any, ...]) -> None:
        self.stages = [(part, REGISTRY[engine].compiled(part)) for part in parts]
        self.results = results
        computed = parts[-1].computed
        place = {symbol.index: row for row, symbol in reversed([*enumerate(computed)])}
        self.rows = [place.get(r.index) if isinstance(r, Symbol) else None for r in results]
        # Numbers that are known follow, so that all of a light may stand together.
        self.known: list[tuple[int, Any]] = []
        for at, result in enumerate(results):
            if not (isinstance(result, Symbol) or np.isnan(result)):
                self.rows[at] = len(computed) + len(self.known)
                self.known.append((len(computed) + len(self.known), result))
        self.room = len(computed) + len(self.known)


class Grid:
    """Gives a compiled formula what it needs for each piece of a batch."""

    def __init__(
        self,
        formula: Formula,
        path: ArrayPath,
        layout: Layout,
        numbers: Mapping[Any, Any],
        axes: Mapping[Any, frozenset[int]],
        *,
        last: bool = False,
    ) -> None:
        self.path, own = path, formula.axes
        shape = layout.shape if last else layout.lengths(own)
        self.batch = layout.batch if last else shape
        self.width = shape[-1] if formula.last is not None else 0
        self.given: list[Any] = []
        self.cells: list[int] = []
        for name, place in formula.places:
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
        """Fill a piece of out (results, paths); return whether the formula holds for all of it."""
        argument, count = list(self.given), piece.stop - piece.start
        for place in self.cells:
            # One number after the other.
            argument[place] = np.ascontiguousarray(argument[place][piece.where]).reshape(-1)
        if not self.width:
            rows, columns = (0, 1), (0, count)
        elif count < self.width:
            row, first = divmod(piece.start, self.width)
            rows, columns = (row, row + 1), (first, first + count)
        else:
            rows, columns = (piece.start // self.width, piece.stop // self.width), (0, self.width)
        return self.path(rows, columns, argument, out, piece.start)
