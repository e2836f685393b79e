"""Reduction: the smallest program that gives what the detectors read."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache, partial
from math import inf, isfinite
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from optipath.composer.builder import Item, along_chains, label_of
from optipath.engines.program import MODELS, Reduction, Result, Tolerance
from optipath.errors import ComposerError
from optipath.faults import listed
from optipath.kernels.carriers.structures import (
    BLOCK,
    DEPOLARIZING_BLOCK,
    FULL,
    JONES,
    ROTATION,
    SCALE,
)
from optipath.kernels.catalog import (
    ATTENUATOR,
    CONSTANT_BLOCK,
    CONSTANT_DEPOLARIZING_BLOCK,
    MATRIX,
    PLAIN_TURN,
    TURN,
    TURN_BACK,
)
from optipath.kernels.kernel import Entry
from optipath.kernels.primitives import FLOAT
from optipath.values.operands import Operand, Operation, ResultOf

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from collections.abc import Set as AbstractSet

    from optipath.engines.program import Program
    from optipath.kernels.carriers.structures import Structure
    from optipath.kernels.kernel import Kernel

    Pass: TypeAlias = Callable[[Program], tuple[Program, list[str]]]


Entries: TypeAlias = tuple[tuple[Entry, ...], ...]
"""Four rows of a matrix, or one row of what a source emits."""

_ALL = frozenset(range(4))
_IDENTITY: Entries = tuple(tuple(float(row == column) for column in range(4)) for row in range(4))


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
        results = set()
        for light, step in enumerate(self.program.steps):
            if step.evaluation is not None and step.inputs:
                needed, reached = self.needed[light] | {0}, self.reached[step.inputs[0]]
                changed = _changed(self.entries[light])
                if not any(row in needed and column in reached for row, column in changed):
                    results.add(light)
        return results

    def _forward(self, light: int) -> Iterable[int]:
        inputs = self.program.steps[light].inputs
        arriving = set().union(*[self.reached[before] for before in inputs]) if inputs else _ALL
        results = {row for row, columns in enumerate(self.sources[light]) if columns & arriving}
        if light in self.doubtful:
            results |= arriving
        if results <= self.reached[light]:
            return ()
        self.reached[light] |= results
        return self.program.used_by[light]

    def _backward(self, light: int) -> Iterable[int]:
        request = set().union(*[self.sources[light][row] for row in self.needed[light]])
        before = [i for i in self.program.steps[light].inputs if not request <= self.needed[i]]
        for source in before:
            self.needed[source] |= request
        return before


def _until_resolved(lights: Iterable[int], look: Callable[[int], Iterable[int]]) -> None:
    """Look at lights, the last one first, and again at those that the look at another asks for."""
    waiting = dict.fromkeys(lights)
    while waiting:
        light, _ = waiting.popitem()
        waiting |= dict.fromkeys(look(light))


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


def number_of(operand: Operand) -> float | None:
    """Return the one real number that an operand is known to be; None for all else."""
    if type(operand.value) is float and operand.part in ("value", "real"):
        return operand.value
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
    operands = list(map(number_of, program.operands))
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


def _entries_of_steps(program: Program) -> list[Entries]:
    """Return what is known of the matrix of each step, or of what it emits."""
    numbers, outcomes = known_numbers(program)
    pairs = zip(program.operands, numbers, strict=True)
    # Which number it is seldom matters, but for these two.
    operands = [0.0 if n is None and vanishes(o) else _ZERO_OR_ONE.get(n) for o, n in pairs]
    results: list[Entries] = []
    for evaluation, outcome in zip(program.evaluations, outcomes, strict=True):
        known: list[Entry] = []
        for argument in evaluation.arguments:
            if not isinstance(argument, Result):
                known.append(operands[argument])
                continue
            # A result is that of a kernel without structure, of which there is one row.
            of_matrix = program.evaluations[argument.evaluation].kernel.structure is not None
            row = () if of_matrix else results[argument.evaluation][0]
            number = row[argument.place] if argument.place < len(row) else None
            known.append(_ZERO_OR_ONE.get(number))
        may_be_absent = evaluation.presence is not None
        results.append(_entries(evaluation.kernel, outcome, tuple(known), may_be_absent))
    # What adds lights up, and does nothing to them, is known as such.
    places = [step.evaluation for step in program.steps]
    return [_IDENTITY if place is None else results[place] for place in places]


_ZERO_OR_ONE: dict[Entry, Entry] = {0.0: 0.0, 1.0: 1.0}


@lru_cache(1024)
def _evaluated(kernel: Kernel, numbers: tuple[float, ...]) -> tuple[float, ...] | None:
    try:
        return tuple(map(float, kernel.made_for(FLOAT)(*numbers)))
    except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
        return None


@lru_cache(1024)
def _entries(
    kernel: Kernel,
    outcome: tuple[float, ...] | None,
    known: tuple[Entry, ...],
    may_be_absent: bool,  # noqa: FBT001 - a part of the key
) -> Entries:
    """Return what is known of a matrix: its numbers, or what the kernel declares of them."""
    if outcome is None and None not in known:
        outcome = _evaluated(kernel, tuple(number for number in known if number is not None))
    zeros = {place for place, number in enumerate(known) if number == 0.0}
    numbers = kernel.known_numbers(zeros, len(known)) if outcome is None else outcome
    if kernel.structure is None:
        row = tuple(
            None if number is None or not isfinite(number) else number for number in numbers
        )
        return (row or (None,) * 4,)
    rows = kernel.structure.known_rows(numbers)
    if not may_be_absent:
        return rows
    return tuple(
        tuple(entry if entry == usual else None for entry, usual in zip(row, of_none, strict=True))
        for row, of_none in zip(rows, _IDENTITY, strict=True)
    )


def passes_for(model: str, composing: str, dtype: str) -> tuple[dict[str, Pass], int]:
    """Return what programs go through, in order, and how often as long as one of them helps."""
    stokes, doubles = composing == "stokes", dtype != "longdouble"
    if model == "full":
        return {}, 1
    result: dict[str, Pass] = {
        "cheaper kernels": cheaper_kernels,
        "joined turns": partial(joined_turns, sums=doubles),
    }
    if doubles:
        result["multiplied constants"] = partial(multiplied_constants, matrices=stokes)
    if stokes:
        result["left out"] = left_out
    return result, 3 if stokes else 1


def reduced(whole: Program, model: str, composing: str, dtype: str) -> Reduction:
    """Return the smallest program that is exact for a path."""
    passes, rounds = passes_for(model, composing, dtype)
    program, notes = whole, list[str]()
    for _ in range(rounds):
        done = len(notes)
        for each in passes.values():
            program, result = each(program)
            notes += result
        if len(notes) == done:
            break
    folded = tuple(dict.fromkeys(notes))
    program = replace(program, live=program.live or Live(program).components)
    if passes and composing == "stokes":
        counts = tuple([alive[-1] + 1 for alive in program.live])
        program, size = replace(program, counts=counts), max(counts)
        return Reduction(program, MODELS[size - 1], _reason(program, size), folded)
    reason = "Jones columns are carried whole"
    if not passes:
        reason = "asked for by name: every step as it stands"
    return Reduction(program, "full", reason, folded, unreduced=not passes)


def by_name(exact: Reduction, model: str) -> Reduction:
    """Return the smallest exact program carried by a model that may be larger."""
    most = MODELS.index(model)
    for light, alive in enumerate(exact.live):
        if alive[-1] > most:
            cure = f"use model '{exact.model}' or 'auto', or give a tolerance, and let all read "
            cure += "'intensity'"
            where = f"S{alive[-1]} is alive at '{exact.program.steps[light].label}'"
            raise ComposerError(f"model '{model}' is not exact for this path: {where}; {cure}")
    return replace(exact.by(model), reason=f"asked for by name; {exact.reason}")


def tolerated(exact: Reduction, model: str, most: float) -> Tolerance | None:
    """Return which model is taken where a certificate allows it; None where there is none."""
    wanted = "scalar" if model == "auto" else model
    read_more = any(end.components > 1 for end in exact.program.readings.values())
    if read_more or MODELS.index(wanted) >= MODELS.index(exact.model):
        return None
    return Tolerance(wanted, most)


def _reason(program: Program, size: int) -> str:
    """Return why as many components are needed."""
    if size == 1:
        return "S1, S2 and S3 are 0, or nobody needs them"
    names = [f"S{i}" for i in range(4) if any(i in alive for alive in program.live)]
    dead = [f"S{i}" for i in range(4) if f"S{i}" not in names]
    return f"{listed(names)} are alive" + (f", {listed(dead)} nowhere" if dead else "")


def cheaper_kernels(program: Program) -> tuple[Program, list[str]]:
    """Return a program with the cheapest kernel for what is known of its arguments."""
    cheaper: dict[int | None, Operation] = {}
    for place, evaluation in enumerate(program.evaluations):
        argument = program.operations[place].arguments
        kernel, arguments = evaluation.kernel.specialised(argument, _vanishes)
        kernel = kernel.never_less(arguments, _span)
        if kernel is not evaluation.kernel:
            cheaper[place] = Operation(kernel, arguments)
    if not cheaper:
        return program, []

    def cheapest(item: Item) -> Item:
        place = program.steps[item.light].evaluation
        return item._replace(operation=cheaper.get(place, item.operation))

    steps = [step for step in program.steps if step.evaluation in cheaper]
    pairs = [(step.label, cheaper[step.evaluation].kernel.name) for step in steps]
    notes = [f"cheaper at '{label}': {name}" for label, name in pairs]
    return along_chains(program, lambda items: list(map(cheapest, items))), notes


def _vanishes(argument: Operand | ResultOf) -> bool:
    return not isinstance(argument, ResultOf) and vanishes(argument)


def _span(argument: Operand | ResultOf) -> tuple[float, float]:
    return (-inf, inf) if isinstance(argument, ResultOf) else argument.span


_KINDS = {
    "scale": (ATTENUATOR, 4),
    "rotation": (PLAIN_TURN, 16),
    "full": (MATRIX, 34),
    JONES.name: (MATRIX, 34),
    BLOCK.name: (CONSTANT_BLOCK, 14),
    DEPOLARIZING_BLOCK.name: (CONSTANT_DEPOLARIZING_BLOCK, 14),
}
"""For each structure, the kernel that is given its numbers, and about how much it costs."""

_EXTINCT = 0.01
"""Where less than this share of some light passes, a product of matrices may lose its digits."""

_LEAST = 1e-60


class Constant(NamedTuple):
    """The numbers of a step, as its structure has them."""

    structure: Structure
    numbers: tuple[float, ...]

    @property
    def lets_through(self) -> bool:
        """Whether no light is nearly extinguished by it."""
        first = self.rows()[0]
        return first[0] - math.hypot(*first[1:]) > _EXTINCT * first[0]

    def rows(self) -> Sequence[tuple[float, ...]]:
        """Return the matrix."""
        return self.structure.rows(FLOAT, self.numbers)

    def as_full(self) -> Constant:
        """Return the same with all sixteen entries."""
        return Constant(FULL, tuple([float(entry) for row in self.rows() for entry in row]))

    def then(self, later: Constant) -> Constant | None:
        """Return both as one of the same sort, no digit lost; None where they have none.

        >>> Constant(SCALE, (0.5,)).then(Constant(SCALE, (0.5,))).numbers
        (0.25,)
        """
        sorts = self.structure, later.structure
        if sorts == (ROTATION, ROTATION):
            (c1, s1), (c2, s2) = self.numbers, later.numbers
            return Constant(ROTATION, (c1 * c2 - s1 * s2, s1 * c2 + c1 * s2))
        if sorts == (BLOCK, BLOCK):
            return _unless_identity(Constant(BLOCK, _blocks(self.numbers, later.numbers)))
        for one, other in ((self, later), (later, self)):
            if one.structure == SCALE and other.structure not in (ROTATION, JONES):
                product = tuple(one.numbers[0] * number for number in other.numbers)
                return _unless_identity(Constant(other.structure, product))
        return None


def multiplied(first: Constant, second: Constant) -> Constant | None:
    """Return two constants in the order of travel as one matrix; None if it is too faint."""
    one, other = first.as_full().numbers, second.as_full().numbers
    rows, columns = [other[i : i + 4] for i in (0, 4, 8, 12)], [one[i::4] for i in range(4)]
    entries = [a * e + b * f + c * g + d * h for a, b, c, d in rows for e, f, g, h in columns]
    result = _unless_identity(Constant(FULL, tuple(entries)))
    return result if result and result.lets_through else None


def _unless_identity(product: Constant) -> Constant | None:
    """Return a product unless its intensity is so faint, or so large, that it might get lost."""
    return product if _LEAST < product.rows()[0][0] < 1.0 / _LEAST else None


def _blocks(first: tuple[float, ...], second: tuple[float, ...]) -> tuple[float, ...]:
    Fs1, Fp1, B1, C1, S1 = first
    Fs2, Fp2, B2, C2, S2 = second
    B = 0.5 * (B1 * (Fs2 + Fp2) + B2 * (Fs1 + Fp1))
    return Fs1 * Fs2, Fp1 * Fp2, B, C1 * C2 - S1 * S2, C1 * S2 + S1 * C2


_MOST = 16
"""How many constants are multiplied, lest their roundings gather."""


def multiplied_constants(program: Program, *, matrices: bool) -> tuple[Program, list[str]]:
    """Return a program whose neighbouring constants are one, in float64."""
    known: dict[int | None, Constant] = {
        place: Constant(evaluation.kernel.structure, numbers)
        for place, numbers in enumerate(known_numbers(program)[1])
        if numbers is not None
        and (evaluation := program.evaluations[place]).presence is None
        and evaluation.kernel.structure is not None
    }
    if not known:
        return program, []
    constants = [known.get(step.evaluation) for step in program.steps]
    notes: list[str] = []

    def done_to(items: list[Item]) -> list[Item]:
        results: list[Item] = []
        run: list[tuple[Item, Constant]] = []
        for item in items:
            constant = constants[item.light]
            if constant is None:
                results += as_one(run)
                run = []
                results.append(item)
            elif tuple(constant.numbers) == constant.structure.identity:
                notes.append(f"{item.operation.kernel.name} at '{item.label}' changes nothing")
            elif run and (both := run[-1][1].then(constant)):
                run[-1] = _joined([run[-1][0], item], both, notes), both
            else:
                run.append((item, constant))
        return results + as_one(run)

    def as_one(run: Sequence[tuple[Item, Constant]]) -> list[Item]:
        """Return neighbours as one matrix where that is less work and loses no digit."""
        costs = [_KINDS[constant.structure.name][1] for _, constant in run]
        dear = matrices and len(run) > 1 and sum(costs) > _KINDS[FULL.name][1]
        if not (dear and all(constant.lets_through for _, constant in run)):
            return [item for item, _ in run]
        results: list[tuple[Item, Constant]] = []
        for place, (item, constant) in enumerate(run):
            both = multiplied(results[-1][1], constant) if place % _MOST else None
            if both:
                results[-1] = _joined([results[-1][0], item], both, notes), both
            else:
                results.append((item, constant))
        return [item for item, _ in results]

    return along_chains(program, done_to), notes


def _joined(items: Sequence[Item], constant: Constant, notes: list[str]) -> Item:
    """Return neighbours as one step, and note it."""
    names = [f"{item.operation.kernel.name} at '{item.label}'" for item in items]
    notes.append(f"constant, and multiplied: {' and '.join(names)}")
    kernel = _KINDS[constant.structure.name][0]
    operation = Operation(kernel, tuple(map(Operand, constant.numbers)))
    return items[-1]._replace(label=label_of(items), operation=operation)


_TURNS = (TURN, TURN_BACK)


def joined_turns(program: Program, *, sums: bool) -> tuple[Program, list[str]]:
    """Return a program whose neighbouring turns are one."""
    notes: list[str] = []
    steps = program.steps
    turns = {place for place, e in enumerate(program.evaluations) if e.kernel in _TURNS}
    second = [step for step in steps if step.evaluation in turns]
    if turns.isdisjoint([steps[step.inputs[0]].evaluation for step in second]):
        return program, notes

    def joined(items: list[Item]) -> list[Item]:
        results: list[Item] = []
        for item in items:
            both = results and _is_turn(item) and _is_turn(results[-1])
            if both and len(results[-1].operation.arguments) < _MOST:
                names = dict.fromkeys(f"'{turn.label}'" for turn in (results[-1], item))
                notes.append(f"the turns at {' and '.join(names)} are one")
                results[-1:] = _as_one(results[-1], item, sums=sums and item.once)
            else:
                results.append(item)
        return results

    return along_chains(program, joined), notes


def _is_turn(item: Item) -> bool:
    known = item.presence is None and item.operation.kernel in _TURNS
    return known and {type(argument) for argument in item.operation.arguments} == {Operand}


def _as_one(first: Item, second: Item, *, sums: bool) -> list[Item]:
    """Return two turns as one, or as none if they undo each other."""
    angles = [*_angles(first), *_angles(second)]
    numbers = [number_of(angle) if sums else None for angle in angles]
    known = sum(number for number in numbers if number is not None)
    left: list[Operand] = []
    for angle in (a for a, number in zip(angles, numbers, strict=True) if number is None):
        opposite = angle.negated().key()
        undone = [other for other in left if opposite is not None and other.key() == opposite]
        if undone:
            left.remove(undone[0])
        else:
            left.append(angle)
    if known:
        left.append(Operand(known))
    whole = second._replace(label=label_of([first, second]), operation=Operation(TURN, tuple(left)))
    return [whole] if left else []


def _angles(item: Item) -> list[Operand]:
    angles = item.operation.arguments
    if item.operation.kernel is TURN_BACK:
        return [angle.negated() for angle in angles]
    return [*angles]
