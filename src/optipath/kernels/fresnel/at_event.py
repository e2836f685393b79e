"""What a surface does to light that it reflects on some paths and lets through on others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.fresnel.at_angle import numbers_at
from optipath.kernels.geometry.events import Event

if TYPE_CHECKING:
    from optipath.kernels.carriers.kernel import Kernel
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


@dataclass(frozen=True)
class AtEvent:
    """Makes ``(event, n1, n, [k,] cos, sin) -> (Fs, Fp, B, C, S)`` for an `Event`.

    All of them are NaN where the cosine is.
    """

    reflection: Kernel
    transmission: Kernel

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the kernel in terms of these primitives."""
        where, kernels = xp.where, (self.transmission, self.reflection)
        through, back = (kernel.made_for(xp) for kernel in kernels)

        def at_event(event: Any, *media_and_angle: Any) -> tuple[Any, ...]:
            refracts, is_behind = event == Event.REFRACTS, event == Event.BEHIND
            # Of the same media at the same angle, the two have most of their terms in common.
            pairs = zip(through(*media_and_angle), back(*media_and_angle), strict=True)
            numbers = [where(refracts, one, other) for one, other in pairs]
            numbers = numbers_at(xp, media_and_angle[-2], numbers)
            as_it_is = zip(BLOCK.identity, numbers, strict=True)
            return tuple(where(is_behind, one, number) for one, number in as_it_is)

        return at_event
