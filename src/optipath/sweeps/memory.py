"""Sweeps in memory: one run of the whole grid, variables as views."""

from __future__ import annotations

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
    from collections.abc import Mapping, Sequence

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
        lights = {name: _components(found[name], grid.shape) for name in detectors_of(plan)}
        results = {each.variable: derived(each, plan, grid, lights) for each in DERIVED}
        for each, several in zip(COMPONENTS, zip(*lights.values(), strict=True), strict=True):
            results[each.variable] = several[0] if len(several) == 1 else np.stack(several)
        return results

    return sweep_dataset(path, plan, grid, composer, data)


def _components(stokes: Any, shape: tuple[int, ...]) -> list[Array]:
    """Return S0 to S3 of a run, of the shape of its grid: views that cannot be written to."""
    parts = stokes if type(stokes) is tuple else np.moveaxis(np.asarray(stokes), -1, 0)
    return [np.broadcast_to(part, shape) for part in parts]


_AT_ONCE = 1 << 17
"""Of how many lights something is computed at a time: what is made on the way stays small."""


class DerivedVariable(BackendArray):
    """The numbers of a quantity over a grid; a part of it costs what the part does."""

    def __init__(
        self, quantity: LightQuantity, plan: Plan, grid: SweepGrid, lights: Mapping[str, Any]
    ) -> None:
        self.quantity, self.plan, self.grid, self.lights = quantity, plan, grid, lights
        self.shape = (*[len(lights)] * (len(lights) > 1), *grid.shape)
        self.dtype = np.dtype(plan.dtype)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        basic = indexing.IndexingSupport.BASIC
        return indexing.explicit_indexing_adapter(key, self.shape, basic, self._part)

    def _part(self, key: Sequence[int | slice]) -> Any:
        several = key if len(self.lights) > 1 else (0, *key)
        which, *cuts = [p if isinstance(p, slice) else slice(p, p + 1 or None) for p in several]
        names, part = [*self.lights][which], self.grid.part(cuts)
        ran = part.varied
        held = tuple([slice(size) for size in ran.shape])
        result = np.empty((len(names), *ran.shape), self.dtype)
        for place, name in enumerate(names):
            stokes = [each[*cuts][*held] for each in self.lights[name]]
            for region in regions(ran.shape, _AT_ONCE) if result.size else ():
                # Values of the part alone, so that nothing of the whole is looked at for its noise.
                noise = (noise_at, self.plan.answers, name, ran.part(region).given(), ())
                light = Light.of(tuple([each[region] for each in stokes]), Frame(), noise=noise)
                result[place, ...][region] = self.quantity.of(light)
        if ran is not part:
            result = np.broadcast_to(result, (len(names), *part.shape)).copy()
        return result[tuple([slice(None) if isinstance(p, slice) else 0 for p in several])]

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        # Light does not change.
        return self

    def __dask_tokenize__(self) -> tuple[str, str]:
        # Random, as its numbers may not be there yet.
        return type(self).__name__, vars(self).setdefault("token", uuid4().hex)


def derived(quantity: LightQuantity, *of: Any) -> Any:
    """Return the data of a variable that is computed once, of what is asked for.

    The wrappers have no public name: xarray's page on new backends imports them like this, and
    `xarray.open_dataset`, which has them as well, wraps the components and takes longer than a run.
    An array of NumPy would be computed at once, one of Dask anew each time it is read; one of
    another class comes back to the user, whom ``.data`` gives an array of NumPy here.
    """
    data: Any = indexing.LazilyIndexedArray(DerivedVariable(quantity, *of))
    data = indexing.CopyOnWriteArray(data)
    cached: Any = indexing.MemoryCachedArray
    return cached(data)
