"""The physics, elementwise, each piece written once.

Every kernel is a factory over `Primitives`; the names below bind the factories
to the structure of what they return.
"""

from optipath.kernels import emission, filters, rotation
from optipath.kernels.carried import Carried, add, carry, stokes_of
from optipath.kernels.circular import cosine, sine
from optipath.kernels.kernel import Kernel, KernelFamily
from optipath.kernels.primitives import FLOAT, NUMPY, Primitives
from optipath.kernels.stable import stable_reflection
from optipath.kernels.structures import BLOCK, FULL, ROTATION, SCALE, Structure, turn_linear
from optipath.kernels.textbook import textbook_reflection

REFLECTION = KernelFamily(
    "Fresnel reflection",
    {
        "stable": Kernel("Fresnel reflection (stable)", BLOCK, stable_reflection),
        "textbook": Kernel("Fresnel reflection (textbook)", BLOCK, textbook_reflection),
    },
)
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
    "TURN",
    "TURN_BACK",
    "UNPOLARIZED",
    "Carried",
    "Kernel",
    "KernelFamily",
    "Primitives",
    "Structure",
    "add",
    "carry",
    "cosine",
    "sine",
    "stokes_of",
    "turn_linear",
]
