"""Medium: a straight length of something that absorbs, rotates or retards light."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.elements.coupling import Coupling, largest, turned, vanishes
from optipath.elements.element import Element
from optipath.elements.polarizers import along_circular_axes
from optipath.errors import ValueFault
from optipath.kernels.catalog import (
    ABSORPTION_ALONG,
    ABSORPTION_WITH_DICHROISM,
    DEPOLARIZATION_ALONG,
    DEPOLARIZING_DICHROISM_ALONG,
    DEXTROROTATION_ALONG,
    DICHROISM_ALONG,
    DICHROISM_AND_RETARDANCE_ALONG,
    RETARDANCE_ALONG,
    ROTATION_ALONG,
    THIRD_OF_ABSORPTION,
    THIRD_WITH_DICHROISM,
)
from optipath.kernels.medium import LARGEST, LARGEST_DICHROISM
from optipath.materials.quantities import (
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
from optipath.values.agreement import Agreement, first_faults, text_of
from optipath.values.arrays import check_broadcast, same
from optipath.values.domains import Domain, Refused
from optipath.values.operands import Operation, operand_of
from optipath.values.use import refuse

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.kernels.kernel import Kernel


_EXTINCTION = Domain("extinction coefficient", minimum=0.0)


class Medium(Element, kind="medium"):
    """A straight stretch of a medium that absorbs, turns, retards, filters and depolarises light.

    The intensity of unpolarised light goes as exp(-absorption length) (Beer and Lambert) where
    there is no dichroism. All that acts at once does so all along the way: the Mueller matrix is
    the exponential of what the medium does per length (R. C. Jones, J. Opt. Soc. Am. 38, 671
    (1948); Azzam, J. Opt. Soc. Am. 68, 1756 (1978); `docs/media.md`).

    Behind an absorption times length of some 700, or 85 in float32, floats end and light is dark.
    Up to there it is right, beside dichroism up to a dichroism times length of 300, or 40 in
    float32.

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
    angle, azimuth : float, array_like or Parameter, optional
        The fast axis, and the turn of the medium's frame, as `Retarder` takes them.
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
            If `k` or `wavelength` is a Parameter or out of range, or the absorption is too large
            for a float.
        ShapeError
            If their arrays do not broadcast together.

        Examples
        --------
        >>> round(Medium.from_extinction(1e-6, k=0.05, wavelength=500e-9).absorption)
        1256637
        """
        faults: list[str] = []
        numbers = []
        for name, value, domain in (("k", k, _EXTINCTION), ("wavelength", wavelength, WAVELENGTH)):
            with ValueFault.collecting(faults):
                numbers.append(domain.check(name, value))
        ValueFault.raise_for(faults)
        check_broadcast({"k": np.shape(numbers[0]), "wavelength": np.shape(numbers[1])})
        with np.errstate(over="ignore"):
            absorption = 4.0 * math.pi * numbers[0] / numbers[1]
        return cls(length, absorption, **others)

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value; only one of the two rotations may be other than 0."""
        why = "stands beside a dextrorotation, the same rotation with the other sign"
        twice = not (vanishes(self.rotation) or vanishes(self.dextrorotation))
        for name, value, domain in super().quantities():
            refused = twice and name == "rotation"
            yield name, value, Refused(name, why=why) if refused else domain

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


_ROUNDING = 1e-6
"""By what share dichroism may exceed the absorption, values being rounded; nothing amplifies."""


@dataclass(frozen=True, eq=False)
class PassiveDichroism(Agreement):
    """What absorbs one state of light more than the mean absorbs another less, but not below 0.

    The operands are the absorption, the linear dichroism and the circular one, per metre.
    """

    owner: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        absorption, linear, circular = numbers
        return ~(xp.hypot(linear, circular) > absorption * (1.0 + _ROUNDING))

    def sentence(self, *numbers: float) -> str:
        absorption, linear, circular = (
            text_of(operand, number / 100.0, " 1/cm")
            for operand, number in zip(self.operands, numbers, strict=True)
        )
        least = float(abs(complex(*numbers[1:]))) / 100.0
        return (
            f"'{self.owner}' would amplify some light: its dichroism is {linear} and its "
            f"circular_dichroism {circular}, but its absorption, the mean of all states, "
            f"{absorption}; give an absorption of {least:.10g} 1/cm or more"
        )


@dataclass(frozen=True, eq=False)
class WithinReach(Agreement):
    """Dichroism and depolarisation at once are computed up to a limit.

    The operands are the linear and the circular dichroism, the retardance, the rotation and the
    depolarization, per metre, and the length.
    """

    owner: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        dichroism, whole = _products(xp, *numbers)
        return ~((dichroism > LARGEST_DICHROISM) | (whole > LARGEST))

    def sentence(self, *numbers: float) -> str:
        dichroism, whole = _products(np, *numbers)
        return (
            f"over the length of '{self.owner}', {text_of(self.operands[-1], numbers[-1], ' m')}, "
            f"its dichroism comes to {dichroism:.3g}, and with its retardance, rotation and "
            f"depolarization to {whole:.3g}; beside a depolarization, {LARGEST_DICHROISM:g} and "
            f"{LARGEST:g} are the most: put several Media, each a part of it, one after the other"
        )


def _products(xp: Any, *numbers: Any) -> tuple[Any, Any]:
    """Return what dichroism comes to over a length, and all together."""
    linear, circular, retardance, rotation, depolarization, length = numbers
    dichroism = xp.hypot(linear, circular) * length
    turning = xp.hypot(retardance, 2.0 * rotation) * length
    return dichroism, dichroism + turning + depolarization * length


_FAR = 50.0
"""From what absorption times length on it is done in three steps, each within any precision."""


def operations_along(medium: Any) -> tuple[Operation, ...]:
    """Return what a `Medium` does along the way, but for what is known to be 0.

    Absorption is that of the state absorbed least, so that no exponential is too large.
    """
    dichroism = medium.dichroism, medium.circular_dichroism
    others = medium.retardance, medium.depolarization
    linear, circular, retards, depolarizes = [not vanishes(rate) for rate in (*dichroism, *others)]
    rotates = not (vanishes(medium.rotation) and vanishes(medium.dextrorotation))
    rates: tuple[Any, ...] = (medium.absorption,)
    of_all, of_third = ABSORPTION_ALONG, THIRD_OF_ABSORPTION
    if linear or circular:
        rates += dichroism
        of_all, of_third = ABSORPTION_WITH_DICHROISM, THIRD_WITH_DICHROISM
    is_far = largest(medium.absorption) * largest(medium.length) > _FAR
    absorbing = _along(medium, of_third if is_far else of_all, *rates) * (3 if is_far else 1)
    if depolarizes and (linear or circular):
        return *absorbing, *_together(medium, DEPOLARIZING_DICHROISM_ALONG, medium.depolarization)
    depolarizing = _along(medium, DEPOLARIZATION_ALONG, medium.depolarization)
    two_axes = linear and retards and not same(medium.angle, medium.dichroic_axis)
    if two_axes or ((linear or retards) and (circular or rotates)):
        at_once = _together(medium, DICHROISM_AND_RETARDANCE_ALONG)
    elif linear:
        filtering = _along(medium, DICHROISM_ALONG, medium.dichroism, medium.retardance)
        at_once = turned(medium.dichroic_axis, *filtering)
    else:
        at_once = _along(medium, ROTATION_ALONG, medium.rotation)
        at_once += _along(medium, DEXTROROTATION_ALONG, medium.dextrorotation)
        if circular:
            filtering = _along(medium, DICHROISM_ALONG, medium.circular_dichroism, 0.0)
            at_once += along_circular_axes(*filtering)
        elif retards:
            at_once += turned(medium.angle, *_along(medium, RETARDANCE_ALONG, medium.retardance))
    return *absorbing, *depolarizing, *at_once


def _together(medium: Any, kernel: Kernel, *first: Any) -> tuple[Operation, ...]:
    """Return what is done at once, in the frame of the fast axis."""
    axis = medium.dichroic_axis
    angles = (0.0, 0.0) if same(axis, medium.angle) else (axis, medium.angle)
    rates = medium.dichroism, medium.circular_dichroism, medium.retardance, medium.turning
    return turned(medium.angle, Operation(kernel, (*first, *rates, *angles, medium.length)))


def _along(medium: Any, kernel: Kernel, *rates: Any) -> tuple[Operation, ...]:
    """Return what a kernel does by rates per metre, unless all are known to be 0."""
    return () if all(map(vanishes, rates)) else (Operation(kernel, (*rates, medium.length)),)
