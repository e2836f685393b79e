"""Vertex: a surface at which some chains of a batch are reflected, others refracted or ended."""

from __future__ import annotations

from dataclasses import field, replace
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn

import numpy as np

from optipath.elements.chain_vertex import ChainVertex
from optipath.elements.coupling import Coupling, numbers_of
from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.elements.vertices.event_domain import Events, EventsDomain
from optipath.elements.vertices.event_fits import EventFits
from optipath.elements.vertices.place import PlaceInChain
from optipath.elements.vertices.vertex_domain import Bad, Vertices, VerticesDomain
from optipath.errors import PathError
from optipath.kernels.catalogue import AT_EVENT, EVENT_AT_VERTEX, TURN_BESIDE_REFRACTION
from optipath.kernels.geometry.events import Event
from optipath.values.domains.quantities import Index, OutsideIndex, Whole
from optipath.values.follows import FOLLOWS
from optipath.values.made import is_checked_later, refuse
from optipath.values.operands import Operand, operand_of
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from optipath.elements.element import Element
    from optipath.elements.vertices.frame import VertexFrame
    from optipath.values.agreement import Agreement
    from optipath.values.domains.domain import Domain


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

    index: Index
    vertices: Vertices
    place: Whole
    outside: OutsideIndex = 1.0
    events: Events = field(kw_only=True)
    bad: Bad = "refuse"

    def __post_init__(self) -> None:
        """Check besides that light can go so from point to point."""
        super().__post_init__()
        if not is_checked_later():
            known = [law for law in self.agreements(type(self).__name__) if not law.is_open]
            refuse([fault for law in known if (fault := law.fault())])

    @property
    def in_chain(self) -> PlaceInChain:
        """Where it stands in its chain."""
        shape = getattr(self.events, "shape", ()) or (None,)
        return PlaceInChain(self.vertices, self.place, shape[-1], "count")

    def domain_here(self, domain: Domain) -> Domain:
        if isinstance(domain, EventsDomain):
            return replace(domain, tail=(self.in_chain.count,))
        here = super().domain_here(domain)
        return replace(here, ends=True) if isinstance(here, VerticesDomain) else here

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the way from ``in`` to ``out``, by reflection or refraction."""
        event, n1, n2, k = self._given
        points = self.in_chain.points_from_start()
        met = points.given_to(EVENT_AT_VERTEX, n1, n2, k, *self._events)
        n1, n2, *cos_sin = met.results(4)
        operation = Operation(AT_EVENT, (event, n1, n2, k, *cos_sin))
        return (Coupling("in", "out", (operation,)),)

    def medium_at(self, port: str) -> Any:
        """Return the medium of each chain at a port, behind as far as it is known."""
        if port == "in":
            return self.outside
        event, n1, n2, _ = map(operand_of, self._given)
        if not all(operand.known for operand in (n1, n2)) or n1.traced or n2.traced:
            return FOLLOWS
        refracts = event.numbers() == Event.REFRACTS
        return np.where(refracts, n2.numbers(), n1.numbers())

    def own_frame(self, port: str) -> VertexFrame:
        frame = super().own_frame(port)
        return replace(frame, points=frame.points._replace(events=self._events))

    def turn_from(self, before: Element) -> Operation:
        del before  # The one that this chain says; some chains are refracted at either.
        points = self.in_chain.points_from_start()._replace(events=self._events)
        return points.planes(TURN_BESIDE_REFRACTION)

    def reversed(self) -> NoReturn:
        """Refuse: chains that end at several places have no one way back.

        Raises
        ------
        PathError
            Always.
        """
        raise PathError(
            f"{self.kind} stands for chains that differ in their events or their lengths, whose "
            f"ways back begin at several places; make a path of the chains of each kind, with one "
            f"text for events, and reverse that"
        )

    def agreements(self, owner: str) -> tuple[Agreement, ...]:
        """Return that light can go so from point to point, unless that is masked."""
        of_angles = isinstance(self.vertices, VerticesByAngles)
        if self.bad == "mask" or self.front is FOLLOWS or of_angles:
            return ()
        given = *map(operand_of, self._given), *self.in_chain.points_around().arguments
        return (EventFits(given, owner),)

    @property
    def event_here(self) -> Operand:
        """What happens at this vertex."""
        return self._event(self.place - 1)

    @property
    def _events(self) -> tuple[Operand, ...]:
        """What happens at each vertex up to this one."""
        return tuple(self._event(place) for place in range(self.place))

    def _event(self, place: int) -> Operand:
        return Operand(self.events, place, (self.in_chain.count,))

    @property
    def _given(self) -> tuple[Any, Any, Any, Any]:
        """The event here, n in front, and n and k behind."""
        n, k = numbers_of(self.index, self.domains()["index"])
        return self.event_here, self.front, n, k
