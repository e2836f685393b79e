"""Kernels of one argument less, which is 0."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Factory, KernelFunction, Primitives


@dataclass(frozen=True)
class WithZero:
    """Makes a kernel without the argument at one place; a class, so that plans can be pickled."""

    factory: Factory
    place: int

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Make the kernel in terms of these primitives."""
        kernel, place = self.factory(xp), self.place

        def with_zero(*given: Any) -> tuple[Any, ...]:
            # Not a plain 0: its precision is that of the others.
            return kernel(*given[:place], 0.0 * given[0], *given[place:])

        return with_zero
