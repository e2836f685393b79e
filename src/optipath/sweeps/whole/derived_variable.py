"""A variable that is computed of the light of a sweep when somebody asks for its values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self
from uuid import uuid4

import numpy as np
from xarray.backends import BackendArray
from xarray.core import indexing

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.sweeps.labels.light_quantities import LightQuantity
    from optipath.sweeps.whole.swept_light import SweptLight


class DerivedVariable(BackendArray):
    """The numbers of a quantity over a grid; a part of it costs what the part does."""

    def __init__(self, quantity: LightQuantity, lights: tuple[SweptLight, ...]) -> None:
        self.quantity = quantity
        self.lights = lights
        front = (len(lights),) if len(lights) > 1 else ()
        self.shape = (*front, *lights[0].grid.shape)
        self.dtype = lights[0].dtype
        self.token = uuid4().hex

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

    def __dask_tokenize__(self) -> tuple[str, str]:
        return type(self).__name__, self.token


def derived(quantity: LightQuantity, lights: tuple[SweptLight, ...]) -> Any:
    """Return the data of a variable that is computed once, of what is asked for."""
    data: Any = indexing.LazilyIndexedArray(DerivedVariable(quantity, lights))
    data = indexing.CopyOnWriteArray(data)
    cached: Any = indexing.MemoryCachedArray
    return cached(data)
