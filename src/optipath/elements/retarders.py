"""Retarders and rotators: by an angle, by thickness, by a magnetic field."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

from optipath.elements.coupling import Coupling, turned, vanishes
from optipath.elements.element import Element
from optipath.errors import ValueFault
from optipath.faults import listed, shown
from optipath.kernels.catalog import (
    ELLIPTICAL_RETARDER,
    FARADAY_ROTATION,
    RETARDER,
    ROTATION_ALONG,
    TURN_BACK,
    WAVEPLATE,
)
from optipath.materials.crystals import Crystal
from optipath.materials.quantities import (
    ANGLE,
    WAVELENGTH,
    Angle,
    Axis,
    Birefringence,
    MagneticField,
    OptionalAngle,
    OptionalPartLength,
    PartLength,
    RotationAngle,
    VerdetConstant,
    Wavelength,
)
from optipath.values.curve_value import CurveValue
from optipath.values.domains import Refused, one_number
from optipath.values.operands import Operation
from optipath.values.precision import real_number
from optipath.values.wavelength import Wavelength as WavelengthParameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.values.domains import Domain
    from optipath.values.parameters import Parameter


class Retarder(Element, kind="retarder"):
    """A linear retarder; pi/2 makes it a quarter-wave plate, pi a half-wave plate.

    Parameters
    ----------
    retardance : float, array_like or Parameter
        By how many radians the slow component falls behind the fast one.
    angle, azimuth : float, array_like or Parameter, optional
        The fast axis, in radians from x towards y of the retarder's frame, and the turn of this
        frame against the frame of the port before it. A quarter-wave plate at 0 turns light
        polarised at +45 degrees into S3 > 0.

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
    angle, azimuth : float, array_like or Parameter, optional
        The fast axis, and the turn of the plate's frame, as `Retarder` takes them.

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
        at, crystal, order, angle, azimuth
            As `retarding` takes them.

        Returns
        -------
        Waveplate
            At the wavelength of the run, so that a path of it takes ``wavelength=``.

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
        at, crystal, order, angle, azimuth
            As `retarding` takes them.

        Returns
        -------
        Waveplate
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
        crystal : str, Crystal, Parameter or float, optional
            What it is made of: a name of `Crystal.named`, or the birefringence.
        order : int, optional
            How many whole waves it retards by besides.
        angle, azimuth : float, array_like or Parameter, optional
            Of the fast axis at that wavelength, and of the plate's frame.

        Returns
        -------
        Waveplate
        """
        thickness, birefringence, wavelength = plate_for(retardance, at, crystal, order)
        return cls(thickness, birefringence, wavelength, angle, azimuth)

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the retarder, its axes turned by the angle."""
        retarding = Operation(WAVEPLATE, (self.thickness, self.birefringence, self.wavelength))
        return (Coupling("in", "out", turned(self.angle, retarding)),)


class EllipticalRetarder(Element, kind="elliptical-retarder"):
    """A retarder whose fast state may be of any ellipticity, by its rotation vector.

    The vector (s1, s2, s3) has the length of the retardance, and the direction of the Stokes
    parameters of the state that is fast; it turns the sphere of polarisation about itself, by the
    right-hand rule (Chipman, Lam & Young, Polarized Light and Optical Systems (2018), ch. 6).
    ``Retarder(d, a)`` has (d cos 2a, d sin 2a, 0), ``Rotator(a)`` has (0, 0, 2a).

    Where s2 and s3 are known to be 0, or s1 and s2, it is computed as those are; else it has no
    Jones matrix here, and is refused where Jones columns are composed.

    Parameters
    ----------
    s1, s2, s3 : float, array_like or Parameter, optional
        By how many radians light along y falls behind that along x, light at -45 degrees behind
        that at 45, and light of S3 < 0 behind that of S3 > 0; up to 1e15, beyond which floats
        are more than an eighth of a radian apart.
    azimuth : float, array_like or Parameter, optional
        As `Retarder` takes it.

    Examples
    --------
    >>> from optipath.light.light import Light
    >>> print(EllipticalRetarder(s2=0.6, s3=0.8) @ Light([1.0, 0.0, 0.6, 0.8]))
    Light([1. , 0. , 0.6, 0.8])
    """

    mirrored: ClassVar[tuple[str, ...]] = ("s2",)

    s1: RotationAngle = 0.0
    s2: RotationAngle = 0.0
    s3: RotationAngle = 0.0
    azimuth: Angle = 0.0

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the rotation, by the cheapest kernel that is right."""
        operation = Operation(ELLIPTICAL_RETARDER, (self.s1, self.s2, self.s3))
        if vanishes(self.s2) and vanishes(self.s3):
            operation = Operation(RETARDER, (self.s1,))
        elif vanishes(self.s2) and vanishes(self.s1):
            operation = Operation(ROTATION_ALONG, (self.s3, 0.5))
        return (Coupling("in", "out", (operation,)),)


def plate_for(retardance: Any, at: Any, crystal: Any, order: Any) -> tuple[float, Any, Any]:
    """Return thickness, birefringence and wavelength of a plate, in metres."""
    whole = real_number(order)
    if whole is None or whole < 0.0 or not whole.is_integer():
        raise ValueFault(
            f"order is {shown(order)}; give how many whole waves there are, 0, 1, 2, ..."
        )
    phase = one_number("retardance", retardance, ANGLE)
    where = one_number("at", WavelengthParameter("at").resolve(at).value, WAVELENGTH)
    if phase < 0.0:
        raise ValueFault(
            f"retardance is {phase:g}; give one of 0 or more, and turn the angle by 90 deg"
        )
    crystal = Crystal.named(crystal) if isinstance(crystal, str) else crystal
    of_index = crystal.birefringence if isinstance(crystal, Crystal) else crystal
    by_wavelength = isinstance(of_index, CurveValue)
    if not by_wavelength and real_number(of_index) is None:
        raise ValueFault(
            f"crystal is {shown(crystal)}; give a name such as 'quartz', a Crystal, or a "
            f"birefringence as a number or by wavelength"
        )
    there = float(of_index.at(where) if by_wavelength else of_index)
    if not np.isfinite(there) or there == 0.0:
        raise ValueFault(
            f"crystal has a birefringence of {there:g} at {where * 1e9:.10g} nm; give one that "
            f"retards"
        )
    thickness = (whole + phase / (2.0 * math.pi)) * where / abs(there)
    when = of_index.depends_on[0] if by_wavelength else WavelengthParameter()
    return thickness, -of_index if there < 0.0 else of_index, when


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


_FACTORS = ("verdet", "field", "length")
_CURE = f"give the angle alone, or {listed([*_FACTORS])}"


class FaradayRotator(Element, kind="faraday-rotator"):
    """A Faraday rotator: glass, a crystal or a vapour in a magnetic field along the light.

    By its angle, or by V B L, the product of Verdet constant, field and length (Hecht, Optics,
    sec. 8.11.2). It does to light what a `Rotator` does, but on the way back: the field is then
    against the light, and in the frame of that light the angle is the opposite one.

    Parameters
    ----------
    angle : float, array_like or Parameter, optional
        As of a `Rotator`, for light that enters at ``in``.
    verdet : float, array_like or Parameter, optional
        The Verdet constant in rad/(T m), -1e9 to 1e9. With a positive one, of most glasses, light
        that goes along the field turns from x towards y (levorotatory, as Hecht has it). That of
        terbium gallium garnet (TGG) is about -134 at 632.8 nm.
    field : float, array_like or Parameter, optional
        The magnetic flux density along the direction of travel, in teslas, -1e6 to 1e6; negative
        where it points against the light.
    length : float, array_like or Parameter, optional
        How far light goes through it, in metres, up to a kilometre.

    Examples
    --------
    >>> from optipath.light.light import Light
    >>> horizontal = Light([1.0, 1.0, 0.0, 0.0])
    >>> garnet = FaradayRotator(verdet=-134.0, field="-0.2 T", length="20 mm")
    >>> print((garnet @ horizontal).aop.round(9), (FaradayRotator(0.536) @ horizontal).aop.round(9))
    0.536 0.536
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle", "field")

    angle: OptionalAngle | None = None
    verdet: VerdetConstant | None = None
    field: MagneticField | None = None
    length: OptionalPartLength | None = None

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value; an angle beside another, or a factor that is missing, is refused."""
        yield from super().quantities()
        missing = [name for name in _FACTORS if getattr(self, name) is None]
        some = len(missing) < len(_FACTORS)
        if self.angle is not None and some:
            others = listed([name for name in _FACTORS if name not in missing])
            yield "angle", self.angle, Refused("angle", why=f"is given beside {others}; {_CURE}")
        elif self.angle is None and missing:
            for name in missing if some else ["angle"]:
                yield name, None, Refused(name, why=f"is missing; {_CURE}")

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the turn of the light, which is the frame's turn undone."""
        kernel, values = TURN_BACK, tuple[Any, ...]((self.angle,))
        if self.angle is None:
            kernel, values = FARADAY_ROTATION, (self.verdet, self.field, self.length)
        return (Coupling("in", "out", (Operation(kernel, values),)),)
