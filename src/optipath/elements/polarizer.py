"""Polarizer: a filter with two principal transmittances."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling, turned
from optipath.elements.element import Element
from optipath.kernels.catalogue import POLARIZER
from optipath.values.domains.quantities import Angle, Axis, Fraction
from optipath.values.operation import Operation


class Polarizer(Element, kind="polarizer"):
    """A linear polariser, ideal unless told otherwise.

    Parameters
    ----------
    angle : float, array_like or Parameter, optional
        The transmission axis, in radians from x towards y of the polariser's frame.
    azimuth : float, array_like or Parameter, optional
        The turn of its frame against the frame of the port before it.
    transmittance, leakage : float, array_like or Parameter, optional
        The principal transmittances along and across the axis, 0 to 1.

    Examples
    --------
    >>> Polarizer(angle=0.5).leakage
    0.0
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle",)

    angle: Axis = 0.0
    azimuth: Angle = 0.0
    transmittance: Fraction = 1.0
    leakage: Fraction = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the diattenuator, its axes turned by the angle."""
        filtering = Operation(POLARIZER, (self.transmittance, self.leakage))
        return (Coupling("in", "out", turned(self.angle, filtering)),)
