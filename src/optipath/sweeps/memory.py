"""Sweeps in memory: one run of the whole grid, variables as views."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING, Any, Self
from uuid import uuid4

import numpy as np
import xarray as xr
from xarray.backends import BackendArray
from xarray.core import indexing

from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.light.quantities import COMPONENTS, DERIVED
from optipath.plan.noise import noise_at
from optipath.plan.reading import pieces
from optipath.sweeps.datasets import (
    attributes_of,
    coordinates_of,
    dataset_attributes,
    dimensions_of,
)
from optipath.sweeps.grid import refuse_more_than_free
from optipath.sweeps.labels import detectors_of, variable_names

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.composer.composer import Composer
    from optipath.light.quantities import LightQuantity
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepGrid

    Array = np.ndarray[Any, Any]


def swept_in_memory(
    path: PathGraph, plan: Plan, grid: SweepGrid, composer: Composer | None = None
) -> xr.Dataset:
    """Return the light of a grid."""
    names, dims = variable_names(grid, plan), dimensions_of(grid, plan)
    coords = coordinates_of(grid, plan)
    refuse_more_than_free(plan, grid.varied)
    result = plan.answers.lights(grid.given())
    lights = tuple([SweptLight(plan, grid, name, result[name]) for name in detectors_of(plan)])
    variables: dict[str, Any] = {}
    each = zip(*[light.components for light in lights], strict=True)
    for quantity, parts in zip(COMPONENTS, each, strict=True):
        numbers = parts[0] if len(parts) == 1 else np.stack(parts)
        variables[quantity.variable] = dims, numbers, attributes_of(quantity)
    for quantity in DERIVED:
        name = names[quantity.variable]
        variables[name] = dims, derived(quantity, lights), attributes_of(quantity)
    return xr.Dataset(variables, coords, dataset_attributes(path, plan, composer))


_AT_ONCE = 1 << 17
"""Of how many lights something is computed at a time: what is made on the way stays small."""


@dataclass(frozen=True, eq=False)
class SweptLight:
    """The light of a run at one detector: stokes (..., 4)."""

    plan: Plan
    grid: SweepGrid
    detector: str
    stokes: Any

    @property
    def dtype(self) -> np.dtype[Any]:
        """The precision of the plan."""
        return np.dtype(self.plan.dtype)

    @property
    def components(self) -> tuple[Array, ...]:
        """S0 to S3, of the shape of the grid: views that cannot be written to."""
        stokes = self.stokes
        parts = stokes if type(stokes) is tuple else np.moveaxis(np.asarray(stokes), -1, 0)
        return tuple(np.broadcast_to(part, self.grid.shape) for part in parts)

    def part(self, region: Sequence[slice]) -> Light:
        """Return the light of a part of what was run, which knows what of it is noise."""
        ran = self.grid.varied
        # Values of the part alone, so that nothing of the whole is looked at for its noise.
        argument = ran.given(region)
        noise = (noise_at, self.plan.answers, self.detector, argument, ())

        def cut(numbers: Any) -> Array:
            return np.broadcast_to(numbers, ran.shape)[tuple(region)]

        if type(self.stokes) is tuple:
            parts: Any = tuple(map(cut, self.stokes))
        else:
            parts = np.broadcast_to(self.stokes, (*ran.shape, 4))[*region, :]
        return Light.of(parts, Frame(), noise=noise)

    def computed(self, quantity: LightQuantity, key: Sequence[int | slice]) -> Array:
        """Return a quantity of a part of the grid."""
        axes = [
            _places(range(size), index) for size, index in zip(self.grid.shape, key, strict=True)
        ]
        whole = tuple(map(len, axes))
        for place, size in enumerate(self.grid.varied.shape):
            if size < self.grid.shape[place]:
                axes[place] = range(min(len(axes[place]), 1))
        shape = tuple(map(len, axes))
        result = np.empty(prod(shape), self.dtype)
        for piece in pieces(shape, _AT_ONCE) if result.size else ():
            where = (*piece.where, *[slice(None)] * (len(axes) - len(piece.where)))
            several = [_places(axis, index) for axis, index in zip(axes, where, strict=True)]
            light = self.part([slice(axis.start, axis.stop, axis.step) for axis in several])
            result[piece.start : piece.stop] = np.ravel(quantity.of(light))
        ends = tuple(slice(None) if isinstance(index, slice) else 0 for index in key)
        result = result.reshape(shape)
        return (result if shape == whole else np.broadcast_to(result, whole).copy())[ends]


def _places(axis: range, index: int | slice) -> range:
    """Return the places of an axis that an index takes."""
    if isinstance(index, slice):
        return axis[index]
    place = axis[index]
    return range(place, place + 1)


class DerivedVariable(BackendArray):
    """The numbers of a quantity over a grid; a part of it costs what the part does."""

    def __init__(self, quantity: LightQuantity, lights: tuple[SweptLight, ...]) -> None:
        self.quantity = quantity
        self.lights = lights
        front = (len(lights),) if len(lights) > 1 else ()
        self.shape = (*front, *lights[0].grid.shape)
        self.dtype = lights[0].dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        basic = indexing.IndexingSupport.BASIC
        return indexing.explicit_indexing_adapter(key, self.shape, basic, self._part)

    def _part(self, key: Sequence[int | slice]) -> Any:
        if len(self.lights) == 1:
            return self.lights[0].computed(self.quantity, key)
        first, *rest = key
        if isinstance(first, slice):
            return np.stack([light.computed(self.quantity, rest) for light in self.lights[first]])
        return self.lights[first].computed(self.quantity, rest)

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        # Light does not change.
        return self

    @cached_property
    def token(self) -> str:
        """What tells it from others: random, as its numbers may not be there yet."""
        return uuid4().hex

    def __dask_tokenize__(self) -> tuple[str, str]:
        return type(self).__name__, self.token


def derived(quantity: LightQuantity, lights: tuple[SweptLight, ...]) -> Any:
    """Return the data of a variable that is computed once, of what is asked for."""
    data: Any = indexing.LazilyIndexedArray(DerivedVariable(quantity, lights))
    data = indexing.CopyOnWriteArray(data)
    cached: Any = indexing.MemoryCachedArray
    return cached(data)
