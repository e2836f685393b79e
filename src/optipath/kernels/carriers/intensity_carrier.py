"""Light of which only the intensity is asked: what lies along x and along y, or all together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.carriers.powers_actions import Intensities, along_x_and_y, in_all

if TYPE_CHECKING:
    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.numbers.primitives import Primitives


class IntensityCarrier(Carrier):
    """Carries intensities over one denominator, which is divided by at the very end.

    Examples
    --------
    >>> from optipath.kernels.carriers.structures import BLOCK
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> carrier = IntensityCarrier(FLOAT)
    >>> light = carrier.emit((1.0, 0.0, 0.0, 0.0), 1)
    >>> carrier.read(carrier.act(BLOCK, (0.5, 0.25, 0.125, 0.0, 0.0), light, 1), 1)
    ((0.375, 0.0, 0.0, 0.0), 0)
    """

    def __init__(self, xp: Primitives, least: float = 0.0) -> None:
        super().__init__(xp)
        self.least = least

    def emit(self, stokes: Components, count: int = 2) -> Intensities:
        s0, s1 = stokes[:2]
        if count == 1:
            return s0, 1.0
        return 0.5 * (s0 + s1), 0.5 * (s0 - s1), 1.0

    def act(
        self, structure: Structure, numbers: Numbers, state: Intensities, count: int = 2
    ) -> Intensities:
        return structure.powers_for(self.xp)(numbers, state, count)

    def add(self, first: Intensities, second: Intensities) -> Intensities:
        if len(first) == len(second) == 2:
            return first[0] * second[1] + second[0] * first[1], first[1] * second[1]
        x1, y1, over1 = along_x_and_y(first)
        x2, y2, over2 = along_x_and_y(second)
        return x1 * over2 + x2 * over1, y1 * over2 + y2 * over1, over1 * over2

    def read(self, state: Intensities, count: int = 1) -> tuple[Components, Any]:
        del count
        total, over = in_all(state)
        kept = (total >= self.least) & (over >= self.least)
        return (self.xp.where(kept, total / over, 0.0), 0.0, 0.0, 0.0), 0
