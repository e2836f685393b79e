"""Rotator: turns the plane of polarisation, the frame staying where it is."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.kernels.catalogue import TURN_BACK
from optipath.values.domains.quantities import Angle
from optipath.values.operation import Operation


class Rotator(Element, kind="rotator"):
    """An optical rotator, such as quartz along its axis.

    Parameters
    ----------
    angle : float, array_like or Parameter
        By how many radians the polarisation turns from x towards y: counter-clockwise to who
        looks at the source, so that what is dextrorotatory has a negative angle.
        ``Medium(length, dextrorotation=...)`` takes the chemists' sign. Light that comes back
        from a mirror meets the same angle again, but the opposite one in a `FaradayRotator`.

    Examples
    --------
    >>> Rotator(angle=0.1)
    Rotator(angle=0.1)
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    angle: Angle

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the turn of the light, which is the frame's turn undone."""
        return (Coupling("in", "out", (Operation(TURN_BACK, (self.angle,)),)),)
