"""Where a ray meets one of the two flat facets of a cell."""

from __future__ import annotations

from typing import Any

import numba as nb

NO_FACET, LOWER, UPPER = -1, 0, 1
"""No facet of a cell, the one beside its edge along x, and the one beside its edge along y."""


@nb.njit(error_model="numpy")
def corners_of(heights: Any, corner: int, row: int) -> Any:
    """Return the heights of a cell's corners (0, 0), (1, 0), (0, 1) and (1, 1)."""
    other = corner + row
    return heights[corner], heights[corner + 1], heights[other], heights[other + 1]


@nb.njit(error_model="numpy")
def facet_gradient(corners: Any, facet: int) -> Any:
    """Return how a facet rises from a cell's side to the next, along x and along y."""
    low, right, back, high = corners
    if facet == LOWER:
        return right - low, high - right
    return high - back, back - low


@nb.njit(error_model="numpy")
def facet_hit(corners: Any, u: float, v: float, ray: Any, span: Any, side: float, own: int) -> Any:
    """Return which facet of a cell a ray meets, and where along the ray.

    A facet is met where the ray comes nearer to it, from its side of the surface, and is at its
    plane or behind it where it leaves the facet. So a ray can slip through no edge: what
    roundings let past one facet is met by the next.
    """
    _, dx, dy, _ = ray
    enters, leaves = span
    apart, along = u - v, dx - dy
    first = own
    if own == NO_FACET:
        at = apart + enters * along
        first = LOWER if at > 0.0 or (at == 0.0 and along > 0.0) else UPPER
    at = apart + leaves * along
    last = LOWER if at > 0.0 or (at == 0.0 and along < 0.0) else UPPER
    cut = leaves
    if first != last:
        # A ray may start from one facet and go along the diagonal.
        cut = min(max(-apart / along, enters), leaves) if along != 0.0 else enters
    if own == NO_FACET:
        t = _met(corners, u, v, ray, enters, cut, side, first)
        if t >= 0.0:
            return first, t
    if first != last:
        t = _met(corners, u, v, ray, cut, leaves, side, last)
        if t >= 0.0:
            return last, t
    return NO_FACET, 0.0


@nb.njit(error_model="numpy")
def _met(
    corners: Any,
    u: float,
    v: float,
    ray: Any,
    enters: float,
    leaves: float,
    side: float,
    facet: int,
) -> Any:
    """Return where a ray meets the plane of a facet between two places, or -1."""
    z, dx, dy, dz = ray
    rise_x, rise_y = facet_gradient(corners, facet)
    rate = dz - (dx * rise_x + dy * rise_y)
    above = (z - corners[0]) - (u * rise_x + v * rise_y)
    if side * rate < 0.0 and side * (above + leaves * rate) <= 0.0:
        return min(max(-above / rate, enters), leaves)
    return -1.0
