"""The coordinates of points of a chain, as kernels are given them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.kernels import Composed, PointsByAngles, composed
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from optipath.kernels import KernelFamily, OfPlanes
    from optipath.kernels.carriers.kernel import Factory


class Coordinates(NamedTuple):
    """Points of a chain: what a kernel is given, and what makes coordinates of it.

    Attributes
    ----------
    arguments : tuple of Operand
        Coordinates, or cosines and sines of angles.
    points : PointsByAngles or None
        Makes coordinates of the arguments, where they are none.
    """

    arguments: tuple[Operand, ...]
    points: PointsByAngles | None

    def factory(self, of_coordinates: Factory) -> Factory:
        """Return a factory of coordinates as one of the arguments."""
        if self.points is None:
            return of_coordinates
        return Composed(of_coordinates, self.points, self.points.takes)

    def planes(self, of_planes: OfPlanes) -> Factory:
        """Return a factory of planes of incidence as one of the arguments.

        Angles tell a plane where points do not; the points are to be all from the start.
        """
        if self.points is None:
            return of_planes
        known = replace(of_planes, known=True)
        return Composed(known, replace(self.points, axes=True), self.points.takes)

    def family(self, kernels: KernelFamily, geometry: Factory) -> KernelFamily:
        """Return kernels whose last arguments a geometry makes of coordinates."""
        return composed(kernels, self.factory(geometry), len(self.arguments))


def coordinates(vertices: Any, count: int, first: int, last: int) -> Coordinates:
    """Return the coordinates of some points of a chain.

    Parameters
    ----------
    vertices : array_like, Parameter or VerticesByAngles
        The chain.
    count : int
        How many points it has.
    first, last : int
        Which are wanted; 0 is where light starts.

    Returns
    -------
    Coordinates

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
        return Coordinates(operands, PointsByAngles(len(vertices.incidences), first, last))
    places = range(3 * first, 3 * last + 3)
    return Coordinates(tuple(Operand(vertices, place, (count, 3)) for place in places), None)
