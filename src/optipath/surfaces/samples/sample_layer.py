"""SampleLayer: a rough interface of a sample, and the medium below it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

from optipath.errors import OptipathError, SurfaceError, shown
from optipath.paths.format.faults import Faults
from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.samples.sample_media import medium_of
from optipath.values.arrays.read_only import same_fields
from optipath.values.domains.domain import Domain
from optipath.values.materials import Material
from optipath.values.parameters import Parameter

Roughness: TypeAlias = tuple[float, float] | HeightField

_ALPHA = Domain("roughness", minimum=0.0, maximum=10.0)


@dataclass(frozen=True, eq=False)
class SampleLayer:
    """An interface of a sample, and the medium below it.

    Attributes
    ----------
    index : float, complex or Material
        The index of refraction of the medium.
    roughness : tuple of float or HeightField
        The roughness alpha along x and along y, (0, 0) of a flat interface; or its heights.
    file : str
        The file that the heights were read from, beside that of the sample; nothing for others.
    """

    index: float | complex | Material
    roughness: Roughness
    file: str = ""

    @property
    def is_random(self) -> bool:
        """Whether its heights are drawn."""
        return isinstance(self.roughness, tuple) and self.roughness != (0.0, 0.0)

    @property
    def isotropic(self) -> bool:
        """Whether no direction is any other."""
        rough = self.roughness
        return rough.isotropic if isinstance(rough, HeightField) else rough[0] == rough[1]

    def __repr__(self) -> str:
        rough = self.roughness
        alike = isinstance(rough, tuple) and rough[0] == rough[1]
        return f"({self.index!r}, {rough[0] if alike else rough!r})"

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]


def layer_of(owner: str, given: Any, domain: Domain) -> SampleLayer:
    """Return a layer as a sample keeps it.

    Parameters
    ----------
    owner : str
        Where it stands, as sentences name it.
    given : tuple or SampleLayer
        The index of the medium below, and the roughness.
    domain : Domain
        What the index may be.

    Returns
    -------
    SampleLayer

    Raises
    ------
    SurfaceError
        With all that is wrong with it.
    """
    file = given.file if isinstance(given, SampleLayer) else ""
    if isinstance(given, SampleLayer):
        given = given.index, given.roughness
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise SurfaceError(
            f"{owner} is {shown(given)}; give a pair of the index of refraction below and the "
            f"roughness, such as (1.5, 0.1)"
        )
    faults = Faults()
    index = faults.attempt("", medium_of, f"{owner}.index", given[0], domain)
    roughness = faults.attempt("", _roughness_of, f"{owner}.alpha", given[1])
    if faults or index is None or roughness is None:
        raise SurfaceError(*faults)
    return SampleLayer(index, roughness, file)
