"""Medium: a straight stretch of something that absorbs, turns or retards light."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.beside_rotation import ROTATION_BESIDE_DEXTROROTATION
from optipath.elements.coupling import Coupling
from optipath.elements.element import Element
from optipath.elements.known_sizes import largest, over_a_length, overflow, vanishes
from optipath.elements.medium_limits import PassiveDichroism, WithinReach
from optipath.elements.medium_operations import operations_along
from optipath.errors import ValueFault, did_you_mean
from optipath.values.agreement import first_faults
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import read_only
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.domains.domain import Domain
from optipath.values.domains.quantities import (
    WAVELENGTH,
    Absorption,
    Angle,
    AnglePerLength,
    Axis,
    Depolarization,
    Dichroism,
    Length,
    OptionalAxis,
    RotatoryPower,
)
from optipath.values.made import refuse
from optipath.values.operands import operand_of
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.values.agreement import Agreement


_EXTINCTION = Domain("extinction coefficient", minimum=0.0)
_TURNING = ("rotation", "retardance", "dextrorotation")
_RATES = ("absorption", *_TURNING, "dichroism", "circular_dichroism", "depolarization")


class Medium(Element, kind="medium"):
    """A straight stretch of a medium that absorbs, turns, retards, filters and depolarises light.

    The intensity of unpolarised light goes as exp(-absorption length) (Beer and Lambert) where
    there is no dichroism. All that acts at once does so all along the way: the Mueller matrix is
    the exponential of what the medium does per length (R. C. Jones, J. Opt. Soc. Am. 38, 671
    (1948); Azzam, J. Opt. Soc. Am. 68, 1756 (1978); `docs/media.md`).

    However faint the light becomes, its polarisation and `Light.log10_intensity` are right up to
    an absorption times length of 2000, or 150 in float32; soon beyond, the light is dark. Two
    Media one after the other go twice as far. Beside dichroism it is up to a dichroism times
    length of 300, or 40 in float32.

    Parameters
    ----------
    length : float, array_like or Parameter
        How far light goes through it, in metres.
    absorption : float, array_like or Parameter, optional
        The napierian absorption coefficient of the intensity, per metre, not negative; beside
        dichroism, the mean of all states of polarisation, and no less than the dichroism.
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
    dichroism : float, array_like or Parameter, optional
        The linear dichroism, per metre: light along the dichroic axis is absorbed by
        absorption - dichroism, light across it by absorption + dichroism. So it is half the
        difference of the two napierian coefficients of the intensity, 2 pi / wavelength times
        that of the extinction coefficients, as ``retardance`` is that of the indices.
    dichroic_angle : float, array_like or Parameter, optional
        The dichroic axis, in radians from x towards y of the medium's frame; the fast axis,
        ``angle``, if it is not given. Along it more light passes if the dichroism is positive,
        as along the axis of a `Polarizer`.
    circular_dichroism : float, array_like or Parameter, optional
        The circular dichroism, per metre: light of S3 > 0 is absorbed by absorption -
        circular_dichroism, light of S3 < 0 by absorption + circular_dichroism. Chemists count the
        other way, and call S3 > 0 left-handed.
    depolarization : float, array_like or Parameter, optional
        By how much polarisation decays per metre, not negative: as exp(-depolarization length),
        alike for all states.

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

    A sheet whose dyes absorb across its axis, and which is stretched at 45 degrees to that:

    >>> dyed = Medium(0.1, 8.0, retardance=5.0, angle="45 deg", dichroism=7.0, dichroic_angle=0.0)
    >>> print((dyed.mueller() @ horizontal).stokes.round(3))
    [ 0.889  0.832  0.    -0.314]
    """

    mirrored: ClassVar[tuple[str, ...]] = ("angle", "dichroic_angle")

    length: Length
    absorption: Absorption = 0.0
    rotation: AnglePerLength = 0.0
    retardance: AnglePerLength = 0.0
    angle: Axis = 0.0
    azimuth: Angle = 0.0
    dextrorotation: RotatoryPower = 0.0
    dichroism: Dichroism = 0.0
    dichroic_angle: OptionalAxis | None = None
    circular_dichroism: Dichroism = 0.0
    depolarization: Depolarization = 0.0

    def __post_init__(self) -> None:
        """Keep values as every element does; those of one medium must agree."""
        super().__post_init__()
        refuse(first_faults(a for a in self.agreements("Medium") if not a.is_open))

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
            All that `Medium` takes besides.

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
        faults += [cls._option_fault(name) for name in others if name not in cls._others()]
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
        cure = did_you_mean(name, cls._others())
        return f"option '{name}' of Medium.from_extinction is unknown{cure}"

    @classmethod
    def _others(cls) -> tuple[str, ...]:
        """Return what is not computed from an extinction coefficient."""
        return tuple(cls.domains())[2:]

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value.

        Only one of the two rotations may be other than 0, and what is given per metre no more
        than what floats hold over the whole length.
        """
        for name, value, domain in super().quantities():
            if name == "rotation" and not vanishes(self.dextrorotation):
                yield name, value, ROTATION_BESIDE_DEXTROROTATION
            elif name in _RATES and overflow(value, self.length):
                yield name, value, over_a_length(domain, largest(self.length))
            else:
                yield name, value, domain

    def agreements(self, owner: str) -> Iterator[Agreement]:
        """Yield what must fit: dichroism with the absorption, and with depolarisation."""
        dichroism = self.dichroism, self.circular_dichroism
        if all(map(vanishes, dichroism)):
            return
        yield PassiveDichroism(tuple(map(operand_of, (self.absorption, *dichroism))), owner)
        if not vanishes(self.depolarization):
            others = self.retardance, self.turning, self.depolarization, self.length
            yield WithinReach(tuple(map(operand_of, (*dichroism, *others))), owner)

    @property
    def dichroic_axis(self) -> Any:
        """The axis of the linear dichroism: its own angle, or that of the fast axis."""
        return self.angle if self.dichroic_angle is None else self.dichroic_angle

    @property
    def turning(self) -> Any:
        """The rotation, by whichever sign it was given."""
        other: Any = self.dextrorotation
        return self.rotation if vanishes(other) else -other

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is done along the way, but for what is known to be 0."""
        return (Coupling("in", "out", operations_along(self)),)


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
