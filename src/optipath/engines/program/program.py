"""Program: a path as an ordered list of steps, ready for an engine.

Nothing here knows a graph or an element. Lights are numbered by the step that
makes them, evaluations and operands by their place in their lists.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.carriers.structures import FULL
from optipath.values.operation import Operation, ResultOf

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.kernels.carriers.kernel import Kernel
    from optipath.values.operands import Operand


class Result(NamedTuple):
    """One of the numbers that an earlier evaluation comes to."""

    evaluation: int
    place: int


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A kernel called on operands, and on what other evaluations come to."""

    kernel: Kernel
    arguments: tuple[int | Result, ...]
    presence: int | None = None


@dataclass(frozen=True, slots=True)
class Step:
    """Makes one light: the sum of its inputs, changed by an evaluation."""

    label: str
    inputs: tuple[int, ...]
    evaluation: int | None = None
    port: bool = False
    bounces: int = 0


@dataclass(frozen=True)
class Reading:
    """A light that a detector or a dump takes.

    Its frame is a `Frame`, or what gives one by the values of a run (`elements`' `VertexFrame`).
    """

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
    def operations(self) -> tuple[Operation, ...]:
        """The evaluations as operations of operands."""
        found: list[Operation] = []
        for evaluation in self.evaluations:
            arguments = [
                ResultOf(found[argument.evaluation], argument.place)
                if type(argument) is Result
                else self.operands[argument]  # type: ignore[index]
                for argument in evaluation.arguments
            ]
            found.append(Operation(evaluation.kernel, tuple(arguments)))
        return tuple(found)

    def presence(self, evaluation: int) -> Operand | None:
        """Return the operand that says where the element of an evaluation is there at all."""
        place = self.evaluations[evaluation].presence
        return None if place is None else self.operands[place]

    @cached_property
    def takes(self) -> tuple[tuple[int, ...], ...]:
        """The evaluations whose results each evaluation is given."""
        results = ([a for a in e.arguments if type(a) is Result] for e in self.evaluations)
        return tuple([tuple(dict.fromkeys([r.evaluation for r in several])) for several in results])

    @cached_property
    def given_to(self) -> tuple[tuple[int, ...], ...]:
        """The operands of each evaluation, and of those whose results it is given."""
        found: list[tuple[int, ...]] = []
        for evaluation, takes in zip(self.evaluations, self.takes, strict=True):
            own = [argument for argument in evaluation.arguments if type(argument) is int]
            behind = [operand for taken in takes for operand in found[taken]]
            found.append(tuple(dict.fromkeys([*own, *behind])))
        return tuple(found)

    @cached_property
    def taken_by_several(self) -> frozenset[int]:
        """The evaluations whose results several others are given."""
        uses = Counter(taken for takes in self.takes for taken in takes)
        return frozenset(taken for taken, count in uses.items() if count > 1)

    @cached_property
    def for_powers(self) -> Program | None:
        """The same for intensities alone, or None where more is carried or read."""
        reads = {reading.components for reading in self.readings.values()}
        if self.loops or not self.counts or max(self.counts) > 2 or reads != {1}:
            return None
        kernels = [evaluation.kernel.powers or evaluation.kernel for evaluation in self.evaluations]
        evaluations = (
            replace(evaluation, kernel=kernel)
            for evaluation, kernel in zip(self.evaluations, kernels, strict=True)
        )
        return replace(self, evaluations=tuple(evaluations))

    @cached_property
    def light_uses(self) -> tuple[int, ...]:
        """How often each light is read, by a later step or by a detector."""
        uses = Counter(light for step in self.steps for light in step.inputs)
        uses.update(self.times_read)
        return tuple(uses[light] for light in range(len(self.steps)))

    @cached_property
    def times_read(self) -> Mapping[int, int]:
        """How often each light is read at an end, or kept."""
        return Counter(reading.light for reading in self.readings.values())

    @cached_property
    def evaluation_uses(self) -> tuple[int, ...]:
        """How many steps need each evaluation."""
        uses = Counter(step.evaluation for step in self.steps)
        return tuple(uses[evaluation] for evaluation in range(len(self.evaluations)))

    @cached_property
    def matrices(self) -> Mapping[int, tuple[str, ...]]:
        """The evaluations that are whole Mueller matrices, and the elements that they are of."""
        found: dict[int, tuple[str, ...]] = {}
        for step in self.steps:
            index = step.evaluation
            if index is not None and self.evaluations[index].kernel.structure == FULL:
                found[index] = (*found.get(index, ()), step.label.rpartition(".")[0])
        return found

    def stretches(self) -> Iterator[tuple[range, Loop | None]]:
        """Yield the steps in order, those of a loop together and with it."""
        done = 0
        for loop in self.loops:
            yield range(done, loop.start), None
            yield range(loop.start, loop.stop), loop
            done = loop.stop
        yield range(done, len(self.steps)), None

    @cached_property
    def used_by(self) -> tuple[tuple[int, ...], ...]:
        """Which steps read each light."""
        found: list[list[int]] = [[] for _ in self.steps]
        for light, step in enumerate(self.steps):
            for source in step.inputs:
                found[source].append(light)
        return tuple(map(tuple, found))

    @cached_property
    def readings(self) -> Mapping[str, Reading]:
        """All light that is read: by detectors, by dumps, and on links."""
        return {**self.detectors, **self.dumps, **self.links}
