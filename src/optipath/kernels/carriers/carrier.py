"""The contract of a carrier: how light is carried from element to element along a path."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.parted import SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.numbers.primitives import Primitives


class Carrier(ABC):
    """How light is carried: as a state, which nobody but the carrier looks into."""

    def __init__(self, xp: Primitives) -> None:
        self.xp = xp

    @abstractmethod
    def emit(self, stokes: Components, count: int = 4) -> Any:
        """Return the state of emitted light."""

    @abstractmethod
    def act(self, structure: Structure, numbers: Numbers, state: Any, count: int = 4) -> Any:
        """Return the state behind an element."""

    @abstractmethod
    def add(self, first: Any, second: Any) -> Any:
        """Return the state of two lights together, incoherently."""

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Any]) -> dict[int, Any]:
        """Return the states at the junctions of a loop; not every carrier goes through loops."""
        raise NotImplementedError(f"{type(self).__name__} carries no light through loops")

    @abstractmethod
    def read(self, state: Any, count: int = 4) -> tuple[Components, Any]:
        """Return the Stokes components, and the exponent of the power of two times them."""
