"""Batches: what many paths have in common, prepared once, and formulas run over grids of them."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.choice import COMPILER, REGISTRY, EngineChoice
from optipath.engines.formula import stages
from optipath.engines.symbols import Symbol
from optipath.errors import ValueFault
from optipath.plan.reading import pieces
from optipath.values.operands import ABSENT

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.engines.formula import ArrayPath, Formula
    from optipath.plan.questions import Question
    from optipath.plan.reading import Batch, Layout, Piece
    from optipath.plan.runner import Runner
    from optipath.plan.scalar_runner import FloatFunction
    from optipath.values.operands import InputKey

    Array = np.ndarray[Any, Any]


MOST_CACHED = 64
"""How many kinds of batches are kept prepared; the oldest goes first."""


def keep(store: dict[Any, Any], key: Any, value: Any) -> None:
    """Keep a value with others, the oldest of which go."""
    for oldest in list(store)[: max(0, len(store) - MOST_CACHED + 1)]:
        store.pop(oldest, None)
    store[key] = value


class BatchKind:
    """Batches of one kind: one question, numbers of the same forms, the same axes."""

    def __init__(
        self,
        question: Question,
        forms: Mapping[InputKey, str],
        layout: Layout,
        runner: Runner,
        *,
        floats: bool,
    ) -> None:
        self.question = question
        self.forms = forms
        self.layout = layout
        self.runner = runner
        self.choice = EngineChoice(runner.options.engine, floats=floats, dtype=runner.options.dtype)

    @cached_property
    def batches(self) -> BatchRunner | None:
        """What does the formula to batches; None where it cannot be made."""
        runner, axes = self.runner, self.layout.axes
        made = runner.attempt(lambda: self.question.formula(runner, self.forms, axes))
        if made is None:
            return None
        staged = not runner.unreduced
        return BatchRunner(made, self.layout, threads=runner.options.threads, staged=staged)

    @cached_property
    def function(self) -> FloatFunction | None:
        """What does one path after the other; None where it cannot be made."""
        nothing = frozenset([key for key, form in self.forms.items() if form == ABSENT])
        return self.runner.single.function(nothing)

    @property
    def has_floats(self) -> bool:
        """Whether a function of floats has been made."""
        return bool(self.runner.single.functions)

    def operations(self, *, floats: bool) -> int | None:
        """Return how many operations a path takes; None where no formula can be made."""
        if floats:
            return None if self.function is None else self.function.operations
        return None if self.batches is None else len(self.batches.formula.steps)

    @property
    def is_stored(self) -> bool:
        """Whether the compiler's code is on disk."""
        return self.batches is not None and all(
            map(REGISTRY[COMPILER].is_ready, self.batches.parts)
        )


class Recipe:
    """How the numbers of a batch are taken out of what is given, for batches of its shapes."""

    def __init__(
        self,
        kind: BatchKind,
        layout: Layout,
        known: Mapping[Any, Any],
        arguments: Batch,
        parameters: Mapping[str, Any],
    ) -> None:
        self.kind = kind
        self.layout = layout
        self.fixed: dict[Any, Any] = dict(known)
        self.plain: list[InputKey] = []
        self.parts: list[InputKey] = []
        self.ranges: list[tuple[str, float, float]] = []
        self.reader = reader = kind.runner.reader
        # What is more than numbers within limits, which formulas look at, is looked at each time.
        self.whole = [
            use
            for use in reader.inputs.distinct_uses
            if type(value := parameters.get(use.value.name)) is np.ndarray
            and not reader.is_plain(use.value.name, value)
        ]
        for key, number in arguments.numbers.items():
            value = parameters.get(key.name)
            if value is None or type(value) is str or key.part == "present":
                self.fixed[key] = number
            elif key.part in ("value", "real") and not key.is_affine:
                self.plain.append(key)
            else:
                self.parts.append(key)
            if type(value) is float:
                self.ranges.append((key.name, *reader.inputs.limits[key.name]))
        # What nothing needs is looked at each time, as is what follows from others, and what says
        # more of this batch than its shapes do.
        names = {key.name for key in arguments.numbers}
        self.holds = parameters.keys() <= names <= reader.inputs.open.keys() and all(
            isinstance(number, np.ndarray)
            for key, number in arguments.numbers.items()
            if type(parameters.get(key.name)) is np.ndarray and key.part not in ("present", "imag")
        )

    def numbers(self, parameters: Mapping[str, Any]) -> dict[Any, Any] | None:
        """Return the numbers by the names of a formula's inputs; None if one is not allowed."""
        for name, low, high in self.ranges:
            if not low <= parameters[name] <= high or abs(parameters[name]) == np.inf:
                return None
        try:
            for use in self.whole:
                use.check_arguments(parameters[use.value.name])
        except ValueFault:
            return None
        results = dict(self.fixed)
        for key in self.plain:
            results[key] = parameters[key.name]
        for key in self.parts:
            results[key] = self.reader.part(key, parameters[key.name])
        return results


_AT_ONCE = 1 << 16
"""How many paths are done before it is looked whether the formula holds for them."""


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
            out = np.empty((len(outcome.each), outcome.out.shape[1]), self.formula.dtype)
            for row, result in zip(out, outcome.each, strict=True):
                row[...] = result
            for piece in failed:
                out[:, piece.start : piece.stop] = fallback(piece)
            outcome = Results([*out], out, [*range(len(out))])
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
        several = [*pieces(grid.batch, _AT_ONCE)]
        if self.threads == 1 or len(several) == 1:
            return [piece for piece in several if not grid.fill(piece, out)]
        with ThreadPoolExecutor(self.threads) as pool:
            held = pool.map(lambda piece: grid.fill(piece, out), several)
            return [piece for piece, holds in zip(several, held, strict=True) if not holds]


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
