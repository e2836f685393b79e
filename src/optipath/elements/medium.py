"""Medium: a straight stretch of something that absorbs, turns or retards light."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.beside_rotation import (
    RETARDANCE_BESIDE_ROTATION,
    ROTATION_BESIDE_DEXTROROTATION,
)
from optipath.elements.coupling import Coupling, Operation, turned
from optipath.elements.element import Element
from optipath.errors import ValueFault, did_you_mean
from optipath.kernels.catalogue import (
    ABSORPTION_ALONG,
    DEXTROROTATION_ALONG,
    RETARDANCE_ALONG,
    ROTATION_ALONG,
    THIRD_OF_ABSORPTION,
)
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import read_only
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.degree_warnings import warn_of_turning
from optipath.values.domains.domain import Domain
from optipath.values.domains.quantities import (
    WAVELENGTH,
    Absorption,
    Angle,
    AnglePerLength,
    Axis,
    Length,
    RotatoryPower,
)
from optipath.values.made import is_checked_later
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.kernels.carriers.kernel import Kernel


_EXTINCTION = Domain("extinction coefficient", minimum=0.0)
_TURNING = ("rotation", "retardance", "dextrorotation")
_RATES = ("absorption", *_TURNING)
_OTHERS = ("rotation", "retardance", "angle", "azimuth", "dextrorotation")
_FAR = 50.0
"""From what absorption times length on it is done in three steps, each within any precision."""


class Medium(Element, kind="medium"):
    """A straight stretch of a homogeneous medium that absorbs, and turns or retards light.

    The intensity goes as exp(-absorption length) (Beer and Lambert). A rotation and a
    retardance together are refused: they do not commute; put two Media one after the other.

    However faint the light becomes, its polarisation and `Light.log10_intensity` are right up to
    an absorption times length of 2000, or 150 in float32; soon beyond, the light is dark. Two
    Media one after the other go twice as far.

    Parameters
    ----------
    length : float, array_like or Parameter
        How far light goes through it, in metres.
    absorption : float, array_like or Parameter, optional
        The napierian absorption coefficient of the intensity, per metre, not negative.
    rotation : float, array_like or Parameter, optional
        The optical rotation, in radians per metre from x towards y: counter-clockwise to who
        looks at the source.
    retardance : float, array_like or Parameter, optional
        By how many radians per metre the slow component falls behind the fast one.
    angle : float, array_like or Parameter, optional
        The fast axis, in radians from x towards y of the medium's frame.
    azimuth : float, array_like or Parameter, optional
        The turn of its frame against the frame of the port before it, in radians.
    dextrorotation : float, array_like or Parameter, optional
        The optical rotation by the chemists' sign, in radians per metre: positive for what is
        dextrorotatory, (+), and turns light clockwise to who looks at the source. In place of
        ``rotation``, which is the same with the other sign (IUPAC, Gold Book, "optical rotation").

    Examples
    --------
    >>> glass_of_water = Medium(length=0.1, absorption=6.9)
    >>> float(glass_of_water.mueller().matrix[0, 0].round(3))
    0.502

    A decimetre of a solution with 1 g/ml of sugar, [alpha] = +66.5 deg ml / (g dm):

    >>> from optipath.light.light import Light
    >>> sugar = Medium(length=0.1, dextrorotation=math.radians(66.5) / 0.1)
    >>> horizontal = Light([1.0, 1.0, 0.0, 0.0])
    >>> print(np.degrees((sugar.mueller() @ horizontal).aop).round(9))
    -66.5
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle",)

    length: Length
    absorption: Absorption = 0.0
    rotation: AnglePerLength = 0.0
    retardance: AnglePerLength = 0.0
    angle: Axis = 0.0
    azimuth: Angle = 0.0
    dextrorotation: RotatoryPower = 0.0

    def __post_init__(self) -> None:
        """Keep values as every element does; warn of turns that look typed in degrees."""
        given = {name: getattr(self, name) for name in _TURNING}
        super().__post_init__()
        for name, rate in given.items():
            if rate is not getattr(Medium, name) and not is_checked_later():
                warn_of_turning(
                    f"Medium {name}", rate, _largest(self.length), self.domains()[name].unit
                )

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
            The wavelength in vacuum, in metres, 1e-12 to 1e-3; values, no Parameter.
        **others : float, array_like or Parameter
            The rotation or dextrorotation, the retardance, the angle and the azimuth, as in
            `Medium`.

        Returns
        -------
        Medium

        Raises
        ------
        ValueFault
            If `k` or `wavelength` is a Parameter or out of range, the absorption is too large
            for a float, or another option is unknown.
        ShapeError
            If their arrays do not broadcast together.

        Examples
        --------
        >>> round(Medium.from_extinction(1e-6, k=0.05, wavelength=500e-9).absorption)
        1256637
        """
        k = read_only(_EXTINCTION.read("k", k))
        wavelength = read_only(WAVELENGTH.read("wavelength", wavelength))
        given = {"k": (k, _EXTINCTION), "wavelength": (wavelength, WAVELENGTH)}
        faults = [f for name, (v, domain) in given.items() for f in _value_faults(name, v, domain)]
        faults += [cls._option_fault(name) for name in others if name not in _OTHERS]
        if faults:
            raise ValueFault(*faults)
        check_broadcast({name: np.shape(value) for name, (value, _) in given.items()})
        return cls(length, _absorption(k, wavelength), **others)

    @classmethod
    def _option_fault(cls, name: str) -> str:
        if name == "absorption":
            return (
                "absorption is computed from k and wavelength; leave it out, or give it to Medium "
                "without them"
            )
        return f"option '{name}' of Medium.from_extinction is unknown{did_you_mean(name, _OTHERS)}"

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value; beside a rotation, a retardance may be nothing but 0.

        Only one of the two rotations may be other than 0, and what is given per metre no more
        than what floats hold over the whole length.
        """
        rotates, dextrorotates = not _vanishes(self.rotation), not _vanishes(self.dextrorotation)
        for name, value, domain in super().quantities():
            if name == "retardance" and (rotates or dextrorotates):
                yield name, value, RETARDANCE_BESIDE_ROTATION
            elif name == "rotation" and dextrorotates:
                yield name, value, ROTATION_BESIDE_DEXTROROTATION
            elif name in _RATES and _overflow(value, self.length):
                yield name, value, _over_a_length(domain, _largest(self.length))
            else:
                yield name, value, domain

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is done along the way, but for what is known to be 0."""
        if _largest(self.absorption) * _largest(self.length) <= _FAR:
            absorbing = self._along(ABSORPTION_ALONG, self.absorption)
        else:
            absorbing = 3 * self._along(THIRD_OF_ABSORPTION, self.absorption)
        rotating = self._along(ROTATION_ALONG, self.rotation)
        rotating += self._along(DEXTROROTATION_ALONG, self.dextrorotation)
        retarding = self._along(RETARDANCE_ALONG, self.retardance)
        if retarding:
            retarding = turned(self.angle, *retarding)
        return (Coupling("in", "out", (*absorbing, *rotating, *retarding)),)

    def _along(self, kernel: Kernel, per_metre: Any) -> tuple[Operation, ...]:
        return () if _vanishes(per_metre) else (Operation(kernel, (per_metre, self.length)),)


def _vanishes(value: Any) -> bool:
    """Tell whether a value is known to be 0."""
    if isinstance(value, Parameter):
        return value.bound and _vanishes(value.placed(value.resolve(value.default).value))
    return isinstance(value, (int, float, np.ndarray)) and not np.any(value)


def _largest(value: Any) -> float:
    """Return the size of a known value, or the most of an open one; infinite without a range."""
    if isinstance(value, Parameter):
        if not value.bound:
            return value.span_of(value.minimum, value.maximum)[1]
        value = value.placed(value.resolve(value.default).value)
    if type(value) is float:
        return abs(value)
    known = np.asarray(value) if isinstance(value, (int, float, np.ndarray)) else np.array(None)
    return float(np.max(np.abs(known), initial=0.0)) if known.dtype.kind in "iuf" else math.inf


def _overflow(per_metre: Any, length: Any) -> bool:
    """Tell whether two values are known, and their product is too large for a float."""
    sizes = _largest(per_metre), _largest(length)
    return max(sizes) < math.inf and math.prod(sizes) == math.inf


def _over_a_length(domain: Domain, length: float) -> Domain:
    """Return the domain of what floats hold times a length."""
    most = np.finfo(np.float64).max / length
    name = f"{domain.name}, over a length of {length:g} m,"
    return replace(domain, name=name, minimum=max(domain.minimum, -most), maximum=most)


def _absorption(k: Any, wavelength: Any) -> Any:
    if is_traced(k) or is_traced(wavelength):
        return 4.0 * math.pi * k / wavelength
    k, wavelength = np.asarray(k), np.asarray(wavelength)
    with np.errstate(over="ignore"):
        absorption = 4.0 * math.pi * k / wavelength
    if not np.all(np.isfinite(absorption)):
        raise ValueFault(
            f"k is up to {np.max(k):g}, and absorption = 4 pi k / wavelength is too large for a "
            f"float; give a smaller k"
        )
    return absorption


def _value_faults(name: str, value: Any, domain: Domain) -> tuple[str, ...]:
    if isinstance(value, Parameter):
        problem = f"{name} is parameter '{value.name}', but absorption is computed from it at once"
        return (f"{problem}; give a value, or give Medium a parameter for its absorption",)
    try:
        domain.check(name, value)
    except ValueFault as fault:
        return fault.faults
    return ()
