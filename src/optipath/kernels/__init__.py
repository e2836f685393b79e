"""The physics, elementwise, each piece written once.

Every kernel is a factory over `Primitives`; the names below bind the factories
to the structure of what they return.
"""

from typing import TypeAlias

from optipath.kernels.carriers.bounds_carrier import (
    Boosts,
    BoundsCarrier,
    boosted,
    largest_error,
    ratio_bounds,
)
from optipath.kernels.carriers.carried import (
    Carried,
    Components,
    add,
    carry,
    not_above_rounding,
    stokes_of,
)
from optipath.kernels.carriers.coherency import FROM_MUELLER, TO_MUELLER, is_physical
from optipath.kernels.carriers.intensity_carrier import IntensityCarrier
from optipath.kernels.carriers.jones_carrier import JonesCarrier
from optipath.kernels.carriers.kernel import Factory, Kernel, KernelFamily
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.parted import Parts, energy, light_of, parts_of, unit_light
from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.carriers.sloped import Sloped
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.carriers.structures import (
    BLOCK,
    DEPOLARIZING_BLOCK,
    FULL,
    POWERS,
    ROTATION,
    SCALE,
    Structure,
    turn_linear,
)
from optipath.kernels.filters import emission, filters, rotation, stretch
from optipath.kernels.fresnel.amplitude import (
    amplitude_reflection,
    amplitude_transmission,
    given_amplitudes,
)
from optipath.kernels.fresnel.compensated import (
    compensated_lossless_reflection,
    compensated_lossless_transmission,
    compensated_reflection,
    compensated_transmission,
)
from optipath.kernels.fresnel.layers import Stack
from optipath.kernels.fresnel.powers import denser_powers, lossless_powers, reflected_powers
from optipath.kernels.fresnel.refraction import Refracting, refraction
from optipath.kernels.fresnel.stable import (
    denser_reflection,
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
    stable_transmission,
)
from optipath.kernels.fresnel.textbook import textbook_reflection, textbook_transmission
from optipath.kernels.geometry import vertex_chain
from optipath.kernels.geometry.planes import AxesAtVertex, OfPlanes, TurnBetweenPlanes
from optipath.kernels.geometry.points_by_angles import PointsByAngles
from optipath.kernels.geometry.vertex_chain import LONGEST, SHORTEST
from optipath.kernels.numbers.circular import cosine, sine, without_rounding
from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.elimination import Elimination, is_zero
from optipath.kernels.numbers.primitives import FLOAT, NUMPY, Primitives
from optipath.kernels.numbers.twice import twice


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
        _REFLECTED,
        "compensated",
        Sloped(compensated_reflection, stable_reflection),
        Sloped(compensated_lossless_reflection, lossless_reflection),
    ),
    amplitude=_fresnel(
        _REFLECTED, "amplitude", Sloped(Refracting(amplitude_reflection), stable_reflection)
    ),
    textbook=_fresnel(
        _REFLECTED, "textbook", Sloped(Refracting(textbook_reflection), stable_reflection)
    ),
)
_REFRACTED = "Fresnel transmission"
TRANSMISSION = _family(
    _REFRACTED,
    stable=_fresnel(_REFRACTED, "stable", stable_transmission, lossless_transmission),
    compensated=_fresnel(
        _REFRACTED,
        "compensated",
        Sloped(compensated_transmission, stable_transmission),
        Sloped(compensated_lossless_transmission, lossless_transmission),
    ),
    amplitude=_fresnel(
        _REFRACTED, "amplitude", Sloped(Refracting(amplitude_transmission), stable_transmission)
    ),
    textbook=_fresnel(
        _REFRACTED, "textbook", Sloped(Refracting(textbook_transmission), stable_transmission)
    ),
)
METHODS = tuple(REFLECTION.methods)


def _stack_family(*, through: bool, from_behind: bool) -> KernelFamily:
    """Return the kernels of what a stack of layers lets through, or sends back."""
    what = "stack transmission" if through else "stack reflection"
    pairs = {
        method: (REFLECTION.methods[method], TRANSMISSION.methods[method]) for method in METHODS
    }
    return _family(
        what,
        **{
            method: Kernel(
                f"{what} ({method})", DEPOLARIZING_BLOCK, Stack(*pair, through, from_behind)
            )
            for method, pair in pairs.items()
        },
    )


STACK_REFLECTION = _stack_family(through=False, from_behind=False)
STACK_TRANSMISSION = _stack_family(through=True, from_behind=False)
STACK_REFLECTION_BACK = _stack_family(through=False, from_behind=True)
STACK_TRANSMISSION_BACK = _stack_family(through=True, from_behind=True)

Carrier: TypeAlias = (
    StokesCarrier | ScaledCarrier | JonesCarrier | MatrixCarrier | IntensityCarrier | BoundsCarrier
)

TURN = Kernel("turn", ROTATION, rotation.turn)
TURN_BACK = Kernel("turn back", ROTATION, rotation.turn_back)
GIVEN_TURN = Kernel("turn between world frames", ROTATION, filters.given)
ALIGN = Kernel("align", ROTATION, rotation.align)
TURN_BETWEEN_PLANES = Kernel("turn between planes of incidence", ROTATION, TurnBetweenPlanes())
INCIDENCE = Kernel("incidence", None, vertex_chain.incidence)
ARRIVING = Kernel("arriving axes", None, AxesAtVertex())
REFLECTED = Kernel("reflected axes", None, AxesAtVertex(leaves=True))
"""What the points of a chain say: an angle of incidence, and the axes at the last vertex."""

POLARIZER = Kernel("polarizer", BLOCK, filters.polarizer)
RETARDER = Kernel("retarder", BLOCK, filters.retarder)
ATTENUATOR = Kernel("attenuator", SCALE, filters.attenuator)
COMPLEMENT = Kernel("complement", SCALE, filters.complement)
DEPOLARIZER = Kernel("depolarizer", FULL, filters.depolarizer)
MIRROR = Kernel("mirror", BLOCK, filters.mirror)
GIVEN_AMPLITUDES = Kernel("mirror of given amplitudes", BLOCK, given_amplitudes)
ABSORPTION_ALONG = Kernel("absorption along the way", SCALE, stretch.absorption_along)
THIRD_OF_ABSORPTION = Kernel("a third of absorption", SCALE, stretch.third_of_absorption)
ROTATION_ALONG = Kernel("rotation along the way", ROTATION, stretch.rotation_along)
DEXTROROTATION_ALONG = Kernel(
    "dextrorotation along the way", ROTATION, stretch.dextrorotation_along
)
RETARDANCE_ALONG = Kernel("retardance along the way", BLOCK, stretch.retardance_along)
CONSTANT_BLOCK = Kernel("retarding diattenuator", BLOCK, filters.given)
CONSTANT_DEPOLARIZING_BLOCK = Kernel("depolarising diattenuator", DEPOLARIZING_BLOCK, filters.given)
MATRIX = Kernel("matrix", FULL, filters.given)

UNPOLARIZED = Kernel("unpolarized light", None, emission.unpolarized)
POLARIZED = Kernel("polarized light", None, emission.polarized)

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
    "POWERS",
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
    "OfPlanes",
    "Parts",
    "PointsByAngles",
    "Primitives",
    "ScaledCarrier",
    "StokesCarrier",
    "Structure",
    "TurnBetweenPlanes",
    "add",
    "boosted",
    "carry",
    "cosine",
    "energy",
    "is_physical",
    "is_zero",
    "largest_error",
    "light_of",
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
