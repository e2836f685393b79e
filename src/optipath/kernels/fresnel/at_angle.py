"""Nothing but NaN of an angle that is none: what a surface does where no light can go so."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.kernels.numbers.primitives import Factory, KernelFunction, Primitives


@dataclass(frozen=True)
class AtAngle:
    """Makes a kernel ``(..., cos, sin) -> (Fs, Fp, B, C, S)`` that is NaN where its cosine is.

    What is known of media, such as that they are equal, can make a number of any angle else.
    """

    factory: Factory

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Make the kernel."""
        kernel = self.factory(xp)

        def at_angle(*given: Any) -> tuple[Any, ...]:
            # That S vanishes where nothing absorbs is known, and C beside it tells all.
            *numbers, S = kernel(*given)
            return *numbers_at(xp, given[-2], numbers), S

        return at_angle


def numbers_at(xp: Primitives, cos: Any, numbers: Sequence[Any]) -> list[Any]:
    """Return numbers where there is an angle, and NaN elsewhere.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> numbers_at(FLOAT, nan, [0.5, 1.0])
    [nan, nan]
    """
    is_angle = cos == cos  # noqa: PLR0124 - NaN alone is not
    return [xp.where(is_angle, number, nan) for number in numbers]
