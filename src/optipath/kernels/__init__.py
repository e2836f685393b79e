"""The physics, elementwise, each piece written once.

Every kernel is a factory over `Primitives`; the names below bind the factories
to the structure of what they return.
"""

from typing import TypeAlias

from optipath.kernels import emission, filters, rotation
from optipath.kernels.amplitude import amplitude_reflection, amplitude_transmission
from optipath.kernels.carried import Carried, Components, add, carry, stokes_of
from optipath.kernels.circular import cosine, sine, without_rounding
from optipath.kernels.compensated import (
    compensated_lossless_reflection,
    compensated_lossless_transmission,
    compensated_reflection,
    compensated_transmission,
)
from optipath.kernels.double_double import DoubleDouble
from optipath.kernels.jones import Jones
from optipath.kernels.kernel import Factory, Kernel, KernelFamily
from optipath.kernels.linear import Linear
from optipath.kernels.plain import Plain
from optipath.kernels.primitives import FLOAT, NUMPY, Primitives
from optipath.kernels.scaled import Scaled
from optipath.kernels.stable import (
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
    stable_transmission,
)
from optipath.kernels.structures import BLOCK, FULL, ROTATION, SCALE, Structure, turn_linear
from optipath.kernels.textbook import textbook_reflection, textbook_transmission


def _fresnel(what: str, **methods: tuple[Factory, Factory | None]) -> KernelFamily:
    found = {}
    for method, (factory, lossless) in methods.items():
        name = f"{what} ({method}"
        # Of (n1, n, k, cos, sin), k is the third.
        without = (2, Kernel(f"{name}, lossless)", BLOCK, lossless)) if lossless else None
        found[method] = Kernel(f"{name})", BLOCK, factory, without)
    return KernelFamily(what, found)


REFLECTION = _fresnel(
    "Fresnel reflection",
    stable=(stable_reflection, lossless_reflection),
    compensated=(compensated_reflection, compensated_lossless_reflection),
    amplitude=(amplitude_reflection, None),
    textbook=(textbook_reflection, None),
)
TRANSMISSION = _fresnel(
    "Fresnel transmission",
    stable=(stable_transmission, lossless_transmission),
    compensated=(compensated_transmission, compensated_lossless_transmission),
    amplitude=(amplitude_transmission, None),
    textbook=(textbook_transmission, None),
)
Way: TypeAlias = Plain | Scaled | Jones | Linear

METHODS = tuple(REFLECTION.methods)

TURN = Kernel("turn", ROTATION, rotation.turn)
TURN_BACK = Kernel("turn back", ROTATION, rotation.turn_back)
GIVEN_TURN = Kernel("turn between world frames", ROTATION, filters.given)
ALIGN = Kernel("align", ROTATION, rotation.align)

POLARIZER = Kernel("polarizer", BLOCK, filters.polarizer)
RETARDER = Kernel("retarder", BLOCK, filters.retarder)
ATTENUATOR = Kernel("attenuator", SCALE, filters.attenuator)
COMPLEMENT = Kernel("complement", SCALE, filters.complement)
MIRROR = Kernel("mirror", BLOCK, filters.mirror)
MATRIX = Kernel("matrix", FULL, filters.given)

UNPOLARIZED = Kernel("unpolarized light", None, emission.unpolarized)
POLARIZED = Kernel("polarized light", None, emission.polarized)

__all__ = [
    "ALIGN",
    "ATTENUATOR",
    "BLOCK",
    "COMPLEMENT",
    "FLOAT",
    "FULL",
    "GIVEN_TURN",
    "MATRIX",
    "METHODS",
    "MIRROR",
    "NUMPY",
    "POLARIZED",
    "POLARIZER",
    "REFLECTION",
    "RETARDER",
    "ROTATION",
    "SCALE",
    "TRANSMISSION",
    "TURN",
    "TURN_BACK",
    "UNPOLARIZED",
    "Carried",
    "Components",
    "DoubleDouble",
    "Jones",
    "Kernel",
    "KernelFamily",
    "Linear",
    "Plain",
    "Primitives",
    "Scaled",
    "Structure",
    "Way",
    "add",
    "carry",
    "cosine",
    "sine",
    "stokes_of",
    "turn_linear",
    "without_rounding",
]
