"""SpecularVertex: a reflecting surface that stands where a chain of points asks for it."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.chain_vertex import ChainVertex
from optipath.elements.coupling import Coupling, numbers_of
from optipath.elements.vertices.place import PlaceInChain
from optipath.elements.vertices.vertex_domain import Bad, Vertices
from optipath.kernels.catalogue import INCIDENCE, REFLECTION
from optipath.values.domains.quantities import Index, OutsideIndex, Whole
from optipath.values.operation import Operation


class SpecularVertex(ChainVertex, kind="specular-vertex"):
    """A smooth opaque surface at one vertex of a chain, perpendicular to the bisector there.

    Its frames come from the points: z along the legs, x = k_out cross k_in across the plane
    of incidence, as `Interface` has it; a link between neighbours of one chain turns the
    light by them. What stands relatively beside it, stands in the frame of its port.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the reflecting medium.
    vertices : array_like, shape (..., m + 2, 3), Parameter or VerticesByAngles
        The points from the light, over m vertices, to the eye; in the unit of any length.
    place : int
        Which of the m vertices this is, 1 being the first that light meets.
    outside : float, array_like, Material, Parameter or FOLLOWS, optional
        The index of the medium that light comes from, without absorption.
    reflections : int, optional
        How many vertices there are, m; needed only where `vertices` is a parameter without
        default.
    bad : {"refuse", "mask"}, optional
        Whether chains that cannot be, as those with a leg of no length, are refused, or have
        light that is NaN.

    Examples
    --------
    >>> corner = SpecularVertex(1.5, [[0, 0, 0], [0, 0, 3], [0, 2, 3]], place=1)
    >>> print(corner.mueller().frame_out.z)
    [0. 1. 0.]
    """

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    mirrored: ClassVar[tuple[str, ...]] = ()

    index: Index
    vertices: Vertices
    place: Whole
    outside: OutsideIndex = 1.0
    reflections: Whole | None = None
    bad: Bad = "refuse"

    @property
    def in_chain(self) -> PlaceInChain:
        """Where it stands in its chain."""
        return PlaceInChain(self.vertices, self.place, self.reflections)

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the reflection from ``in`` to ``reflected``."""
        index = numbers_of(self.index, self.domains()["index"])
        cos_sin = self.in_chain.points_around().given_to(INCIDENCE).results(2)
        operation = Operation(REFLECTION, (self.front, *index, *cos_sin))
        return (Coupling("in", "reflected", (operation,), reflects=True),)
