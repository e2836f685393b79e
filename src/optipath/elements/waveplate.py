"""Waveplate: a retarder, by its thickness and birefringence."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Self

from optipath.elements.coupling import Coupling, turned
from optipath.elements.designed_plates import plate_for
from optipath.elements.element import Element
from optipath.kernels.catalogue import WAVEPLATE
from optipath.values.domains.quantities import (
    Angle,
    Axis,
    Birefringence,
    PartLength,
    Wavelength,
)
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from optipath.values.crystals import Crystal
    from optipath.values.parameters import Parameter


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

    A plate of zero order at 550 nm, with the dispersion of quartz at other wavelengths:

    >>> from optipath import Detector, Source
    >>> plate = Waveplate.quarter(at="550 nm", crystal="quartz", angle="-45 deg")
    >>> path = Source(stokes=[1, 1, 0, 0]) >> plate >> Detector()
    >>> print(path.trace(wavelength=["450 nm", "550 nm", "650 nm"]).docp.round(3))
    [0.923 1.    0.966]
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle",)

    thickness: PartLength
    birefringence: Birefringence
    wavelength: Wavelength
    angle: Axis = 0.0
    azimuth: Angle = 0.0

    @classmethod
    def quarter(
        cls,
        at: Any,
        crystal: str | Crystal | Parameter | float = "quartz",
        *,
        order: int = 0,
        angle: Any = 0.0,
        azimuth: Any = 0.0,
    ) -> Self:
        """Return a quarter-wave plate by the wavelength at which it is one.

        Parameters
        ----------
        at : float or str
            The wavelength, in metres, or ``"550 nm"``.
        crystal : str, Crystal, Parameter or float, optional
            What it is made of: a name of `Crystal.named`, or the birefringence.
        order : int, optional
            How many whole waves it retards by besides.
        angle, azimuth : float, array_like or Parameter, optional
            Of the fast axis at that wavelength, and of the plate's frame.

        Returns
        -------
        Waveplate
            At the wavelength of the run, so that a path of it takes ``wavelength=``.

        Raises
        ------
        ValueFault
            If any is no such value.

        Examples
        --------
        >>> round(Waveplate.quarter("550 nm", order=10).thickness * 1e6, 1)
        615.5
        """
        return cls.retarding(math.pi / 2, at, crystal, order=order, angle=angle, azimuth=azimuth)

    @classmethod
    def half(
        cls,
        at: Any,
        crystal: str | Crystal | Parameter | float = "quartz",
        *,
        order: int = 0,
        angle: Any = 0.0,
        azimuth: Any = 0.0,
    ) -> Self:
        """Return a half-wave plate by the wavelength at which it is one.

        Parameters
        ----------
        at : float or str
            The wavelength, in metres, or ``"550 nm"``.
        crystal, order, angle, azimuth
            As in `quarter`.

        Returns
        -------
        Waveplate

        Raises
        ------
        ValueFault
            If any is no such value.
        """
        return cls.retarding(math.pi, at, crystal, order=order, angle=angle, azimuth=azimuth)

    @classmethod
    def retarding(
        cls,
        retardance: Any,
        at: Any,
        crystal: str | Crystal | Parameter | float = "quartz",
        *,
        order: int = 0,
        angle: Any = 0.0,
        azimuth: Any = 0.0,
    ) -> Self:
        """Return a plate by its retardance at a wavelength.

        Its thickness is (order + retardance / 2 pi) at / abs(n_e - n_o).

        Parameters
        ----------
        retardance : float or str
            Beyond whole waves, in radians, not negative; 0 with an order of 1 is a full-wave plate.
        at : float or str
            The wavelength, in metres, or ``"550 nm"``.
        crystal, order, angle, azimuth
            As in `quarter`.

        Returns
        -------
        Waveplate

        Raises
        ------
        ValueFault
            If any is no such value.
        """
        thickness, birefringence, wavelength = plate_for(retardance, at, crystal, order)
        return cls(thickness, birefringence, wavelength, angle, azimuth)

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the retarder, its axes turned by the angle."""
        retarding = Operation(WAVEPLATE, (self.thickness, self.birefringence, self.wavelength))
        return (Coupling("in", "out", turned(self.angle, retarding)),)
