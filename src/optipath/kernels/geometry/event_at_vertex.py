"""The angle to the normal where light is reflected on some paths, and refracted on others."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING, Any

from optipath.kernels.geometry.deviation import refraction_at_vertex
from optipath.kernels.geometry.events import Event
from optipath.kernels.geometry.vertex_chain import incidence

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

_THERE_AND_BACK = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)


def event_at_vertex(xp: Primitives) -> KernelFunction:
    """Make ``(event, n1, n2, k, x0, y0, z0, ..., z2) -> (n1, n2, cos, sin)`` of three points.

    What `incidence` or `refraction_at_vertex` says at the middle one; no number into a medium
    that absorbs, and where the event cannot be. Behind the end of a chain no point is looked at.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> points = (0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0, 2.0, 3.0)
    >>> event_at_vertex(FLOAT)(Event.REFLECTS, 1.0, 1.5, 0.0, *points)
    (1.0, 1.5, 0.7071067811865476, 0.7071067811865476)
    """
    where, reflection, refraction = xp.where, incidence(xp), refraction_at_vertex(xp)

    def met(event: Any, n1: Any, n2: Any, k: Any, *coordinates: Any) -> tuple[Any, Any, Any, Any]:
        refracts, is_behind = event == Event.REFRACTS, event == Event.BEHIND
        pairs = zip(_THERE_AND_BACK, coordinates, strict=True)
        points = [where(is_behind, instead, given) for instead, given in pairs]
        c, s = reflection(*points)
        pairs = zip(refraction(n1, n2, *points), (n1, n2, c, s), strict=True)
        m1, m2, c, s = (where(refracts, one, other) for one, other in pairs)
        cannot = (event == Event.CANNOT) | (refracts & (k > 0.0))
        return m1, m2, where(cannot, nan, c), where(cannot, nan, s)

    return met
