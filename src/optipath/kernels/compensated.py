"""Fresnel's equations as `stable` has them, in twice the precision, rounded once at the end."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.double_double import DoubleDouble, twice
from optipath.kernels.stable import (
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
    stable_transmission,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.kernel import Factory
    from optipath.kernels.primitives import Primitives


def _compensated(factory: Factory) -> Factory:
    def make(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
        kernel, sqrt = factory(twice(xp)), DoubleDouble.sqrt

        def rounded_once(*given: Any) -> tuple[Any, ...]:
            # Not a plain 0: the rest has the precision of the number.
            *media, c, s = (DoubleDouble(xp, number, 0.0 * number) for number in given)
            # A cosine and a sine that are rounded belong to no angle; their ratio does.
            length = sqrt(c * c + s * s)
            numbers = kernel(*media, c / length, s / length)
            return tuple(n.high if isinstance(n, DoubleDouble) else n for n in numbers)

        return rounded_once

    return make


compensated_reflection = _compensated(stable_reflection)
compensated_transmission = _compensated(stable_transmission)
compensated_lossless_reflection = _compensated(lossless_reflection)
compensated_lossless_transmission = _compensated(lossless_transmission)
