"""Curves of angles that come back: where they jump from one end to the other, they are open."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    Numbers = npt.NDArray[np.float64]

_FLIP = 0.05
"""How near to half a period a step is a flip, which is drawn neither up nor down."""


def open_at_jumps(along: Numbers, angles: Numbers, period: float) -> tuple[Numbers, Numbers]:
    """Return a curve that goes out at one end and comes in at the other, with a gap between.

    Shape: along, angles (count,).

    Examples
    --------
    >>> along, angles = np.array([0.0, 1.0]), np.array([80.0, -80.0])
    >>> [each.tolist() for each in open_at_jumps(along, angles, 180.0)]
    [[0.0, 0.5, 0.5, 0.5, 1.0], [80.0, 90.0, nan, -90.0, -80.0]]
    """
    step = np.diff(angles)
    with np.errstate(invalid="ignore"):
        flips = np.abs(np.abs(step) / period - 0.5) < _FLIP
        jumps = (np.abs(step) > period / 2) & ~flips
    end = np.sign(angles[:-1]) * period / 2
    rest = step + 2 * end
    places: list[int] = []
    more: list[tuple[float, float]] = []
    for at in np.flatnonzero(flips | jumps).tolist():
        places += [at + 1] * (1 if flips[at] else 3)
        if flips[at]:
            more.append((along[at], np.nan))
            continue
        share = (end[at] - angles[at]) / rest[at] if rest[at] else 0.5
        meets = along[at] + share * (along[at + 1] - along[at])
        more += [(meets, end[at]), (meets, np.nan), (meets, -end[at])]
    if not places:
        return along, angles
    x, y = np.array(more).T
    return np.insert(along, places, x), np.insert(angles, places, y)
