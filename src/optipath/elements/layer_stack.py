"""LayerStack: any number of smooth layers as one element."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.coupling import Operation, numbers_of
from optipath.kernels.catalogue import (
    STACK_REFLECTION,
    STACK_REFLECTION_BACK,
    STACK_TRANSMISSION,
    STACK_TRANSMISSION_BACK,
)
from optipath.values.domains.indices import INDEX
from optipath.values.domains.quantities import Angle, Incidence, Indices
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from optipath.elements.coupling import Coupling


class LayerStack(BoundaryElement, kind="layer-stack"):
    """Smooth parallel layers on a substrate, with the ports of an `Interface`.

    Light goes to and fro between the boundaries; intensities add up, as they do in layers much
    thicker than the coherence length. For thin films, which interfere, it is not meant. It
    depolarises, since light that has gone round more often has gained other phases.

    Parameters
    ----------
    indices : sequence of float, complex, array_like, Material or Parameter
        The medium in front first, then the layers, and the substrate last; all but the
        substrate without absorption. Two media are one `Interface`.
    incidence : float, array_like or Parameter
        The angle of incidence in radians, 0 to pi/2, in the medium in front.
    azimuth : float, array_like or Parameter, optional
        The turn of the frame of ``in``, x = s, against the frame of the port before it; for
        ``back``, a link may say it.

    Examples
    --------
    >>> pane = LayerStack([1.0, 1.5, 1.0], incidence=0.0)
    >>> print(pane.mueller("in", "transmitted").matrix[0, 0].round(12), 2 * 1.5 / (1 + 1.5**2))
    0.923076923077 0.9230769230769231
    """

    indices: Indices
    incidence: Incidence
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is reflected and what is let through, from either side."""
        pairs = [numbers_of(index, INDEX) for index in self._media]
        media = [n for n, _ in pairs]
        angle = (Operand(self.incidence, "cos"), Operand(self.incidence, "sin"))
        front, back = (*media, pairs[-1][1], *angle), (*media[::-1], 0.0, *angle)
        return self._ways(
            (Operation(STACK_REFLECTION, front), Operation(STACK_TRANSMISSION, front)),
            (Operation(STACK_REFLECTION_BACK, back), Operation(STACK_TRANSMISSION_BACK, back)),
        )

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
