"""Reduction: the smallest program that gives what the detectors read."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from math import inf
from operator import and_
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.composer.flow import Fact, Flow, find_alive, idle_items, number_of, vanishes
from optipath.engines.draft import DraftStep
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
from optipath.values.operands import Operand, Operation, ResultOf, operand_of
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from optipath.engines.draft import Draft
    from optipath.engines.program import Program
    from optipath.kernels.carriers.structures import Structure

    Pass: TypeAlias = Callable[[Flow], list[str]]
    """Changes chains in place, and says what it has done."""


def left_out(flow: Flow) -> list[str]:
    """Take the steps out that do nothing to what is alive."""
    if flow.is_looked_at:  # As it was when nothing was found to be idle.
        return []
    find_alive(flow)
    if not (idle := idle_items(flow)):
        return []
    # One may be idle since another takes away what would reach it: without both, it reaches on.
    find_alive(flow, idle)
    idle &= idle_items(flow)
    notes = []
    for node in flow.chains:
        for item in node.items:
            if id(item) in idle:
                what = f"{item.operation.kernel.name} at '{item.label}'"
                notes.append(f"left out, since it changes nothing alive: {what}")
        node.items = [item for item in node.items if id(item) not in idle]
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
    for step in whole.steps:
        step.fact = None  # As large as the step, and of no use any more.
    program = flow.program() if notes else whole.program
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
    alive = {i for several in {*program.live} for i in several}
    names = [f"S{i}" for i in range(4) if i in alive]
    dead = [f"S{i}" for i in range(4) if f"S{i}" not in names]
    return f"{listed(names)} are alive" + (f", {listed(dead)} nowhere" if dead else "")


def cheaper_kernels(flow: Flow) -> list[str]:
    """Give each step the cheapest kernel for what is known of its arguments."""
    notes: list[str] = []
    cheapest: dict[int, Operation | None] = {}
    for node in flow.chains:
        for place, item in enumerate(node.items):
            operation = item.operation
            if not operation.kernel.has_cheaper:
                continue
            if id(operation) not in cheapest:
                cheapest[id(operation)] = _cheaper(operation)
            if cheaper := cheapest[id(operation)]:
                notes.append(f"cheaper at '{item.label}': {cheaper.kernel.name}")
                node.items[place] = DraftStep(item.label, (), cheaper, item.presence)
    return notes


def _cheaper(operation: Operation) -> Operation | None:
    kernel: Any = operation.kernel
    cheaper, arguments = kernel.specialised(operation.arguments, _vanishes)
    cheaper = cheaper.never_less(arguments, _span)
    return None if cheaper is kernel else Operation(cheaper, arguments)


def _vanishes(argument: Any) -> bool:
    if type(argument) is ResultOf:
        return False
    number = number_of(argument)
    return vanishes(argument) if number is None else number == 0.0


def _span(argument: Any) -> tuple[float, float]:
    if type(argument) is ResultOf:
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


def _product(structure: Structure, numbers: tuple[float, ...]) -> Fact | None:
    """Return a constant, unless its intensity is so faint, or so large, that it might get lost."""
    fact = Fact(Operation(_KINDS[structure.name][0], numbers), numbers)
    return fact if _LEAST < fact.rows[0][0] < 1.0 / _LEAST else None


def in_one(first: Fact, second: Fact) -> Fact | None:
    """Return two constants in the order of travel as one of their sort; None if there is none.

    No digit is lost.
    """
    one, other = first.structure.name, second.structure.name
    if one == other == ROTATION.name:
        (c1, s1), (c2, s2) = first.numbers, second.numbers
        return _product(ROTATION, (c1 * c2 - s1 * s2, s1 * c2 + c1 * s2))
    if one == other == BLOCK.name:
        return _product(BLOCK, _blocks(first.numbers, second.numbers))
    if SCALE.name in (one, other) and {one, other}.isdisjoint([ROTATION.name, JONES.name]):
        scale, scaled = (first, second) if one == SCALE.name else (second, first)
        t = scale.numbers[0]
        return _product(scaled.structure, tuple([t * number for number in scaled.numbers]))
    return None


def multiplied(first: Fact, second: Fact) -> Fact | None:
    """Return two constants in the order of travel as one matrix; None if it is too faint."""
    columns = [*zip(*first.rows, strict=True)]
    rows = second.rows
    entries = [a * e + b * f + c * g + d * h for a, b, c, d in rows for e, f, g, h in columns]
    result = _product(FULL, tuple(entries))
    return result if result and _lets_through(result) else None


def _lets_through(constant: Fact) -> bool:
    """Tell whether no light is nearly extinguished by a constant."""
    if constant.structure is ROTATION:
        return True
    first, *others = constant.rows[0]
    return first - math.hypot(*others) > _EXTINCT * first


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

    def done_to(items: list[DraftStep]) -> list[DraftStep]:
        results: list[DraftStep] = []
        run: list[DraftStep] = []
        for item in items:
            fact = item.fact
            if fact.numbers is None or fact.structure is None or item.presence is not None:
                if run:
                    results += as_one(run)
                    run = []
                results.append(item)
            elif fact.numbers == fact.structure.identity:
                notes.append(f"{item.operation.kernel.name} at '{item.label}' changes nothing")
            elif run and (both := in_one(run[-1].fact, fact)):
                run[-1] = _joined(run[-1], item, both, notes)
            else:
                run.append(item)
        return results + as_one(run) if run else results

    def as_one(run: list[DraftStep]) -> list[DraftStep]:
        """Return neighbours as one matrix where that is less work and loses no digit."""
        if len(run) < 2 or not matrices:
            return run
        cost = sum([_KINDS[item.fact.structure.name][1] for item in run])
        if cost <= _KINDS[FULL.name][1] or not all(_lets_through(item.fact) for item in run):
            return run
        results: list[DraftStep] = []
        for place, item in enumerate(run):
            both = multiplied(results[-1].fact, item.fact) if place % _MOST else None
            if both:
                results[-1] = _joined(results[-1], item, both, notes)
            else:
                results.append(item)
        return results

    flow.look_up()
    for node in flow.chains:
        node.items = done_to(node.items)
    return notes


def _joined(first: DraftStep, second: DraftStep, constant: Fact, notes: list[str]) -> DraftStep:
    """Return neighbours as one step, and note it."""
    one, other = [f"{item.operation.kernel.name} at '{item.label}'" for item in (first, second)]
    notes.append(f"constant, and multiplied: {one} and {other}")
    result = DraftStep(label_of(first, second), (), constant.operation)
    result.fact = constant
    return result


_WORDS = 60
"""How long the name of a step may become that is made of several."""


def label_of(first: DraftStep, second: DraftStep) -> str:
    """Return the names of steps as one, the first and the last where they would be too long."""
    names = [first.label, second.label]
    if ", " in names[0] or ", " in names[1]:
        names = [name for label in names for name in label.split(", ")]
    whole = ", ".join(dict.fromkeys(names))
    if len(whole) <= _WORDS:
        return whole
    return f"{names[0].split(' .. ')[0]} .. {names[-1].split(' .. ')[-1]}"


def joined_turns(flow: Flow, *, sums: bool) -> list[str]:
    """Make neighbouring turns one."""
    notes: list[str] = []
    # Equal turns meet in many places.
    known: dict[tuple[int, int, bool], tuple[Operation | None, Operation, Operation]] = {}

    def one_of(first: DraftStep, item: DraftStep, *, adds: bool) -> DraftStep | None:
        one, other = first.label, item.label
        where = f"'{one}'" if one == other else f"'{one}' and '{other}'"
        notes.append(f"the turns at {where} are one")
        pair = first.operation, item.operation
        key = id(pair[0]), id(pair[1]), adds
        if (both := known.get(key)) is None:
            both = known[key] = _as_one(*pair, sums=adds), *pair
        return None if both[0] is None else DraftStep(label_of(first, item), (), both[0])

    for node in flow.chains:
        turns = [*map(_is_turn, node.items)]
        if True not in map(and_, turns, turns[1:]):
            continue
        results: list[DraftStep] = []
        ahead = None  # The turn that is the last of the results.
        for item, is_turn in zip(node.items, turns, strict=True):
            if is_turn and ahead and len(ahead.operation.arguments) < _MOST:
                results.pop()
                if (ahead := one_of(ahead, item, adds=sums and node.once)) is None:
                    ahead = results[-1] if results and _is_turn(results[-1]) else None
                else:
                    results.append(ahead)
                continue
            results.append(item)
            ahead = item if is_turn else None
        node.items = results
    return notes


def _is_turn(item: DraftStep) -> bool:
    operation = item.operation
    is_turn = operation.kernel is TURN or operation.kernel is TURN_BACK
    if item.presence is not None or not is_turn:
        return False
    return ResultOf not in map(type, operation.arguments)


def _as_one(first: Operation, second: Operation, *, sums: bool) -> Operation | None:
    """Return two turns as one, or None if they undo each other."""
    known = 0.0
    left: list[tuple[Hashable, Operand, bool]] = []
    for turn in (first, second):
        back = turn.kernel is TURN_BACK
        for argument in turn.arguments:
            if sums and (number := number_of(argument)) is not None:
                known += -number if back else number
                continue
            angle = operand_of(argument)
            key, opposite = _keys(angle)
            if back:
                key, opposite = opposite, key
            if undone := [each for each in left if opposite is not None and each[0] == opposite]:
                left.remove(undone[0])
            else:
                left.append((key, angle, back))
    angles = [angle.negated() if back else angle for _, angle, back in left]
    if known:
        angles.append(Operand(known))
    return Operation(TURN, tuple(angles)) if angles else None


def _keys(angle: Operand) -> tuple[Hashable, Hashable]:
    """Return what equal angles share, and what opposite ones do."""
    value, part = angle.value, angle.part
    if isinstance(value, Parameter):
        return angle.key(), (value.name, -value.scale, -value.offset, part)
    return angle.key(), angle.negated().key()
