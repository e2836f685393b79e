"""The physics, elementwise, each piece written once.

Every kernel is a factory over `Primitives`; the names below bind the factories
to the structure of what they return.
"""

from typing import TypeAlias

from optipath.kernels import emission, filters, rotation, vertices
from optipath.kernels.amplitude import amplitude_reflection, amplitude_transmission
from optipath.kernels.bounds import Boosts, Bounds, boosted, largest_error, ratio_bounds
from optipath.kernels.carried import Carried, Components, add, carry, stokes_of
from optipath.kernels.circular import cosine, sine, without_rounding
from optipath.kernels.compensated import (
    compensated_lossless_reflection,
    compensated_lossless_transmission,
    compensated_reflection,
    compensated_transmission,
)
from optipath.kernels.composed import Composed, composed
from optipath.kernels.double_double import DoubleDouble
from optipath.kernels.jones import Jones
from optipath.kernels.kernel import Factory, Kernel, KernelFamily
from optipath.kernels.linear import Linear
from optipath.kernels.plain import Plain
from optipath.kernels.points_by_angles import PointsByAngles
from optipath.kernels.powers import denser_powers, lossless_powers, reflected_powers
from optipath.kernels.powers_way import Powers
from optipath.kernels.primitives import FLOAT, NUMPY, Primitives
from optipath.kernels.scaled import Scaled
from optipath.kernels.stable import (
    denser_reflection,
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
    stable_transmission,
)
from optipath.kernels.structures import (
    BLOCK,
    FULL,
    POWERS,
    ROTATION,
    SCALE,
    Structure,
    turn_linear,
)
from optipath.kernels.textbook import textbook_reflection, textbook_transmission


def _fresnel(
    what: str, method: str, factory: Factory, *cheaper: Factory, powers: tuple[Factory, ...] = ()
) -> Kernel:
    """Return the kernel of a method: for any media, for k = 0, and for n >= n1 besides."""
    found: Kernel | None = None
    words = ("", ", lossless", ", lossless, from the rarer side")
    factories = (factory, *cheaper)
    for place, made_by in reversed(list(enumerate(factories))):
        name = f"{what} ({method}{words[place]})"
        # Of (n1, n, k, cos, sin), k is the third; of (n1, n, cos, sin), n is to be n1 or more.
        alone = None
        if powers:
            cheap = (2, found.powers) if place == 0 and found and found.powers else None
            alone = Kernel(f"{name}, powers", POWERS, powers[place], cheap)
        without = (2, found) if place == 0 and found else None
        denser = (1, 0, found) if place == 1 and found else None
        found = Kernel(name, BLOCK, made_by, without, denser, alone)
    assert found is not None  # noqa: S101 - there is one factory at least
    return found


def _family(what: str, **methods: Kernel) -> KernelFamily:
    return KernelFamily(what, methods)


_REFLECTED = "Fresnel reflection"
REFLECTION = _family(
    _REFLECTED,
    stable=_fresnel(
        _REFLECTED,
        "stable",
        stable_reflection,
        lossless_reflection,
        denser_reflection,
        powers=(reflected_powers, lossless_powers, denser_powers),
    ),
    compensated=_fresnel(
        _REFLECTED, "compensated", compensated_reflection, compensated_lossless_reflection
    ),
    amplitude=_fresnel(_REFLECTED, "amplitude", amplitude_reflection),
    textbook=_fresnel(_REFLECTED, "textbook", textbook_reflection),
)
_REFRACTED = "Fresnel transmission"
TRANSMISSION = _family(
    _REFRACTED,
    stable=_fresnel(_REFRACTED, "stable", stable_transmission, lossless_transmission),
    compensated=_fresnel(
        _REFRACTED, "compensated", compensated_transmission, compensated_lossless_transmission
    ),
    amplitude=_fresnel(_REFRACTED, "amplitude", amplitude_transmission),
    textbook=_fresnel(_REFRACTED, "textbook", textbook_transmission),
)
Way: TypeAlias = Plain | Scaled | Jones | Linear | Powers | Bounds

METHODS = tuple(REFLECTION.methods)

TURN = Kernel("turn", ROTATION, rotation.turn)
TURN_BACK = Kernel("turn back", ROTATION, rotation.turn_back)
GIVEN_TURN = Kernel("turn between world frames", ROTATION, filters.given)
ALIGN = Kernel("align", ROTATION, rotation.align)
TURN_BETWEEN_PLANES = Kernel(
    "turn between planes of incidence", ROTATION, vertices.turn_between_planes
)
INCIDENCE, ARRIVING, REFLECTED = vertices.incidence, vertices.arriving, vertices.reflected
"""What the points of a chain say: an angle of incidence, and the axes at the last vertex."""

POLARIZER = Kernel("polarizer", BLOCK, filters.polarizer)
RETARDER = Kernel("retarder", BLOCK, filters.retarder)
ATTENUATOR = Kernel("attenuator", SCALE, filters.attenuator)
COMPLEMENT = Kernel("complement", SCALE, filters.complement)
MIRROR = Kernel("mirror", BLOCK, filters.mirror)
CONSTANT_BLOCK = Kernel("retarding diattenuator", BLOCK, filters.given)
MATRIX = Kernel("matrix", FULL, filters.given)

UNPOLARIZED = Kernel("unpolarized light", None, emission.unpolarized)
POLARIZED = Kernel("polarized light", None, emission.polarized)

__all__ = [
    "ALIGN",
    "ARRIVING",
    "ATTENUATOR",
    "BLOCK",
    "COMPLEMENT",
    "CONSTANT_BLOCK",
    "FLOAT",
    "FULL",
    "GIVEN_TURN",
    "INCIDENCE",
    "MATRIX",
    "METHODS",
    "MIRROR",
    "NUMPY",
    "POLARIZED",
    "POLARIZER",
    "POWERS",
    "REFLECTED",
    "REFLECTION",
    "RETARDER",
    "ROTATION",
    "SCALE",
    "TRANSMISSION",
    "TURN",
    "TURN_BACK",
    "TURN_BETWEEN_PLANES",
    "UNPOLARIZED",
    "Boosts",
    "Bounds",
    "Carried",
    "Components",
    "Composed",
    "DoubleDouble",
    "Jones",
    "Kernel",
    "KernelFamily",
    "Linear",
    "Plain",
    "PointsByAngles",
    "Powers",
    "Primitives",
    "Scaled",
    "Structure",
    "Way",
    "add",
    "boosted",
    "carry",
    "composed",
    "cosine",
    "largest_error",
    "ratio_bounds",
    "sine",
    "stokes_of",
    "turn_linear",
    "without_rounding",
]
