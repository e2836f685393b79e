"""The physics, elementwise, each piece written once.

A kernel is made for any `Primitives`; `catalogue` binds each to the structure of what it returns.
"""

from optipath.kernels.carriers.bounds_carrier import (
    Boosts,
    BoundsCarrier,
    boosted,
    largest_error,
    ratio_bounds,
)
from optipath.kernels.carriers.carried import Carried, Components, add, carry, stokes_of
from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.carriers.coherency import FROM_MUELLER, TO_MUELLER, is_physical
from optipath.kernels.carriers.intensity_carrier import IntensityCarrier
from optipath.kernels.carriers.jones_carrier import JonesCarrier
from optipath.kernels.carriers.kernel import Kernel, KernelFamily
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.parted import Parts, energy, parts_of, unit_light
from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.carriers.structures import (
    BLOCK,
    DEPOLARIZING_BLOCK,
    FULL,
    ROTATION,
    SCALE,
    Structure,
    turn_linear,
)
from optipath.kernels.catalogue import (
    ABSORPTION_ALONG,
    ALIGN,
    ARRIVING,
    ATTENUATOR,
    COMPLEMENT,
    CONSTANT_BLOCK,
    CONSTANT_DEPOLARIZING_BLOCK,
    DEPOLARIZER,
    DEXTROROTATION_ALONG,
    GIVEN_AMPLITUDES,
    GIVEN_TURN,
    INCIDENCE,
    MATRIX,
    METHODS,
    MIRROR,
    POLARIZED,
    POLARIZER,
    REFLECTED,
    REFLECTION,
    RETARDANCE_ALONG,
    RETARDER,
    ROTATION_ALONG,
    STACK_REFLECTION,
    STACK_REFLECTION_BACK,
    STACK_TRANSMISSION,
    STACK_TRANSMISSION_BACK,
    THIRD_OF_ABSORPTION,
    TRANSMISSION,
    TURN,
    TURN_BACK,
    TURN_BETWEEN_PLANES,
    UNPOLARIZED,
)
from optipath.kernels.fresnel.refraction import refraction
from optipath.kernels.geometry.points_by_angles import PointsByAngles
from optipath.kernels.geometry.vertex_chain import LONGEST, SHORTEST
from optipath.kernels.numbers.circular import cosine, sine, without_rounding
from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.elimination import Elimination, is_zero
from optipath.kernels.numbers.primitives import FLOAT, NUMPY, Primitives
from optipath.kernels.numbers.twice import twice
from optipath.kernels.numbers.vanishing import not_above_rounding

__all__ = [
    "ABSORPTION_ALONG",
    "ALIGN",
    "ARRIVING",
    "ATTENUATOR",
    "BLOCK",
    "COMPLEMENT",
    "CONSTANT_BLOCK",
    "CONSTANT_DEPOLARIZING_BLOCK",
    "DEPOLARIZER",
    "DEPOLARIZING_BLOCK",
    "DEXTROROTATION_ALONG",
    "FLOAT",
    "FROM_MUELLER",
    "FULL",
    "GIVEN_AMPLITUDES",
    "GIVEN_TURN",
    "INCIDENCE",
    "LONGEST",
    "MATRIX",
    "METHODS",
    "MIRROR",
    "NUMPY",
    "POLARIZED",
    "POLARIZER",
    "REFLECTED",
    "REFLECTION",
    "RETARDANCE_ALONG",
    "RETARDER",
    "ROTATION",
    "ROTATION_ALONG",
    "SCALE",
    "SHORTEST",
    "STACK_REFLECTION",
    "STACK_REFLECTION_BACK",
    "STACK_TRANSMISSION",
    "STACK_TRANSMISSION_BACK",
    "THIRD_OF_ABSORPTION",
    "TO_MUELLER",
    "TRANSMISSION",
    "TURN",
    "TURN_BACK",
    "TURN_BETWEEN_PLANES",
    "UNPOLARIZED",
    "Boosts",
    "BoundsCarrier",
    "Carried",
    "Carrier",
    "Components",
    "DoubleDouble",
    "Elimination",
    "IntensityCarrier",
    "JonesCarrier",
    "Kernel",
    "KernelFamily",
    "MatrixCarrier",
    "Parts",
    "PointsByAngles",
    "Primitives",
    "ScaledCarrier",
    "StokesCarrier",
    "Structure",
    "add",
    "boosted",
    "carry",
    "cosine",
    "energy",
    "is_physical",
    "is_zero",
    "largest_error",
    "not_above_rounding",
    "parts_of",
    "ratio_bounds",
    "refraction",
    "sine",
    "stokes_of",
    "turn_linear",
    "twice",
    "unit_light",
    "without_rounding",
]
