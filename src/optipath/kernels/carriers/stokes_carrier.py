"""Light carried as it is: (weak, S1, S2, S3) from step to step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.carried import (
    Carried,
    Components,
    add,
    at_most_polarised,
    carry,
    leaving,
    stokes_of,
)
from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.carriers.parted import light_of, parts_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.parted import SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure


class StokesCarrier(Carrier):
    """Carries light along short paths, whose light gathers few roundings and does not underflow."""

    def emit(self, stokes: Components, count: int = 4) -> Carried:
        return carry(self.xp, stokes, count)

    def act(
        self, structure: Structure, numbers: Numbers, state: Carried, count: int = 4
    ) -> Carried:
        return structure.made_for(self.xp)(numbers, state, count)

    def add(self, first: Carried, second: Carried) -> Carried:
        return add(self.xp, first, second)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Carried]) -> dict[int, Carried]:
        parts = {k: parts_of(self.xp, state, solver.count(k)) for k, state in arriving.items()}
        return {k: light_of(self.xp, found) for k, found in solver.lights(parts).items()}

    def read(self, state: Carried, count: int = 4) -> tuple[Components, Any]:
        read = at_most_polarised(self.xp, leaving(self.xp, state, count))
        return stokes_of(self.xp, read), 0
