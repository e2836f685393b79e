"""Every kernel by name: a factory over `Primitives`, bound to the structure of what it returns."""

from dataclasses import replace
from functools import lru_cache
from typing import TypeAlias

from optipath.kernels import filters, medium, vertex_chain
from optipath.kernels.carriers.structures import (
    BLOCK,
    DEPOLARIZING_BLOCK,
    FULL,
    POWERS,
    ROTATION,
    SCALE,
)
from optipath.kernels.fresnel import absorbing, boundary, stable, textbook, variants
from optipath.kernels.fresnel.boundary import Refracting
from optipath.kernels.fresnel.layers import Stack
from optipath.kernels.fresnel.variants import AtAngle, AtEvent, Compensated
from optipath.kernels.kernel import Entry, Kernel, KernelFamily, Known, Sloped
from optipath.kernels.primitives import Factory, WithZero
from optipath.kernels.vertex_chain import (
    AxesAtVertex,
    TurnBetweenPlanes,
    event_at_vertex,
    refraction_at_vertex,
)

Factories: TypeAlias = tuple[Factory, ...]
"""One for any media, and cheaper ones for k = 0, and for n >= n1 besides."""

_NO_B: tuple[Entry, ...] = (None, None, 0.0, None, None)
_NO_S: tuple[Entry, ...] = (None, None, None, None, 0.0)
_NO_B_NO_S: tuple[Entry, ...] = (None, None, 0.0, None, 0.0)
_NO_C_NO_S: tuple[Entry, ...] = (None, None, None, 0.0, 0.0)
_LOSSLESS: tuple[Entry, ...] = (1.0, 1.0, 0.0, None, None)
"""What may be known of (Fs, Fp, B, C, S)."""

_COS, _SIN = -2, -1
_NORMAL = (Known(_NO_B_NO_S, (_SIN,)),)
_NORMAL_OR_GRAZING = (*_NORMAL, Known(_NO_B_NO_S, (_COS,)))
"""Of an angle of incidence of which the sine, or the cosine, is 0."""

_LETS_THROUGH = (*_NORMAL, Known(_NO_B, (_COS,)))
_KEEPS_PHASE = (*_LETS_THROUGH, Known(_NO_S))


def _matrix(*zeros: int, ones: tuple[int, ...] = ()) -> tuple[Entry, ...]:
    """Return sixteen numbers of which some are known."""
    known = dict.fromkeys(zeros, 0.0) | dict.fromkeys(ones, 1.0)
    return tuple(known.get(place) for place in range(16))


_DIAGONAL = (0, 5, 10, 15)
_OFF_DIAGONAL = tuple(place for place in range(16) if place not in _DIAGONAL)
_IDENTITY = _matrix(*_OFF_DIAGONAL, ones=_DIAGONAL)


def _where_any_is_zero(numbers: tuple[Entry, ...], *places: int) -> tuple[Known, ...]:
    return tuple(Known(numbers, (place,)) for place in places)


def _arguments(count: int) -> tuple[Known, ...]:
    """Return that numbers are 0 where the arguments at their places are."""
    return tuple(
        Known(tuple(0.0 if i == place else None for i in range(count)), (place,))
        for place in range(count)
    )


def _fresnel(
    what: str,
    of_stable: Factories,
    intensities: Factories,
    known: dict[str, tuple[tuple[Known, ...], ...]],
    **others: Factories,
) -> KernelFamily:
    """Return the kernels of all methods; each has the slopes of the stable one."""
    declared = known["stable"]
    methods = {"stable": _cheaper_within(f"{what} (stable", of_stable, declared, intensities)}
    for method, factories in others.items():
        sloped, declared = tuple(map(Sloped, factories, of_stable)), known.get(method, ((), ()))
        methods[method] = _cheaper_within(f"{what} ({method}", sloped, declared)
    return KernelFamily(what, methods)


def _cheaper_within(
    name: str,
    factories: Factories,
    known: tuple[tuple[Known, ...], ...],
    intensities: Factories = (),
) -> Kernel:
    """Return the kernel of the first factory, which knows the cheaper ones of the others."""
    result: Kernel | None = None
    words = (")", ", lossless)", ", lossless, from the rarer side)")
    for place, made_by in reversed(list(enumerate(factories))):
        # Of (n1, n, k, cos, sin), k is the third; of (n1, n, cos, sin), n is to be n1 or more.
        without = (2, result) if place == 0 and result else None
        denser = (1, 0, result) if place == 1 and result else None
        alone = None
        if intensities:
            cheap = (2, result.powers) if place == 0 and result and result.powers else None
            alone = Kernel(f"{name}{words[place]}, powers", POWERS, intensities[place], cheap)
        result = Kernel(
            name + words[place], BLOCK, made_by, without, denser, alone, known=known[place]
        )
    assert result is not None  # noqa: S101 - there is one factory at least
    return result


REFLECTION = _fresnel(
    "Fresnel reflection",
    (stable.stable_reflection, stable.lossless_reflection, stable.denser_reflection),
    (variants.reflected_powers, variants.lossless_powers, variants.denser_powers),
    {
        "stable": (
            _NORMAL_OR_GRAZING,
            _NORMAL_OR_GRAZING,
            (*_NORMAL_OR_GRAZING, Known(_NO_S)),
        ),
        "amplitude": ((Known(_NO_S, (2, _SIN)),),),
    },
    compensated=(Compensated(stable.stable_reflection), Compensated(stable.lossless_reflection)),
    amplitude=(Refracting(textbook.amplitude_reflection),),
    textbook=(Refracting(textbook.textbook_reflection),),
)
TRANSMISSION = _fresnel(
    "Fresnel transmission",
    (stable.stable_transmission, stable.lossless_transmission),
    (),
    {
        "stable": (_LETS_THROUGH, _KEEPS_PHASE),
        "compensated": ((), (Known(_NO_S),)),
        "amplitude": ((Known((0.0,) * 5, (_COS,)), Known(_NO_S, (2, _SIN))),),
    },
    compensated=(
        Compensated(stable.stable_transmission),
        Compensated(stable.lossless_transmission),
    ),
    amplitude=(Refracting(textbook.amplitude_transmission),),
    textbook=(Refracting(textbook.textbook_transmission),),
)
METHODS = tuple(REFLECTION.methods)

_OF_STACK = {"reflected": "reflection", "transmitted": "transmission", "absorbed": "absorption"}


def _at_event(method: str) -> Kernel:
    """Return the kernel of a method for what is reflected on some paths, let through on others."""
    both = REFLECTION.methods[method], TRANSMISSION.methods[method]
    name, cheaper = f"Fresnel reflection or transmission ({method}", None
    without = [kernel.without[1] for kernel in both if kernel.without]
    if len(without) == len(both):
        lossless = AtEvent(*without)
        # Of (event, n1, n, k, cos, sin), k is the fourth.
        known = _NORMAL_OR_GRAZING if method == "stable" else ()
        cheaper = 3, Kernel(f"{name}, lossless)", BLOCK, lossless, known=known)
    known = _LETS_THROUGH if method == "stable" else ()
    return Kernel(f"{name})", BLOCK, AtEvent(*both), cheaper, known=known)


def _at_angle(kernel: Kernel) -> Kernel:
    """Return a kernel whose numbers are NaN where its angle is none."""
    without = kernel.without and (kernel.without[0], _at_angle(kernel.without[1]))
    return replace(
        kernel, name=f"{kernel.name} at a vertex", factory=AtAngle(kernel.factory), without=without
    )


TRANSMISSION_AT_VERTEX = KernelFamily(
    "Fresnel transmission at a vertex",
    {method: _at_angle(kernel) for method, kernel in TRANSMISSION.methods.items()},
)
AT_EVENT = KernelFamily(
    "Fresnel reflection or transmission", {method: _at_event(method) for method in METHODS}
)


def _from_absorbing(stable: Factory, amplitude: Factory) -> dict[str, Factory]:
    """Return the kernels ``(n1, k1, n, k, [n0,] cos, sin)``; textbook ones are of amplitudes."""
    by_amplitudes = Sloped(amplitude, stable)
    return {
        "stable": stable,
        "compensated": Sloped(Compensated(stable), stable),
        "amplitude": by_amplitudes,
        "textbook": by_amplitudes,
    }


def _from_front(family: KernelFamily, stable: Factory, amplitude: Factory) -> KernelFamily:
    """Return a family for a medium in front that absorbs, and where it does not, the other."""
    what, methods = f"{family.name} out of an absorbing medium", {}
    for method, factory in _from_absorbing(stable, amplitude).items():
        usual, name = family.methods[method], f"{what} ({method})"
        alone = None
        if usual.powers:
            intensities = variants.inhomogeneous_powers
            alone = Kernel(f"{name}, powers", POWERS, intensities, (1, usual.powers))
        known = _NORMAL if method == "stable" else ()
        methods[method] = Kernel(name, BLOCK, factory, (1, usual), powers=alone, known=known)
    return KernelFamily(what, methods)


def _from_behind(family: KernelFamily, stable: Factory, amplitude: Factory) -> KernelFamily:
    """Return a family for light from behind; where nothing absorbs, it is the other."""
    what, methods = f"{family.name} from behind", {}
    for method, factory in _from_absorbing(stable, amplitude).items():
        usual = family.methods[method]
        name = f"{what} ({method}, lossless)"
        lossless = (
            usual.without[1] if usual.without else Kernel(name, BLOCK, WithZero(usual.factory, 2))
        )
        name = f"{what} ({method}, lossless in front)"
        known = _NORMAL if method == "stable" else ()
        rarer = Kernel(name, BLOCK, WithZero(factory, 1), (2, lossless), known=known)
        methods[method] = Kernel(f"{what} ({method})", BLOCK, factory, (1, rarer), known=known)
    return KernelFamily(what, methods)


REFLECTION_FROM_ABSORBING = _from_front(
    REFLECTION,
    absorbing.inhomogeneous_reflection,
    textbook.amplitude_inhomogeneous_reflection,
)
TRANSMISSION_FROM_ABSORBING = _from_front(
    TRANSMISSION,
    absorbing.inhomogeneous_transmission,
    textbook.amplitude_inhomogeneous_transmission,
)
TRANSMISSION_FROM_BEHIND = _from_behind(
    TRANSMISSION,
    absorbing.transmission_from_behind,
    textbook.amplitude_transmission_from_behind,
)
PHASE_INDEX = Kernel(
    "index of planes of constant phase",
    None,
    boundary.phase_index,
    without=(1, Kernel("index without absorption", None, boundary.real_index)),
)
"""The index by which Snell's law holds for the real angle in an absorbing medium."""


@lru_cache(256)
def stack(wanted: str, measured: str, absorbing: tuple[int, ...] = ()) -> KernelFamily:
    """Return the kernels of what a stack of layers lets through, sends back, or absorbs."""
    what = f"stack {_OF_STACK[wanted]}"
    lossy = ", absorbing" if absorbing else ""
    structure = None if wanted == "absorbed" else DEPOLARIZING_BLOCK
    methods = {}
    for method in METHODS:
        made_by = Stack(
            REFLECTION_FROM_ABSORBING.methods[method],
            TRANSMISSION_FROM_ABSORBING.methods[method],
            TRANSMISSION_FROM_BEHIND.methods[method],
            wanted,
            measured,
            absorbing,
        )
        name, grey = f"{what} ({method}{lossy})", replace(made_by, unpolarising=True)
        known = (Known(_NO_S, (_SIN,)),) if structure and method == "stable" else ()
        by_means = Kernel(f"{name} by means", structure, grey, known=known)
        methods[method] = Kernel(name, structure, made_by, unpolarising=by_means, known=known)
    return KernelFamily(what, methods)


TURN = Kernel("turn", ROTATION, filters.turn)
TURN_BACK = Kernel("turn back", ROTATION, filters.turn_back)
PLAIN_TURN = Kernel("turn between world frames", ROTATION, filters.given, known=_arguments(2))
ALIGN = Kernel("align", ROTATION, filters.align)
TURN_BETWEEN_PLANES = Kernel("turn between planes of incidence", ROTATION, TurnBetweenPlanes())
TURN_AT_REFRACTION = Kernel(
    "turn between planes beside a refraction", ROTATION, TurnBetweenPlanes(across=True)
)
INCIDENCE = Kernel("incidence", None, vertex_chain.incidence)
REFRACTION = Kernel("refraction at a vertex", None, refraction_at_vertex)
EVENT_AT_VERTEX = Kernel("event at a vertex", None, event_at_vertex)
ARRIVING = Kernel("arriving axes", None, AxesAtVertex())
REFLECTED = Kernel("reflected axes", None, AxesAtVertex(leaves=True))
"""What the points of a chain say: angles of incidence, and the axes at the last vertex."""

POLARIZER = Kernel(
    "polarizer",
    BLOCK,
    filters.polarizer,
    known=(Known(_NO_S), *_where_any_is_zero(_NO_C_NO_S, 0, 1)),
)
RETARDER = Kernel("retarder", BLOCK, filters.retarder, known=(Known(_LOSSLESS),))
ELLIPTICAL_RETARDER = Kernel(
    "elliptical retarder",
    FULL,
    medium.retardance,
    known=(
        Known(_matrix(ones=(0,))),
        Known(_matrix(1, 4), (0,)),
        Known(_matrix(2, 8), (1,)),
        Known(_matrix(3, 12), (2,)),
        Known(_matrix(7, 11, 13, 14), (0, 1)),
        Known(_matrix(6, 9, 11, 14), (0, 2)),
        Known(_matrix(6, 7, 9, 13), (1, 2)),
    ),
)
ATTENUATOR = Kernel("attenuator", SCALE, filters.attenuator)
RESPONSE = Kernel("response", SCALE, filters.given)
COMPLEMENT = Kernel("complement", SCALE, filters.complement)
_DEPOLARIZES = Known(_matrix(*_OFF_DIAGONAL, ones=(0,)))
DEPOLARIZER = Kernel("depolarizer", FULL, filters.depolarizer, known=(_DEPOLARIZES,))
MIRROR = Kernel("mirror", BLOCK, filters.mirror, known=(Known(_NO_B_NO_S),))
PLAIN_AMPLITUDES = Kernel(
    "mirror of given amplitudes",
    BLOCK,
    textbook.plain_amplitudes,
    known=(
        Known(_NO_C_NO_S, (0, 1)),
        Known(_NO_C_NO_S, (2, 3)),
        Known(_NO_S, (0, 2)),
        Known(_NO_S, (1, 3)),
    ),
)
_KEEPS = (1.0,), (1.0, 0.0)
"""The numbers of a scale and of a rotation that change nothing."""

ABSORPTION_ALONG = Kernel(
    "absorption along the way",
    SCALE,
    medium.absorption_along,
    known=_where_any_is_zero(_KEEPS[0], 0, 1),
)
THIRD_OF_ABSORPTION = Kernel(
    "a third of absorption",
    SCALE,
    medium.third_of_absorption,
    known=_where_any_is_zero(_KEEPS[0], 0, 1),
)
ROTATION_ALONG = Kernel(
    "rotation along the way",
    ROTATION,
    medium.rotation_along,
    known=_where_any_is_zero(_KEEPS[1], 0, 1),
)
DEXTROROTATION_ALONG = Kernel(
    "dextrorotation along the way",
    ROTATION,
    medium.dextrorotation_along,
    known=_where_any_is_zero(_KEEPS[1], 0, 1),
)
RETARDANCE_ALONG = Kernel(
    "retardance along the way",
    BLOCK,
    medium.retardance_along,
    known=(Known(_LOSSLESS), *_where_any_is_zero(BLOCK.identity, 0, 1)),
)
FARADAY_ROTATION = Kernel(
    "Faraday rotation",
    ROTATION,
    filters.faraday_rotation,
    known=_where_any_is_zero(_KEEPS[1], 0, 1, 2),
)
WAVEPLATE = Kernel("wave plate", BLOCK, filters.waveplate, known=(Known(_LOSSLESS),))
POLARIZING_REFLECTION = Kernel(
    "polarising reflection", BLOCK, filters.polarizing_reflection, known=(Known(_NO_S),)
)
POLARIZING_TRANSMISSION = Kernel(
    "polarising transmission", BLOCK, filters.polarizing_transmission, known=(Known(_NO_S),)
)
ABSORPTION_WITH_DICHROISM = Kernel(
    "absorption beside dichroism",
    SCALE,
    medium.absorption_with_dichroism,
    known=(Known(_KEEPS[0], (3,)),),
)
THIRD_WITH_DICHROISM = Kernel(
    "a third of absorption beside dichroism",
    SCALE,
    medium.third_of_absorption_with_dichroism,
    known=(Known(_KEEPS[0], (3,)),),
)
DICHROISM_ALONG = Kernel(
    "dichroism along the way",
    BLOCK,
    medium.dichroism_along,
    known=(Known(_LOSSLESS, (0,)), Known(_NO_S, (1,)), Known(BLOCK.identity, (2,))),
)
DEPOLARIZATION_ALONG = Kernel(
    "depolarisation along the way",
    FULL,
    medium.depolarization_along,
    known=(_DEPOLARIZES, *_where_any_is_zero(_IDENTITY, 0, 1)),
)
DICHROISM_AND_RETARDANCE_ALONG = Kernel(
    "dichroism and retardance along the way",
    FULL,
    medium.dichroism_and_retardance_along,
    known=(
        Known(_matrix(2, 8), (0, 1)),
        Known(_matrix(7, 13), (0, 3)),
        Known(_matrix(7, 13), (1, 2, 4, 5)),
        Known(_matrix(2, 6, 8, 9, 11, 14), (2, 3, 4, 5)),
        Known(_IDENTITY, (6,)),
    ),
)
DEPOLARIZING_DICHROISM_ALONG = Kernel(
    "dichroism and depolarisation along the way",
    FULL,
    medium.depolarizing_dichroism_along,
    known=(Known(_IDENTITY, (7,)),),
)
CONSTANT_BLOCK = Kernel("retarding diattenuator", BLOCK, filters.given)
CONSTANT_DEPOLARIZING_BLOCK = Kernel("depolarising diattenuator", DEPOLARIZING_BLOCK, filters.given)
MATRIX = Kernel("matrix", FULL, filters.given, known=_arguments(16))

PRODUCT = Kernel(
    "intensity at a wavelength", None, filters.product, known=_where_any_is_zero((0.0,), 0, 1)
)
UNPOLARIZED = Kernel(
    "unpolarized light", None, filters.unpolarized, known=(Known((None, 0.0, 0.0, 0.0)),)
)
POLARIZED = Kernel(
    "polarized light",
    None,
    filters.polarized,
    known=(
        Known((0.0,) * 4, (0,)),
        *(Known(entry.numbers, (place,)) for place, entry in enumerate(_arguments(4), 1)),
    ),
)
