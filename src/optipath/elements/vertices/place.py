"""The place of a vertex in its chain, and what its points are there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.elements.vertices.coordinates import Coordinates, coordinates
from optipath.errors import shown
from optipath.values.arrays.read_only import same
from optipath.values.parameters import Parameter
from optipath.values.whole_numbers import is_whole

_MOST = (1 << 31) - 1
_DOUBLE = np.dtype(np.float64)


@dataclass(frozen=True, eq=False)
class PlaceInChain:
    """Which vertex of a chain, as somebody says it; it may be none.

    Examples
    --------
    >>> import numpy as np
    >>> PlaceInChain(np.eye(3), 2, None).faults("mirror")
    ['mirror.place must be a whole number of 1 .. 1, not 2']
    """

    vertices: Any
    number: Any
    told: Any
    counted_by: str = "reflections"

    @property
    def count(self) -> int:
        """How many vertices there are; 0 where nothing says so."""
        if isinstance(self.vertices, VerticesByAngles):
            return len(self.vertices.incidences)
        if is_whole(self.told, most=_MOST):
            return int(self.told)
        value = self.vertices
        value = value.default if isinstance(value, Parameter) else value
        shape: tuple[int, ...] = getattr(value, "shape", ())
        return max(shape[-2] - 2, 0) if len(shape) > 1 else 0

    @property
    def tail(self) -> tuple[int, int]:
        """The axes of the points of one chain."""
        return max(self.count, 1) + 2, 3

    def points_around(self) -> Coordinates:
        """Return the vertex between its neighbours."""
        return self._points(self._number - 1)

    def points_from_start(self) -> Coordinates:
        """Return all points up to the one behind the vertex."""
        return self._points(0)

    def faults(self, owner: str) -> list[str]:
        """Return what is wrong with the numbers, a sentence each."""
        found, name = [], self.counted_by
        if self.told is not None and not is_whole(self.told, most=_MOST):
            found.append(f"{owner}.{name} must be a whole number above 0, not {shown(self.told)}")
        elif not self.count and isinstance(self.vertices, Parameter):
            found.append(
                f"{owner}.vertices is a parameter without a default; tell the number of "
                f"{'vertices' if name == 'count' else name} of the chain, {name}=..."
            )
        if not is_whole(self.number, most=self.count or _MOST):
            up_to = f" of 1 .. {self.count}" if self.count else " above 0"
            given = "a parameter" if isinstance(self.number, Parameter) else shown(self.number)
            found.append(f"{owner}.place must be a whole number{up_to}, not {given}")
        return found

    @property
    def _number(self) -> int:
        # What is no place is told as a fault, and must not be in the way until then.
        number = self.number if is_whole(self.number) else 1
        return min(number, max(self.count, 1))

    def _points(self, first: int) -> Coordinates:
        return coordinates(self.vertices, self.tail[0], first, self._number + 1)


def same_points(first: Any, second: Any) -> bool:
    """Tell whether two chains are equal; points that are not finite are, where they stand alike.

    Examples
    --------
    >>> import numpy as np
    >>> same_points(np.full((3, 3), np.nan), np.full((3, 3), np.nan))
    True
    """
    if same(first, second):
        return True
    kinds = {getattr(chain, "dtype", None) for chain in (first, second)}
    return kinds == {_DOUBLE} and np.array_equal(first, second, equal_nan=True)
