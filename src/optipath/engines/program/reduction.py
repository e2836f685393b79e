"""Reduction: what is left of a path when no more is done than the question needs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from optipath.engines.program.program import Program

MODELS = ("scalar", "sp", "linear", "full")
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
