"""Every kernel by name: a factory over `Primitives`, bound to the structure of what it returns."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, Literal, TypeAlias, get_args

from optipath.kernels import filters, medium, vertex_chain
from optipath.kernels.carriers.structures import (
    BLOCK,
    DEPOLARIZING_BLOCK,
    FULL,
    POWERS,
    ROTATION,
    SCALE,
)
from optipath.kernels.fresnel import boundary, stable, textbook, variants
from optipath.kernels.fresnel.boundary import refracting
from optipath.kernels.fresnel.layers import Stack
from optipath.kernels.fresnel.variants import at_angle, at_event, compensated
from optipath.kernels.kernel import Kernel, KernelFamily, Known, sloped
from optipath.kernels.primitives import Factory, Made, with_zero
from optipath.kernels.vertex_chain import (
    axes_at_vertex,
    event_at_vertex,
    refraction_at_vertex,
    turn_between_planes,
    turn_to_frame,
)

Row: TypeAlias = tuple[Factory, tuple[Known, ...], *tuple[Factory, ...]]
"""What makes a kernel, what is known of its numbers, and what makes the powers alone, if any."""

_COS, _SIN = -2, -1
_NORMAL = (("..0.0", _SIN),)
_NORMAL_OR_GRAZING = (*_NORMAL, ("..0.0", _COS))
_LETS_THROUGH = (*_NORMAL, ("..0..", _COS))
_NO_S = (("....0",),)
_NO_S_IF_LOSSLESS = ("....0", 2, _SIN)
"""What is known of (Fs, Fp, B, C, S), also where the sine or the cosine of the angle is 0."""

_IDENTITY = "1000 0100 0010 0001"


def _if_any_is_zero(numbers: str, *places: int) -> tuple[Known, ...]:
    return tuple([(numbers, place) for place in places])


def _given(count: int, first: int = 0) -> tuple[Known, ...]:
    """Return that numbers are 0 where the arguments are, the first of them at a place."""
    return tuple([("." * i + "0" + "." * (count - i - 1), first + i) for i in range(count)])


def _fresnel(
    what: str, exact: Sequence[Row], lossless: tuple[Known, ...] = (), **textbooks: Row
) -> KernelFamily:
    """Return the kernels of all methods; each has the slopes of the stable one.

    The exact ones are for any media, for k = 0, and for n >= n1 besides; `lossless` is known of
    the second in twice the precision.
    """
    known = zip(exact, ((), lossless), strict=False)
    others: dict[str, list[Row]] = {
        "compensated": [(Made(compensated, row[0]), of) for row, of in known]
    }
    others |= {name: [(Made(refracting, row[0]), row[1])] for name, row in textbooks.items()}
    methods = {"stable": _cheaper_within(f"{what} (stable", exact)}
    for method, rows in others.items():
        pairs = zip(rows, exact, strict=False)
        kernels = [(Made(sloped, own[0], stable[0]), own[1]) for own, stable in pairs]
        methods[method] = _cheaper_within(f"{what} ({method}", kernels)
    return KernelFamily(what, methods)


_MEDIA = ")", ", lossless)", ", lossless, from the rarer side)"


def _cheaper_within(name: str, rows: Sequence[Row]) -> Kernel:
    """Return the kernel of the first row, which knows the cheaper ones of the others."""
    result: Any = None
    powers: Any = None
    for place, (factory, known, *intensities) in reversed([*enumerate(rows)]):
        own = name + _MEDIA[place]
        for made_by in intensities:
            cheaper = (2, powers) if place == 0 else None
            powers = Kernel(f"{own}, powers", POWERS, made_by, cheaper)
        # Of (n1, n, k, cos, sin), k is the third; of (n1, n, cos, sin), n is to be n1 or more.
        without = (2, result) if place == 0 and result else None
        denser = (1, 0, result) if place == 1 and result else None
        result = Kernel(own, BLOCK, factory, without, denser, powers, known=known)
    kernel: Kernel = result
    return kernel


_LOSSLESS_POWERS = Made(variants.lossless_powers, boundary.lossless_boundary)
_DENSER_POWERS = Made(variants.lossless_powers, boundary.denser_boundary)
REFLECTION = _fresnel(
    "Fresnel reflection",
    [
        (stable.stable_reflection, _NORMAL_OR_GRAZING, variants.reflected_powers),
        (stable.lossless_reflection, _NORMAL_OR_GRAZING, _LOSSLESS_POWERS),
        (stable.denser_reflection, (*_NORMAL_OR_GRAZING, *_NO_S), _DENSER_POWERS),
    ],
    amplitude=(textbook.amplitude_reflection, (_NO_S_IF_LOSSLESS,)),
    textbook=(textbook.textbook_reflection, ()),
)
TRANSMISSION = _fresnel(
    "Fresnel transmission",
    [
        (stable.stable_transmission, _LETS_THROUGH),
        (stable.lossless_transmission, (*_LETS_THROUGH, *_NO_S)),
    ],
    _NO_S,
    amplitude=(textbook.amplitude_transmission, (("00000", _COS), _NO_S_IF_LOSSLESS)),
    textbook=(textbook.textbook_transmission, ()),
)
Method: TypeAlias = Literal["stable", "compensated", "amplitude", "textbook"]
METHODS: tuple[Method, ...] = get_args(Method)

_OF_STACK = {"reflected": "reflection", "transmitted": "transmission", "absorbed": "absorption"}


def _at_event(method: str) -> Kernel:
    """Return the kernel of a method for what is reflected on some paths, let through on others."""
    both = REFLECTION.methods[method], TRANSMISSION.methods[method]
    name, cheaper = f"Fresnel reflection or transmission ({method}", None
    without = [kernel.without[1] for kernel in both if kernel.without]
    if len(without) == len(both):
        # Of (event, n1, n, k, cos, sin), k is the fourth.
        known = _NORMAL_OR_GRAZING if method == "stable" else ()
        cheaper = 3, Kernel(f"{name}, lossless)", BLOCK, Made(at_event, *without), known=known)
    known = _LETS_THROUGH if method == "stable" else ()
    return Kernel(f"{name})", BLOCK, Made(at_event, *both), cheaper, known=known)


def _at_angle(kernel: Kernel) -> Kernel:
    """Return a kernel whose numbers are NaN where its angle is none."""
    without = kernel.without and (kernel.without[0], _at_angle(kernel.without[1]))
    return replace(
        kernel,
        name=f"{kernel.name} at a vertex",
        factory=Made(at_angle, kernel.factory),
        without=without,
    )


TRANSMISSION_AT_VERTEX = KernelFamily(
    "Fresnel transmission at a vertex",
    {method: _at_angle(kernel) for method, kernel in TRANSMISSION.methods.items()},
)
AT_EVENT = KernelFamily(
    "Fresnel reflection or transmission", {method: _at_event(method) for method in METHODS}
)


def _from_absorbing(
    method: str, stable: Factory, amplitude: Factory
) -> tuple[Factory, tuple[Known, ...]]:
    """Return what makes ``(n1, k1, n, k, [n0,] cos, sin)``; textbook ones are of amplitudes."""
    if method == "stable":
        return stable, _NORMAL
    twice = Made(compensated, stable)
    return Made(sloped, twice if method == "compensated" else amplitude, stable), ()


def _from_front(family: KernelFamily, stable: Factory, amplitude: Factory) -> KernelFamily:
    """Return a family for a medium in front that absorbs, and where it does not, the other."""
    what, methods = f"{family.name} out of an absorbing medium", {}
    for method, usual in family.methods.items():
        factory, known = _from_absorbing(method, stable, amplitude)
        name, alone = f"{what} ({method})", None
        if usual.powers:
            intensities = variants.inhomogeneous_powers
            alone = Kernel(f"{name}, powers", POWERS, intensities, (1, usual.powers))
        methods[method] = Kernel(name, BLOCK, factory, (1, usual), powers=alone, known=known)
    return KernelFamily(what, methods)


def _from_behind(family: KernelFamily, stable: Factory, amplitude: Factory) -> KernelFamily:
    """Return a family for light from behind; where nothing absorbs, it is the other."""
    what, methods = f"{family.name} from behind", {}
    for method, usual in family.methods.items():
        factory, known = _from_absorbing(method, stable, amplitude)
        name = f"{what} ({method}"
        lossless = Kernel(f"{name}, lossless)", BLOCK, Made(with_zero, usual.factory, 2))
        cheaper = 2, usual.without[1] if usual.without else lossless
        in_front = f"{name}, lossless in front)"
        rarer = Kernel(in_front, BLOCK, Made(with_zero, factory, 1), cheaper, known=known)
        methods[method] = Kernel(f"{name})", BLOCK, factory, (1, rarer), known=known)
    return KernelFamily(what, methods)


REFLECTION_FROM_ABSORBING = _from_front(
    REFLECTION, stable.inhomogeneous_reflection, textbook.amplitude_inhomogeneous_reflection
)
TRANSMISSION_FROM_ABSORBING = _from_front(
    TRANSMISSION,
    stable.inhomogeneous_transmission,
    textbook.amplitude_inhomogeneous_transmission,
)
TRANSMISSION_FROM_BEHIND = _from_behind(
    TRANSMISSION, stable.transmission_from_behind, textbook.amplitude_transmission_from_behind
)
_FACES = REFLECTION_FROM_ABSORBING, TRANSMISSION_FROM_ABSORBING, TRANSMISSION_FROM_BEHIND

_REAL_INDEX = Kernel("index without absorption", None, boundary.real_index)
PHASE_INDEX = Kernel(
    "index of planes of constant phase", None, boundary.phase_index, (1, _REAL_INDEX)
)
"""The index by which Snell's law holds for the real angle in an absorbing medium."""


@lru_cache(256)
def stack(wanted: str, measured: str, absorbing: tuple[int, ...] = ()) -> KernelFamily:
    """Return the kernels of what a stack of layers lets through, sends back, or absorbs."""
    what = f"stack {_OF_STACK[wanted]}"
    lossy = ", absorbing" if absorbing else ""
    structure = None if wanted == "absorbed" else DEPOLARIZING_BLOCK
    methods: dict[str, Kernel] = {}
    for method in METHODS:
        reflection, transmission, behind = (family.methods[method] for family in _FACES)
        made_by = Stack(reflection, transmission, behind, wanted, measured, absorbing)
        name, grey = f"{what} ({method}{lossy})", replace(made_by, unpolarising=True)
        known: tuple[Known, ...] = ()
        if structure and method == "stable":
            known = (("....0", _SIN),)
        by_means = Kernel(f"{name} by means", structure, grey, known=known)
        methods[method] = Kernel(name, structure, made_by, unpolarising=by_means, known=known)
    return KernelFamily(what, methods)


TURN = Kernel("turn", ROTATION, filters.turn)
TURN_BACK = Kernel("turn back", ROTATION, filters.turn_back)
PLAIN_TURN = Kernel("turn between world frames", ROTATION, filters.given, known=_given(2))
ALIGN = Kernel("align", ROTATION, filters.align)
TURN_BETWEEN_PLANES = Kernel(
    "turn between planes of incidence", ROTATION, Made(turn_between_planes)
)
TURN_AT_REFRACTION = Kernel(
    "turn between planes beside a refraction", ROTATION, Made(turn_between_planes, across=True)
)
TURN_TO_FRAME = Kernel("turn between a vertex and a frame", ROTATION, Made(turn_to_frame))
INCIDENCE = Kernel("incidence", None, vertex_chain.incidence)
REFRACTION = Kernel("refraction at a vertex", None, refraction_at_vertex)
EVENT_AT_VERTEX = Kernel("event at a vertex", None, event_at_vertex)
ARRIVING = Kernel("arriving axes", None, Made(axes_at_vertex))
REFLECTED = Kernel("reflected axes", None, Made(axes_at_vertex, leaves=True))
"""What the points of a chain say: angles of incidence, and the axes at the last vertex."""

ATTENUATOR = Kernel("attenuator", SCALE, filters.attenuator)
RESPONSE = Kernel("response", SCALE, filters.given)
COMPLEMENT = Kernel("complement", SCALE, filters.complement)
CONSTANT_BLOCK = Kernel("retarding diattenuator", BLOCK, filters.given)
CONSTANT_DEPOLARIZING_BLOCK = Kernel("depolarising diattenuator", DEPOLARIZING_BLOCK, filters.given)
MATRIX = Kernel("matrix", FULL, filters.given, known=_given(16))


def _block(name: str, factory: Factory, *known: Known) -> Kernel:
    return Kernel(name, BLOCK, factory, known=known)


_RETARDS, _UNRETARDED = ("110..",), _if_any_is_zero("11010", 0, 1)
POLARIZER = _block("polarizer", filters.polarizer, *_NO_S, *_if_any_is_zero("...00", 0, 1))
RETARDER = _block("retarder", filters.retarder, _RETARDS)
WAVEPLATE = _block("wave plate", filters.waveplate, _RETARDS)
RETARDANCE_ALONG = _block(
    "retardance along the way", Made(medium.along, filters.retarder), _RETARDS, *_UNRETARDED
)
DICHROISM_ALONG = _block(
    "dichroism along the way", medium.dichroism_along, ("110..", 0), ("....0", 1), ("11010", 2)
)
MIRROR = _block("mirror", filters.mirror, ("..0.0",))
PLAIN_AMPLITUDES = _block(
    "mirror of given amplitudes",
    textbook.plain_amplitudes,
    *(("...00", 0, 1), ("...00", 2, 3), ("....0", 0, 2), ("....0", 1, 3)),
)
POLARIZING_REFLECTION = _block("polarising reflection", filters.polarizing_reflection, *_NO_S)
POLARIZING_TRANSMISSION = _block("polarising transmission", filters.polarizing_transmission, *_NO_S)


def _absorption(name: str, share: float = 1.0, *, dichroic: bool = False) -> Kernel:
    known = (("1", 3),) if dichroic else _if_any_is_zero("1", 0, 1)
    return Kernel(name, SCALE, Made(medium.absorption, share=share, dichroic=dichroic), known=known)


_BESIDE, _THIRD = "absorption beside dichroism", 1.0 / 3.0
ABSORPTION_ALONG = _absorption("absorption along the way")
THIRD_OF_ABSORPTION = _absorption("a third of absorption", _THIRD)
ABSORPTION_WITH_DICHROISM = _absorption(_BESIDE, dichroic=True)
THIRD_WITH_DICHROISM = _absorption(f"a third of {_BESIDE}", _THIRD, dichroic=True)


def _rotation(name: str, factory: Factory, arguments: int = 2) -> Kernel:
    return Kernel(name, ROTATION, factory, known=_if_any_is_zero("10", *range(arguments)))


ROTATION_ALONG = _rotation("rotation along the way", Made(medium.along, filters.turn_back))
DEXTROROTATION_ALONG = _rotation("dextrorotation along the way", Made(medium.along, filters.turn))
FARADAY_ROTATION = _rotation("Faraday rotation", filters.faraday_rotation, 3)


def _full(name: str, factory: Factory, *known: Known) -> Kernel:
    return Kernel(name, FULL, factory, known=known)


ELLIPTICAL_RETARDER = _full(
    "elliptical retarder",
    medium.retardance,
    ("1... .... .... ....",),
    (".0.. 0... .... ....", 0),
    ("..0. .... 0... ....", 1),
    ("...0 .... .... 0...", 2),
    (".... ...0 ...0 .00.", 0, 1),
    (".... ..0. .0.0 ..0.", 0, 2),
    (".... ..00 .0.. .0..", 1, 2),
)
_DEPOLARIZES = "1000 0.00 00.0 000."
DEPOLARIZER = _full("depolarizer", filters.depolarizer, (_DEPOLARIZES,))
DEPOLARIZATION_ALONG = _full(
    "depolarisation along the way",
    medium.depolarization_along,
    *((_DEPOLARIZES,), *_if_any_is_zero(_IDENTITY, 0, 1)),
)
DICHROISM_AND_RETARDANCE_ALONG = _full(
    "dichroism and retardance along the way",
    medium.dichroism_and_retardance_along,
    ("..0. .... 0... ....", 0, 1),
    (".... ...0 .... .0..", 0, 3),
    (".... ...0 .... .0..", 1, 2, 4, 5),
    ("..0. ..0. 00.0 ..0.", 2, 3, 4, 5),
    (_IDENTITY, 6),
)
DEPOLARIZING_DICHROISM_ALONG = _full(
    "dichroism and depolarisation along the way",
    medium.depolarizing_dichroism_along,
    (_IDENTITY, 7),
)


def _light(name: str, factory: Factory, *known: Known) -> Kernel:
    return Kernel(name, None, factory, known=known)


PRODUCT = _light("intensity at a wavelength", filters.product, *_if_any_is_zero("0", 0, 1))
UNPOLARIZED = _light("unpolarized light", filters.unpolarized, (".000",))
POLARIZED = _light("polarized light", filters.polarized, ("0000", 0), *_given(4, first=1))
