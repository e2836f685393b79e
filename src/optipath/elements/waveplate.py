"""Waveplate: a retarder, by its thickness and birefringence."""

from __future__ import annotations

from typing import ClassVar

from optipath.elements.coupling import Coupling, Operation, turned
from optipath.elements.element import Element
from optipath.kernels.catalogue import WAVEPLATE
from optipath.values.domains.quantities import (
    Angle,
    Axis,
    Birefringence,
    PartLength,
    Wavelength,
)


class Waveplate(Element, kind="waveplate"):
    """A plate of a birefringent crystal, of any order.

    Its retardance is 2 pi thickness birefringence / wavelength (Born & Wolf, Principles of
    Optics, sec. 15.4.2). Of a thick plate, which retards by thousands of radians, cosine and sine
    of it have all digits that the numbers have that are given.

    Parameters
    ----------
    thickness : float, array_like or Parameter
        How far light goes through it, in metres, up to a kilometre.
    birefringence : float, array_like or Parameter
        The index of the slow axis minus that of the fast one, -10 to 10. Where it is negative,
        `angle` is that of the slow axis: with n_e - n_o of a crystal (quartz +0.0091, calcite
        -0.172) that of the ordinary ray, across the optic axis.
    wavelength : float, array_like or Parameter
        The wavelength in vacuum, in metres, 1e-12 to 1e-3.
    angle : float, array_like or Parameter, optional
        The fast axis, in radians from x towards y of the plate's frame.
    azimuth : float, array_like or Parameter, optional
        The turn of its frame against the frame of the port before it, in radians.

    Examples
    --------
    A quarter-wave plate of the tenth order, of quartz at 589 nm:

    >>> plate = Waveplate(10.25 * 589e-9 / 0.0091, 0.0091, 589e-9)
    >>> print(plate.mueller().matrix[2, 2:].round(12) + 0.0)
    [ 0. -1.]
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle",)

    thickness: PartLength
    birefringence: Birefringence
    wavelength: Wavelength
    angle: Axis = 0.0
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the retarder, its axes turned by the angle."""
        retarding = Operation(WAVEPLATE, (self.thickness, self.birefringence, self.wavelength))
        return (Coupling("in", "out", turned(self.angle, retarding)),)
