"""Attenuator: a grey filter."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.kernels.catalogue import ATTENUATOR
from optipath.values.domains.quantities import Fraction
from optipath.values.operation import Operation


class Attenuator(Element, kind="attenuator"):
    """A filter that dims light and leaves its polarisation as it is.

    Parameters
    ----------
    transmittance : float, array_like or Parameter
        The fraction of light let through, 0 to 1.

    Examples
    --------
    >>> Attenuator(transmittance=0.25)
    Attenuator(transmittance=0.25)
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    transmittance: Fraction

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the attenuation."""
        return (Coupling("in", "out", (Operation(ATTENUATOR, (self.transmittance,)),)),)
