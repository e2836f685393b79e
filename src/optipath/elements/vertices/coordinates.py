"""The coordinates of points of a chain, as kernels are given them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.kernels.carriers.kernel import Kernel
from optipath.kernels.geometry.points_by_angles import PointsByAngles
from optipath.values.operands import Operand
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from optipath.values.operation import ResultOf


class Coordinates(NamedTuple):
    """Points of a chain: what is given of them, and what makes coordinates of it."""

    arguments: tuple[Operand, ...]
    points: PointsByAngles | None
    events: tuple[Operand, ...] = ()

    @property
    def operands(self) -> tuple[Operand, ...]:
        """All that is given of them."""
        return *self.events, *self.arguments

    def given_to(self, kernel: Kernel, *before: Any) -> Operation:
        """Return the operation of a kernel of coordinates."""
        return Operation(kernel, (*before, *self._coordinates(self.points)))

    def planes(self, kernel: Kernel) -> Operation:
        """Return the operation of a kernel of planes of incidence, by `OfPlanes`.

        Angles tell a plane where points do not; the points are to be all from the start.
        """
        if self.points is None:
            factory: Any = replace(kernel.factory, events=len(self.events))  # type: ignore[type-var]
            return Operation(replace(kernel, factory=factory), self.operands)
        known: Any = replace(kernel.factory, known=True)  # type: ignore[type-var]
        points = replace(self.points, axes=True)
        return Operation(replace(kernel, factory=known), self._coordinates(points))

    def _coordinates(self, points: PointsByAngles | None) -> tuple[Operand | ResultOf, ...]:
        if points is None:
            return self.arguments
        return Operation(Kernel("points", None, points), self.arguments).results(points.gives)


def coordinates(vertices: Any, count: int, first: int, last: int) -> Coordinates:
    """Return the coordinates of some points of a chain.

    Examples
    --------
    >>> import numpy as np
    >>> found = coordinates(np.eye(3), 3, 1, 2)
    >>> [float(view.numbers({})) for view in found.arguments]
    [0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    """
    if isinstance(vertices, VerticesByAngles):
        angles = [angle for _, angle, _ in vertices.parts("")]
        operands = tuple(Operand(angle, part) for angle in angles for part in ("cos", "sin"))
        count, backwards = len(vertices.incidences), vertices.backwards
        return Coordinates(operands, PointsByAngles(count, first, last, backwards=backwards))
    places = range(3 * first, 3 * last + 3)
    return Coordinates(tuple(Operand(vertices, place, (count, 3)) for place in places), None)
