"""Retarder: a wave plate."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling, turned
from optipath.elements.element import Element
from optipath.kernels.catalogue import RETARDER
from optipath.values.domains.quantities import Angle, Axis
from optipath.values.operation import Operation


class Retarder(Element, kind="retarder"):
    """A linear retarder; pi/2 makes it a quarter-wave plate, pi a half-wave plate.

    Parameters
    ----------
    retardance : float, array_like or Parameter
        By how many radians the slow component falls behind the fast one.
    angle : float, array_like or Parameter, optional
        The fast axis, in radians from x towards y of the retarder's frame. A quarter-wave
        plate at 0 turns light polarised at +45 degrees into S3 > 0.
    azimuth : float, array_like or Parameter, optional
        The turn of its frame against the frame of the port before it.

    Examples
    --------
    >>> Retarder(retardance=1.5708, angle=0.5).azimuth
    0.0
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle",)

    retardance: Angle
    angle: Axis = 0.0
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the retarder, its axes turned by the angle."""
        retarding = Operation(RETARDER, (self.retardance,))
        return (Coupling("in", "out", turned(self.angle, retarding)),)
