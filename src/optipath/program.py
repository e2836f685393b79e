"""Program: a path as an ordered list of steps, ready for an engine.

Nothing here knows a graph or an element. Lights are numbered by the step that
makes them, evaluations and leaves by their place in their lists.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.frames import Frame
    from optipath.kernels import Kernel
    from optipath.vertices import VertexFrame
    from optipath.views import View


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A kernel called on leaves.

    Attributes
    ----------
    kernel : Kernel
        What is computed.
    arguments : tuple of int
        The leaves it is given.
    presence : int or None
        The leaf that says where the element is there at all; None where it always is.
    """

    kernel: Kernel
    arguments: tuple[int, ...]
    presence: int | None = None


@dataclass(frozen=True, slots=True)
class Step:
    """Makes one light: the sum of its inputs, changed by an evaluation.

    Attributes
    ----------
    label : str
        The node and the port where this happens.
    inputs : tuple of int
        The lights that are added up; empty where light is emitted.
    evaluation : int or None
        What is done to the sum; None leaves it as it is.
    """

    label: str
    inputs: tuple[int, ...]
    evaluation: int | None = None


@dataclass(frozen=True)
class Reading:
    """A light that a detector or a dump takes.

    Attributes
    ----------
    light : int
        The step that makes it.
    frame : Frame or VertexFrame
        The frame of the port where it arrives.
    components : int
        How many of the four Stokes components are read.
    """

    light: int
    frame: Frame | VertexFrame
    components: int = 4


@dataclass(frozen=True)
class Program:
    """Everything an engine needs.

    Attributes
    ----------
    leaves : tuple of View
        The numbers that kernels are given, constants and parameters alike.
    evaluations : tuple of Evaluation
        What is computed from the leaves.
    steps : tuple of Step
        In the order of travel.
    sources : mapping of str to (int, frame)
        The emitting step and the frame of each source.
    detectors, dumps : mapping of str to Reading
        Where light ends.
    counts : tuple of int
        How many of (S0, S1, S2, S3) each light is carried by, the first ones; all four where
        it is empty.
    """

    leaves: tuple[View, ...]
    evaluations: tuple[Evaluation, ...]
    steps: tuple[Step, ...]
    sources: Mapping[str, tuple[int, Frame | VertexFrame]]
    detectors: Mapping[str, Reading]
    dumps: Mapping[str, Reading]
    counts: tuple[int, ...] = ()

    def count(self, light: int) -> int:
        """Return by how many components a light is carried."""
        return self.counts[light] if self.counts else 4

    def parts(self, evaluation: int) -> tuple[Kernel, tuple[View, ...], View | None]:
        """Return the kernel of an evaluation, what it is given, and where it is there at all."""
        found = self.evaluations[evaluation]
        there = None if found.presence is None else self.leaves[found.presence]
        return found.kernel, tuple(self.leaves[leaf] for leaf in found.arguments), there

    @cached_property
    def for_powers(self) -> Program | None:
        """The same for intensities alone, or None where more is carried or read."""
        reads = {reading.components for reading in self.readings.values()}
        if not self.counts or max(self.counts) > 2 or reads != {1}:
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
        uses.update(reading.light for reading in self.readings.values())
        return tuple(uses[light] for light in range(len(self.steps)))

    @cached_property
    def evaluation_uses(self) -> tuple[int, ...]:
        """How often each evaluation is needed."""
        uses = Counter(step.evaluation for step in self.steps)
        return tuple(uses[evaluation] for evaluation in range(len(self.evaluations)))

    @cached_property
    def readings(self) -> Mapping[str, Reading]:
        """Where light ends, detectors and dumps together."""
        return {**self.detectors, **self.dumps}
