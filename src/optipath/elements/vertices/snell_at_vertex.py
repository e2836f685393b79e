"""SnellAtVertex: the points around a vertex are those of a refraction between its media."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.catalogue import INCIDENCE, REFRACTION
from optipath.kernels.numbers.primitives import of_module
from optipath.values.agreement import Agreement, text_of
from optipath.values.cures import cure

if TYPE_CHECKING:
    from collections.abc import Collection


@dataclass(frozen=True, eq=False)
class SnellAtVertex(Agreement):
    """A surface between two media can turn light so far by refraction.

    The operands are the indices in front and behind, and the coordinates of three points.
    """

    owner: str

    @property
    def shows_in_light(self) -> bool:
        """Light that no surface refracts so is not finite."""
        return True

    def fits(self, xp: Any, *numbers: Any) -> Any:
        n1, n2, *points = numbers
        primitives = of_module(xp)
        half, _ = INCIDENCE.made_for(primitives)(*points)
        # Short of the most that light may be turned by, as nearly all is, nothing else is asked.
        larger = xp.maximum(n1, n2)
        surely = 2.0 * half * half * larger < larger - xp.minimum(n1, n2)
        if xp is np and np.all(surely):
            return surely
        *_, cos, _ = REFRACTION.made_for(primitives)(n1, n2, *points)
        # Faulty indices and points are told elsewhere.
        sound = (n1 > 0.0) & (n2 > 0.0) & xp.isfinite(larger) & ~xp.isnan(half)
        return ~xp.isnan(cos) | ~sound

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying  # No number is a cure.
        n1, n2, *points = numbers
        media = [text_of(operand, n) for operand, n in zip(self.operands, (n1, n2), strict=False)]
        turned = deviation(points)
        most = math.degrees(math.acos(min(n1, n2) / max(n1, n2)))
        between = f"from n = {media[0]} into n = {media[1]}"
        allowed = f"turns it by {most:.9g} deg at most" if most else "lets it go straight on"
        instead = cure("SpecularVertex", 'kind = "specular-vertex"')
        return (
            f"light is turned by {turned:.9g} deg at '{self.owner}', but a refraction {between} "
            f"{allowed}; move the points, give other media, or let it be reflected there "
            f"(events with R for T, or {instead})"
        )


def deviation(points: Any) -> float:
    """Return by how many degrees light is turned at the middle of three points.

    Examples
    --------
    >>> round(deviation([0, 0, 0, 0, 0, 1, 0, 5, 1]), 9)
    90.0
    """
    half, across = INCIDENCE.made_for(of_module(np))(*map(np.float64, points))
    return 2.0 * math.degrees(math.atan2(half, across))
