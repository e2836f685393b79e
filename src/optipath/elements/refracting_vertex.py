"""RefractingVertex: a surface that light goes through where a chain of points asks for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Self

from optipath.elements.chain_vertex import ChainVertex
from optipath.elements.coupling import Coupling
from optipath.elements.element import with_values
from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.elements.vertices.place import PlaceInChain
from optipath.elements.vertices.snell_at_vertex import SnellAtVertex
from optipath.elements.vertices.vertex_domain import Bad, Vertices
from optipath.errors import PathError
from optipath.kernels.catalogue import REFRACTION, TRANSMISSION_AT_VERTEX
from optipath.values.domains.quantities import ClearIndex, OutsideIndex, Whole
from optipath.values.follows import FOLLOWS
from optipath.values.made import is_checked_later, refuse
from optipath.values.materials import Material
from optipath.values.operands import operand_of
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from typing import Any

    from optipath.values.agreement import Agreement


class RefractingVertex(ChainVertex, kind="refracting-vertex"):
    """A smooth boundary at one vertex of a chain, which light goes through, tilted by Snell's law.

    The normal is along n2 k_out - n1 k_in; between equal media light goes straight on, and
    nothing happens to it. What is let through is the power carried on, as `Interface` has it, and
    the frames are those of `SpecularVertex`, x = k_out cross k_in across the plane of incidence.

    Parameters
    ----------
    index : float, array_like, Material or Parameter
        The index of refraction of the medium that light goes on in, without absorption.
    vertices : array_like, shape (..., m + 2, 3), or Parameter
        The points from the light, over m vertices, to the eye; in the unit of any length.
    place : int
        Which of the m vertices this is, 1 being the first that light meets.
    outside : float, array_like, Material, Parameter or FOLLOWS, optional
        The index of the medium that light comes from, without absorption.
    count : int, optional
        How many vertices there are, m; needed only where `vertices` is a parameter without
        default.
    bad : {"refuse", "mask"}, optional
        Whether chains that cannot be, as those with a leg of no length, are refused, or have
        light that is NaN.

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
    vertices: Vertices
    place: Whole
    outside: OutsideIndex = 1.0
    count: Whole | None = None
    bad: Bad = "refuse"

    def __post_init__(self) -> None:
        """Check besides that the points are those of a refraction."""
        super().__post_init__()
        name = type(self).__name__
        if not is_checked_later():
            known = [law for law in self.agreements(name) if not law.is_open]
            refuse([fault for law in known if (fault := law.fault())])

    @property
    def in_chain(self) -> PlaceInChain:
        """Where it stands in its chain."""
        return PlaceInChain(self.vertices, self.place, self.count, "count")

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the refraction from ``in`` to ``transmitted``."""
        points = self.in_chain.points_around()
        rarer, denser, *cos_sin = points.given_to(REFRACTION, self.front, self._behind).results(4)
        operation = Operation(TRANSMISSION_AT_VERTEX, (rarer, denser, 0.0, *cos_sin))
        return (Coupling("in", "transmitted", (operation,)),)

    def reversed(self) -> Self:
        """Return the vertex in the chain from its end to its start, its media exchanged.

        Raises
        ------
        PathError
            If the vertices are an open parameter, or the medium in front is not known.
        """
        if self.outside is FOLLOWS:
            raise PathError(
                f"{self.kind} takes its outside over from the vertex before it (FOLLOWS), which "
                f"alone it has not; reverse the path that it stands in, path.reversed()"
            )
        return with_values(super().reversed(), index=self.outside, outside=self.index)

    def agreements(self, owner: str) -> tuple[Agreement, ...]:
        """Return that its points are those of a refraction."""
        of_angles = isinstance(self.vertices, VerticesByAngles)
        if self.front is FOLLOWS or of_angles or self.bad == "mask":
            return ()
        media = operand_of(self.front), operand_of(self._behind)
        return (SnellAtVertex((*media, *self.in_chain.points_around().arguments), owner),)

    @property
    def _behind(self) -> Any:
        return self.index.n if isinstance(self.index, Material) else self.index
