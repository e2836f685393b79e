"""Kernels of an angle in twice the precision, rounded once at the end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.twice import twice

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import Factory, KernelFunction, Primitives


@dataclass(frozen=True)
class Compensated:
    """Makes a kernel in twice the precision; a class, so that plans can be pickled."""

    factory: Factory

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Make the kernel, which rounds what it returns once."""
        kernel, sqrt = self.factory(twice(xp)), DoubleDouble.sqrt

        def rounded_once(*given: Any) -> tuple[Any, ...]:
            # Not a plain 0: the rest has the precision of the number.
            *media, c, s = (DoubleDouble(xp, number, 0.0 * number) for number in given)
            # A cosine and a sine that are rounded belong to no angle; their ratio does.
            length = sqrt(c * c + s * s)
            numbers = kernel(*media, c / length, s / length)
            return tuple(n.high if isinstance(n, DoubleDouble) else n for n in numbers)

        return rounded_once
