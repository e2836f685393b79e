"""Layers of a sample: rough interfaces, media and their indices."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import Cure, Fault, OptipathError, SurfaceError, ValueFault, shown
from optipath.materials.index_domains import IndexDomain, LitBehind
from optipath.materials.material import Material
from optipath.paths.files.schema import Faults
from optipath.surfaces.height_field import HeightField
from optipath.values.arrays import same_fields
from optipath.values.curve_value import CurveValue
from optipath.values.domains import Domain
from optipath.values.jax_values import is_traced
from optipath.values.parameters import THERE, Parameter
from optipath.values.use import Use, faults_of
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    import numpy.typing as npt

    from optipath.values.parameters import Resolved

    Parts: TypeAlias = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


Roughness: TypeAlias = tuple[float, float] | HeightField


class AlphaDomain(Domain):
    """Roughnesses of interfaces, 0 of flat ones."""

    def quickly_allows(self, value: Any) -> bool:
        return super().quickly_allows(value) or value == 0.0

    def allows(self, numbers: Any) -> Any:
        return super().allows(numbers) | (numbers == 0.0)

    def described(self) -> str:
        return (
            f"a {self.name} within {self.minimum:g} .. {self.maximum:g}, or 0 for a flat interface"
        )


# Beyond, squares of heights and of lengths that are of their size are no numbers.
ALPHA = AlphaDomain("roughness", minimum=1e-6, maximum=100.0)


@dataclass(frozen=True, eq=False)
class SampleLayer:
    """An interface of a sample, and the medium below it."""

    index: float | complex | Material
    roughness: Roughness
    file: str = ""

    @property
    def is_random(self) -> bool:
        """Whether its heights are drawn."""
        return isinstance(self.roughness, tuple) and self.roughness != (0.0, 0.0)

    @property
    def is_flat(self) -> bool:
        """Whether it is a plane that goes on for ever."""
        rough = self.roughness
        if isinstance(rough, HeightField):
            return rough.is_flat and rough.periodic
        return rough == (0.0, 0.0)

    @property
    def isotropic(self) -> bool:
        """Whether no direction is any other."""
        rough = self.roughness
        return rough.isotropic if isinstance(rough, HeightField) else rough[0] == rough[1]

    def __repr__(self) -> str:
        rough = self.roughness
        if isinstance(rough, tuple) and rough[0] == rough[1]:
            return f"({self.index!r}, {rough[0]!r})"
        return f"({self.index!r}, {rough!r})"

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]


def layer_of(owner: str, arguments: Any, domain: Domain) -> SampleLayer:
    """Return a layer as a sample keeps it."""
    file = arguments.file if isinstance(arguments, SampleLayer) else ""
    if isinstance(arguments, SampleLayer):
        arguments = arguments.index, arguments.roughness
    if not isinstance(arguments, (tuple, list)) or len(arguments) != 2:
        raise SurfaceError(
            f"{owner} is {shown(arguments)}; give a pair of the index of refraction below and the "
            f"roughness, such as (1.5, 0.1)"
        )
    faults = Faults()
    index = faults.attempt("", medium_of, f"{owner}.index", arguments[0], domain)
    roughness = faults.attempt("", _roughness_of, f"{owner}.alpha", arguments[1])
    if faults or index is None or roughness is None:
        raise SurfaceError(*faults)
    return SampleLayer(index, roughness, file)


def _roughness_of(owner: str, argument: Any) -> Roughness:
    """Return the roughness along x and y, or heights as they are given."""
    if isinstance(argument, HeightField):
        return argument
    argument = argument.tolist() if isinstance(argument, np.ndarray) else argument
    both = argument if isinstance(argument, (tuple, list)) else (argument, argument)
    if len(both) != 2:
        raise SurfaceError(
            f"{owner} is {shown(argument)}; give one number, a pair along x and y, or heights"
        )
    along_x, along_y = [_alpha_of(owner, one) for one in both]
    if (along_x == 0.0) != (along_y == 0.0):
        raise SurfaceError(
            f"{owner} is {shown(argument)}; give two numbers above 0, or 0 for a flat interface"
        )
    return along_x, along_y


def _alpha_of(owner: str, argument: Any) -> float:
    if isinstance(argument, Parameter) or is_traced(argument):
        what = argument.called if isinstance(argument, Parameter) else "traced by JAX"
        raise SurfaceError(f"{owner} is {what}; give a number, and make a sample for each")
    result = ALPHA.check(owner, argument)
    if result.ndim:
        raise SurfaceError(
            f"{owner} has {shown(argument)} for one number; give a pair along x and y"
        )
    return float(result)


def layers_of(argument: Any, faults: Faults) -> tuple[SampleLayer, ...]:
    """Return the layers of a sample as it keeps them."""
    if not isinstance(argument, (list, tuple)) or not argument:
        faults.append(
            f"layers is {shown(argument)}; give a list with a pair for each interface, the "
            f"index of refraction below it and its roughness, such as [(1.5, 0.1)]"
        )
        return ()
    domains = [CLEAR_MEDIUM] * (len(argument) - 1) + [BASE]
    results = [
        faults.attempt("", layer_of, f"layers[{place}]", layer, domain)
        for place, (layer, domain) in enumerate(zip(argument, domains, strict=True))
    ]
    return tuple([layer for layer in results if layer is not None])


def unused_faults(layers: Sequence[SampleLayer], cells: Any, *, periodic: bool) -> list[str]:
    """Return a sentence for what is given of random fields and says nothing of those there are.

    >>> from optipath.surfaces.sample_layers import SampleLayer
    >>> unused_faults([SampleLayer(1.5, (0.0, 0.0))], (640, 640), periodic=True)
    ['cells is given, but no interface is random; leave it out']
    """
    results = []
    if cells is not None and not any(layer.is_random for layer in layers):
        results.append("cells is given, but no interface is random; leave it out")
    for place, layer in enumerate(layers):
        heights = layer.roughness if isinstance(layer.roughness, HeightField) else None
        if not periodic and heights is not None and heights.periodic and not heights.is_flat:
            results.append(
                f"periodic is False, but the heights of layers[{place}] are periodic; give those a "
                f"border, or leave periodic out, which is of random fields"
            )
    return results


_NAME = "index of refraction"


@dataclass(frozen=True)
class ClearMediumDomain(LitBehind):
    """Positive real numbers: light goes to and fro in a medium above the last."""

    why: str = ", since only the last medium may absorb"

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        if np.any(array.imag):
            raise ValueFault(f"{owner} is {array[()]}, which absorbs; give {self.described()}")
        super()._check_numbers(owner, array, rounding)


class BaseDomain(IndexDomain):
    """Complex numbers n + ik other than 0, n and k not negative: the medium of the base."""

    def quickly_allows(self, value: Any) -> bool:
        return super().quickly_allows(value) and value != 0.0

    def described(self) -> str:
        return "an index of refraction n + ik with n and k not negative, and one of them above 0"

    def allows(self, numbers: Any) -> Any:
        return super().allows(numbers) & (numbers != 0.0)


# Limits as a stack of smooth layers has them.
CLEAR_MEDIUM = ClearMediumDomain(_NAME, minimum=1e-60, maximum=1e60)
BASE = BaseDomain(_NAME)


def medium_of(owner: str, value: Any, domain: Domain) -> float | complex | Material:
    """Return a medium as a sample keeps it.

    >>> medium_of("outside", Material(1.5), CLEAR_MEDIUM), medium_of("base", "0.5+2.1j", BASE)
    (1.5, (0.5+2.1j))
    """
    if faults := _open_faults(owner, value):
        raise SurfaceError(*faults)
    if isinstance(value, Material) and depends_on_wavelength(value):
        if faults := faults_of([Use(*place) for place in domain.parts(owner, value)]):
            raise SurfaceError(*faults)
        return value
    several = isinstance(value, (list, tuple)) or is_traced(value)
    array = None if several else domain.check(owner, value)
    if array is None or array.ndim:
        cure = Cure.of(
            "give one, such as {}, and make a sample for each".format,
            "1.5 or 0.5+2.1j",
            "1.5 or { n = 0.5, k = 2.1 }",
        )
        raise SurfaceError(
            Fault(f"{owner} is {shown(value)}, but a sample has one index there", cure)
        )
    number = complex(array)
    return number if number.imag else number.real


def depends_on_wavelength(medium: Any) -> bool:
    """Tell whether n or k of a medium follows from a curve."""
    return isinstance(medium, Material) and any(
        isinstance(part, CurveValue) for part in (medium.n, medium.k)
    )


def _open_faults(owner: str, value: Any) -> list[str]:
    """Return a sentence for each parameter that a medium follows from."""
    parts = [value.n, value.k] if isinstance(value, Material) else [value]
    names = dict.fromkeys(name for part in parts for name in _open_names(part))
    return [
        f"{owner} follows from the parameter '{name}'; give numbers, or a Material that follows "
        f"from the wavelength alone, made without wavelength=..."
        for name in names
    ]


def _open_names(part: Any) -> list[str]:
    """Return the parameters that a number follows from, but for the usual wavelength."""
    depends_on = part.depends_on if isinstance(part, CurveValue) else (part,)
    return [one.name for one in depends_on if isinstance(one, Parameter) and one != Wavelength()]


WHEN = "wavelength"
"""The parameter that media follow from."""


class SampleIndices(NamedTuple):
    """The indices of the media of a sample; only the last may depend on the wavelength."""

    outside: float
    inner: tuple[float, ...]
    n: npt.NDArray[np.float64]
    k: npt.NDArray[np.float64]

    @property
    def opaque(self) -> bool:
        """Whether all light that meets the last interface is reflected or absorbed there."""
        return bool(np.all(self.k))

    @property
    def base(self) -> Any:
        """That of the base as one number n + ik, or an array of such."""
        return (self.n + 1j * self.k)[()]


def indices_of(media: Mapping[str, Any], wavelength: Any) -> SampleIndices:
    """Return the indices of media. Units: wavelength in metres."""
    argument = _numbers_at(media.values(), wavelength)
    domains = [CLEAR_MEDIUM] * (len(media) - 1) + [BASE]
    faults = Faults()
    results: dict[str, Parts] = {}
    for (place, medium), domain in zip(media.items(), domains, strict=True):
        parts = faults.attempt("", _parts_at, place, medium, domain, argument)
        results |= {} if parts is None else {place: parts}
    if not faults:
        faults += _faults_of_several(results)
    if faults:
        raise SurfaceError(*dict.fromkeys(faults))
    *above, (n, k) = results.values()
    outside, *inner = [float(np.ravel(clear)[0]) for clear, _ in above]
    shape = np.shape(argument[WHEN].value) if argument else ()
    return SampleIndices(outside, tuple(inner), _laid_out(n, shape), _laid_out(k, shape))


def _laid_out(numbers: Any, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    return np.array(np.broadcast_to(numbers, shape), np.float64)


def _numbers_at(media: Iterable[Any], wavelength: Any) -> dict[str, Resolved]:
    """Return the wavelengths that are given; nothing where no medium depends on them."""
    dependent = next(filter(depends_on_wavelength, media), None)
    if wavelength is None and dependent is None:
        return {}
    if wavelength is None:
        cure = Cure.of("give one, {}".format, "such as '550 nm'", "--wavelength '550 nm'")
        raise SurfaceError(Fault(f"{dependent} depends on the wavelength", cure))
    if dependent is None:
        raise SurfaceError("wavelength is given, but no medium depends on it; leave it out")
    if is_traced(wavelength):
        raise SurfaceError("wavelength is traced by JAX, but samples have no slopes; give a number")
    try:
        argument = Wavelength().resolve(wavelength)
    except OptipathError as error:
        raise SurfaceError(*error.faults) from None
    if not argument.value.size:
        raise SurfaceError("wavelength is empty; give one or more")
    return {WHEN: argument}


def _parts_at(place: str, medium: Any, domain: Domain, arguments: Mapping[str, Resolved]) -> Parts:
    """Return n and k of a medium at the wavelengths that are given."""
    if not depends_on_wavelength(medium):
        return np.asarray(np.real(medium)), np.asarray(np.imag(medium))
    n, k = [_part_at(place, Use(*part), arguments) for part in domain.parts(place, medium)]
    domain.check(place, n + 1j * k)
    return n, k


def _part_at(place: str, use: Use, arguments: Mapping[str, Resolved]) -> Any:
    if not isinstance(use.value, CurveValue):
        return np.asarray(use.value)
    when, _ = use.with_arguments()
    # Of n and k of one curve it is told once.
    replace(when, owner=place).check_arguments(arguments[WHEN].value)
    numbers = use.value.computed(arguments).value
    use.check_arguments(numbers, THERE, arguments)
    return use.value.placed(numbers)


def _faults_of_several(results: Mapping[str, Parts]) -> Iterator[str]:
    """Yield what keeps light of several wavelengths from one way through a sample."""
    *above, base = results
    for place in above:
        if np.ptp(results[place][0]):
            yield (
                f"{place} differs from wavelength to wavelength, and so do the ways of light below "
                f"it; give one wavelength at a time"
            )
    n, k = results[base]
    if n.size > 1 and not np.all(k):
        yield (
            f"{base} lets light through, whose ways differ from wavelength to wavelength; give one "
            f"wavelength at a time"
        )
