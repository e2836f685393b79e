"""Builder: collects leaves, evaluations and steps of a program; equal ones are entered once."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from optipath.program import Evaluation, Program, Reading, Step

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping, Sequence

    from optipath.frames import Frame
    from optipath.kernels import Kernel
    from optipath.vertices import VertexFrame
    from optipath.views import View


class Builder:
    """A program in the making."""

    def __init__(self) -> None:
        self.leaves: list[View] = []
        self.evaluations: list[Evaluation] = []
        self.steps: list[Step] = []
        self._leaf_at: dict[Hashable, int] = {}
        self._evaluation_at: dict[Evaluation, int] = {}

    def program(
        self,
        sources: Mapping[str, tuple[int, Frame | VertexFrame]],
        detectors: Mapping[str, Reading],
        dumps: Mapping[str, Reading],
    ) -> Program:
        """Return what has been collected."""
        collected = tuple(self.leaves), tuple(self.evaluations), tuple(self.steps)
        return Program(*collected, sources, detectors, dumps)

    def instead_of(self, old: Program, moved: Callable[[int], int]) -> Program:
        """Return what has been collected, with the ends of another program.

        Parameters
        ----------
        old : Program
            The program that this one is made of.
        moved : callable
            Gives the new light of an old one.
        """

        def ends(readings: Mapping[str, Reading]) -> dict[str, Reading]:
            return {name: replace(r, light=moved(r.light)) for name, r in readings.items()}

        # In this order, since some lights are made when they are asked for.
        detectors, dumps = ends(old.detectors), ends(old.dumps)
        sources = {name: (moved(at), frame) for name, (at, frame) in old.sources.items()}
        return self.program(sources, detectors, dumps)

    def step(
        self,
        label: str,
        inputs: tuple[int, ...],
        kernel: Kernel,
        views: Sequence[View],
        presence: View | None = None,
    ) -> int:
        """Add a step that does something to light; return the light that it makes."""
        arguments = tuple(map(self._leaf, views))
        there = None if presence is None else self._leaf(presence)
        evaluation = Evaluation(kernel, arguments, there)
        index = self._evaluation_at.setdefault(evaluation, len(self.evaluations))
        if index == len(self.evaluations):
            self.evaluations.append(evaluation)
        self.steps.append(Step(label, inputs, index))
        return len(self.steps) - 1

    def sum(self, label: str, lights: Sequence[int]) -> int:
        """Add the sum of several lights; one alone is itself."""
        if len(lights) == 1:
            return lights[0]
        self.steps.append(Step(label, tuple(lights)))
        return len(self.steps) - 1

    def _leaf(self, view: View) -> int:
        key = view.key()
        index = len(self.leaves) if key is None else self._leaf_at.setdefault(key, len(self.leaves))
        if index == len(self.leaves):
            self.leaves.append(view)
        return index
