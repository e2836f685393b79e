"""Layers of a sample: rough interfaces, media and their indices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import Cure, Fault, OptipathError, SurfaceError, shown
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.paths.files.schema import Faults
from optipath.surfaces.height_field import HeightField
from optipath.values.arrays import same_fields
from optipath.values.curve_value import CurveValue
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter
from optipath.values.precision import real_number
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt


Roughness: TypeAlias = tuple[float, float] | HeightField

_LEAST, _MOST = 1e-6, 100.0
"""Beyond, squares of heights and of lengths that are of their size are no numbers."""


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


def layers_of(argument: Any, faults: Faults) -> tuple[SampleLayer, ...]:
    """Return the layers of a sample as it keeps them."""
    if not isinstance(argument, (list, tuple)) or not argument:
        faults.append(
            f"layers is {shown(argument)}; give a list with a pair for each interface, the "
            f"index of refraction below it and its roughness, such as [(1.5, 0.1)]"
        )
        return ()
    last = len(argument) - 1
    results = [
        faults.attempt("", _layer_of, f"layers[{place}]", layer, clear=place < last)
        for place, layer in enumerate(argument)
    ]
    return tuple([layer for layer in results if layer is not None])


def _layer_of(owner: str, argument: Any, *, clear: bool) -> SampleLayer:
    file = ""
    if isinstance(argument, SampleLayer):
        argument, file = (argument.index, argument.roughness), argument.file
    if not isinstance(argument, (tuple, list)) or len(argument) != 2:
        raise SurfaceError(
            f"{owner} is {shown(argument)}; give a pair of the index of refraction below and the "
            f"roughness, such as (1.5, 0.1)"
        )
    faults = Faults()
    index = faults.attempt("", medium_of, f"{owner}.index", argument[0], clear=clear)
    roughness = faults.attempt("", _roughness_of, f"{owner}.alpha", argument[1])
    if faults or index is None or roughness is None:
        raise SurfaceError(*faults)
    return SampleLayer(index, roughness, file)


def _roughness_of(owner: str, argument: Any) -> Roughness:
    """Return the roughness along x and y, or heights as they are given."""
    if isinstance(argument, HeightField):
        return argument
    argument = argument.tolist() if isinstance(argument, np.ndarray) else argument
    both = argument if isinstance(argument, (tuple, list)) else (argument, argument)
    numbers = [real_number(each) for each in both]
    is_rough = all(each is not None and _LEAST <= each <= _MOST for each in numbers)
    if len(numbers) != 2 or not (is_rough or numbers == [0.0, 0.0]):
        raise SurfaceError(
            f"{owner} is {shown(argument)}; give a number within {_LEAST:g} .. {_MOST:g}, or a "
            f"pair of them along x and y, 0 for a flat interface, or a HeightField"
        )
    along_x, along_y = map(float, both)
    return along_x, along_y


def medium_of(owner: str, value: Any, *, clear: bool) -> float | complex | Material:
    """Return a medium as a sample keeps it; one that is clear does not absorb.

    >>> medium_of("outside", Material(1.5), clear=True), medium_of("base", "0.5+2.1j", clear=False)
    (1.5, (0.5+2.1j))
    """
    if names := _open_names(value):
        raise SurfaceError(
            f"{owner} follows from the parameter '{names[0]}'; give numbers, or a Material that "
            f"follows from the wavelength alone, made without wavelength=..."
        )
    if isinstance(value, Material) and depends_on_wavelength(value):
        return value
    several = isinstance(value, (list, tuple)) or is_traced(value)
    array = None if several else INDEX.check(owner, value)
    if array is None or array.ndim:
        cure = Cure.of(
            "give one, such as {}, and make a sample for each".format,
            "1.5 or 0.5+2.1j",
            "1.5 or { n = 0.5, k = 2.1 }",
        )
        fault = Fault(f"{owner} is {shown(value)}, but a sample has one index there", cure)
        raise SurfaceError(fault)
    if clear:
        _refuse_absorbing(owner, array)
    number = complex(array)
    return number if number.imag else number.real


def depends_on_wavelength(medium: Any) -> bool:
    """Tell whether n or k of a medium follows from a curve."""
    return any(isinstance(part, CurveValue) for part in _parts(medium))


def _parts(medium: Any) -> tuple[Any, ...]:
    return (medium.n, medium.k) if isinstance(medium, Material) else (medium,)


def _open_names(medium: Any) -> list[str]:
    """Return the parameters that a medium follows from, but for the usual wavelength."""
    parts = _parts(medium)
    several = [part.depends_on if isinstance(part, CurveValue) else (part,) for part in parts]
    known = [one for each in several for one in each if isinstance(one, Parameter)]
    return [one.name for one in known if one != Wavelength()]


def _refuse_absorbing(owner: str, index: npt.NDArray[Any]) -> None:
    if np.any(index.imag):
        number = index[index.imag != 0.0].flat[0]
        raise SurfaceError(
            f"{owner} is {number}, which absorbs; give a real index of refraction, since only the "
            f"last medium may absorb, or of a material its n alone, Material(glass.n)"
        )


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
    """Return the indices of media, the base last. Units: wavelength in metres."""
    dependent = next(filter(depends_on_wavelength, media.values()), None)
    if dependent is not None and wavelength is None:
        cure = Cure.of("give one, {}".format, "such as '550 nm'", "--wavelength '550 nm'")
        raise SurfaceError(Fault(f"{dependent} depends on the wavelength", cure))
    if dependent is None and wavelength is not None:
        raise SurfaceError("wavelength is given, but no medium depends on it; leave it out")
    if is_traced(wavelength):
        raise SurfaceError("wavelength is traced by JAX, but samples have no slopes; give a number")
    *above, base = media
    faults, results = Faults(), dict[str, Any]()
    for place, medium in media.items():
        results[place] = faults.attempt(
            "", _index_at, place, medium, wavelength, clear=place != base
        )
    if faults:
        raise SurfaceError(*dict.fromkeys(faults))
    shape = np.broadcast_shapes(*(index.shape for index in results.values()))
    n, k = (
        np.array(np.broadcast_to(part, shape)) for part in (results[base].real, results[base].imag)
    )
    if not n.size:
        raise SurfaceError("wavelength is empty; give one or more")
    faults += [
        f"{place} differs from wavelength to wavelength, and so do the ways of light below it; "
        f"give one wavelength at a time"
        for place in above
        if np.ptp(results[place].real)
    ]
    if np.size(results[base]) > 1 and not np.all(k):
        faults.append(
            f"{base} lets light through, whose ways differ from wavelength to wavelength; give one "
            f"wavelength at a time"
        )
    if faults:
        raise SurfaceError(*faults)
    outside, *inner = [float(results[place].real.flat[0]) for place in above]
    return SampleIndices(outside, tuple(inner), n, k)


def _index_at(place: str, medium: Any, wavelength: Any, *, clear: bool) -> npt.NDArray[Any]:
    """Return the index n + ik of a medium at the wavelengths that are given."""
    if not depends_on_wavelength(medium):
        return np.asarray(medium, complex)
    try:
        there = medium.at(wavelength)
    except OptipathError as error:
        raise SurfaceError(*(fault.under(place) for fault in error.faults)) from None
    index = np.asarray(there.n) + 1j * np.asarray(there.k)
    index = INDEX.check(place, index)
    if clear:
        _refuse_absorbing(place, index)
    return index
