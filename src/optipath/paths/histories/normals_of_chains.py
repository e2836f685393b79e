"""Normals that are given, beside what the points and the histories of chains say of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertices.normals import are_off, normal_faults
from optipath.errors import ValueFault
from optipath.kernels.geometry.events import Event
from optipath.paths.histories.chain_histories import Histories, masked
from optipath.paths.histories.known_media import in_order, over_the_larger, sides_of
from optipath.paths.histories.media_along import media_along
from optipath.paths.histories.vertex_events import REFLECTS
from optipath.values.arrays.array_likes import as_given
from optipath.values.materials import Material

if TYPE_CHECKING:
    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]


def normals_checked(
    points: Floats | None, normals: Any, chains: Histories, outside: Any, bad: str
) -> tuple[Histories, list[str]]:
    """Return what is told of chains, and what is wrong with their normals.

    Shapes: points (..., m + 2, 3); normals (..., m, 3).
    """
    sides = _sides(chains, outside)
    if sides is None:
        fault = "normals that refract are checked against media that are known; leave them out"
        return chains, [fault]
    given = normals
    if chains.ended is not None and points is not None:
        points = _turned_back(points, chains.ended)
        given = _any_behind_the_end(normals, chains)
    found = normal_faults(points if bad == "refuse" else None, given, chains.count, sides)
    if bad == "refuse" or found or points is None:
        return chains, found
    off = are_off(points, np.asarray(given), sides)
    return masked(chains, off) if np.any(off) else chains, []


def _sides(chains: Histories, outside: Any) -> Floats | None:
    """Return n1 and n2 at each vertex as `sides_of` does, whichever event each chain has."""
    events: Any = chains.events
    if not isinstance(events, np.ndarray):
        return sides_of(events or REFLECTS * chains.count, chains.materials, outside)
    found: list[Any] = []
    for place, (n1, behind) in enumerate(media_along(events, chains.materials, outside)):
        n2 = behind.n if isinstance(behind, Material) else behind
        here = events[..., place]
        otherwise = np.where(here == Event.BEHIND, 0.0, 1.0)
        found.append(over_the_larger(n1, n2, here == Event.REFRACTS, otherwise))
    return in_order(found)


def _turned_back(points: Floats, ended: npt.NDArray[np.bool_]) -> Floats:
    """Return points that go to and fro behind the end of a chain, where nobody says any."""
    batch = np.broadcast_shapes(points.shape[:-2], ended.shape[:-1])
    found = np.array(np.broadcast_to(points, (*batch, *points.shape[-2:])))
    for place in range(ended.shape[-1]):
        there = ended[..., place, np.newaxis]
        found[..., place + 2, :] = np.where(there, found[..., place, :], found[..., place + 2, :])
    return found


def _any_behind_the_end(normals: Any, chains: Histories) -> Any:
    try:
        given = as_given("the array of normals", normals)
    except ValueFault:
        return normals
    ended: Any = chains.ended
    if given.shape[-2:] != (chains.count, 3) or given.dtype.kind not in "iuf":
        return normals
    try:
        return np.where(ended[..., np.newaxis], 1.0, given)
    except ValueError:
        return normals
