"""The angle to the normal where light is reflected on some paths, and refracted on others."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING, Any

from optipath.kernels.geometry.deviation import refracted
from optipath.kernels.geometry.events import Event, ended
from optipath.kernels.geometry.vertex_chain import incidence_between, legs, points_of

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def event_at_vertex(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n2, k, event, ..., x0, y0, z0, ...) -> (n1, n2, cos, sin)``.

    Of some vertices in a row and the points around them; the media and the angle are those at the
    last vertex, as `incidence_between` or `refracted` says them. No number into a medium that
    absorbs, and where the event cannot be; behind the end of a chain no point is looked at.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> points = (0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0, 2.0, 3.0)
    >>> event_at_vertex(FLOAT)(1.0, 1.5, 0.0, Event.REFLECTS, *points)
    (1.0, 1.5, 0.7071067811865476, 0.7071067811865476)
    """
    where, along = xp.where, legs(xp)
    reflection, refraction = incidence_between(xp), refracted(xp)

    def met(n1: Any, n2: Any, k: Any, *numbers: Any) -> tuple[Any, Any, Any, Any]:
        # Of n vertices there are n events and n + 2 points.
        count = (len(numbers) - 6) // 4
        events, points = numbers[:count], points_of(numbers[count:])
        *_, before, behind = along(points, ended(events))
        refracts = events[-1] == Event.REFRACTS
        both = refraction(n1, n2, before, behind), (n1, n2, *reflection(before, behind))
        m1, m2, c, s = (where(refracts, *two) for two in zip(*both, strict=True))
        cannot = (events[-1] == Event.CANNOT) | (refracts & (k > 0.0))
        return m1, m2, where(cannot, nan, c), where(cannot, nan, s)

    return met
