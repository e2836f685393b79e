"""Reduction: the smallest program that gives what the detectors read."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import chain
from math import inf
from operator import and_
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.composer.flow import Flow, Item, find_alive, idle_items, number_of, vanishes
from optipath.engines.program import MODELS, Reduction, Tolerance
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
from optipath.kernels.primitives import FLOAT
from optipath.values.operands import Operand, Operation, ResultOf
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Sequence

    from optipath.engines.draft import Draft
    from optipath.engines.program import Program
    from optipath.kernels.carriers.structures import Structure

    Pass: TypeAlias = Callable[[Flow], list[str]]
    """Changes chains in place, and says what it has done."""


def left_out(flow: Flow) -> list[str]:
    """Take the steps out that do nothing to what is alive."""
    find_alive(flow)
    if not (idle := idle_items(flow)):
        return []
    # One may be idle since another takes away what would reach it: without both, it reaches on.
    find_alive(flow, idle)
    idle &= idle_items(flow)
    notes = []
    for node in flow.chains:
        for item in node.items:
            if item in idle:
                what = f"{item.kernel.name} at '{item.label}'"
                notes.append(f"left out, since it changes nothing alive: {what}")
        node.items = [item for item in node.items if item not in idle]
    return notes


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


def reduced(whole: Draft, model: str, composing: str, dtype: str) -> Reduction:
    """Return the smallest program that is exact for a path."""
    passes, rounds = passes_for(model, composing, dtype)
    flow, notes = Flow(whole), list[str]()
    for _ in range(rounds):
        done = len(notes)
        for each in passes.values():
            if more := each(flow):
                notes += more
                flow.is_looked_at = False
        if len(notes) == done:
            break
    if not flow.is_looked_at:
        find_alive(flow)
    program = (flow.drafted() if notes else whole).program
    program = replace(program, live=flow.live(changed=bool(notes)))
    folded = tuple(dict.fromkeys(notes))
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


def cheaper_kernels(flow: Flow) -> list[str]:
    """Give each step the cheapest kernel for what is known of its arguments."""
    notes: list[str] = []
    cheapest: dict[int, Operation | None] = {}
    items = chain.from_iterable([node.items for node in flow.chains])
    for item in [item for item in items if item.kernel.has_cheaper]:
        operation = item.operation
        if id(operation) not in cheapest:
            cheapest[id(operation)] = _cheaper(operation)
        if cheaper := cheapest[id(operation)]:
            notes.append(f"cheaper at '{item.label}': {cheaper.kernel.name}")
            item.become(cheaper)
    return notes


def _cheaper(operation: Operation) -> Operation | None:
    kernel: Any = operation.kernel
    cheaper, arguments = kernel.specialised(operation.arguments, _vanishes)
    cheaper = cheaper.never_less(arguments, _span)
    return None if cheaper is kernel else Operation(cheaper, arguments)


def _vanishes(argument: Operand | ResultOf) -> bool:
    if isinstance(argument, ResultOf):
        return False
    number = number_of(argument)
    return vanishes(argument) if number is None else number == 0.0


def _span(argument: Operand | ResultOf) -> tuple[float, float]:
    if isinstance(argument, ResultOf):
        return -inf, inf
    number = number_of(argument)
    return argument.span if number is None else (number, number)


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


@dataclass(eq=False)
class Constant:
    """The numbers of a step, as its structure has them."""

    structure: Structure
    numbers: tuple[float, ...]

    @cached_property
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
        one, other = self.structure.name, later.structure.name
        if one == other == ROTATION.name:
            (c1, s1), (c2, s2) = self.numbers, later.numbers
            return Constant(ROTATION, (c1 * c2 - s1 * s2, s1 * c2 + c1 * s2))
        if one == other == BLOCK.name:
            return _unless_identity(Constant(BLOCK, _blocks(self.numbers, later.numbers)))
        if SCALE.name in (one, other) and {one, other}.isdisjoint([ROTATION.name, JONES.name]):
            scale, scaled = (self, later) if one == SCALE.name else (later, self)
            product = tuple([scale.numbers[0] * number for number in scaled.numbers])
            return _unless_identity(Constant(scaled.structure, product))
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


def multiplied_constants(flow: Flow, *, matrices: bool) -> list[str]:
    """Make neighbouring constants one, in float64."""
    notes: list[str] = []

    def constant_of(item: Item) -> Constant | None:
        structure = item.kernel.structure
        if item.presence is not None or structure is None:
            return None
        numbers = flow.facts.outcome(item.operation)
        return None if numbers is None else Constant(structure, numbers)

    def done_to(items: list[Item]) -> list[Item]:
        results: list[Item] = []
        run: list[tuple[Item, Constant]] = []
        for item in items:
            constant = item.constant
            if constant is False:
                constant = item.constant = constant_of(item)
            if constant is None:
                if run:
                    results += as_one(run)
                    run = []
                results.append(item)
            elif constant.numbers == constant.structure.identity:
                notes.append(f"{item.kernel.name} at '{item.label}' changes nothing")
            elif run and (both := run[-1][1].then(constant)):
                run[-1] = _joined([run[-1][0], item], both, notes), both
            else:
                run.append((item, constant))
        return results + as_one(run)

    def as_one(run: Sequence[tuple[Item, Constant]]) -> list[Item]:
        """Return neighbours as one matrix where that is less work and loses no digit."""
        if len(run) < 2:
            return [item for item, _ in run]
        costs = [_KINDS[constant.structure.name][1] for _, constant in run]
        dear = matrices and sum(costs) > _KINDS[FULL.name][1]
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

    for node in flow.chains:
        node.items = done_to(node.items)
    return notes


def _joined(items: Sequence[Item], constant: Constant, notes: list[str]) -> Item:
    """Return neighbours as one step, and note it."""
    names = [f"{item.kernel.name} at '{item.label}'" for item in items]
    notes.append(f"constant, and multiplied: {' and '.join(names)}")
    kernel = _KINDS[constant.structure.name][0]
    operation = Operation(kernel, tuple(map(Operand, constant.numbers)))
    return Item(label_of(items), operation, once=items[-1].once)


_WORDS = 60
"""How long the name of a step may become that is made of several."""


def label_of(items: Sequence[Item]) -> str:
    """Return the names of steps as one, the first and the last where they would be too long."""
    names = [name for item in items for name in item.label.split(", ")]
    whole = ", ".join(dict.fromkeys(names))
    if len(whole) <= _WORDS:
        return whole
    return f"{names[0].split(' .. ')[0]} .. {names[-1].split(' .. ')[-1]}"


def joined_turns(flow: Flow, *, sums: bool) -> list[str]:
    """Make neighbouring turns one."""
    notes: list[str] = []
    # Equal turns meet in many places.
    known: dict[tuple[int, int, bool], tuple[Operation | None, Operation, Operation]] = {}

    def joined(items: list[Item]) -> list[Item]:
        results: list[Item] = []
        after_turn = False
        for item in items:
            is_turn = _is_turn(item)
            if is_turn and after_turn and len(results[-1].operation.arguments) < _MOST:
                names = dict.fromkeys(f"'{turn.label}'" for turn in (results[-1], item))
                notes.append(f"the turns at {' and '.join(names)} are one")
                first, adds = results.pop(), sums and item.once
                pair = first.operation, item.operation
                key = id(pair[0]), id(pair[1]), adds
                if (one := known.get(key)) is None:
                    one = known[key] = _as_one(*pair, sums=adds), *pair
                if one[0] is not None:
                    results.append(Item(label_of([first, item]), one[0], once=item.once))
                after_turn = bool(results) and _is_turn(results[-1])
            else:
                results.append(item)
                after_turn = is_turn
        return results

    for node in flow.chains:
        turns = [item.kernel is TURN or item.kernel is TURN_BACK for item in node.items]
        if True in map(and_, turns, turns[1:]):
            node.items = joined(node.items)
    return notes


def _is_turn(item: Item) -> bool:
    operation = item.operation
    turns = operation.kernel is TURN or operation.kernel is TURN_BACK
    return (
        turns
        and item.presence is None
        and all(type(argument) is Operand for argument in operation.arguments)
    )


def _as_one(first: Operation, second: Operation, *, sums: bool) -> Operation | None:
    """Return two turns as one, or None if they undo each other."""
    known, left = 0.0, list[Operand]()
    for angle in (*_angles(first), *_angles(second)):
        if sums and (number := number_of(angle)) is not None:
            known += number
            continue
        opposite = _opposite_key(angle)
        undone = [other for other in left if opposite is not None and other.key() == opposite]
        if undone:
            left.remove(undone[0])
        else:
            left.append(angle)
    if known:
        left.append(Operand(known))
    return Operation(TURN, tuple(left)) if left else None


def _opposite_key(angle: Operand) -> Hashable:
    value = angle.value
    if type(value) is Parameter:
        return value.name, -value.scale, -value.offset, angle.part
    return angle.negated().key()


def _angles(turn: Operation) -> list[Operand]:
    angles = turn.arguments
    if turn.kernel is TURN_BACK:
        return [angle.negated() for angle in angles]
    return [*angles]
