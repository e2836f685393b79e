"""Program: a path as an ordered list of steps, with its loops, and its execution.

Lights are numbered by the step that makes them, evaluations and operands by their place. Every loop
passes a junction, where lights add up; unit lights sent from each junction along the steps give a
system of equations in the intensities along x and y, S2 and S3 of all junctions.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from math import inf
from operator import and_
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from optipath.kernels.carriers.carried import energy, parts_of, unit_light
from optipath.kernels.carriers.carrier import StokesCarrier
from optipath.kernels.carriers.intensities import IntensityCarrier
from optipath.kernels.carriers.structures import FULL, SCALE
from optipath.kernels.linear_solve import Elimination, is_zero
from optipath.kernels.primitives import not_above_rounding

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from optipath.kernels.carriers.carried import Carried, Components, Parts
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.kernel import Kernel
    from optipath.kernels.primitives import Primitives
    from optipath.values.operands import Operand


class Result(NamedTuple):
    """One of the numbers that an earlier evaluation comes to."""

    evaluation: int
    place: int


class Evaluation(NamedTuple):
    """A kernel called on operands, and on what other evaluations come to."""

    kernel: Kernel
    arguments: tuple[int | Result, ...]
    presence: int | None = None


class Step(NamedTuple):
    """Makes one light: the sum of its inputs, changed by an evaluation."""

    label: str
    inputs: tuple[int, ...]
    evaluation: int | None = None
    port: bool = False
    bounces: int = 0


@dataclass(frozen=True)
class Reading:
    """A light that a detector or a dump takes; its frame is a `Frame` or a `VertexFrame`."""

    light: int
    frame: Any
    components: int = 4


@dataclass(frozen=True, slots=True)
class Loop:
    """Neighbouring steps whose lights depend on each other: a strongly connected component."""

    junctions: tuple[int, ...]
    stop: int
    layered: bool = False

    @property
    def start(self) -> int:
        """The first step."""
        return min(self.junctions)


@dataclass(frozen=True)
class Program:
    """Everything an engine needs."""

    operands: tuple[Operand, ...]
    evaluations: tuple[Evaluation, ...]
    steps: tuple[Step, ...]
    sources: Mapping[str, tuple[int, Any]]
    detectors: Mapping[str, Reading]
    dumps: Mapping[str, Reading]
    counts: tuple[int, ...] = ()
    loops: tuple[Loop, ...] = ()
    links: Mapping[str, Reading] = field(default_factory=dict)
    live: tuple[tuple[int, ...], ...] = ()

    def count(self, light: int) -> int:
        """Return by how many components a light is carried."""
        return self.counts[light] if self.counts else 4

    @cached_property
    def takes(self) -> tuple[tuple[int, ...], ...]:
        """The evaluations whose results each evaluation is given."""
        results = ([a for a in e.arguments if type(a) is Result] for e in self.evaluations)
        return tuple([tuple(dict.fromkeys([r.evaluation for r in several])) for several in results])

    @cached_property
    def passed_to(self) -> tuple[tuple[int, ...], ...]:
        """The operands of each evaluation, and of those whose results it is given."""
        results: list[tuple[int, ...]] = []
        for evaluation, takes in zip(self.evaluations, self.takes, strict=True):
            own = [argument for argument in evaluation.arguments if type(argument) is int]
            behind = [operand for taken in takes for operand in results[taken]]
            results.append(tuple(dict.fromkeys([*own, *behind])))
        return tuple(results)

    @cached_property
    def taken_by_several(self) -> frozenset[int]:
        """The evaluations whose results several others are given."""
        uses = Counter([taken for takes in self.takes for taken in takes])
        return frozenset(taken for taken, count in uses.items() if count > 1)

    @cached_property
    def for_powers(self) -> Program | None:
        """The same for intensities alone, or None where more is carried or read."""
        reads = {reading.components for reading in self.readings.values()}
        if self.loops or not self.counts or max(self.counts) > 2 or reads != {1}:
            return None
        powers = [e._replace(kernel=e.kernel.powers or e.kernel) for e in self.evaluations]
        return replace(self, evaluations=tuple(powers))

    @cached_property
    def light_uses(self) -> tuple[int, ...]:
        """How often each light is read, by a later step or by a detector."""
        uses = Counter([light for step in self.steps for light in step.inputs])
        uses.update(self.times_read)
        return tuple(uses[light] for light in range(len(self.steps)))

    @cached_property
    def times_read(self) -> Mapping[int, int]:
        """How often each light is read at an end, or kept."""
        return Counter([reading.light for reading in self.readings.values()])

    @cached_property
    def evaluation_uses(self) -> tuple[int, ...]:
        """How many steps need each evaluation."""
        uses = Counter([step.evaluation for step in self.steps])
        return tuple(uses[evaluation] for evaluation in range(len(self.evaluations)))

    @cached_property
    def matrices(self) -> Mapping[int, tuple[str, ...]]:
        """The evaluations that are whole Mueller matrices, and the elements that they are of."""
        results: dict[int, tuple[str, ...]] = {}
        for step in self.steps:
            index = step.evaluation
            if index is not None and self.evaluations[index].kernel.structure == FULL:
                results[index] = (*results.get(index, ()), step.label.rpartition(".")[0])
        return results

    @cached_property
    def used_by(self) -> tuple[tuple[int, ...], ...]:
        """Which steps read each light."""
        results: list[list[int]] = [[] for _ in self.steps]
        for light, step in enumerate(self.steps):
            for source in step.inputs:
                results[source].append(light)
        return tuple(map(tuple, results))

    @cached_property
    def readings(self) -> Mapping[str, Reading]:
        """All light that is read: by detectors, by dumps, and on links."""
        return {**self.detectors, **self.dumps, **self.links}


LITTLE = 1e-2
"""What of an unknown does not come back where its sum takes a closer look, as a share."""

_ROUNDING = 1e-9
"""How much light may gain by roundings of what leaves."""


class Column(NamedTuple):
    """What becomes of one unit of light at a junction until it meets other light again."""

    back: dict[int, Parts]
    leaves: Any


@dataclass(eq=False, repr=False)
class LoopSolver:
    """The lights at the junctions of a loop, for any light that arrives there."""

    program: Program
    loop: Loop
    numbers: Callable[[int], Numbers]
    xp: Primitives
    number: Callable[[Any], Any]
    rounded: Callable[[Any], Any] | None = None

    def __post_init__(self) -> None:
        loop = self.loop
        self.carrier = StokesCarrier(self.xp)
        self.unknowns = [
            (junction, part) for junction in loop.junctions for part in range(self.count(junction))
        ]
        self._junctions = frozenset(loop.junctions)
        self._place = {unknown: place for place, unknown in enumerate(self.unknowns)}
        self.found: list[Any] = []

    @cached_property
    def columns(self) -> list[Column]:
        """What becomes of a unit of each unknown."""
        return [self._column(*unknown) for unknown in self.unknowns]

    @cached_property
    def leaves(self) -> list[Any]:
        """What of each unknown leaves the loop."""
        return [self._resolved(column.leaves) for column in self.columns]

    @cached_property
    def _system(self) -> Elimination:
        return Elimination(
            self.xp,
            [self.scattered(column.back) for column in self.columns],
            self.leaves,
            [part < 2 for _, part in self.unknowns],
            None if self.rounded is None else reduce(and_, self.fading(), True),  # noqa: FBT003
        )

    @property
    def pivots(self) -> list[Any]:
        """What of each unknown does not come back, once those before it are eliminated."""
        return self._system.pivots

    def count(self, junction: int) -> int:
        """Return by how many components the light at a junction is carried."""
        return self.program.count(junction)

    def ways(self) -> Iterator[tuple[int, int, list[tuple[Structure, Numbers]]]]:
        """Yield each way from a junction to the next, and what light passes on it."""
        for junction in self.loop.junctions:
            waiting: list[tuple[int, list[tuple[Structure, Numbers]]]] = [(junction, [])]
            while waiting:
                light, passed = waiting.pop()
                for user in self.program.used_by[light]:
                    index, after = self.program.steps[user].evaluation, passed
                    if index is not None:
                        structure: Any = self.program.evaluations[index].kernel.structure
                        after = [*passed, (structure, self.numbers(index))]
                    if user in self._junctions:
                        yield junction, user, after
                    elif self.loop.start <= user < self.loop.stop:
                        waiting.append((user, after))

    def lights(self, arriving: Mapping[int, Parts]) -> dict[int, Parts]:
        """Return the parts of the light at each junction, for those of what arrives at some."""
        argument = self.scattered(arriving)
        result = self._system.solved([argument.get(i, 0.0) for i in range(len(self.unknowns))])
        rounded = self.rounded or self.number
        self.found = [number if is_zero(number) else rounded(number) for number in result]
        lights: dict[int, Parts] = dict.fromkeys(self.loop.junctions, ())
        for (junction, _), number in zip(self.unknowns, self.found, strict=True):
            lights[junction] = (*lights[junction], rounded(number))
        return lights

    @property
    def conditions(self) -> list[Any]:
        """Whether so much of each unknown leaves that nobody needs to look at it."""
        enough = [pivot > LITTLE for pivot in self.pivots if not is_zero(pivot - 1.0)]
        return [*enough, *self.fading(self.pivots)]

    def adds_up(self, slack: float) -> Any:
        """Return whether what has been found is light that can be, but for roundings.

        Where light gains on each round, the sum diverges and the solution of the system is
        unphysical: a physical solution x = b + M x is never less than b + M b + ... + M^n b.
        """
        xp, holds = self.carrier.xp, True
        for junction in self.loop.junctions:
            parts = [
                self.found[self._place[junction, part]] for part in range(self.count(junction))
            ]
            total = sum(parts[:2])
            size = xp.where(total > 0.0, total, 1.0)
            x, *others = (part / size for part in parts)
            y, *across = others or (x,)
            squares = sum(part * part for part in across)
            bright = (x >= -slack) & (y >= -slack) & (squares <= 4.0 * x * y + slack)
            holds = holds & bright & (total < inf)
        return holds

    def fading(self, looked_at: Sequence[Any] = ()) -> list[Any]:
        """Return whether no light at any junction, however polarized, gains on its way to others.

        Of light (x, y, S2, S3), l1 x + l2 y + l3 S2 + l4 S3 leaves; never negative if l3^2 + l4^2
        <= l1 l2.
        """
        results = []
        for junction in self.loop.junctions:
            places = [self._place[junction, part] for part in range(self.count(junction))]
            along, across = places[:2], [self.leaves[place] for place in places[2:]]
            results += [
                self.leaves[place] > -_ROUNDING
                for place in along
                if not any(self.leaves[place] is number for number in looked_at)
            ]
            squares = [leaves * leaves for leaves in across if not is_zero(leaves)]
            if squares:
                most = self.leaves[along[0]] * self.leaves[along[1]] + _ROUNDING
                results.append(sum(squares) <= most)
        return results

    def scattered(self, lights: Mapping[int, Parts]) -> dict[int, Any]:
        """Return the parts of the lights at some junctions by their place among the unknowns."""
        return {
            self._place[junction, part]: self._resolved(number)
            for junction, parts in lights.items()
            for part, number in enumerate(parts)
        }

    def _resolved(self, number: Any) -> Any:
        return 0.0 if is_zero(number) else self.number(number)

    def _column(self, junction: int, part: int) -> Column:
        """Follow a unit of light at a junction to the next ones."""
        column, xp = Column({}, 0.0), self.carrier.xp
        waiting = [(junction, unit_light(part, self.program.count(junction)))]
        while waiting:
            light, state = waiting.pop()
            there = energy(xp, state)
            passed = [there] * self.program.times_read[light]
            leaves = sum(passed, start=column.leaves)
            for user in self.program.used_by[light]:
                after = self._behind(user, state)
                passed.append(energy(xp, after))
                if user in self._junctions:
                    parts = parts_of(xp, after, self.count(user))
                    before = column.back.get(user, (0.0,) * len(parts))
                    sums = (one + other for one, other in zip(before, parts, strict=True))
                    column.back[user] = tuple(sums)
                elif self.loop.start <= user < self.loop.stop:
                    waiting.append((user, after))
                else:
                    leaves = leaves + passed[-1]
            absorbed = there - sum(passed)
            if not self._only_dims(light):
                # What a lossless element seems to absorb is its rounding.
                size = sum(map(xp.absolute, passed), start=xp.absolute(there))
                absorbed = not_above_rounding(xp, absorbed, size)
            column = Column(column.back, leaves + absorbed)
        return column

    def _only_dims(self, light: int) -> bool:
        """Tell whether light goes one way only, and is dimmed there: the difference is exact."""
        users = self.program.used_by[light]
        if len(users) != 1 or self.program.times_read[light]:
            return False
        evaluation = self.program.steps[users[0]].evaluation
        if evaluation is None:
            return False
        return self.program.evaluations[evaluation].kernel.structure is SCALE

    def _behind(self, user: int, state: Carried) -> Carried:
        step, count = self.program.steps[user], self.count(user)
        if step.evaluation is None:
            return state
        structure = self.program.evaluations[step.evaluation].kernel.structure
        assert structure is not None  # noqa: S101 - sources take no light
        return self.carrier.act(structure, self.numbers(step.evaluation), state, count)


Model: TypeAlias = Literal["scalar", "sp", "linear", "full"]
MODELS: tuple[Model, ...] = get_args(Model)
"""What is carried, the smallest first: S0; S0 and S1; S0, S1 and S2; all four."""


@dataclass(frozen=True)
class Reduction:
    """The program that is run, and how it came out of the path as it stands."""

    program: Program
    model: str
    reason: str
    folded: tuple[str, ...] = ()
    unreduced: bool = False

    @property
    def live(self) -> tuple[tuple[int, ...], ...]:
        """For each light of the program, the components that are alive."""
        return self.program.live

    def by(self, model: str) -> Reduction:
        """Return the same carried by another model, exact or not."""
        counts = (MODELS.index(model) + 1,) * len(self.program.steps)
        return replace(self, program=replace(self.program, counts=counts), model=model)


@dataclass(frozen=True)
class Tolerance:
    """What is taken in place of an exact model where a certificate allows it."""

    model: str
    most: float


_SPARE = 2.0**60
"""How far the numbers of a quotient keep from where they lose digits."""


def carrying(
    program: Program, carrier: type[Carrier], xp: Primitives, dtype: str
) -> tuple[Program, Carrier]:
    """Return what is done to light, and its carrier: intensities alone where that will do."""
    if carrier is StokesCarrier and program.for_powers is not None:
        return program.for_powers, IntensityCarrier(xp, float(np.finfo(dtype).tiny) * _SPARE)
    return program, carrier(xp)


def itself(number: Any) -> Any:
    """Return a number as it is."""
    return number


def execute(
    program: Program,
    operands: Sequence[Any],
    carrier: Carrier,
    emitted: Mapping[int, Components] | None = None,
    number: Callable[[Any], Any] = itself,
    shared: Mapping[int, Numbers] | None = None,
    solvers: list[LoopSolver] | None = None,
    meet: Callable[[Loop], LoopSolver] | None = None,
) -> dict[int, tuple[Components, Any]]:
    """Return the light of every reading, as four components and an exponent."""
    reads: dict[int, int] = {}
    for reading in program.readings.values():
        reads[reading.light] = max(reading.components, reads.get(reading.light, 1))
    loops = {loop.start: loop for loop in program.loops}
    states: dict[int, Any] = {}
    states_left = list(program.light_uses)
    numbers: dict[int, Numbers] = dict(shared or {})
    numbers_left = list(program.evaluation_uses)
    results: dict[int, Numbers] = {}

    def numbers_of(index: int) -> Numbers:
        if index not in numbers:
            numbers[index] = evaluated(program, index, operands, carrier, number, results)
        return numbers[index]

    def together(lights: Sequence[int]) -> Any:
        return reduce(carrier.add, [states[light] for light in lights]) if lights else None

    def met(loop: Loop) -> dict[int, Any]:
        """Return the light at the junctions of a loop."""
        solver = meet(loop) if meet else LoopSolver(program, loop, numbers_of, carrier.xp, number)
        if solvers is not None:
            solvers.append(solver)
        steps = [(junction, program.steps[junction]) for junction in loop.junctions]
        outside = {at: [light for light in step.inputs if light < loop.start] for at, step in steps}
        arriving = {at: together(lights) for at, lights in outside.items() if lights}
        return carrier.meet(solver, arriving)

    def behind(light: int) -> Any:
        """Return the light that a step makes."""
        step, count = program.steps[light], program.count(light)
        state = together(step.inputs)
        if step.evaluation is None:
            return state
        numbers = numbers_of(step.evaluation)
        structure = program.evaluations[step.evaluation].kernel.structure
        if structure is None:
            s0, s1, s2, s3 = numbers
            return carrier.emit((s0, s1, s2, s3), count)
        return carrier.act(structure, numbers, state, count)

    for light, step in enumerate(program.steps):
        if light in loops:
            states |= met(loops[light])
        if emitted is not None and light in emitted:
            states[light] = carrier.emit(emitted[light], program.count(light))
        # In a loop, some light is of use to the junctions alone, and they are known.
        elif light not in states and states_left[light]:
            states[light] = behind(light)
        if step.evaluation is not None:
            numbers_left[step.evaluation] -= 1
            if not numbers_left[step.evaluation]:
                numbers.pop(step.evaluation, None)
        for source in step.inputs:
            states_left[source] -= 1
            if not states_left[source]:
                states.pop(source, None)
    return {light: carrier.read(states[light], count) for light, count in reads.items()}


def whole_matrices(
    program: Program,
    operands: Sequence[Any],
    carrier: Carrier,
    number: Callable[[Any], Any] = itself,
) -> dict[int, tuple[Any, ...]]:
    """Return the values of evaluations of whole Mueller matrices, which `execute` may take."""
    return {i: evaluated(program, i, operands, carrier, number) for i in program.matrices}


def evaluated(
    program: Program,
    index: int,
    operands: Sequence[Any],
    carrier: Carrier,
    number: Callable[[Any], Any] = itself,
    results: dict[int, Numbers] | None = None,
) -> tuple[Any, ...]:
    """Return the numbers that an evaluation comes to."""
    results = {} if results is None else results
    evaluation, takes = program.evaluations[index], program.takes[index]
    for taken in takes:
        if taken not in results:
            results[taken] = evaluated(program, taken, operands, carrier, results=results)
    arguments = [
        results[argument.evaluation][argument.place]
        if type(argument) is Result
        else operands[argument]  # type: ignore[index]
        for argument in evaluation.arguments
    ]
    for taken in takes:
        if taken not in program.taken_by_several:
            del results[taken]
    kernel, left = evaluation.kernel.specialised(arguments, is_zero)
    numbers = carrier.evaluated(kernel, left)
    structure = evaluation.kernel.structure
    if evaluation.presence is not None and structure is not None:
        present, where = operands[evaluation.presence], carrier.xp.where
        pairs = zip(numbers, structure.identity, strict=True)
        numbers = tuple([where(present, its, nothing) for its, nothing in pairs])
    return tuple(map(number, numbers))
