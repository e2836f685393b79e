"""Interface: a smooth boundary between two media, by Fresnel's equations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.coupling import Operation, numbers_of
from optipath.kernels.catalogue import REFLECTION, TRANSMISSION
from optipath.values.domains.quantities import (
    Angle,
    FollowedIncidence,
    Index,
    OptionalIndex,
    OutsideIndex,
    YesOrNo,
)
from optipath.values.materials import Material
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from optipath.elements.coupling import Coupling


class Interface(BoundaryElement, kind="interface"):
    """A smooth boundary; its frames have x = s, perpendicular to the plane of incidence.

    Light from the front enters at ``in``; what is reflected leaves at ``reflected``, and what
    is refracted at ``transmitted``, as the power carried into the medium behind: a radiance is
    multiplied by (n2 / n1)^2 besides (Nicodemus, Am. J. Phys. 31, 368 (1963)). Light from
    behind enters at ``back``: what is reflected leaves at ``transmitted``, and what is
    refracted at ``reflected``. It needs a medium behind that does not absorb.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the medium behind the boundary.
    incidence : float, array_like, Parameter or FOLLOWS
        The angle of incidence in radians, 0 to pi/2, of light from the front; with `FOLLOWS`, that
        of the boundary before, whose light has been refracted by Snell's law.
    outside : float, array_like, Material, Parameter or FOLLOWS, optional
        The index of the medium in front, without absorption; with `FOLLOWS`, the medium that the
        light of the boundary before comes in.
    azimuth : float, array_like or Parameter, optional
        The angle by which the frame of ``in`` is turned about the direction of travel
        against the frame of the port before it. For ``back``, which light from the next
        boundary of a stack enters without a turn, a link may say it.
    incidence_in : float, array_like, Material or Parameter, optional
        The index of the medium in which the incidence is measured; ``outside`` by default.
        With it, one angle serves all parallel interfaces of a stack, refracted from the medium
        in front of the stack by Snell's law. Where that gets no light into ``outside``, since
        all has been reflected before, all is reflected here, too.
    parallel : bool, optional
        Whether it is parallel to a boundary before whose refracted light enters it, so that
        n sin(incidence) must be the same; False for a face that stands at an angle to that one,
        such as the second of a prism, whose incidence is its own. It says nothing of the faces
        behind, and none that sends light back to the one before can have it.

    Examples
    --------
    >>> Interface(index=0.608 + 2.12j, incidence=0.349).outside
    1.0
    >>> glass = Interface(index=1.5, incidence=0.0)
    >>> print(glass.mueller("in", "transmitted").matrix[0, 0])
    0.96
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    index: Index
    incidence: FollowedIncidence
    outside: OutsideIndex = 1.0
    azimuth: Angle = 0.0
    incidence_in: OptionalIndex | None = None
    parallel: YesOrNo = True

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is reflected and what is let through, from either side.

        Between media that do not absorb, both are the same from the two sides (Stokes'
        relations): r' = -r for s and for p, and power carried either way is 1 - |r|^2. Where
        the medium in front may be one that light does not get into, since it has been
        refracted before, what is reflected from behind is another matter.
        """
        n, k = numbers_of(self.index, self.domains()["index"])
        media = (_real(self.outside), n, k)
        angle = (Operand(self.incidence, "cos"), Operand(self.incidence, "sin"))
        before = () if self.incidence_in is None else (_real(self.incidence_in),)
        reflect = Operation(REFLECTION, (*media, *before, *angle))
        transmit = Operation(TRANSMISSION, (*media, *before, *angle))
        behind = (n, media[0], 0.0) if before else media
        reflect_back = Operation(REFLECTION, (*behind, *before, *angle))
        return self._ways((reflect, transmit), (reflect_back, transmit))


def _real(index: Any) -> Any:
    """Return n of a medium that does not absorb."""
    return index.n if isinstance(index, Material) else index
