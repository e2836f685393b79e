"""EllipticalRetarder: a rotation of the sphere of polarisation about any axis."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.elements.known_sizes import vanishes
from optipath.errors import ValueFault
from optipath.kernels.catalogue import ELLIPTICAL_RETARDER, RETARDER, ROTATION_ALONG
from optipath.values.domains.quantities import (
    FIRST_ROTATION_ANGLE,
    ROTATION_ANGLE,
    Angle,
    FirstRotationAngle,
    RotationAngle,
)
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from optipath.values.domains.domain import Domain


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
        The turn of its frame against the frame of the port before it, in radians.

    Examples
    --------
    >>> from optipath.light.light import Light
    >>> print(EllipticalRetarder(s2=0.6, s3=0.8) @ Light([1.0, 0.0, 0.6, 0.8]))
    Light([1. , 0. , 0.6, 0.8])
    """

    mirrored: ClassVar[tuple[str, ...]] = ("s2",)

    s1: FirstRotationAngle = 0.0
    s2: RotationAngle = 0.0
    s3: RotationAngle = 0.0
    azimuth: Angle = 0.0

    def __post_init__(self) -> None:
        """Ask besides whether three numbers are the vector."""
        given = self.s1
        super().__post_init__()
        asked = FIRST_ROTATION_ANGLE.doubt("EllipticalRetarder s1", given)
        if asked and self._is_of_one_component:
            raise ValueFault(asked)

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every number; beside others, three of s1 are no vector."""
        found = super().quantities()
        if self._is_of_one_component:
            return found
        first = FIRST_ROTATION_ANGLE
        return ((name, value, ROTATION_ANGLE if of is first else of) for name, value, of in found)

    @property
    def _is_of_one_component(self) -> bool:
        return vanishes(self.s2) and vanishes(self.s3)

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the rotation, by the cheapest kernel that is right."""
        return (Coupling("in", "out", (self._operation,)),)

    @property
    def _operation(self) -> Operation:
        if vanishes(self.s2):
            if vanishes(self.s3):
                return Operation(RETARDER, (self.s1,))
            if vanishes(self.s1):
                return Operation(ROTATION_ALONG, (self.s3, 0.5))
        return Operation(ELLIPTICAL_RETARDER, (self.s1, self.s2, self.s3))
