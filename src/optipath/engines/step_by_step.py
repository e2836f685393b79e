"""A carrier whose light XLA takes through one element after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.carrier import Carrier

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.parted import SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure


class StepByStep(Carrier):
    """Carries light as another carrier does, each element a piece of its own.

    Each component of light enters all those behind an element: in one piece, XLA computes the
    light in front again for each of them, which is 10^9 times for a filter of four plates.
    """

    def __init__(self, carrier: Carrier) -> None:
        super().__init__(carrier.xp)
        self._carrier = carrier

    def emit(self, stokes: Components, count: int = 4) -> Any:
        return self._carrier.emit(stokes, count)

    def act(self, structure: Structure, numbers: Numbers, state: Any, count: int = 4) -> Any:
        def through(numbers: Numbers, state: Any) -> Any:
            return self._carrier.act(structure, numbers, state, count)

        return self.xp.apart(through)(tuple(numbers), state)

    def add(self, first: Any, second: Any) -> Any:
        return self._carrier.add(first, second)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Any]) -> dict[int, Any]:
        return self._carrier.meet(solver, arriving)

    def read(self, state: Any, count: int = 4) -> tuple[Components, Any]:
        return self._carrier.read(state, count)
