"""SampleLayer: a rough interface of a sample, and the medium below it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.errors import SurfaceError, shown
from optipath.paths.format.faults import Faults
from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.samples.sample_media import medium_of
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import same_fields
from optipath.values.domains.domain import Domain
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from optipath.values.materials import Material

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


def layer_of(owner: str, given: Any, domain: Domain) -> SampleLayer:
    """Return a layer as a sample keeps it."""
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


def _roughness_of(owner: str, given: Any) -> Roughness:
    """Return the roughness along x and y, or heights as they are given."""
    if isinstance(given, HeightField):
        return given
    given = given.tolist() if isinstance(given, np.ndarray) else given
    both = given if isinstance(given, (tuple, list)) else (given, given)
    if len(both) != 2:
        raise SurfaceError(
            f"{owner} is {shown(given)}; give one number, a pair along x and y, or heights"
        )
    along_x, along_y = [_alpha_of(owner, one) for one in both]
    if (along_x == 0.0) != (along_y == 0.0):
        raise SurfaceError(
            f"{owner} is {shown(given)}; give two numbers above 0, or 0 for a flat interface"
        )
    return along_x, along_y


def _alpha_of(owner: str, given: Any) -> float:
    if isinstance(given, Parameter) or is_traced(given):
        what = given.called if isinstance(given, Parameter) else "traced by JAX"
        raise SurfaceError(f"{owner} is {what}; give a number, and make a sample for each")
    found = ALPHA.check(owner, given)
    if found.ndim:
        raise SurfaceError(f"{owner} has {shown(given)} for one number; give a pair along x and y")
    return float(found)
