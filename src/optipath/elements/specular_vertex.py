"""SpecularVertex: a reflecting surface that stands where a chain of points asks for it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar

from optipath.elements.coupling import Coupling, Operation, numbers_of
from optipath.elements.element import Element
from optipath.elements.media_of_boundary import MediaOfBoundary
from optipath.elements.vertices.frame import VertexFrame
from optipath.elements.vertices.place import PlaceInChain, same_points
from optipath.elements.vertices.vertex_domain import Bad, Vertices, VerticesDomain
from optipath.kernels.catalogue import INCIDENCE, REFLECTION, TURN_BETWEEN_PLANES
from optipath.values.domains.quantities import Index, OutsideIndex, Whole
from optipath.values.made import refuse
from optipath.values.materials import Material
from optipath.values.whole_numbers import is_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.light.frames import Frame
    from optipath.values.domains.domain import Domain


class SpecularVertex(MediaOfBoundary, Element, kind="specular-vertex"):
    """A smooth opaque surface at one vertex of a chain, perpendicular to the bisector there.

    Its frames come from the points: z along the legs, x = k_out cross k_in across the plane
    of incidence, as `Interface` has it; a link between neighbours of one chain turns the
    light by them. What stands relatively beside it, stands in the frame of its port.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the reflecting medium.
    vertices : array_like, shape (..., m + 2, 3), Parameter or VerticesByAngles
        The points from the light, over m reflections, to the eye; in the unit of any length.
    place : int
        Which of the m reflections this is, 1 being the first that light meets.
    outside : float, array_like, Material, Parameter or FOLLOWS, optional
        The index of the medium that light comes from, without absorption.
    reflections : int, optional
        How many there are, m; needed only where `vertices` is a parameter without default.
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
    straight: ClassVar[bool] = False
    self_placed: ClassVar[bool] = True

    index: Index
    vertices: Vertices
    place: Whole
    outside: OutsideIndex = 1.0
    reflections: Whole | None = None
    bad: Bad = "refuse"

    def __post_init__(self) -> None:
        """Check besides that there is such a place in the chain."""
        super().__post_init__()
        refuse(self.in_chain.faults(type(self).__name__))

    @property
    def in_chain(self) -> PlaceInChain:
        """Where it stands in its chain."""
        return PlaceInChain(self.vertices, self.place, self.reflections)

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value that is a number; which vertex this is, is none."""
        for name, domain in self.domains().items():
            value = getattr(self, name)
            if isinstance(domain, VerticesDomain):
                whole = replace(domain, tail=self.in_chain.tail, masks=self.bad == "mask")
                yield from whole.parts(name, value)
            elif name not in ("place", "reflections", "bad"):
                yield from domain.parts(name, value)

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the reflection from ``in`` to ``reflected``."""
        outside = self.outside.n if isinstance(self.outside, Material) else self.outside
        index = numbers_of(self.index, self.domains()["index"])
        cos_sin = self.in_chain.points_around().given_to(INCIDENCE).results(2)
        operation = Operation(REFLECTION, (outside, *index, *cos_sin))
        return (Coupling("in", "reflected", (operation,), reflects=True),)

    def own_frame(self, port: str) -> VertexFrame:
        """Return the frame of a port, made when somebody looks at it."""
        return VertexFrame(self.in_chain.points_from_start(), leaves=port == "reflected")

    def turn_from(self, before: Element) -> Operation:
        """Return the turn from the frame in which light leaves the vertex before."""
        del before  # It is the one that this chain says.
        return self.in_chain.points_from_start().planes(TURN_BETWEEN_PLANES)

    def fault_behind(self, before: Element) -> str:
        """Say which vertex light must come from, unless it comes from the one before this."""
        chain, place = getattr(before, "vertices", None), getattr(before, "place", None)
        counted = is_whole(self.place) and is_whole(place)
        if counted and place == self.place - 1 and same_points(self.vertices, chain):
            return ""
        wanted = self.place - 1 if isinstance(self.place, int) else "the one"
        return (
            f"must lead from a vertex to the next of one chain: the same vertices, and place "
            f"{wanted} before place {self.place}"
        )

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        found = []
        if frames:
            found.append(f"'{owner}' has its frames from its vertices; give it no other frames")
        return [*found, *self.in_chain.faults(owner)]
