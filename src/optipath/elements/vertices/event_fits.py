"""EventFits: the points around a vertex, and its media, are those of what happens there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertices.snell_at_vertex import SnellAtVertex
from optipath.kernels.catalogue import EVENT_AT_VERTEX
from optipath.kernels.geometry.events import Event
from optipath.kernels.geometry.vectors import dot, minus
from optipath.kernels.geometry.vertex_chain import LONGEST, SHORTEST, points_of
from optipath.kernels.numbers.primitives import of_module
from optipath.values.agreement import Agreement

_MORE = 1.0 + 2.0**-20
_LEAST, _MOST = _MORE * SHORTEST**2, LONGEST**2 / _MORE

if TYPE_CHECKING:
    from collections.abc import Collection


@dataclass(frozen=True, eq=False)
class EventFits(Agreement):
    """Light can go from point to point as the event at a vertex says.

    The operands are the event, n in front, n and k behind, and the coordinates of three points.
    """

    owner: str

    @property
    def shows_in_light(self) -> bool:
        """Light that cannot go so is not finite."""
        return True

    def fits(self, xp: Any, *numbers: Any) -> Any:
        if xp is not np:
            return _fits(xp, *numbers)
        found = _surely_fits(*numbers)
        if not np.all(found):
            left = ~found
            several = (np.broadcast_to(number, left.shape)[left] for number in numbers)
            found[left] = _fits(np, *several)
        return found

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying  # No number is a cure.
        event, _, _, k, *points = numbers
        others = "give others, or bad='mask', by which the light of such chains is NaN"
        if event == Event.CANNOT:
            return f"there is no such chain, says the event at '{self.owner}'; {others}"
        three = np.reshape(points, (3, 3))
        if not np.all(np.isfinite(three)):
            return f"the points around '{self.owner}' are {three.tolist()}, not finite; {others}"
        with np.errstate(over="ignore"):
            lengths = np.max(np.abs(np.diff(three, axis=0)), axis=-1)
        if not np.all((lengths > SHORTEST) & (lengths < LONGEST)):
            about = " and ".join(f"{length:.2g}" for length in lengths)
            return (
                f"the legs before and behind '{self.owner}' are about {about} long; legs are "
                f"within {SHORTEST:g} .. {LONGEST:g}: {others}"
            )
        if k > 0.0:
            return (
                f"light is refracted at '{self.owner}' into a medium that absorbs, k = {k:g}, in "
                f"which no light goes on to the next point; let it be reflected there (R for T), "
                f"{others}"
            )
        snell = SnellAtVertex((self.operands[1], self.operands[2], *self.operands[4:]), self.owner)
        return f"{snell.sentence(*numbers[1:3], *points)}; or give bad='mask'"


def _fits(xp: Any, *numbers: Any) -> Any:
    event, n1, n2, k, *points = numbers
    *_, cos, _ = EVENT_AT_VERTEX.made_for(of_module(xp))(n1, n2, k, event, *points)
    return ~xp.isnan(cos) | (event == Event.BEHIND)


def _surely_fits(event: Any, n1: Any, n2: Any, k: Any, *points: Any) -> Any:
    """Return where light can go so by a margin, as nearly all does: by products alone."""
    start, here, end = points_of(points)
    before, behind = minus(here, start), minus(end, here)
    with np.errstate(over="ignore", invalid="ignore"):
        squares = dot(before, before), dot(behind, behind)
        product = squares[0] * squares[1]
        along = dot(before, behind)
        # Light may be turned by arccos(rarer / denser) at most.
        is_turned_less = np.maximum(n1, n2) * along > _MORE * np.minimum(n1, n2) * np.sqrt(product)
    fits = (event == Event.REFLECTS) | ((event == Event.REFRACTS) & (k == 0.0) & is_turned_less)
    for square in squares:
        fits &= (square > _LEAST) & (square < _MOST)
    return np.atleast_1d(fits | (event == Event.BEHIND))
