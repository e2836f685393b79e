"""The media that light is in along chains whose events differ: computed once, for all chains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.kernels.geometry.events import Event
from optipath.paths.histories.palette import index_parts
from optipath.values.arrays.read_only import locked
from optipath.values.materials import Material

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]

_WHY = "which medium light is in differs from chain to chain"


class Sides(NamedTuple):
    """The media on both sides of a vertex, for each chain."""

    front: Any
    behind: Any


def media_along(events: Floats, materials: Sequence[Any], outside: Any) -> list[Sides]:
    """Return the media on both sides of each vertex.

    Shape: events (..., m).

    Examples
    --------
    A pane, from which some light comes back:

    >>> events = np.array([[1.0, 1.0], [1.0, 0.0]])
    >>> media_along(events, (1.5, 1.2), 1.0)[1].front
    array([1.5, 1.5])
    """
    front, _ = index_parts("outside", outside, _WHY)
    found = []
    for place, material in enumerate(materials):
        n, k = index_parts(f"materials[{place}]", material, _WHY)
        behind = Material(_plain(n), _plain(k)) if np.any(k) else _plain(n)
        found.append(Sides(_plain(front), behind))
        front = locked(np.where(events[..., place] == Event.REFRACTS, n, front))
    return found


def _plain(numbers: Floats) -> Any:
    """Return an array, or one number as it is."""
    return numbers if numbers.ndim else float(numbers)
