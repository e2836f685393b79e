"""Carriers: how light is carried from element to element, as Stokes vectors or matrix columns."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.carried import (
    Carried,
    Components,
    add,
    at_most_polarised,
    carry,
    leaving,
    light_of,
    parts_of,
    stokes_of,
)
from optipath.kernels.vanishing import products

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import Parts, SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.primitives import Primitives


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
        return {k: light_of(self.xp, result) for k, result in solver.lights(parts).items()}

    def read(self, state: Carried, count: int = 4) -> tuple[Components, Any]:
        read = at_most_polarised(self.xp, leaving(self.xp, state, count))
        return stokes_of(self.xp, read), 0


class MatrixCarrier(Carrier):
    """Carries columns of Mueller matrices: every element is its matrix, and nothing else.

    >>> from optipath.kernels.carriers.structures import BLOCK
    >>> from optipath.kernels.primitives import FLOAT
    >>> carrier = MatrixCarrier(FLOAT)
    >>> carrier.act(BLOCK, (0.5, 0.25, 0.125, 0.0, 0.0), carrier.emit((0.0, 1.0, 0.0, 0.0)))
    (0.125, 0.375, 0.0, 0.0)
    """

    def emit(self, stokes: Components, count: int = 4) -> Components:
        del count  # All four, whatever is asked for.
        return stokes

    def act(
        self, structure: Structure, numbers: Numbers, state: Components, count: int = 4
    ) -> Components:
        del count
        rows = structure.rows(self.xp, numbers)
        # Entries that a shape of matrix never has are plain zeros.
        first, second, third, fourth = (products(*zip(row, state, strict=True)) for row in rows)
        return first, second, third, fourth

    def add(self, first: Components, second: Components) -> Components:
        s0, s1, s2, s3 = (one + other for one, other in zip(first, second, strict=True))
        return s0, s1, s2, s3

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Components]) -> dict[int, Components]:
        parts = {junction: _parts(s, solver.count(junction)) for junction, s in arriving.items()}
        return {junction: _whole(result) for junction, result in solver.lights(parts).items()}

    def read(self, state: Components, count: int = 4) -> tuple[Components, Any]:
        del count
        return state, 0


def _parts(state: Components, count: int) -> Parts:
    s0, s1, s2, s3 = state
    return (s0,) if count == 1 else (0.5 * (s0 + s1), 0.5 * (s0 - s1), s2, s3)[:count]


def _whole(parts: Parts) -> Components:
    if len(parts) == 1:
        return parts[0], 0.0, 0.0, 0.0
    x, y, s2, s3 = (*parts, 0.0, 0.0)[:4]
    return x + y, x - y, s2, s3
