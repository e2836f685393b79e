"""Vertices: surfaces in space at points of a chain, reflecting, refracting or either."""

from __future__ import annotations

from dataclasses import field, replace
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self

import numpy as np

from optipath.elements.boundary_media import MediaOfBoundary
from optipath.elements.coupling import Coupling, numbers_of, value_back
from optipath.elements.element import Element, with_values
from optipath.elements.vertex_chain import (
    Bad,
    Vertices,
    VerticesByAngles,
    VerticesDomain,
    vertices_back,
)
from optipath.elements.vertex_place import (
    Coordinates,
    EventFits,
    Events,
    EventsDomain,
    PlaceInChain,
    VertexFrame,
    same_points,
)
from optipath.errors import PathError
from optipath.kernels.catalog import (
    AT_EVENT,
    EVENT_AT_VERTEX,
    INCIDENCE,
    REFLECTION,
    REFRACTION,
    TRANSMISSION_AT_VERTEX,
    TURN_AT_REFRACTION,
    TURN_BETWEEN_PLANES,
)
from optipath.kernels.vertex_chain import Event
from optipath.materials.index_domains import FOLLOWS
from optipath.materials.material import Material
from optipath.materials.quantities import ClearIndex, Index, OutsideIndex, Whole
from optipath.values.agreement import first_faults
from optipath.values.arrays import changed
from optipath.values.curve_value import CurveValue
from optipath.values.operands import Operand, Operation, operand_of
from optipath.values.precision import is_whole
from optipath.values.use import is_checked_later, refuse

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.light.frame import Frame
    from optipath.values.agreement import Agreement
    from optipath.values.domains import Domain


class ChainVertex(MediaOfBoundary, Element):
    """A smooth surface at one vertex of a chain.

    z is along the legs, x = k_out cross k_in across the plane of incidence, as in `Interface`;
    relative elements take the frame of its port.
    """

    straight: ClassVar[bool] = False
    self_placed: ClassVar[bool] = True
    refracts: ClassVar[bool] = False
    counted_by: ClassVar[str] = "count"

    bad = "refuse"  # No field, which would stand before those of the classes.

    index: Index
    vertices: Vertices
    place: Whole
    outside: OutsideIndex = 1.0

    def __post_init__(self) -> None:
        """Check besides that there is such a place in the chain, and that light can go there."""
        super().__post_init__()
        if not is_checked_later():
            name = type(self).__name__
            known = (law for law in self.agreements(name) if not law.is_open)
            refuse(self._place_faults(name) or first_faults(known))

    @property
    def in_chain(self) -> PlaceInChain:
        """Where it stands in its chain."""
        name = self.counted_by
        return PlaceInChain(self.vertices, self.place, getattr(self, name), name)

    @property
    def _points(self) -> Coordinates:
        """The points up to the one behind the vertex."""
        return self.in_chain.points()

    @property
    def front(self) -> Any:
        """The index n of the medium that light comes from."""
        return self.outside.n if isinstance(self.outside, Material) else self.outside

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value that is a number; which vertex this is, is none."""
        for name, domain in self.domains().items():
            if name not in ("place", self.counted_by):
                yield from self.domain_here(domain).parts(name, getattr(self, name))

    def domain_here(self, domain: Domain) -> Domain:
        """Return the domain of a field in this chain, which says the axes of its points."""
        if isinstance(domain, VerticesDomain):
            return replace(domain, tail=self.in_chain.tail, masks=self.bad == "mask")
        return domain

    def reversed(self) -> Self:
        """Return the vertex in the chain from its end to its start, which must be known."""
        vertices = vertices_back(value_back(self.kind, "vertices", self.vertices))
        place = self.in_chain.count + 1 - self.place
        return with_values(super().reversed(), vertices=vertices, place=place)

    def own_frame(self, port: str) -> VertexFrame:
        """Return the frame of a port, made when somebody looks at it."""
        return VertexFrame(self._points, leaves=port != "in")

    def turn_from(self, before: Element) -> Operation:
        """Return the turn from the frame in which light leaves the vertex before."""
        # The vertex before is the one that this chain says.
        hardly = self.refracts or getattr(before, "refracts", False)
        return self._points.planes(TURN_AT_REFRACTION if hardly else TURN_BETWEEN_PLANES)

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
        others = [f"'{owner}' has its frames from its vertices; give it no other frames"]
        return (others if frames else []) + self._place_faults(owner)

    def _goes_so(self, owner: str, *event_and_media: Any) -> tuple[Agreement, ...]:
        """Return that light can go from point to point by an event, n in front, n and k behind."""
        of_angles = isinstance(self.vertices, VerticesByAngles)
        goes = self._is_sound and getattr(self, "_goes", False)
        if goes or self.bad == "mask" or self.front is FOLLOWS or of_angles:
            return ()
        points = self.in_chain.points(around=True).arguments
        return (EventFits((*map(operand_of, event_and_media), *points), owner),)

    def _place_faults(self, owner: str) -> list[str]:
        result = self.in_chain.faults(owner)
        if self.refracts and isinstance(self.vertices, VerticesByAngles):
            result.append(
                f"{owner}.vertices are angles, which say reflections alone; give the points"
            )
        return result


class Vertex(ChainVertex, kind="vertex"):
    """A smooth surface at one vertex of chains, which reflects, refracts or ends each by a number.

    What `SpecularVertex` or `RefractingVertex` does to a chain, it does to those that have their
    event; `path_from_vertices` makes it of chains whose events or lengths differ. Behind the end
    of a chain light stays as it is, in the frame of its last leg, and no point is looked at.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the medium on the other side of the surface; without
        absorption where light is refracted.
    vertices : array_like, shape (..., m + 2, 3), or Parameter
        The points from the light, over m vertices, to the eye; in the unit of any length.
    place : int
        Which of the m vertices this is, 1 being the first that light meets.
    events : array_like, shape (..., m)
        What happens at each vertex of a chain: 0 where light is reflected, 1 where it is
        refracted, 2 behind the end, and 3 where the chain cannot be, and its light is NaN.
    outside : float, array_like, Material, Parameter or FOLLOWS, optional
        The index of the medium that light comes from, without absorption.
    bad : {"refuse", "mask"}, optional
        Whether chains that cannot be, as those with a leg of no length, are refused, or have
        light that is NaN.

    Examples
    --------
    >>> down = [[0, 0, 2], [0, 0, 1], [0, 0, 2]]
    >>> vertex = Vertex(1.5, down, place=1, events=[[0], [2]])
    >>> print(vertex.mueller().matrix[:, 0, 0].round(6))
    [0.04 1.  ]
    """

    refracts: ClassVar[bool] = True

    events: Events = field(kw_only=True)
    bad: Bad = "refuse"

    @property
    def count(self) -> int | None:
        """How many vertices there are; None where the events do not say."""
        shape = getattr(self.events, "shape", ())
        return shape[-1] if shape else None

    def domain_here(self, domain: Domain) -> Domain:
        if isinstance(domain, EventsDomain):
            follows = isinstance(self.events, CurveValue)
            return changed(domain, tail=(self.in_chain.count,), takes_parameters=follows)
        if isinstance(domain, VerticesDomain):
            domain = replace(domain, ends=True)
        return super().domain_here(domain)

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the way from ``in`` to ``out``, by reflection or refraction."""
        event, *media = self._event_and_media
        n1, n2, *cos_sin = self._points.passed_to(EVENT_AT_VERTEX, *media).results(4)
        operation = Operation(AT_EVENT, (event, n1, n2, media[-1], *cos_sin))
        return (Coupling("in", "out", (operation,)),)

    def medium_at(self, port: str) -> Any:
        """Return the medium of each chain at a port, behind as far as it is known."""
        if port == "in":
            return self.outside
        *sides, behind = getattr(self, "_behind", (None, None, None))
        if sides[0] is self.index and sides[1] is self.outside:
            return behind
        event, n1, n2, _ = map(operand_of, self._event_and_media)
        if any(not operand.known or operand.traced for operand in (event, n1, n2)):
            return FOLLOWS
        return np.where(event.numbers() == Event.REFRACTS, n2.numbers(), n1.numbers())

    def reversed(self) -> NoReturn:
        """Refuse: chains that end at several places have no one way back."""
        raise PathError(
            f"{self.kind} stands for chains of several kinds, whose ways back begin at several "
            f"places; make a path of those of each kind, with one text for events, and reverse it"
        )

    def agreements(self, owner: str) -> tuple[Agreement, ...]:
        """Return that light can go so from point to point, unless that is masked."""
        return self._goes_so(owner, *self._event_and_media)

    @property
    def event_here(self) -> Operand:
        """What happens at this vertex."""
        return self._events[-1]

    @property
    def _events(self) -> tuple[Operand, ...]:
        """What happens at each vertex up to this one."""
        here = self.in_chain
        return tuple(Operand(self.events, place, (here.count,)) for place in range(here.at))

    @property
    def _points(self) -> Coordinates:
        return super()._points._replace(events=self._events)

    @property
    def _event_and_media(self) -> tuple[Any, Any, Any, Any]:
        """The event here, n in front, and n and k behind."""
        n, k = numbers_of(self.index, self.domains()["index"])
        return self.event_here, self.front, n, k


class SpecularVertex(ChainVertex, kind="specular-vertex"):
    """A smooth opaque surface at one vertex of a chain, perpendicular to the bisector there.

    Its frames come from the points: z along the legs, x = k_out cross k_in across the plane
    of incidence, as `Interface` has it; a link between neighbours of one chain turns the
    light by them. What stands relatively beside it, stands in the frame of its port.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the reflecting medium.
    vertices, place, outside, bad
        As `Vertex` takes them; `vertices` may be a `VerticesByAngles`.
    reflections : int, optional
        How many vertices there are, m; needed only where `vertices` is a parameter without
        default.

    Examples
    --------
    >>> corner = SpecularVertex(1.5, [[0, 0, 0], [0, 0, 3], [0, 2, 3]], place=1)
    >>> print(corner.mueller().frame_out.z)
    [0. 1. 0.]
    """

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    counted_by: ClassVar[str] = "reflections"
    mirrored: ClassVar[tuple[str, ...]] = ()

    reflections: Whole | None = None
    bad: Bad = "refuse"

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the reflection from ``in`` to ``reflected``."""
        index = numbers_of(self.index, self.domains()["index"])
        cos_sin = self.in_chain.points(around=True).passed_to(INCIDENCE).results(2)
        operation = Operation(REFLECTION, (self.front, *index, *cos_sin))
        return (Coupling("in", "reflected", (operation,), reflects=True),)


class RefractingVertex(ChainVertex, kind="refracting-vertex"):
    """A smooth boundary at one vertex of a chain, which light goes through, tilted by Snell's law.

    The normal is along n2 k_out - n1 k_in; between equal media light goes straight on, and
    nothing happens to it. What is let through is the power carried on, as `Interface` has it, and
    the frames are those of `SpecularVertex`, x = k_out cross k_in across the plane of incidence.

    Parameters
    ----------
    index : float, array_like, Material or Parameter
        The index of refraction of the medium that light goes on in, without absorption.
    vertices, place, outside, bad
        As `Vertex` takes them.
    count : int, optional
        How many vertices there are, m; needed only where `vertices` is a parameter without
        default.

    Raises
    ------
    ValueFault
        If no surface between the two media turns light so far.

    Examples
    --------
    Light goes straight down into water:

    >>> water = RefractingVertex(1.33, [[0, 0, 1], [0, 0, 0], [0, 0, -1]], place=1)
    >>> print(water.mueller().matrix[0, 0].round(6))
    0.979941
    """

    outputs: ClassVar[tuple[str, ...]] = ("transmitted",)
    natural: ClassVar[str] = "transmitted"
    refracts: ClassVar[bool] = True
    mirrored: ClassVar[tuple[str, ...]] = ()

    index: ClearIndex
    count: Whole | None = None
    bad: Bad = "refuse"

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the refraction from ``in`` to ``transmitted``."""
        points = self.in_chain.points(around=True)
        rarer, denser, *cos_sin = points.passed_to(REFRACTION, self.front, self._behind).results(4)
        operation = Operation(TRANSMISSION_AT_VERTEX, (rarer, denser, 0.0, *cos_sin))
        return (Coupling("in", "transmitted", (operation,)),)

    def reversed(self) -> Self:
        """Return the vertex in the chain from its end to its start, its media exchanged."""
        if self.outside is FOLLOWS:
            raise PathError(
                f"{self.kind} takes its outside over from the vertex before it (FOLLOWS), which "
                f"alone it has not; reverse the path that it stands in, path.reversed()"
            )
        return with_values(super().reversed(), index=self.outside, outside=self.index)

    def agreements(self, owner: str) -> tuple[Agreement, ...]:
        """Return that its points are those of a refraction."""
        return self._goes_so(owner, Event.REFRACTS, self.front, self._behind, 0.0)

    @property
    def _behind(self) -> Any:
        return self.index.n if isinstance(self.index, Material) else self.index
