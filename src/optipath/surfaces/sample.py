"""Sample: rough or flat interfaces one below the other, with the media between them."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.elements.layer_stack import LayerStack
from optipath.errors import SurfaceError
from optipath.faults import Cure, Fault, shown
from optipath.materials.index_domains import INDEX
from optipath.materials.material import Material
from optipath.materials.quantities import YES_OR_NO
from optipath.paths.files.schema import Faults
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.random_field import cells_of
from optipath.values.arrays import ComparedByFields, Unchanging
from optipath.values.curve_value import CurveValue
from optipath.values.jax_values import is_traced
from optipath.values.parameters import Parameter
from optipath.values.precision import real_number, whole_number
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from optipath.surfaces.photon import Photon


Roughness: TypeAlias = tuple[float, float] | HeightField

_LEAST, _MOST = 1e-6, 100.0
"""Beyond, squares of heights and of lengths that are of their size are no numbers."""


@dataclasses.dataclass(frozen=True, eq=False)
class SampleLayer(ComparedByFields):
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
    for one in [one for part in parts for one in part]:
        if isinstance(one, Parameter) and one != Wavelength():
            raise SurfaceError(
                f"{owner} follows from the parameter '{one.name}'; give numbers, or a Material "
                f"that follows from the wavelength alone, made without wavelength=..."
            )
    if isinstance(value, Material) and depends_on_wavelength(value):
        return value
    several = isinstance(value, (list, tuple)) or is_traced(value)
    array = None if several else INDEX.check(owner, value)
    if array is None or array.ndim:
        how = "give one, such as {}, and make a sample for each".format
        cure = Cure.of(how, "1.5 or 0.5+2.1j", "1.5 or { n = 0.5, k = 2.1 }")
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
    SurfaceError.raise_for(faults)
    last = np.broadcast_arrays(*results.values())[-1]
    n, k = np.array(last.real), np.array(last.imag)
    if not n.size:
        raise SurfaceError("wavelength is empty; give one or more")
    several = [place for place in above if np.ptp(results[place].real)]
    several += [base] if results[base].size > 1 and not np.all(k) else []
    if several:
        why = "lets light through, whose ways differ from wavelength to wavelength; give one"
        raise SurfaceError(*(f"{place} {why} wavelength at a time" for place in several))
    outside, *inner = [float(results[place].real.flat[0]) for place in above]
    return SampleIndices(outside, tuple(inner), n, k)


def _index_at(place: str, medium: Any, wavelength: Any, *, clear: bool) -> npt.NDArray[Any]:
    """Return the index n + ik of a medium at the wavelengths that are given."""
    if not depends_on_wavelength(medium):
        return np.asarray(medium, complex)
    faults = Faults()
    there: Any = faults.attempt(place, medium.at, wavelength)
    SurfaceError.raise_for(faults)
    index = INDEX.check(place, np.asarray(there.n) + 1j * np.asarray(there.k))
    if clear:
        _refuse_absorbing(place, index)
    return index


_WIDTH = 80.0
"""How wide a field is, over alpha: 40 correlation lengths 2 / alpha."""


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Sample(Unchanging, ComparedByFields):
    """Rough or flat interfaces one below the other, and the media between them.

    Heights over x and y, lengths of the fields and wavelengths are no part of each other: light
    is rays, which neither bend round edges nor interfere. Media do not absorb, but for the last.

    Parameters
    ----------
    layers : sequence of pair
        From the top, the index of the medium below an interface and the interface's roughness:
        alpha (the slopes have the density exp(-tan^2 / alpha^2) / (pi alpha^2), 0 is flat), a pair
        of alpha along x and y, or a `HeightField`. The last medium may absorb, n + ik, and is
        opaque then; ``1j`` makes a perfect mirror of it.
    outside : float or Material, optional
        The medium above.
    cells : int or pair of int, optional
        How many cells random fields have along x and y; 640, which are 16 a correlation length
        2 / alpha, by default.
    surfaces : int, optional
        How many realisations of random fields light is spread over at a time, since the
        statistics of one finite field differ a little from those that are meant. After some
        million photons each, others are drawn.
    seed : int, optional
        What random fields begin with. Surface number i of layer number j has the seed
        ``SeedSequence(seed, spawn_key=(i, j))``.
    periodic : bool, optional
        Whether random fields go on beyond their border, so that no light is lost there.
    description : str, optional
        One line about it, as its file has it.

    Examples
    --------
    >>> sample = Sample([(1.5, 0.1), (2.4, (0.1, 0.2))])
    >>> sample, sample.isotropic
    (Sample([(1.5, 0.1), (2.4, (0.1, 0.2))]), False)
    >>> from optipath.materials.material import Material
    >>> Sample([(Material.cauchy([1.5, 0.004]), 0.0)]).indices("500 nm").n
    array(1.516)
    """

    layers: Sequence[Any]
    outside: float | Material = 1.0
    cells: int | tuple[int, int] | None = None
    surfaces: int = 16
    seed: int = 0
    periodic: bool = True
    description: str = ""

    def __post_init__(self) -> None:
        """Keep what is given as it is meant; refuse all faults."""
        faults = Faults()
        outside = faults.attempt("", medium_of, "outside", self.outside, clear=True)
        layers = layers_of(self.layers, faults)
        cells = None if self.cells is None else cells_of(self.cells, faults)
        faults += whole_number("surfaces", self.surfaces) + whole_number("seed", self.seed, 0)
        periodic = faults.attempt("", YES_OR_NO.check, "periodic", self.periodic)
        if cells is not None and layers and not any(layer.is_random for layer in layers):
            faults.append("cells is given, but no interface is random; leave it out")
        SurfaceError.raise_for(faults)
        surfaces, seed = int(self.surfaces), int(self.seed)
        stored = {"outside": outside, "cells": cells, "surfaces": surfaces, "seed": seed}
        vars(self).update(stored, layers=layers, periodic=periodic)

    @property
    def isotropic(self) -> bool:
        """Whether no direction along the surface is any other."""
        return all(layer.isotropic for layer in self.layers)

    @property
    def is_random(self) -> bool:
        """Whether the heights of an interface are drawn."""
        return any(layer.is_random for layer in self.layers)

    @property
    def is_flat(self) -> bool:
        """Whether all interfaces are planes that go on for ever."""
        return all(layer.is_flat for layer in self.layers)

    def fields(self, surface: int = 0) -> tuple[HeightField, ...]:
        """Return the heights of all interfaces, from the top, for a realisation of random ones.

        As many as take turns are kept; others are drawn when they are asked for, with the same
        bits. A `MeshWarning` tells of too few cells for the roughness.

        >>> Sample([(1.5, 0.25)], cells=320).fields(3)
        (HeightField.beckmann of alpha (0.25, 0.25), 320 x 320 cells, 320 x 320, periodic,)
        """
        known: dict[int, tuple[HeightField, ...]] = vars(self).setdefault("_drawn", {})
        if surface not in known:
            drawn = tuple(self._field(int(surface), place) for place in range(len(self.layers)))
            if len(known) >= self.surfaces:
                known.pop(next(iter(known)))
            known[surface] = drawn
        return known[surface]

    def indices(self, wavelength: Any = None) -> SampleIndices:
        """Return the indices of refraction of all media.

        The wavelength in vacuum, in metres or as a text such as ``"550 nm"``, is for media that
        depend on it. Where there are several, the base alone may, and must be opaque. The numbers
        ``outside`` and ``inner`` are floats; ``n`` and ``k`` of the base have the shape of the
        wavelengths.

        >>> Sample([(1.5, 0.1), (0.5 + 2.1j, 0.3)]).indices()
        SampleIndices(outside=1.0, inner=(1.5,), n=array(0.5), k=array(2.1))
        """
        return indices_of(self._media, wavelength)

    def smooth(self, incidence: Any = None) -> LayerStack:
        """Return the same media with flat interfaces, between which light goes to and fro.

        The angle of incidence is in radians; the parameter ``incidence`` by default.

        >>> stack = Sample([(1.5, 0.1), (2.4, 0.1)]).smooth("65 deg")
        >>> print(stack.mueller("in", "reflected").matrix[0, 0].round(5))
        0.16024
        """
        angle = Parameter("incidence") if incidence is None else incidence
        return LayerStack([*self._media.values()], angle)

    def photon(
        self,
        number: int,
        incidence: Any = 0.0,
        *,
        seed: int = 0,
        azimuth: Any = 0.0,
        wavelength: str | npt.ArrayLike | None = None,
        stokes: npt.ArrayLike = (1.0, 0.0, 0.0, 0.0),
        most_events: int = 1000,
    ) -> Photon:
        """Return one of the photons that `energy` counts, with all that happens to it.

        Parameters
        ----------
        number : int
            Which photon, from 0. Those of its block of 16384 that come before it are walked, too.
        incidence, seed, azimuth, wavelength, stokes, most_events : optional
            As `energy` takes them. On an isotropic sample each photon has an azimuth of its own.

        Returns
        -------
        Photon

        Raises
        ------
        SurfaceError
            With all faults at once, or if photons meet nothing of a finite field.

        Examples
        --------
        >>> from optipath.surfaces.sample import Sample
        >>> photon = Sample([(1.5, 0.0)]).photon(3, "40 deg")
        >>> photon
        <Photon 3 of seed 0: down after 1 event>
        >>> print(photon.events[0].onwards[2].round(6))
        -0.90353
        """
        from optipath.surfaces import photon  # noqa: PLC0415 - replays samples

        light = {"azimuth": azimuth, "wavelength": wavelength, "stokes": stokes}
        options = light | {"seed": seed, "most_events": most_events}
        return photon.replayed_photon(self, number, incidence, **options)

    def to_toml(self) -> str:
        """Return the sample as the text of a file; `load_sample` gives the sample back.

        Heights that are in no file, and materials without a form in files, are refused.
        """
        from optipath.surfaces.sample_files import toml_of  # noqa: PLC0415 - reads samples

        return toml_of({"description": self.description, **self._unusual()}, self.layers)

    def _field(self, surface: int, place: int) -> HeightField:
        layer = self.layers[place]
        if isinstance(layer.roughness, HeightField):
            return layer.roughness
        if not layer.is_random:
            return HeightField.flat()
        along_x, along_y = layer.roughness
        return HeightField.beckmann(
            along_x,
            along_y,
            size=(_WIDTH / along_x, _WIDTH / along_y),
            cells=self.cells,
            seed=np.random.SeedSequence(self.seed, spawn_key=(surface, place)),
            periodic=self.periodic,
        )

    @property
    def _media(self) -> dict[str, Any]:
        """The media by their places, from above."""
        below = {f"layers[{place}].index": each.index for place, each in enumerate(self.layers)}
        return {"outside": self.outside, **below}

    def _unusual(self) -> dict[str, Any]:
        """Return what is given besides the layers, and is not what it is by default."""
        usual = {each.name: each.default for each in dataclasses.fields(self)}
        arguments = {name: getattr(self, name) for name in usual if name != "layers"}
        return {name: value for name, value in arguments.items() if value != usual[name]}

    def __repr__(self) -> str:
        others = [f"{name}={value!r}" for name, value in self._unusual().items()]
        return f"Sample({', '.join([repr([*self.layers]), *others])})"

    def __getstate__(self) -> dict[str, Any]:
        # Random fields are drawn again, with the same bits.
        return {each.name: getattr(self, each.name) for each in dataclasses.fields(self)}
