"""Live components: which Stokes components steps can have and somebody reads; known entries."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import isfinite
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from optipath.composer.builder import Item, along_chains
from optipath.engines.program import Result
from optipath.kernels.kernel import Entry
from optipath.kernels.primitives import FLOAT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from collections.abc import Set as AbstractSet

    from optipath.engines.program import Program
    from optipath.kernels.kernel import Kernel
    from optipath.values.operands import Operand


class Live:
    """What of each light of a program is alive."""

    def __init__(
        self,
        program: Program,
        doubtful: AbstractSet[int] = frozenset(),
        entries: list[Entries] | None = None,
    ) -> None:
        self.program = program
        self.doubtful = doubtful
        self.entries = _entries_of_steps(program) if entries is None else entries
        self.sources = [_sources(each) for each in self.entries]
        self.reached: list[set[int]] = [set() for _ in program.steps]
        self.needed: list[set[int]] = [set() for _ in program.steps]
        _until_resolved(reversed(range(len(program.steps))), self._forward)
        for reading in program.readings.values():
            self.needed[reading.light] |= set(range(reading.components))
        _until_resolved(range(len(program.steps)), self._backward)

    @property
    def components(self) -> tuple[tuple[int, ...], ...]:
        """For each light, the components that are alive; an intensity always is."""
        pairs = zip(self.reached, self.needed, strict=True)
        return tuple([tuple(sorted((reached & needed) | {0})) for reached, needed in pairs])

    def idle(self) -> set[int]:
        """Return the steps that each leave everything as it is that is alive."""
        return {light for light in range(len(self.program.steps)) if self._does_nothing(light)}

    def _does_nothing(self, light: int) -> bool:
        step, needed = self.program.steps[light], self.needed[light] | {0}
        if step.evaluation is None or not step.inputs:
            return False
        reached = self.reached[step.inputs[0]]
        changed = _changed(self.entries[light])
        return not [1 for row, column in changed if row in needed and column in reached]

    def _forward(self, light: int) -> Iterable[int]:
        inputs, sources = self.program.steps[light].inputs, self.sources[light]
        arriving = set().union(*[self.reached[before] for before in inputs]) if inputs else _ALL
        results = {row for row, columns in enumerate(sources) if columns & arriving}
        if light in self.doubtful:
            results |= arriving
        if results <= self.reached[light]:
            return ()
        self.reached[light] |= results
        return self.program.used_by[light]

    def _backward(self, light: int) -> Iterable[int]:
        sources = self.sources[light]
        request = set().union(*[sources[row] for row in self.needed[light]])
        before = [i for i in self.program.steps[light].inputs if not request <= self.needed[i]]
        for source in before:
            self.needed[source] |= request
        return before


_ALL = frozenset(range(4))
_IDENTITY: Entries = tuple(tuple(float(row == column) for column in range(4)) for row in range(4))


def _entries_of_steps(program: Program) -> list[Entries]:
    known = entries_of_evaluations(program)
    # What adds lights up, and does nothing to them, is known as such.
    places = [step.evaluation for step in program.steps]
    return [_IDENTITY if place is None else known[place] for place in places]


@lru_cache(1024)
def _sources(entries: Entries) -> tuple[frozenset[int], ...]:
    """Return of which components each component is made."""
    if len(entries) == 1:
        # What a source emits is made of nothing that arrives, and there if it is not 0.
        return tuple(_ALL if entry != 0.0 else frozenset() for entry in entries[0])
    return tuple(frozenset(j for j, entry in enumerate(row) if entry != 0.0) for row in entries)


@lru_cache(1024)
def _changed(entries: Entries) -> tuple[tuple[int, int], ...]:
    """Return which entries are not, or may not be, those of a step that does nothing."""
    places = ((row, column) for row in range(4) for column in range(4))
    return tuple((r, c) for r, c in places if entries[r][c] != _IDENTITY[r][c])


def _until_resolved(lights: Iterable[int], look: Callable[[int], Iterable[int]]) -> None:
    """Look at lights, the last one first, and again at those that the look at another asks for."""
    waiting = dict.fromkeys(lights)
    while waiting:
        light, _ = waiting.popitem()
        waiting |= dict.fromkeys(look(light))


def left_out(program: Program) -> tuple[Program, list[str]]:
    """Return a program without the steps that do nothing to what is alive."""
    live = Live(program)
    # One may be idle since another takes away what would reach it: without both, it reaches on.
    idle = live.idle()
    idle = idle and idle & Live(program, idle, live.entries).idle()
    if not idle:
        return replace(program, live=live.components), []
    notes = []
    for light in sorted(idle):
        step = program.steps[light]
        kernel = program.evaluations[step.evaluation or 0].kernel
        notes.append(f"left out, since it changes nothing alive: {kernel.name} at '{step.label}'")

    def rest(items: list[Item]) -> list[Item]:
        return [item for item in items if item.light not in idle]

    return along_chains(program, rest), notes


Entries: TypeAlias = tuple[tuple[Entry, ...], ...]
"""Four rows of a matrix, or one row of what a source emits."""


def number_of(operand: Operand) -> float | None:
    """Return the one real number that an operand is known to be; None for all else."""
    quickly = operand.known_float
    if quickly is not None:
        return quickly
    if not operand.known or operand.traced or operand.part == "present":
        return None
    numbers = operand.numbers({})
    return None if numbers.ndim or numbers.dtype.kind == "c" else float(numbers)


def vanishes(operand: Operand) -> bool:
    """Tell whether an operand is known to be 0, for every path."""
    if not operand.known or operand.traced:
        return False
    numbers = operand.numbers({})
    # Of most arrays the first number tells.
    return not (numbers.size and numbers[(0,) * numbers.ndim]) and not np.any(numbers)


def known_numbers(
    program: Program,
) -> tuple[list[float | None], list[tuple[float, ...] | None]]:
    """Return the number of each operand, and those of each evaluation, as far as known.

    In a loop none is known: in twice the digits, what floats give as 0 or 1 may be neither.
    """
    operands = [number_of(operand) for operand in program.operands]
    outcomes: list[tuple[float, ...] | None] = []
    for evaluation in program.evaluations:
        arguments: list[float | None] = []
        for argument in evaluation.arguments:
            if isinstance(argument, Result):
                results = outcomes[argument.evaluation]
                arguments.append(None if results is None else results[argument.place])
            else:
                arguments.append(operands[argument])
        unknown = None in arguments or program.loops
        outcomes.append(None if unknown else _evaluated(evaluation.kernel, tuple(arguments)))
    return operands, outcomes


def entries_of_evaluations(program: Program) -> list[Entries]:
    """Return what is known of the matrix of each evaluation, or of what it emits."""
    numbers, evaluated = known_numbers(program)
    pairs = zip(program.operands, numbers, strict=True)
    known = [0.0 if n is None and vanishes(o) else _zero_or_one(n) for o, n in pairs]
    results: list[Entries] = []
    for evaluation, result in zip(program.evaluations, evaluated, strict=True):
        arguments = [
            _zero_or_one(_result(program, results, argument))
            if isinstance(argument, Result)
            else known[argument]
            for argument in evaluation.arguments
        ]
        results.append(_entries(evaluation.kernel, result, tuple(arguments)))
        if evaluation.presence is not None and evaluation.kernel.structure is not None:
            results[-1] = _as_it_may_be_absent(results[-1])
    return results


@lru_cache(1024)
def _evaluated(kernel: Kernel, numbers: tuple[float, ...]) -> tuple[float, ...] | None:
    try:
        return tuple(map(float, kernel.made_for(FLOAT)(*numbers)))
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return None


def _result(program: Program, results: Sequence[Entries], result: Result) -> Entry:
    """Return what is known of a result: that of a kernel without structure has one row."""
    structure = program.evaluations[result.evaluation].kernel.structure
    row = results[result.evaluation][0]
    return row[result.place] if structure is None and result.place < len(row) else None


def _zero_or_one(number: Entry) -> Entry:
    """Return 0, 1 or None: which number it is seldom matters, but for these two."""
    return abs(number) if number in (0.0, 1.0) else None


@lru_cache(1024)
def _entries(kernel: Kernel, result: tuple[float, ...] | None, known: tuple[Entry, ...]) -> Entries:
    """Return what is known of a matrix: its numbers, or what the kernel declares of them."""
    if result is None and None not in known:
        result = _evaluated(kernel, tuple(number for number in known if number is not None))
    zeros = {place for place, number in enumerate(known) if number == 0.0}
    numbers = kernel.known_numbers(zeros, len(known)) if result is None else result
    if kernel.structure is not None:
        return kernel.structure.known_rows(numbers)
    row = tuple(None if number is None or not isfinite(number) else number for number in numbers)
    return (row or (None,) * 4,)


@lru_cache(1024)
def _as_it_may_be_absent(rows: Entries) -> Entries:
    return tuple(
        tuple(entry if entry == float(r == c) else None for c, entry in enumerate(row))
        for r, row in enumerate(rows)
    )
