"""LayerStack: any number of smooth layers as one element."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.coupling import Operation, numbers_of
from optipath.kernels.catalogue import (
    STACK_REFLECTION,
    STACK_REFLECTION_BACK,
    STACK_REFLECTION_BELOW,
    STACK_TRANSMISSION,
    STACK_TRANSMISSION_BACK,
    STACK_TRANSMISSION_BELOW,
)
from optipath.values.arrays.read_only import changed
from optipath.values.domains.indices import INDEX, OPTIONAL_OUTSIDE
from optipath.values.domains.quantities import (
    Angle,
    FollowedIncidence,
    Indices,
    OptionalIndex,
    YesOrNo,
)
from optipath.values.made import not_known_sound
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from optipath.elements.coupling import Coupling

_STACK = STACK_REFLECTION, STACK_TRANSMISSION
_STACK_BACK = STACK_REFLECTION_BACK, STACK_TRANSMISSION_BACK
_BELOW = STACK_REFLECTION_BELOW, STACK_TRANSMISSION_BELOW


class LayerStack(BoundaryElement, kind="layer-stack"):
    """Smooth parallel layers on a substrate, with the ports of an `Interface`.

    Light goes to and fro between the boundaries; intensities add up, as they do in layers much
    thicker than the coherence length. For thin films, which interfere, it is not meant. It
    depolarises, since light that has gone round more often has gained other phases.

    Parameters
    ----------
    indices : sequence of float, complex, array_like, Material or Parameter
        The medium in front first, then the layers, and the substrate last; all but the
        substrate without absorption. Two media are one `Interface`. The first may be `FOLLOWS`,
        as ``outside`` of an `Interface`.
    incidence : float, array_like, Parameter or FOLLOWS
        The angle of incidence in radians, 0 to pi/2, in the medium in front.
    azimuth : float, array_like or Parameter, optional
        The turn of the frame of ``in``, x = s, against the frame of the port before it; for
        ``back``, a link may say it.
    incidence_in, parallel : optional
        As `Interface` takes them.

    Examples
    --------
    >>> pane = LayerStack([1.0, 1.5, 1.0], incidence=0.0)
    >>> print(pane.mueller("in", "transmitted").matrix[0, 0].round(12), 2 * 1.5 / (1 + 1.5**2))
    0.923076923077 0.9230769230769231
    """

    media_fields: ClassVar[tuple[str, str]] = ("indices[0]", "indices[-1]")
    mirrored: ClassVar[tuple[str, ...]] = ()

    indices: Indices
    incidence: FollowedIncidence
    azimuth: Angle = 0.0
    incidence_in: OptionalIndex | None = None
    parallel: YesOrNo = True

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is reflected and what is let through, from either side."""
        pairs = [numbers_of(index, INDEX) for index in self._media]
        media = [n for n, _ in pairs]
        angle: tuple[Any, ...] = (Operand(self.incidence, "cos"), Operand(self.incidence, "sin"))
        families = _STACK, _STACK_BACK
        if self.incidence_in is not None:
            angle, families = (
                (numbers_of(self.incidence_in, OPTIONAL_OUTSIDE)[0], *angle),
                (_BELOW, _BELOW),
            )
        front, back = (*media, pairs[-1][1], *angle), (*media[::-1], 0.0, *angle)
        ways = zip(families, (front, back), strict=True)
        from_front, from_behind = [
            (Operation(reflection, given), Operation(transmission, given))
            for (reflection, transmission), given in ways
        ]
        return self._ways(from_front, from_behind)

    def taking_over(self, **values: Any) -> LayerStack:
        """Return a stack like it with values of the boundary before in place of `FOLLOWS`."""
        if "outside" in values:
            values["indices"] = (values.pop("outside"), *self._media[1:])
        return not_known_sound(changed(self, **values))

    @property
    def outside(self) -> Any:
        """The index of the medium in front."""
        return self._media[0]

    @property
    def index(self) -> Any:
        """The index of the substrate."""
        return self._media[-1]

    @property
    def _media(self) -> tuple[Any, ...]:
        """The indices; two of air where they are no list, which is told as a fault."""
        several: Any = self.indices
        return several if isinstance(several, tuple) and len(several) > 1 else (1.0, 1.0)
