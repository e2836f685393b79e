"""Interface: a smooth boundary between two media, by Fresnel's equations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.coupling import numbers_of
from optipath.elements.known_sizes import vanishes
from optipath.kernels.catalogue import (
    PHASE_INDEX,
    REFLECTION,
    REFLECTION_FROM_ABSORBING,
    TRANSMISSION,
    TRANSMISSION_FROM_ABSORBING,
    TRANSMISSION_FROM_BEHIND,
)
from optipath.values.domains.indices import INDEX, LIT_INDEX
from optipath.values.domains.quantities import (
    Angle,
    FollowedIncidence,
    Index,
    LitIndex,
    OptionalLitIndex,
    YesOrNo,
)
from optipath.values.operands import Operand
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.elements.coupling import Coupling
    from optipath.kernels.carriers.kernel import KernelFamily
    from optipath.values.domains.domain import Domain


class Interface(BoundaryElement, kind="interface"):
    """A smooth boundary; its frames have x = s, perpendicular to the plane of incidence.

    Light from the front enters at ``in``; what is reflected leaves at ``reflected``, and what
    is refracted at ``transmitted``, as the power carried into the medium behind: a radiance is
    multiplied by (n2 / n1)^2 besides (Nicodemus, Am. J. Phys. 31, 368 (1963)). Light from
    behind enters at ``back``: what is reflected leaves at ``transmitted``, and what is
    refracted at ``reflected``.

    Either medium may absorb. Light in an absorbing medium has come in by a smooth face that is
    parallel to this one: its planes of constant amplitude are parallel to the face. What is
    reflected and let through, each over what arrives, need not add up to 1 there
    ("Light in and out of media that absorb", in the documentation). A wave that fades along the
    normal faster than it goes on is refused.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the medium behind the boundary.
    incidence : float, array_like, Parameter or FOLLOWS
        The angle of incidence in radians, 0 to pi/2, of light from the front; with `FOLLOWS`, that
        of the boundary before, whose light has been refracted by Snell's law. In a medium that
        absorbs, the real angle: that of the normal to the planes of constant phase.
    outside : float, complex, array_like, Material, Parameter or FOLLOWS, optional
        The index of the medium in front; with `FOLLOWS`, the medium that the light of the
        boundary before comes in.
    azimuth : float, array_like or Parameter, optional
        The angle by which the frame of ``in`` is turned about the direction of travel
        against the frame of the port before it. For ``back``, which light from the next
        boundary of a stack enters without a turn, a link may say it.
    incidence_in : float, complex, array_like, Material or Parameter, optional
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
    lit_from_absorbing: ClassVar[bool] = True

    index: Index
    incidence: FollowedIncidence
    outside: LitIndex = 1.0
    azimuth: Angle = 0.0
    incidence_in: OptionalLitIndex | None = None
    parallel: YesOrNo = True

    def domains_entered(self, port: str) -> Mapping[str, Domain]:
        """Return that light cannot come from a medium behind of index 0."""
        return {"index": LIT_INDEX} if port == "back" else {}

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is reflected and what is let through, from either side.

        Between media that do not absorb, both are the same from the two sides (Stokes'
        relations): r' = -r for s and for p, and power carried either way is ``1 - |r|^2``. Where
        the medium in front may be one that light does not get into, since it has been
        refracted before, what is reflected from behind is another matter. With absorption,
        r' = -r as well, but what is let through differs.
        """
        first, second = [numbers_of(index, INDEX) for index in (self.outside, self.index)]
        angle = (Operand(self.incidence, "cos"), Operand(self.incidence, "sin"))
        before = self._index_of_angle(angle)
        behind = (second, first) if before else (first, second)
        given = first, second, *before, *angle
        reflect, transmit = [_between(family, *given) for family in _FROM_FRONT]
        reflect_back = _between(_FROM_FRONT[0], *behind, *before, *angle)
        through_back = transmit
        if not (vanishes(first[1]) and vanishes(second[1])):
            numbers = (*first, *second, *before, *angle)
            through_back = Operation(TRANSMISSION_FROM_BEHIND, numbers)
        return self._ways((reflect, transmit), (reflect_back, through_back))

    def _index_of_angle(self, angle: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return n0 of the medium in which the incidence is measured, unless that is in front."""
        if self.incidence_in is None:
            return ()
        n, k = numbers_of(self.incidence_in, INDEX)
        return (n,) if vanishes(k) else Operation(PHASE_INDEX, (n, k, *angle)).results(1)


_FROM_FRONT = (
    (REFLECTION, REFLECTION_FROM_ABSORBING),
    (TRANSMISSION, TRANSMISSION_FROM_ABSORBING),
)


def _between(
    families: tuple[KernelFamily, KernelFamily],
    first: tuple[Any, ...],
    second: tuple[Any, ...],
    *angle: Any,
) -> Operation:
    """Return the operation for light from the first of two media, of (n, k) each."""
    usual, from_absorbing = families
    if vanishes(first[1]):
        return Operation(usual, (first[0], *second, *angle))
    return Operation(from_absorbing, (*first, *second, *angle))
