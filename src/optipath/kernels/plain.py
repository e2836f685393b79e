"""Light carried as it is: (weak, S1, S2, S3) from step to step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.carried import Carried, Components, add, at_most_polarised, carry, stokes_of

if TYPE_CHECKING:
    from optipath.kernels.primitives import Primitives
    from optipath.kernels.structures import Numbers, Structure


class Plain:
    """The way for short paths, whose light gathers few roundings and does not underflow."""

    def __init__(self, xp: Primitives) -> None:
        self.xp = xp

    def emit(self, stokes: Components) -> Carried:
        """Return the state of emitted light."""
        return carry(self.xp, stokes)

    def act(self, structure: Structure, numbers: Numbers, state: Carried) -> Carried:
        """Return the state behind an element."""
        return structure.made_for(self.xp)(numbers, state)

    def add(self, first: Carried, second: Carried) -> Carried:
        """Return the state of two lights together, incoherently."""
        return add(self.xp, first, second)

    def read(self, state: Carried) -> tuple[Components, Any]:
        """Return the Stokes components, and the exponent of the power of two times them."""
        return stokes_of(self.xp, at_most_polarised(self.xp, state)), 0
