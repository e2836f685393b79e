"""Medium: a straight stretch of something that absorbs, turns or retards light."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.domains import Absorption, Angle, AnglePerLength, Domain, Length
from optipath.elements.beside_rotation import BESIDE_ROTATION
from optipath.elements.coupling import Coupling, Operation, turned
from optipath.elements.element import Element
from optipath.errors import ValueFault
from optipath.jax_values import is_traced
from optipath.kernels import ABSORPTION_ALONG, RETARDANCE_ALONG, ROTATION_ALONG
from optipath.parameters import Parameter
from optipath.shapes import check_broadcast

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.kernels import Kernel


_EXTINCTION = Domain("extinction coefficient", minimum=0.0)
_WAVELENGTH = Domain("wavelength", "length", minimum=1e-12)


class Medium(Element, kind="medium"):
    """A straight stretch of a homogeneous medium that absorbs, and turns or retards light.

    The intensity goes as exp(-absorption length) (Beer and Lambert). A rotation and a
    retardance together are refused: they do not commute; put two Media one after the other.

    Parameters
    ----------
    length : float, array_like or Parameter
        How far light goes through it, in metres.
    absorption : float, array_like or Parameter, optional
        The napierian absorption coefficient of the intensity, per metre, not negative.
    rotation : float, array_like or Parameter, optional
        The optical rotation, in radians per metre from x towards y.
    retardance : float, array_like or Parameter, optional
        By how many radians per metre the slow component falls behind the fast one.
    angle : float, array_like or Parameter, optional
        The fast axis, in radians from x towards y of the medium's frame.
    azimuth : float, array_like or Parameter, optional
        The turn of its frame against the frame of the port before it, in radians.

    Examples
    --------
    >>> glass_of_water = Medium(length=0.1, absorption=6.9)
    >>> float(glass_of_water.mueller().matrix[0, 0].round(3))
    0.502
    """

    length: Length
    absorption: Absorption = 0.0
    rotation: AnglePerLength = 0.0
    retardance: AnglePerLength = 0.0
    angle: Angle = 0.0
    azimuth: Angle = 0.0

    @classmethod
    def from_extinction(cls, length: Any, k: Any, wavelength: Any, **others: Any) -> Medium:
        """Return a medium whose absorption is that of an extinction coefficient.

        absorption = 4 pi k / wavelength; Born & Wolf, Principles of Optics, sec. 14.1.

        Parameters
        ----------
        length : float, array_like or Parameter
            As in `Medium`.
        k : float or array_like
            The imaginary part of the index of refraction, not negative; values, no Parameter.
        wavelength : float or array_like
            The wavelength in vacuum, in metres, 1e-12 or more; values, no Parameter.
        **others : float, array_like or Parameter
            The rotation, the retardance, the angle and the azimuth, as in `Medium`.

        Raises
        ------
        ValueFault
            If `k` or `wavelength` is a Parameter or out of range.
        ShapeError
            If their arrays do not broadcast together.

        Examples
        --------
        >>> round(Medium.from_extinction(1e-6, k=0.05, wavelength=500e-9).absorption)
        1256637
        """
        given = {"k": (k, _EXTINCTION), "wavelength": (wavelength, _WAVELENGTH)}
        faults = [f for name, (v, domain) in given.items() for f in _value_faults(name, v, domain)]
        if faults:
            raise ValueFault(*faults)
        check_broadcast({name: np.shape(value) for name, (value, _) in given.items()})
        k, wavelength = (v if is_traced(v) else np.asarray(v) for v, _ in given.values())
        return cls(length, 4.0 * math.pi * k / wavelength, **others)

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value; beside a rotation, a retardance may be nothing but 0."""
        for name, value, domain in super().quantities():
            alone = name != "retardance" or _vanishes(self.rotation)
            yield name, value, domain if alone else BESIDE_ROTATION

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is done along the way, but for what is known to be 0."""
        absorbing = self._along(ABSORPTION_ALONG, self.absorption)
        rotating = self._along(ROTATION_ALONG, self.rotation)
        retarding = self._along(RETARDANCE_ALONG, self.retardance)
        if retarding:
            retarding = turned(self.angle, *retarding)
        return (Coupling("in", "out", (*absorbing, *rotating, *retarding)),)

    def _along(self, kernel: Kernel, per_metre: Any) -> tuple[Operation, ...]:
        return () if _vanishes(per_metre) else (Operation(kernel, (per_metre, self.length)),)


def _vanishes(value: Any) -> bool:
    """Tell whether a value is known to be 0."""
    if isinstance(value, Parameter):
        return value.bound and _vanishes(value.resolve(value.default).value)
    return isinstance(value, (int, float, np.ndarray)) and not np.any(value)


def _value_faults(name: str, value: Any, domain: Domain) -> tuple[str, ...]:
    if isinstance(value, Parameter):
        problem = f"{name} is parameter '{value.name}', but absorption is computed from it at once"
        return (f"{problem}; give a value, or give Medium a parameter for its absorption",)
    try:
        domain.check(name, value)
    except ValueFault as fault:
        return fault.faults
    return ()
