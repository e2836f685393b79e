"""The types that fields of elements are annotated with: ``angle: Angle = 0.0``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, TypeAlias

import numpy as np
import numpy.typing as npt

from optipath.values.curves.curve import Curve
from optipath.values.domains.axis import AxisDomain, OptionalAxisDomain
from optipath.values.domains.choice import Choice
from optipath.values.domains.domain import Domain
from optipath.values.domains.extinction import ExtinctionDomain
from optipath.values.domains.followed import Followed
from optipath.values.domains.fraction import FractionDomain
from optipath.values.domains.indices import (
    CLEAR,
    FOLLOWED_LIT_INDEX,
    FOLLOWED_OUTSIDE,
    INDEX,
    OPTIONAL_LIT_INDEX,
    OPTIONAL_OUTSIDE,
)
from optipath.values.domains.optional import OptionalDomain
from optipath.values.domains.rotation_vector import FirstComponentDomain
from optipath.values.domains.spectral import SPECTRAL
from optipath.values.domains.stack_indices import INDICES
from optipath.values.domains.states import AmplitudeDomain, IntensityDomain, StokesDomain
from optipath.values.domains.thick_layers import LENGTHS
from optipath.values.domains.wavelengths import LONGEST
from optipath.values.domains.whole_number import WholeNumber
from optipath.values.domains.yes_no import YesNo
from optipath.values.follows import Follows
from optipath.values.materials import Material
from optipath.values.parameters import Parameter

Quantity: TypeAlias = npt.ArrayLike | Parameter
"""A number, an array over paths, or a parameter that will give either."""

REAL = Domain("number")

ANGLE = Domain("angle", "angle")
Angle: TypeAlias = Annotated[Quantity, ANGLE]
ROTATION_ANGLE = Domain("component of a rotation vector", "angle", -1e15, 1e15)
RotationAngle: TypeAlias = Annotated[Quantity, ROTATION_ANGLE]
FIRST_ROTATION_ANGLE = FirstComponentDomain(ROTATION_ANGLE.name, "angle", -1e15, 1e15)
FirstRotationAngle: TypeAlias = Annotated[Quantity, FIRST_ROTATION_ANGLE]
Axis: TypeAlias = Annotated[Quantity, AxisDomain("angle", "angle")]
OptionalAxis: TypeAlias = Annotated[Quantity, OptionalAxisDomain("angle", "angle")]
INCIDENCE = Domain("angle of incidence", "angle", minimum=0.0, maximum=np.pi / 2)
Incidence: TypeAlias = Annotated[Quantity, INCIDENCE]
FollowedIncidence: TypeAlias = Annotated[
    Quantity | Follows,
    Followed(INCIDENCE.name, INCIDENCE.dimension, INCIDENCE.minimum, INCIDENCE.maximum),
]
Fraction: TypeAlias = Annotated[Quantity, FractionDomain("fraction", minimum=0.0, maximum=1.0)]
NON_NEGATIVE = Domain("number", minimum=0.0)
NonNegative: TypeAlias = Annotated[Quantity, NON_NEGATIVE]
INTENSITY = IntensityDomain(NON_NEGATIVE.name, minimum=NON_NEGATIVE.minimum)
Intensity: TypeAlias = Annotated[Quantity, INTENSITY]
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
OptionalPartLength: TypeAlias = Annotated[
    Quantity, OptionalDomain("length", "length", 0.0, PART_LENGTH.maximum, own_unit="mm")
]
OptionalAngle: TypeAlias = Annotated[Quantity, OptionalDomain("angle", "angle")]
VerdetConstant: TypeAlias = Annotated[
    Quantity, OptionalDomain("Verdet constant", "Verdet constant", -1e9, 1e9)
]
MagneticField: TypeAlias = Annotated[
    Quantity, OptionalDomain("magnetic field", "magnetic field", -1e6, 1e6)
]
WAVELENGTH = Domain("wavelength in metres", "length", minimum=1e-12, maximum=LONGEST, own_unit="m")
Wavelength: TypeAlias = Annotated[Quantity, replace(WAVELENGTH, name="wavelength", own_unit="nm")]
OptionalWavelength: TypeAlias = Annotated[
    Quantity, OptionalDomain("wavelength", "length", minimum=1e-12, maximum=LONGEST, own_unit="nm")
]
Birefringence: TypeAlias = Annotated[Quantity, Domain("birefringence", minimum=-10, maximum=10)]
EXTINCTION = ExtinctionDomain("extinction ratio", minimum=1.000001)
ExtinctionRatio: TypeAlias = Annotated[Quantity, EXTINCTION]
HANDEDNESSES = ("right", "left")
Handedness: TypeAlias = Annotated[str, Choice("handedness", words=HANDEDNESSES)]
StokesState: TypeAlias = Annotated[Quantity, StokesDomain("Stokes vector", tail=(4,))]
MuellerMatrix: TypeAlias = Annotated[Quantity, Domain("Mueller matrix", tail=(4, 4))]
Whole: TypeAlias = Annotated[int, WholeNumber("whole number")]
READINGS = ("stokes", "linear", "intensity")
Reads: TypeAlias = Annotated[str, Choice("reading", words=READINGS)]
YES_OR_NO = YesNo("yes or no")
YesOrNo: TypeAlias = Annotated[bool, YES_OR_NO]
