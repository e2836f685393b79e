"""What a surface does to light that it reflects on some paths and lets through on others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.geometry.events import Event
from optipath.kernels.numbers.elimination import is_zero

if TYPE_CHECKING:
    from optipath.kernels.carriers.kernel import Kernel
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


@dataclass(frozen=True)
class AtEvent:
    """Makes ``(event, n1, n, [k,] cos, sin) -> (Fs, Fp, B, C, S)`` for an `Event`.

    Attributes
    ----------
    reflection, transmission : Kernel
        Of one boundary. What is let through goes on in a medium without absorption.
    """

    reflection: Kernel
    transmission: Kernel

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the kernel in terms of these primitives."""
        where, reflected = xp.where, self.reflection.made_for(xp)

        def at_event(event: Any, *media_and_angle: Any) -> tuple[Any, ...]:
            *media, c, s = media_and_angle
            n1, n = media[:2]
            refracts, is_behind = event == Event.REFRACTS, event == Event.BEHIND
            # Each is given what it keeps its slopes at, where the other is wanted.
            back = reflected(*media, where(refracts, 1.0, c), where(refracts, 0.0, s))
            m, c, s = (where(refracts, *two) for two in ((n, n1), (c, 1.0), (s, 0.0)))
            kernel, given = self.transmission.specialised((n1, m, 0.0, c, s), is_zero)
            on = kernel.made_for(xp)(*given)
            return tuple(
                where(is_behind, as_it_is, where(refracts, one, other))
                for as_it_is, one, other in zip(BLOCK.identity, on, back, strict=True)
            )

        return at_event
