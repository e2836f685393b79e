"""Projections: how a hemisphere is laid out flat, as a disc of radius 1."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Callable

Numbers = npt.NDArray[np.float64]


class Projection(NamedTuple):
    """A projection of directions, each at its azimuth."""

    radius: Callable[[Numbers, Numbers], Numbers]
    angle: Callable[[Numbers], Numbers]
    cap: Callable[[Numbers], Numbers]
    density: Callable[[Numbers], Numbers]


PROJECTIONS = {
    "equidistant": Projection(
        radius=lambda sin, cos: np.arctan2(sin, cos) / (np.pi / 2.0),
        angle=lambda r: np.asarray(r * (np.pi / 2.0)),
        cap=lambda r: np.asarray(2.0 * (np.pi / 4.0 * np.sinc(r / 4.0)) ** 2),
        density=lambda r: np.asarray((np.pi / 2.0) ** 2 * np.sinc(r / 2.0)),
    ),
    "equal-area": Projection(
        radius=lambda sin, cos: np.asarray(sin / np.sqrt(1.0 + cos)),
        angle=lambda r: 2.0 * np.arcsin(r / np.sqrt(2.0)),
        cap=np.ones_like,
        density=lambda r: np.full_like(r, 2.0),
    ),
}
"""The polar angle is proportional to the distance from the centre; or all areas are kept."""
