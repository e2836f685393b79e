"""Sweeps in memory: one run of the whole grid, variables as views."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Self
from uuid import uuid4

import numpy as np
from xarray.backends import BackendArray
from xarray.core import indexing

from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.light.quantities import COMPONENTS, DERIVED
from optipath.plan.noise import noise_at
from optipath.sweeps.datasets import detectors_of, regions, sweep_dataset
from optipath.sweeps.grid import refuse_more_than_free

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

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

    def data() -> dict[str, Any]:
        refuse_more_than_free(plan, grid.varied)
        found = plan.answers.lights(grid.given())
        lights = tuple([SweptLight(plan, grid, name, found[name]) for name in detectors_of(plan)])
        results: dict[str, Any] = {each.variable: derived(each, lights) for each in DERIVED}
        parts = zip(*[light.components for light in lights], strict=True)
        for each, several in zip(COMPONENTS, parts, strict=True):
            results[each.variable] = several[0] if len(several) == 1 else np.stack(several)
        return results

    return sweep_dataset(path, plan, grid, composer, data)


_AT_ONCE = 1 << 17
"""Of how many lights something is computed at a time: what is made on the way stays small."""


class SweptLight:
    """The light of a run at one detector: its components are views that cannot be written to."""

    def __init__(self, plan: Plan, grid: SweepGrid, detector: str, stokes: Any) -> None:
        self.plan, self.grid, self.detector = plan, grid, detector
        self.dtype = np.dtype(plan.dtype)
        parts = stokes if type(stokes) is tuple else np.moveaxis(np.asarray(stokes), -1, 0)
        self.components = tuple([np.broadcast_to(part, grid.shape) for part in parts])

    def computed(self, quantity: LightQuantity, key: Sequence[int | slice]) -> Array:
        """Return a quantity of a part of the grid."""
        cuts = [
            index if isinstance(index, slice) else slice(index, index + 1 or None) for index in key
        ]
        part = self.grid.part(cuts)
        ran = part.varied
        held = [slice(size) for size in ran.shape]
        stokes = [each[*cuts][*held] for each in self.components]
        result = np.empty(ran.shape, self.dtype)
        for region in regions(ran.shape, _AT_ONCE) if result.size else ():
            # Values of the part alone, so that nothing of the whole is looked at for its noise.
            noise = (noise_at, self.plan.answers, self.detector, ran.part(region).given(), ())
            light = Light.of(tuple([each[region] for each in stokes]), Frame(), noise=noise)
            result[region] = quantity.of(light)
        ends = tuple([slice(None) if isinstance(index, slice) else 0 for index in key])
        return (result if ran is part else np.broadcast_to(result, part.shape).copy())[ends]


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
    """Return the data of a variable that is computed once, of what is asked for.

    The wrappers have no public name, and xarray's page on new backends imports them like this. An
    array of NumPy would be computed at once, one of Dask anew each time it is read.
    """
    data: Any = indexing.LazilyIndexedArray(DerivedVariable(quantity, lights))
    data = indexing.CopyOnWriteArray(data)
    cached: Any = indexing.MemoryCachedArray
    return cached(data)
