"""Annotations of element fields: ``angle: Angle = 0.0``; values as JSON writes them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from types import NoneType
from typing import Annotated, Any, Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from optipath.errors import OptipathError, UnitError, ValueFault
from optipath.faults import Cure, Fault, closest, shown
from optipath.materials.illuminants import ILLUMINANTS
from optipath.materials.index_domains import (
    CLEAR,
    FOLLOWED_LIT_INDEX,
    FOLLOWED_OUTSIDE,
    INDEX,
    INDICES,
    LENGTHS,
    OPTIONAL_LIT_INDEX,
    OPTIONAL_OUTSIDE,
    Followed,
    Follows,
)
from optipath.materials.material import Material
from optipath.values.curve import Curve
from optipath.values.curve_value import curve_values
from optipath.values.domains import (
    AmplitudeDomain,
    Choice,
    Domain,
    ExtinctionDomain,
    FractionDomain,
    StokesDomain,
    WholeNumber,
    YesNo,
)
from optipath.values.parameters import Parameter
from optipath.values.units import in_unit
from optipath.values.use import AxisDomain
from optipath.values.wavelength import LONGEST
from optipath.values.wavelength import WAVELENGTH as VACUUM_WAVELENGTH
from optipath.values.wavelength import Wavelength as WavelengthParameter


def spectrum_meant(text: str) -> Fault | None:
    """Return the sentence for a text in place of a spectrum, if it names one.

    >>> print(spectrum_meant("D65"))
    'D65' is no spectrum by itself; write op.Spectrum.illuminant("D65")
    """
    kind, name = "illuminant", closest(text.strip(), ILLUMINANTS) or text.strip().upper()
    if name not in ILLUMINANTS:
        kind, name = "line", text.strip()
        try:
            if not VACUUM_WAVELENGTH.parse(name) > 0.0:
                return None
        except OptipathError:
            return None
    ways = f'op.Spectrum.{kind}("{name}")', f'{{ {kind} = "{name}" }}'
    return Fault(f"{shown(text)} is no spectrum by itself", Cure.of("write {}".format, *ways))


class SpectralDomain(Domain):
    """Numbers that are not negative, of which a spectrum gives one for each wavelength; or None.

    >>> SPECTRAL.parts("spectrum", None)
    []
    """

    def kept(self, value: Any) -> Any:
        if isinstance(value, Curve) and len(value.parts) == 1:
            return curve_values(value, WavelengthParameter())[0]
        return super().kept(value)

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        if isinstance(value, type):
            raise ValueFault(
                f"{owner} is the class {value.__name__}; give one of it, "
                f'op.Spectrum.illuminant("D65")'
            )
        return super().check(owner, value)

    def parse(self, text: str) -> Any:
        try:
            return super().parse(text)
        except UnitError as fault:
            meant = spectrum_meant(text)
            raise UnitError(*([meant] if meant else fault.faults)) from None

    def described(self) -> str:
        return f"a Spectrum, or {super().described()}"


SPECTRAL = SpectralDomain("number", minimum=0.0, optional=True)


Quantity: TypeAlias = npt.ArrayLike | Parameter
"""A number, an array over paths, or a parameter that will give either."""

REAL = Domain("number")

ANGLE = Domain("angle", "angle")
Angle: TypeAlias = Annotated[Quantity, ANGLE]
ROTATION_ANGLE = Domain("component of a rotation vector", "angle", -1e15, 1e15)
RotationAngle: TypeAlias = Annotated[Quantity, ROTATION_ANGLE]
Axis: TypeAlias = Annotated[Quantity, AxisDomain("angle", "angle")]
OptionalAxis: TypeAlias = Annotated[Quantity, AxisDomain("angle", "angle", optional=True)]
INCIDENCE = Domain("angle of incidence", "angle", minimum=0.0, maximum=np.pi / 2)
Incidence: TypeAlias = Annotated[Quantity, INCIDENCE]
FollowedIncidence: TypeAlias = Annotated[Quantity | Follows, Followed(**vars(INCIDENCE))]
Fraction: TypeAlias = Annotated[Quantity, FractionDomain("fraction", minimum=0.0, maximum=1.0)]
NON_NEGATIVE = Domain("number", minimum=0.0)
NonNegative: TypeAlias = Annotated[Quantity, NON_NEGATIVE]
Spectral: TypeAlias = Annotated[Quantity | Curve | None, SPECTRAL]
Real: TypeAlias = Annotated[Quantity, REAL]
Index: TypeAlias = Annotated[Quantity | Material, INDEX]
ClearIndex: TypeAlias = Annotated[Quantity | Material, CLEAR]
OutsideIndex: TypeAlias = Annotated[Quantity | Material | Follows, FOLLOWED_OUTSIDE]
LitIndex: TypeAlias = Annotated[Quantity | Material | Follows, FOLLOWED_LIT_INDEX]
OptionalLitIndex: TypeAlias = Annotated[Quantity | Material, OPTIONAL_LIT_INDEX]
Indices: TypeAlias = Annotated[Sequence[Quantity | Material | Follows], INDICES]
Lengths: TypeAlias = Annotated[Sequence[Quantity], LENGTHS]
OptionalIndex: TypeAlias = Annotated[Quantity | Material, OPTIONAL_OUTSIDE]
AMPLITUDE = AmplitudeDomain("amplitude")
Amplitude: TypeAlias = Annotated[Quantity, AMPLITUDE]
Length: TypeAlias = Annotated[Quantity, Domain("length", "length", minimum=0.0, own_unit="mm")]
Absorption: TypeAlias = Annotated[
    Quantity, Domain("absorption coefficient", "inverse length", minimum=0.0)
]
Dichroism: TypeAlias = Annotated[Quantity, Domain("dichroism", "inverse length")]
Depolarization: TypeAlias = Annotated[
    Quantity, Domain("depolarization per length", "inverse length", minimum=0.0)
]
AnglePerLength: TypeAlias = Annotated[Quantity, Domain("angle per length", "angle per length")]
RotatoryPower: TypeAlias = Annotated[
    Quantity, Domain("rotatory power", "angle per length", own_unit="deg/dm")
]
PART_LENGTH = Domain("length", "length", minimum=0.0, maximum=1e3, own_unit="mm")
"""Of a part that stands on a bench, so that what it turns or retards by is a number."""
PartLength: TypeAlias = Annotated[Quantity, PART_LENGTH]
OptionalPartLength: TypeAlias = Annotated[Quantity, replace(PART_LENGTH, optional=True)]
OptionalAngle: TypeAlias = Annotated[Quantity, Domain("angle", "angle", optional=True)]
VerdetConstant: TypeAlias = Annotated[
    Quantity, Domain("Verdet constant", "Verdet constant", -1e9, 1e9, optional=True)
]
MagneticField: TypeAlias = Annotated[
    Quantity, Domain("magnetic field", "magnetic field", -1e6, 1e6, optional=True)
]
WAVELENGTH = Domain("wavelength in metres", "length", minimum=1e-12, maximum=LONGEST, own_unit="m")
Wavelength: TypeAlias = Annotated[Quantity, replace(WAVELENGTH, name="wavelength", own_unit="nm")]
OptionalWavelength: TypeAlias = Annotated[
    Quantity, replace(WAVELENGTH, name="wavelength", own_unit="nm", optional=True)
]
Birefringence: TypeAlias = Annotated[Quantity, Domain("birefringence", minimum=-10, maximum=10)]
_ENDLESS = ", or infinity (a BeamSplitter does not polarise)"
EXTINCTION = ExtinctionDomain("extinction ratio", minimum=1.000001, besides=_ENDLESS)
ExtinctionRatio: TypeAlias = Annotated[Quantity, EXTINCTION]
Hand: TypeAlias = Literal["right", "left"]
Handedness: TypeAlias = Annotated[Hand, Choice("handedness", words=get_args(Hand))]
StokesState: TypeAlias = Annotated[
    Quantity, StokesDomain("Stokes vector", tail=(4,), optional=True)
]
MuellerMatrix: TypeAlias = Annotated[Quantity, Domain("Mueller matrix", tail=(4, 4))]
Whole: TypeAlias = Annotated[int, WholeNumber("whole number")]
Reading: TypeAlias = Literal["stokes", "linear", "intensity"]
READINGS: tuple[Reading, ...] = get_args(Reading)
Reads: TypeAlias = Annotated[Reading, Choice("reading", words=READINGS)]
YES_OR_NO = YesNo("yes or no")
YesOrNo: TypeAlias = Annotated[bool, YES_OR_NO]


def plain(
    value: Any, unit: str = "", complex_parts: tuple[str, ...] = AMPLITUDE.complex_parts
) -> Any:
    """Return a value as JSON can hold it, in a unit; what is not finite is None.

    >>> plain(0.5 + 0.1j), plain(1.5 + 0.1j, "", ("n", "k"))
    ({'re': 0.5, 'im': 0.1}, {'n': 1.5, 'k': 0.1})
    """
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list):
        return [plain(entry, unit, complex_parts) for entry in value]
    if isinstance(value, complex):
        return dict(zip(complex_parts, (value.real, value.imag), strict=True))
    if isinstance(value, (str, NoneType)):
        return value
    # JSON has no NaN: what is not read is null, and so is the logarithm of the dark. Adding 0
    # turns -0 into 0.
    return None if not math.isfinite(value) else in_unit(value, unit) + 0.0
