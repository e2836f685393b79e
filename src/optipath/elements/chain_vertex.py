"""ChainVertex: what all surfaces have that stand where a chain of points asks for them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, Self

from optipath.elements.element import Element, with_values
from optipath.elements.media_of_boundary import MediaOfBoundary
from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.elements.vertices.frame import VertexFrame
from optipath.elements.vertices.place import same_points
from optipath.elements.vertices.vertex_domain import Vertices, VerticesDomain
from optipath.elements.vertices.vertices_back import vertices_back
from optipath.kernels.catalogue import TURN_BESIDE_REFRACTION, TURN_BETWEEN_PLANES
from optipath.values.domains.quantities import Index, OutsideIndex, Whole
from optipath.values.made import refuse
from optipath.values.materials import Material
from optipath.values.whole_numbers import is_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.elements.vertices.place import PlaceInChain
    from optipath.light.frames import Frame
    from optipath.values.domains.domain import Domain
    from optipath.values.operation import Operation


class ChainVertex(MediaOfBoundary, Element):
    """A smooth surface at one vertex of a chain.

    Its frames come from the points: z along the legs, x = k_out cross k_in across the plane
    of incidence, as `Interface` has it; a link between neighbours of one chain turns the
    light by them. What stands relatively beside it, stands in the frame of its port.
    """

    straight: ClassVar[bool] = False
    self_placed: ClassVar[bool] = True
    refracts: ClassVar[bool] = False

    bad = "refuse"  # No field, which would stand before those of the classes.

    index: Index
    vertices: Vertices
    place: Whole
    outside: OutsideIndex = 1.0

    def __post_init__(self) -> None:
        """Check besides that there is such a place in the chain."""
        super().__post_init__()
        refuse(self._place_faults(type(self).__name__))

    @property
    def in_chain(self) -> PlaceInChain:
        """Where it stands in its chain."""
        raise NotImplementedError

    @property
    def front(self) -> Any:
        """The index n of the medium that light comes from."""
        return self.outside.n if isinstance(self.outside, Material) else self.outside

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value that is a number; which vertex this is, is none."""
        for name, domain in self.domains().items():
            if name not in ("place", self.in_chain.counted_by):
                yield from self.domain_here(domain).parts(name, getattr(self, name))

    def domain_here(self, domain: Domain) -> Domain:
        """Return the domain of a field in this chain, which says the axes of its points."""
        if isinstance(domain, VerticesDomain):
            return replace(domain, tail=self.in_chain.tail, masks=self.bad == "mask")
        return domain

    def reversed(self) -> Self:
        """Return the vertex in the chain from its end to its start.

        Raises
        ------
        PathError
            If the vertices are an open parameter.
        """
        vertices = vertices_back(self.kind, self.vertices)
        place = self.in_chain.count + 1 - self.place
        return with_values(super().reversed(), vertices=vertices, place=place)

    def own_frame(self, port: str) -> VertexFrame:
        """Return the frame of a port, made when somebody looks at it."""
        return VertexFrame(self.in_chain.points_from_start(), leaves=port != "in")

    def turn_from(self, before: Element) -> Operation:
        """Return the turn from the frame in which light leaves the vertex before."""
        # The vertex before is the one that this chain says.
        hardly = self.refracts or getattr(before, "refracts", False)
        turn = TURN_BESIDE_REFRACTION if hardly else TURN_BETWEEN_PLANES
        return self.in_chain.points_from_start().planes(turn)

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
        return [*found, *self._place_faults(owner)]

    def _place_faults(self, owner: str) -> list[str]:
        found = self.in_chain.faults(owner)
        if self.refracts and isinstance(self.vertices, VerticesByAngles):
            found.append(
                f"{owner}.vertices are angles, which say reflections alone; give the points"
            )
        return found
