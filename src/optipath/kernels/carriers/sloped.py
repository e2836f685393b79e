"""Kernels with the values of one text and the slopes of another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Factory, KernelFunction, Primitives


@dataclass(frozen=True)
class Sloped:
    """A factory with the slopes of another, which is the same function.

    What loses digits loses those of its slopes, too, and has none where its roots and angles
    have none. A class, so that plans can be pickled.
    """

    values: Factory
    slopes: Factory

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function in terms of these primitives."""
        return (self.slopes if xp.within else self.values)(xp)
