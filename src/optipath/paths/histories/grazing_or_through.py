"""Vertices that may be meant to refract: light that would graze them hardly turns there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertices.naming import of_chain, pieces_of
from optipath.elements.vertices.snell_at_vertex import deviation
from optipath.kernels.catalogue import REFRACTION
from optipath.kernels.numbers.primitives import NUMPY
from optipath.paths.histories.known_media import known, known_index
from optipath.paths.histories.vertex_events import REFLECTS, REFRACTS

if TYPE_CHECKING:
    from collections.abc import Sequence

_TURNED = 2.0**-50
"""The deviation below which light goes straight on, which changes nothing."""


def doubtful_vertex(chains: Any, materials: Sequence[Any], outside: Any, there: Any = None) -> str:
    """Ask what is meant at a vertex where every chain may be reflected, and refracted as well.

    Shapes: chains (..., m + 2, 3); there (..., m).
    """
    points, front = known(chains), known_index(outside)
    if points is None or front is None:
        return ""
    events, told = "", ""
    for place, material in enumerate(materials):
        behind = known_index(material)
        around = points[..., place : place + 3, :]
        if there is not None and behind is not None:
            around, behind = _of_those(there[..., place], around, behind)
        if behind is None or not _may_all_refract(around, front, behind):
            events += REFLECTS
            continue
        events += REFRACTS
        told = told or _readings(place + 1, around, front, behind)
        front = behind
    if not told:
        return ""
    return (
        f"{told}; say which, events='{REFLECTS * len(events)}' where it is reflected, "
        f"events='{events}' where it goes through"
    )


def _of_those(there: Any, around: Any, behind: Any) -> tuple[Any, Any]:
    """Return points and indices, those of chains that are not there replaced by one that is."""
    if np.all(there) or not np.any(there):
        return around, behind
    first = np.unravel_index(np.argmax(there), there.shape)
    if around.shape[:-2] == there.shape:
        around = np.where(there[..., np.newaxis, np.newaxis], around, around[first])
    if behind.shape == there.shape:
        behind = np.where(there, behind, behind[first])
    return around, behind


def _may_all_refract(around: Any, front: Any, behind: Any) -> bool:
    """Tell of points around a vertex whether each chain may be one that refracts."""
    try:
        batch = np.broadcast_shapes(around.shape[:-2], front.shape, behind.shape)
    except ValueError:
        return False  # A fault of its own.
    points = np.broadcast_to(around, (*batch, 3, 3)).reshape(-1, 9)
    media = [np.broadcast_to(n, batch).reshape(-1) for n in (front, behind)]
    # Mostly the first piece says that light is reflected.
    return len(points) > 0 and all(
        _refracts(points[piece].T, *(n[piece] for n in media)) for piece in pieces_of(len(points))
    )


def _refracts(coordinates: Any, front: Any, behind: Any) -> bool:
    with np.errstate(all="ignore"):
        _, _, cos, sin = REFRACTION.made_for(NUMPY)(
            front, behind, *np.asarray(coordinates, np.float64)
        )
        return bool(np.all((cos >= 0.0) & (sin > _TURNED)))


def _readings(vertex: int, around: Any, front: Any, behind: Any) -> str:
    """Return both readings of a vertex, for the first chain."""
    batch = around.shape[:-2]
    points = np.asarray(around, np.float64).reshape(-1, 9)[0]
    n1, n2 = (float(n.reshape(-1)[0]) for n in (front, behind))
    turned = deviation(points)
    _, _, cos, sin = REFRACTION.made_for(NUMPY)(n1, n2, *points)
    in_rarer = math.atan2(sin, cos)
    incidence = in_rarer if n1 <= n2 else math.asin(math.sin(in_rarer) * n2 / n1)
    return (
        f"light is turned by {turned:.6g} deg at vertex {vertex}{of_chain(0, batch)}, which is a "
        f"reflection at an incidence of {90.0 - 0.5 * turned:.6g} deg, or a refraction from "
        f"n = {n1:.6g} into n = {n2:.6g} at "
        f"{math.degrees(incidence):.6g} deg"
    )
