"""Reduction: the smallest program that gives what the detectors read."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from math import inf
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from optipath.composer.builder import Item, along_chains, label_of
from optipath.composer.live import Live, known_numbers, left_out, number_of, vanishes
from optipath.engines.program import MODELS, Reduction, Tolerance
from optipath.errors import ComposerError, listed
from optipath.kernels.carriers.structures import BLOCK, DEPOLARIZING_BLOCK, FULL, ROTATION, SCALE
from optipath.kernels.catalog import (
    ATTENUATOR,
    CONSTANT_BLOCK,
    CONSTANT_DEPOLARIZING_BLOCK,
    MATRIX,
    PLAIN_TURN,
    TURN,
    TURN_BACK,
)
from optipath.kernels.primitives import FLOAT
from optipath.values.operands import Operand, Operation, ResultOf

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.engines.program import Program
    from optipath.kernels.carriers.structures import Structure
    from optipath.kernels.kernel import Kernel

    Pass: TypeAlias = Callable[[Program], tuple[Program, list[str]]]


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
            cure = f"use model '{exact.model}' or 'auto'"
            if not _others(exact):
                cure += ", or give a tolerance"
            raise ComposerError(
                f"model '{model}' is not exact for this path: S{alive[-1]} is alive at "
                f"'{exact.program.steps[light].label}'; {cure}"
            )
    return replace(exact.by(model), reason=f"asked for by name; {exact.reason}")


def tolerated(exact: Reduction, model: str, most: float) -> Tolerance | None:
    """Return which model is taken where a certificate allows it."""
    size = MODELS.index(exact.model)
    wanted = "scalar" if model == "auto" else model
    if MODELS.index(wanted) >= size:
        return None
    others = _others(exact)
    if not others and not exact.program.loops:
        return Tolerance(wanted, most)
    if model == "auto":
        return None
    why = f"{listed([repr(name) for name in others])} reads more"
    if exact.program.loops:
        why = "the light of this path goes round"
    raise ComposerError(
        f"model '{model}' is not exact for this path, and certificates are for intensities of "
        f"light that does not go round, but {why}; let all read 'intensity', as "
        f"path.reading('intensity') does, or use model '{exact.model}'"
    )


def _others(exact: Reduction) -> list[str]:
    """Return the ends that read more than the intensity."""
    return [name for name, end in exact.program.readings.items() if end.components > 1]


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

    notes = [
        f"cheaper at '{step.label}': {cheaper[step.evaluation].kernel.name}"
        for step in program.steps
        if step.evaluation in cheaper
    ]
    return along_chains(program, lambda items: list(map(cheapest, items))), notes


def _vanishes(argument: Operand | ResultOf) -> bool:
    return not isinstance(argument, ResultOf) and vanishes(argument)


def _span(argument: Operand | ResultOf) -> tuple[float, float]:
    return (-inf, inf) if isinstance(argument, ResultOf) else argument.span


_KERNELS = {
    "scale": ATTENUATOR,
    "rotation": PLAIN_TURN,
    "full": MATRIX,
    BLOCK.name: CONSTANT_BLOCK,
    DEPOLARIZING_BLOCK.name: CONSTANT_DEPOLARIZING_BLOCK,
}
_COSTS = {"scale": 4, "rotation": 16, BLOCK.name: 14, DEPOLARIZING_BLOCK.name: 14, "full": 34}
_EXTINCT = 0.01
"""Where less than this share of some light passes, a product of matrices may lose its digits."""

_LEAST = 1e-60


class Constant(NamedTuple):
    """The numbers of a step, as its structure has them."""

    structure: Structure
    numbers: tuple[float, ...]

    @property
    def kernel(self) -> Kernel:
        """The kernel that is given these numbers."""
        return _KERNELS[self.structure.name]

    @property
    def cost(self) -> int:
        """About how many operations it takes."""
        return _COSTS[self.structure.name]

    @property
    def is_identity(self) -> bool:
        """Whether it leaves every light as it is."""
        return tuple(self.numbers) == self.structure.identity

    @property
    def lets_through(self) -> bool:
        """Whether no light is nearly extinguished by it."""
        first = self._rows()[0]
        return first[0] - math.hypot(*first[1:]) > _EXTINCT * first[0]

    def _rows(self) -> Sequence[tuple[float, ...]]:
        return self.structure.rows(FLOAT, self.numbers)

    def as_full(self) -> Constant:
        """Return the same with all sixteen entries."""
        return Constant(FULL, tuple(float(entry) for row in self._rows() for entry in row))

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
            if one.structure == SCALE and other.structure != ROTATION:
                t = one.numbers[0]
                product = tuple(t * number for number in other.numbers)
                return _unless_identity(Constant(other.structure, product))
        return None


def multiplied(first: Constant, second: Constant) -> Constant | None:
    """Return two constants in the order of travel as one matrix; None if it is too faint."""
    one, other = first.as_full().numbers, second.as_full().numbers
    rows, columns = [other[i : i + 4] for i in (0, 4, 8, 12)], [one[i::4] for i in range(4)]
    product = tuple(a * e + b * f + c * g + d * h for a, b, c, d in rows for e, f, g, h in columns)
    result = _unless_identity(Constant(FULL, product))
    return result if result and result.lets_through else None


def _unless_identity(product: Constant) -> Constant | None:
    """Return a product unless its intensity is so faint, or so large, that it might get lost."""
    first = product.structure.rows(FLOAT, product.numbers)[0][0]
    return product if _LEAST < first < 1.0 / _LEAST else None


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
    multiplying = _Multiplying(
        [known.get(step.evaluation) for step in program.steps], matrices=matrices
    )
    return along_chains(program, multiplying.done_to), multiplying.notes


class _Multiplying:
    """Multiplies the constants of chains, and notes which."""

    def __init__(self, known: Sequence[Constant | None], *, matrices: bool) -> None:
        self.known = known
        self.matrices = matrices
        self.notes: list[str] = []

    def done_to(self, items: list[Item]) -> list[Item]:
        results: list[Item] = []
        run: list[tuple[Item, Constant]] = []
        for item in items:
            constant = self.known[item.light]
            if constant is None:
                results += self._as_one(run)
                run = []
                results.append(item)
            elif constant.is_identity:
                self.notes.append(f"{item.operation.kernel.name} at '{item.label}' changes nothing")
            elif run and (both := run[-1][1].then(constant)):
                run[-1] = self._joined([run[-1][0], item], both), both
            else:
                run.append((item, constant))
        return results + self._as_one(run)

    def _as_one(self, run: Sequence[tuple[Item, Constant]]) -> list[Item]:
        """Return neighbours as one matrix where that is less work and loses no digit."""
        items, constants = [item for item, _ in run], [constant for _, constant in run]
        if not (self.matrices and len(run) > 1):
            return items
        dear = sum(constant.cost for constant in constants) > Constant(FULL, ()).cost
        if not (dear and all(constant.lets_through for constant in constants)):
            return items
        results: list[tuple[Item, Constant]] = []
        for place, (item, constant) in enumerate(run):
            both = multiplied(results[-1][1], constant) if place % _MOST else None
            if both:
                results[-1] = self._joined([results[-1][0], item], both), both
            else:
                results.append((item, constant))
        return [item for item, _ in results]

    def _joined(self, items: Sequence[Item], constant: Constant) -> Item:
        names = [f"{item.operation.kernel.name} at '{item.label}'" for item in items]
        self.notes.append(f"constant, and multiplied: {' and '.join(names)}")
        operation = Operation(constant.kernel, tuple(map(Operand, constant.numbers)))
        return items[-1]._replace(label=label_of(items), operation=operation)


def joined_turns(program: Program, *, sums: bool) -> tuple[Program, list[str]]:
    """Return a program whose neighbouring turns are one."""
    notes: list[str] = []

    def joined(items: list[Item]) -> list[Item]:
        results: list[Item] = []
        for item in items:
            turns = results and _is_turn(item) and _is_turn(results[-1])
            if turns and len(results[-1].operation.arguments) < _MOST:
                names = dict.fromkeys(f"'{turn.label}'" for turn in (results[-1], item))
                notes.append(f"the turns at {' and '.join(names)} are one")
                results[-1:] = _as_one(results[-1], item, sums=sums and item.once)
            else:
                results.append(item)
        return results

    return (along_chains(program, joined) if _has_neighbours(program) else program), notes


def _has_neighbours(program: Program) -> bool:
    turns = {place for place, e in enumerate(program.evaluations) if e.kernel in _TURNS}
    steps = program.steps
    second = [step for step in steps if step.evaluation in turns]
    return not turns.isdisjoint([steps[step.inputs[0]].evaluation for step in second])


_TURNS = (TURN, TURN_BACK)


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
