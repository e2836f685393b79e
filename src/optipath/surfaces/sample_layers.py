"""Layers of a sample: rough interfaces, media and their indices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import Cure, Fault, SurfaceError, shown
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
    results = []
    for place, layer in enumerate(argument):
        owner, clear, file = f"layers[{place}]", place < len(argument) - 1, ""
        pair = layer
        if isinstance(layer, SampleLayer):
            pair, file = (layer.index, layer.roughness), layer.file
        if not isinstance(pair, (tuple, list)) or len(pair) != 2:
            faults.append(f"{owner} is {shown(layer)}; give an index and a roughness: (1.5, 0.1)")
            continue
        index: Any = faults.attempt("", medium_of, f"{owner}.index", pair[0], clear=clear)
        rough: Any = faults.attempt("", _roughness_of, f"{owner}.alpha", pair[1])
        results.append(SampleLayer(index, rough, file))
    return () if faults else tuple(results)


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
    """Return a medium as a sample keeps it; one that is clear does not absorb."""
    parts = [part.depends_on if isinstance(part, CurveValue) else (part,) for part in _parts(value)]
    known = [one for part in parts for one in part if isinstance(one, Parameter)]
    for one in known:
        if one != Wavelength():
            raise SurfaceError(
                f"{owner} follows from the parameter '{one.name}'; give numbers, or a Material "
                f"that follows from the wavelength alone, made without wavelength=..."
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
    faults = Faults()
    results: dict[str, Any] = {
        place: faults.attempt("", _index_at, place, medium, wavelength, clear=place != base)
        for place, medium in media.items()
    }
    if faults:
        raise SurfaceError(*dict.fromkeys(faults))
    last = np.broadcast_arrays(*results.values())[-1]
    n, k = np.array(last.real), np.array(last.imag)
    if not n.size:
        raise SurfaceError("wavelength is empty; give one or more")
    several = [place for place in above if np.ptp(results[place].real)]
    several += [base] if results[base].size > 1 and not np.all(k) else []
    if several:
        raise SurfaceError(*(_ONE_AT_A_TIME.format(place) for place in several))
    outside, *inner = [float(results[place].real.flat[0]) for place in above]
    return SampleIndices(outside, tuple(inner), n, k)


_ONE_AT_A_TIME = (
    "{} lets light through, whose ways differ from wavelength to wavelength; give one wavelength "
    "at a time"
)


def _index_at(place: str, medium: Any, wavelength: Any, *, clear: bool) -> npt.NDArray[Any]:
    """Return the index n + ik of a medium at the wavelengths that are given."""
    if not depends_on_wavelength(medium):
        return np.asarray(medium, complex)
    faults = Faults()
    there: Any = faults.attempt(place, medium.at, wavelength)
    if faults:
        raise SurfaceError(*faults)
    index = INDEX.check(place, np.asarray(there.n) + 1j * np.asarray(there.k))
    if clear:
        _refuse_absorbing(place, index)
    return index
