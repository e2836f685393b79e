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
from optipath.kernels.carriers.parted import light_of, parts_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.parted import SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.numbers.primitives import Primitives


class StokesCarrier:
    """Carries light along short paths, whose light gathers few roundings and does not underflow."""

    def __init__(self, xp: Primitives) -> None:
        self.xp = xp

    def emit(self, stokes: Components, count: int = 4) -> Carried:
        """Return the state of emitted light, the first components alone."""
        return carry(self.xp, stokes, count)

    def act(
        self, structure: Structure, numbers: Numbers, state: Carried, count: int = 4
    ) -> Carried:
        """Return the state behind an element, the first components alone."""
        return structure.made_for(self.xp)(numbers, state, count)

    def add(self, first: Carried, second: Carried) -> Carried:
        """Return the state of two lights together, incoherently."""
        return add(self.xp, first, second)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Carried]) -> dict[int, Carried]:
        """Return the states at the junctions of a loop, for those that arrive at some."""
        parts = {k: parts_of(self.xp, state, solver.count(k)) for k, state in arriving.items()}
        return {
            junction: light_of(self.xp, found) for junction, found in solver.lights(parts).items()
        }

    def read(self, state: Carried, count: int = 4) -> tuple[Components, Any]:
        """Return the first components, and the exponent of the power of two times them."""
        read = at_most_polarised(self.xp, leaving(self.xp, state, count))
        return stokes_of(self.xp, read), 0
