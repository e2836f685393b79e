"""Every kernel by name: a factory over `Primitives`, bound to the structure of what it returns."""

from functools import lru_cache
from typing import TypeAlias

from optipath.kernels.carriers.kernel import Kernel, KernelFamily
from optipath.kernels.carriers.sloped import Sloped
from optipath.kernels.carriers.structures import (
    BLOCK,
    DEPOLARIZING_BLOCK,
    FULL,
    POWERS,
    ROTATION,
    SCALE,
)
from optipath.kernels.filters import emission, filters, rotation, stretch
from optipath.kernels.fresnel import amplitude, powers, stable, textbook
from optipath.kernels.fresnel.compensated import Compensated
from optipath.kernels.fresnel.layers import Stack
from optipath.kernels.fresnel.refraction import Refracting
from optipath.kernels.geometry import vertex_chain
from optipath.kernels.geometry.planes import AxesAtVertex, TurnBetweenPlanes
from optipath.kernels.numbers.primitives import Factory

Factories: TypeAlias = tuple[Factory, ...]
"""One for any media, and cheaper ones for k = 0, and for n >= n1 besides."""


def _fresnel(
    what: str, of_stable: Factories, intensities: Factories, **others: Factories
) -> KernelFamily:
    """Return the kernels of all methods; each has the slopes of the stable one."""
    methods = {"stable": _cheaper_within(f"{what} (stable", of_stable, intensities)}
    for method, factories in others.items():
        sloped = tuple(map(Sloped, factories, of_stable))
        methods[method] = _cheaper_within(f"{what} ({method}", sloped)
    return KernelFamily(what, methods)


def _cheaper_within(name: str, factories: Factories, intensities: Factories = ()) -> Kernel:
    """Return the kernel of the first factory, which knows the cheaper ones of the others."""
    found: Kernel | None = None
    words = (")", ", lossless)", ", lossless, from the rarer side)")
    for place, made_by in reversed(list(enumerate(factories))):
        # Of (n1, n, k, cos, sin), k is the third; of (n1, n, cos, sin), n is to be n1 or more.
        without = (2, found) if place == 0 and found else None
        denser = (1, 0, found) if place == 1 and found else None
        alone = None
        if intensities:
            cheap = (2, found.powers) if place == 0 and found and found.powers else None
            alone = Kernel(f"{name}{words[place]}, powers", POWERS, intensities[place], cheap)
        found = Kernel(name + words[place], BLOCK, made_by, without, denser, alone)
    assert found is not None  # noqa: S101 - there is one factory at least
    return found


REFLECTION = _fresnel(
    "Fresnel reflection",
    (stable.stable_reflection, stable.lossless_reflection, stable.denser_reflection),
    (powers.reflected_powers, powers.lossless_powers, powers.denser_powers),
    compensated=(Compensated(stable.stable_reflection), Compensated(stable.lossless_reflection)),
    amplitude=(Refracting(amplitude.amplitude_reflection),),
    textbook=(Refracting(textbook.textbook_reflection),),
)
TRANSMISSION = _fresnel(
    "Fresnel transmission",
    (stable.stable_transmission, stable.lossless_transmission),
    (),
    compensated=(
        Compensated(stable.stable_transmission),
        Compensated(stable.lossless_transmission),
    ),
    amplitude=(Refracting(amplitude.amplitude_transmission),),
    textbook=(Refracting(textbook.textbook_transmission),),
)
METHODS = tuple(REFLECTION.methods)

_OF_STACK = {"reflected": "reflection", "transmitted": "transmission", "absorbed": "absorption"}


@lru_cache(256)
def stack(wanted: str, measured: str, absorbing: tuple[int, ...] = ()) -> KernelFamily:
    """Return the kernels of what a stack of layers lets through, sends back, or absorbs.

    Parameters
    ----------
    wanted, measured, absorbing
        As `Stack` has them.

    Returns
    -------
    KernelFamily
    """
    what = f"stack {_OF_STACK[wanted]}"
    lossy = ", absorbing" if absorbing else ""
    structure = None if wanted == "absorbed" else DEPOLARIZING_BLOCK
    methods = {}
    for method in METHODS:
        pair = REFLECTION.methods[method], TRANSMISSION.methods[method]
        made_by = Stack(*pair, wanted, measured, absorbing)
        methods[method] = Kernel(f"{what} ({method}{lossy})", structure, made_by)
    return KernelFamily(what, methods)


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
GIVEN_AMPLITUDES = Kernel("mirror of given amplitudes", BLOCK, amplitude.given_amplitudes)
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
