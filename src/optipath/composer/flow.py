"""Flow: a draft as chains of steps that a reduction changes in place, and what is alive in it.

Components of light are bits of a mask: S0 is 1, S1 is 2, S2 is 4 and S3 is 8.
"""

from __future__ import annotations

from collections import Counter
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache, reduce
from math import isfinite
from operator import ne, or_
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.engines.draft import SharedSteps
from optipath.kernels.kernel import Entry
from optipath.kernels.primitives import FLOAT, FLOAT_ARRAYS, is_below_rounding
from optipath.values.operands import Operand, ResultOf

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Iterator, Sequence
    from collections.abc import Set as AbstractSet

    from optipath.engines.draft import Draft, DraftStep
    from optipath.engines.program import Program
    from optipath.kernels.carriers.structures import Structure
    from optipath.kernels.kernel import Kernel
    from optipath.kernels.primitives import KernelFunction
    from optipath.values.operands import Operation


class LightNode:
    """A light: of a source, a sum of others (which has a label), or another one behind items.

    `reached` and `needed` have the components of the light before each item and behind the last.
    """

    __slots__ = (
        "inputs", "is_junction", "items", "label", "light", "needed", "once", "placed",
        "reached", "reads", "source", "users",
    )  # fmt: skip

    def __init__(
        self,
        inputs: list[LightNode],
        items: list[DraftStep],
        label: str = "",
        source: DraftStep | None = None,
        *,
        once: bool = True,
        is_junction: bool = False,
    ) -> None:
        self.inputs = inputs
        self.items = items
        self.label = label
        self.source = source
        self.once = once  # In no loop.
        self.is_junction = is_junction
        self.placed = False
        self.users: list[LightNode] = []
        self.reads = 0
        self.light = -1
        self.reached: list[int] = [0]
        self.needed: list[int] = [0]


ENDS = ("detectors", "dumps", "links")
"""What reads light."""


class Flow:
    """A draft whose steps stand in chains, the light of each used by the next alone."""

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        self.facts = Facts(draft)
        self.is_looked_at = False  # Whether the masks of all nodes are as they should be.
        # The nodes in the order in which their lights are made; junctions, where a loop ends.
        self.order: list[LightNode | tuple[LightNode, ...]] = []
        # Of each light of the draft: the node, and behind how many of its items it is.
        self.places: list[tuple[LightNode, int]] = []
        readings = [reading for which in ENDS for reading in draft.ends[which].values()]
        self._uses = Counter([light for step in draft.steps for light in step.inputs])
        self._uses.update([reading.light for reading in readings])
        self._add_all()
        for reading in readings:
            self._made(reading.light).reads |= (1 << reading.components) - 1
        for light, _ in draft.ends["sources"].values():
            self._made(light)
        for node in self.nodes:
            for before in node.inputs:
                before.users.append(node)

    def _add_all(self) -> None:
        steps, done = self.draft.steps, 0
        for junctions, stop in self.draft.loops:
            start = min(junctions)
            for step in steps[done:start]:
                self._add(step)
            # What enters a loop is there before, since its steps stand together.
            for step in steps[start:stop]:
                for light in step.inputs:
                    if light < start:
                        self._made(light)
            for junction in sorted(junctions):
                self._begin(LightNode([], [], steps[junction].label, is_junction=True))
            for step in steps[start + len(junctions) : stop]:
                self._add(step, once=False)
            for junction in junctions:
                lights = steps[junction].inputs
                self.places[junction][0].inputs = [self._made(light) for light in lights]
            self.order.append(tuple([self.places[junction][0] for junction in junctions]))
            done = stop
        for step in steps[done:]:
            self._add(step)

    @property
    def nodes(self) -> Iterator[LightNode]:
        """The nodes in order."""
        return (node for node in self.order if isinstance(node, LightNode))

    @property
    def chains(self) -> Iterator[LightNode]:
        """The nodes that have items."""
        return (node for node in self.nodes if node.items)

    def look_up(self) -> None:
        """Find what is known of the operations of all items."""
        self.facts.look_up([i for node in self.chains for i in node.items if i.fact is None])

    def program(self) -> Program:
        """Return the program that has been made of the draft."""
        made = SharedSteps()
        for node in self.order:
            if isinstance(node, tuple):
                made.close({at.light: [each.light for each in at.inputs] for at in node})
            elif node.source is not None:
                node.light = made.share(node.source, ())
            elif node.label:
                inputs = [] if node.is_junction else node.inputs
                node.light = made.sum(node.label, [each.light for each in inputs])
            else:
                light = node.inputs[0].light
                for item in node.items:
                    light = made.share(item, (light,))
                node.light = light
        ends: dict[str, Any] = {}
        for which in ENDS:
            readings = self.draft.ends[which].items()
            ends[which] = {n: replace(r, light=self._light_of(r.light)) for n, r in readings}
        sources = self.draft.ends["sources"].items()
        ends["sources"] = {n: (self._light_of(at), frame) for n, (at, frame) in sources}
        return made.program(ends)

    def live(self, *, changed: bool) -> tuple[tuple[int, ...], ...]:
        """Return for each light the components that are alive, of the draft it is, or was."""
        if not changed:
            pairs = [(n.reached[at] & n.needed[at]) if n.placed else 0 for n, at in self.places]
            return tuple([COMPONENTS[mask] for mask in pairs])
        results: list[tuple[int, ...]] = []
        for node in self.nodes:
            is_chain = node.source is None and not node.label
            alive = zip(node.reached[is_chain:], node.needed[is_chain:], strict=True)
            results += [COMPONENTS[reached & needed] for reached, needed in alive]
        return tuple(results)

    def _light_of(self, light: int) -> int:
        return self.places[light][0].light

    def _begin(self, node: LightNode) -> None:
        node.placed = True
        self.order.append(node)
        self.places.append((node, 0))

    def _add(self, step: DraftStep, *, once: bool = True) -> None:
        if step.operation is None:
            self._begin(LightNode([self._made(light) for light in step.inputs], [], step.label))
            return
        if not step.inputs:
            self._begin(LightNode([], [], source=step))
            return
        (before,) = step.inputs
        node, _ = self.places[before]
        if self._uses[before] > 1 or not node.items:
            node = LightNode([self._made(before)], [], once=once)
        node.items.append(step)
        self.places.append((node, len(node.items)))

    def _made(self, light: int) -> LightNode:
        """Return the node of a light, which is used from here on."""
        node = self.places[light][0]
        if not node.placed:
            node.placed = True
            self.order.append(node)
        return node


_ALL = 15

COMPONENTS = tuple(
    tuple([place for place in range(4) if (mask | 1) >> place & 1]) for mask in range(16)
)
"""The components in each mask; an intensity is always alive."""


def find_alive(flow: Flow, doubtful: AbstractSet[int] = frozenset()) -> None:
    """Find what of each light is reached from the sources, and needed by what is read.

    Of doubtful items (by their id), which may be taken out, light that arrives reaches on as well.
    """
    nodes, facts, flow.is_looked_at = list(flow.nodes), flow.facts, not doubtful
    for node in nodes:
        for item in node.items:
            if item.action is None:
                item.action = facts.action(item)
        node.reached, node.needed = [0], [0]
    # The last one first, and again those behind one at which more has been found.
    waiting = dict.fromkeys(reversed(nodes))
    while waiting:
        node, _ = waiting.popitem()
        before, last = node.reached, 0
        if node.source is not None:
            last = facts.action(node.source).forward[_ALL]
        for each in node.inputs:
            last |= each.reached[-1]
        results = [last]
        for item in node.items:
            last = item.action.forward[last] | (last if doubtful and id(item) in doubtful else 0)
            results.append(last)
        node.reached = results
        if last != before[-1]:
            waiting |= dict.fromkeys(node.users)
    waiting = dict.fromkeys(nodes)
    while waiting:
        node, _ = waiting.popitem()
        before, first = node.needed, node.reads
        for user in node.users:
            first |= user.needed[0]
        results = [first]
        for item in reversed(node.items):
            first = item.action.backward[first]
            results.append(first)
        node.needed = results[::-1]
        if first != before[0]:
            waiting |= dict.fromkeys(node.inputs)


def idle_items(flow: Flow) -> set[int]:
    """Return the items (by their id) that each leave everything as it is that is alive."""
    return {
        id(item)
        for node in flow.chains
        for item, before, behind in zip(node.items, node.reached, node.needed[1:], strict=False)
        if not item.action.changes[behind | 1] & before
    }


class Action(NamedTuple):
    """What a step makes of components, by masks: 16 masks each.

    Which are reached where some arrive, which are needed for some of those behind it, and by which
    of those that arrive it may change some.
    """

    forward: tuple[int, ...]
    backward: tuple[int, ...]
    changes: tuple[int, ...]


Entries: TypeAlias = tuple[tuple[Entry, ...], ...]
"""Four rows of a matrix, or one row of what a source emits."""

_IDENTITY: Entries = tuple(tuple(float(row == column) for column in range(4)) for row in range(4))


def _action_of(entries: Entries) -> Action:
    # What a source emits is made of nothing that arrives, and there if it is not 0.
    rows = [[entry] * 4 for entry in entries[0]] if len(entries) == 1 else entries
    made_of = [_mask([entry != 0.0 for entry in row]) for row in rows]
    pairs = zip(rows, _IDENTITY, strict=True)
    changed = [_mask(map(ne, row, of_none)) for row, of_none in pairs]
    masks = range(16)
    forward = [_mask(bool(columns & mask) for columns in made_of) for mask in masks]
    every = [[made_of[i] for i in range(4) if mask >> i & 1] for mask in masks]
    moved = [[changed[i] for i in range(4) if mask >> i & 1] for mask in masks]
    backward, changes = ([reduce(or_, several, 0) for several in each] for each in (every, moved))
    return Action(tuple(forward), tuple(backward), tuple(changes))


def _mask(signs: Any) -> int:
    return sum([bool(sign) << place for place, sign in enumerate(signs)])


_zero_or_one = dict[Entry, Entry]({0.0: 0.0, 1.0: 1.0}).get
"""Which number it is seldom matters, but for these two."""


class Fact:
    """What is known of an operation before a program runs: the numbers it comes to, if any.

    `actions` are those of a step that is always there, and of one that may be absent.
    """

    __slots__ = ("_rows", "actions", "numbers", "operation", "structure")

    def __init__(self, operation: Operation, numbers: tuple[float, ...] | None) -> None:
        kernel: Any = operation.kernel
        self.operation = operation
        self.structure = kernel.structure
        self.numbers: Any = numbers
        self.actions: tuple[Action | None, Action | None] = (None, None)
        self._rows: Any = None

    @property
    def rows(self) -> Sequence[tuple[float, ...]]:
        """The matrix of what is known."""
        if self._rows is None:
            self._rows = self.structure.rows(FLOAT, self.numbers)
        return self._rows  # type: ignore[no-any-return]


class Facts:
    """What is known of the operations of a program before it runs, each looked at once.

    In a loop no number is known: in twice the digits, what floats give as 0 or 1 may be neither.
    """

    def __init__(self, draft: Draft) -> None:
        self._closed = bool(draft.loops)
        # By their numbers; each keeps its operation, so that no others get these.
        self._known: dict[int, Fact] = {}
        self._zeros: dict[Hashable, tuple[bool, Operand]] = {}

    def look_up(self, items: Iterable[DraftStep]) -> None:
        """Find what is known of the operations of items; those of one kernel together."""
        known, waiting = self._known, dict[int, Fact]()
        alike: dict[int, list[tuple[Fact, Sequence[float]]]] = {}
        for item in items:
            operation = item.operation
            fact = known.get(id(operation)) or waiting.get(id(operation))
            if fact is None:
                fact = waiting[id(operation)] = Fact(operation, None)
                if (numbers := self._numbers(operation)) is not None:
                    alike.setdefault(id(operation.kernel), []).append((fact, numbers))
            item.fact = fact
        for several in alike.values():
            outcomes = evaluated(several[0][0].operation.kernel, [row for _, row in several])
            for (fact, _), outcome in zip(several, outcomes, strict=True):
                fact.numbers = outcome
        known.update(waiting)

    def of(self, operation: Operation) -> Fact:
        """Return what is known of an operation."""
        if (fact := self._known.get(id(operation))) is None:
            numbers = self._numbers(operation)
            outcome = None if numbers is None else evaluated(operation.kernel, [numbers])[0]
            fact = self._known[id(operation)] = Fact(operation, outcome)
        return fact

    def action(self, item: DraftStep) -> Action:
        """Return what a step makes of components."""
        fact, may_be_absent = item.fact or self.of(item.operation), item.presence is not None
        if (action := fact.actions[may_be_absent]) is None:
            kernel = item.operation.kernel
            if fact.numbers is None:
                action = _of_kernel(kernel, self._signs(item.operation), may_be_absent)
            else:
                signs = tuple(map(_zero_or_one, fact.numbers))
                action = _of_numbers(kernel.structure, signs, may_be_absent)
            always, absent = fact.actions
            fact.actions = (always, action) if may_be_absent else (action, absent)
        return action

    def _numbers(self, operation: Operation) -> Sequence[float] | None:
        """Return the numbers that an operation is given, if all are known."""
        if self._closed:
            return None
        if operation.is_of_floats:
            return operation.arguments
        numbers: list[float] = []
        for argument in operation.arguments:
            if type(argument) is ResultOf:
                results = self.of(argument.operation).numbers
                number = None if results is None else results[argument.place]
            else:
                number = number_of(argument)
            if number is None:
                return None
            numbers.append(number)
        return numbers

    def _signs(self, operation: Operation) -> tuple[Entry, ...]:
        """Return which arguments are 0, and which 1, as far as that is known."""
        signs: list[Entry] = []
        for argument in operation.arguments:
            if type(argument) is ResultOf:
                inner, place = argument.operation, argument.place
                kernel: Any = inner.kernel
                row = self.of(inner).numbers or _open_numbers(kernel, self._signs(inner))
                signs.append(_zero_or_one(row[place] if place < len(row) else None))
            elif (number := number_of(argument)) is None and self._vanishes(argument):
                signs.append(0.0)
            else:
                signs.append(_zero_or_one(number))
        return tuple(signs)

    def _vanishes(self, operand: Operand) -> bool:
        """Tell whether an operand is known to be 0; large arrays are looked at once."""
        if type(operand.value) is not np.ndarray:
            return vanishes(operand)
        key = id(operand.value), operand.part, operand.tail
        if key not in self._zeros:
            self._zeros[key] = vanishes(operand), operand
        return self._zeros[key][0]


@lru_cache(1024)
def _of_numbers(
    structure: Structure | None,
    numbers: tuple[Entry, ...],
    may_be_absent: bool,  # noqa: FBT001 - a part of the key
) -> Action:
    """Return the action of a step that comes to numbers, as far as these are known."""
    if structure is None:
        return _action_of((numbers or (None,) * 4,))
    rows = structure.known_rows(numbers)
    if may_be_absent:
        pairs = zip(rows, _IDENTITY, strict=True)
        rows = tuple([tuple(map(_same_or_none, row, of_none)) for row, of_none in pairs])
    return _action_of(rows)


def _same_or_none(entry: Entry, usual: Entry) -> Entry:
    return entry if entry == usual else None


@lru_cache(1024)
def _of_kernel(kernel: Kernel, signs: tuple[Entry, ...], may_be_absent: bool) -> Action:  # noqa: FBT001
    return _of_numbers(kernel.structure, _open_numbers(kernel, signs), may_be_absent)


def _open_numbers(kernel: Kernel, signs: tuple[Entry, ...]) -> tuple[Entry, ...]:
    """Return what a kernel declares of its numbers, for arguments that are 0 or 1."""
    outcome = None if None in signs else evaluated(kernel, [signs])[0]
    if outcome is None:
        zeros = {place for place, number in enumerate(signs) if number == 0.0}
        return kernel.known_numbers(zeros, len(signs))
    return tuple([number if isfinite(number) else None for number in outcome])


_MANY = 16
"""From how many on operations are evaluated together."""


def evaluated(kernel: Any, rows: list[Any]) -> list[tuple[float, ...] | None]:
    """Return what a kernel makes of each row of numbers, many together with the bits of floats."""
    if len(rows) >= _MANY and kernel.is_built_in:
        with suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
            results = kernel.made_for(FLOAT_ARRAYS)(*np.array(rows).T)
            numbers = np.array([np.broadcast_to(each, len(rows)) for each in results])
            if np.isfinite(numbers).all():
                return [*zip(*numbers.tolist(), strict=True)]
    outcomes: list[tuple[float, ...] | None] = []
    for row in rows:
        try:
            outcomes.append(tuple(map(float, _of_floats(kernel)(*row))))
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            outcomes.append(None)
    return outcomes


@lru_cache(256)
def _of_floats(kernel: Kernel) -> KernelFunction:
    return kernel.made_for(FLOAT)


def number_of(operand: Any) -> float | None:
    """Return the one real number that an argument is known to be; None for all else."""
    if type(operand) is float:
        return operand
    value, part = operand.value, operand.part
    if type(value) is float:
        if part in ("value", "real"):
            return value
        if part in ("cos", "sin"):
            number = float(np.cos(value) if part == "cos" else np.sin(value))
            return 0.0 if is_below_rounding(value, number) else number
    if not operand.known or operand.traced or part == "present":
        return None
    numbers = operand.numbers()
    return None if numbers.ndim or numbers.dtype.kind == "c" else float(numbers)


def vanishes(operand: Operand) -> bool:
    """Tell whether an operand is known to be 0, for every path."""
    if not operand.known or operand.traced:
        return False
    numbers = operand.numbers()
    # Of most arrays the first numbers tell.
    return not np.any(numbers[:64] if numbers.ndim else numbers) and not np.any(numbers)
