"""Ribbons from a row to another: outlines of a constant width, straight, bent or turned back."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    Numbers = npt.NDArray[np.float64]

_STEPS = np.linspace(0.0, 1.0, 25)
_DEEP = 0.44
"""How far a turn reaches, of the distance of rows."""

_THICK = 0.25
"""How thick a turn is at most, of the same."""


def bent(stations: list[tuple[float, float]]) -> Numbers:
    """Return a line that goes through stations and is upright in each.

    Shape: returns (..., 2).

    Examples
    --------
    >>> bent([(0.0, 0.0), (1.0, -1.0)])[[0, 12, -1]].tolist()
    [[0.0, 0.0], [0.5, -0.5], [1.0, -1.0]]
    """
    ease = _STEPS**2 * (3.0 - 2.0 * _STEPS)
    parts = []
    for (x, y), (to_x, to_y) in pairwise(stations):
        parts.append(np.stack([x + (to_x - x) * ease, y + (to_y - y) * _STEPS], axis=-1))
    return np.concatenate(parts)


def ribbon(stations: list[tuple[float, float]], width: float) -> Numbers:
    """Return the outline of a ribbon through stations, as wide everywhere along x.

    Shape: returns (..., 2).
    """
    middle = bent(stations)
    half = np.array([width / 2, 0.0])
    return np.concatenate([middle - half, (middle + half)[::-1]])


def turned_back(
    begin: tuple[float, float], lane: float, end: tuple[float, float], width: float, share: float
) -> Numbers:
    """Return the outline of a ribbon that goes down, up in a lane on the right, and down again.

    Shape: returns (..., 2).
    """
    edges = []
    for side, deep in ((-0.5, _DEEP), (0.5, _DEEP - _THICK * share)):
        out, up, into = begin[0] + side * width, lane - side * width, end[0] + side * width
        below = _arc(out, up, begin[1], -deep)
        above = _arc(up, into, end[1], deep)
        edges.append(np.concatenate([below, above]))
    return np.concatenate([edges[0], edges[1][::-1]])


def _arc(begin: float, end: float, level: float, reach: float) -> Numbers:
    angle = np.pi * _STEPS
    x = (begin + end) / 2 + (begin - end) / 2 * np.cos(angle)
    return np.stack([x, level + reach * np.sin(angle)], axis=-1)
