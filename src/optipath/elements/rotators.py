"""Rotators: optical activity and the Faraday effect."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.errors import listed
from optipath.kernels.catalog import FARADAY_ROTATION, TURN_BACK
from optipath.materials.quantities import (
    Angle,
    MagneticField,
    OptionalAngle,
    OptionalPartLength,
    VerdetConstant,
)
from optipath.values.domains import Refused
from optipath.values.operands import Operation

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.values.domains import Domain


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
        By how many radians the polarisation turns from x towards y, counter-clockwise to who
        looks at the source, for light that enters at ``in``.
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
        arguments = [name for name in _FACTORS if getattr(self, name) is not None]
        if self.angle is not None and arguments:
            why = f"is given beside {listed(arguments)}; {_CURE}"
            yield "angle", self.angle, Refused("angle", why=why)
        elif self.angle is None and len(arguments) < len(_FACTORS):
            missing = (
                [name for name in _FACTORS if name not in arguments] if arguments else ["angle"]
            )
            why = f"is missing; {_CURE}"
            yield from ((name, None, Refused(name, why=why)) for name in missing)

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the turn of the light, which is the frame's turn undone."""
        if self.angle is not None:
            turning = Operation(TURN_BACK, (self.angle,))
        else:
            turning = Operation(FARADAY_ROTATION, (self.verdet, self.field, self.length))
        return (Coupling("in", "out", (turning,)),)
